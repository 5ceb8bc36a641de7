"""Every number that solvers and physics contain says below itself what it is, and why.

Looked at are constants of modules, defaults of settings and defaults of arguments; the page
`docs/methods/numbers.md` is made from what they say.
"""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "docs" / "_extensions"))
from constants_page import (  # noqa: E402  (the folder is no package)
    CITATION,
    REASON,
    constants_in,
    constants_of,
    constants_page,
)

CONSTANTS = constants_of(ROOT / "src" / "lasersph")
REFERENCES = (ROOT / "docs" / "references.bib").read_text(encoding="utf-8")


@pytest.mark.parametrize("constant", CONSTANTS, ids=lambda one: f"{one.file}: {one.name}")
def test_every_number_has_a_reason(constant):
    """It says what it is, one kind of reason, and the reason; of a source, one that is listed."""
    assert len(constant.meaning) > 8, "the docstring below it does not say what it is"
    assert constant.kind, f"no kind of reason, such as 'Guard: ...': {constant.meaning}"
    assert len(constant.reason) > 8 and not REASON.search(constant.reason)
    cited = [found[1] for found in CITATION.finditer(constant.reason)]
    assert all(f"{{{name}," in REFERENCES for name in cited)
    if constant.kind == "Source":
        assert cited or re.search(r"CODATA|standard", constant.reason)


def test_page_has_every_number():
    """With its values, in the table of its room."""
    page = constants_page(CONSTANTS)
    assert len(CONSTANTS) > 100
    for one in CONSTANTS:
        place = one.file.partition("/")[2]
        values = ", ".join(f"{value:.13g}" for value in one.values)
        assert page.count(f"| `{place}: {one.name}` | {values} |") >= 1


def test_what_counts_as_a_number():
    """Constants, tuples and sums of them, tables, defaults; neither 0 and 1 nor words."""
    text = '''
A, B = 0.6, 2
"""Ends of a range [m/s]. Guard: [Xu2009, eq. (3)] says so; `b | c` as well."""
C = 1.0 - 1e-9
D = {1: 0.64, 2: 1.5}
E = ("a", "b")
class Model:
    share: float = Field(default=0.25, description="of it")
    """Accuracy: a quarter is enough."""
    count: int = 0
    other: int = 7
def solve(b, tolerance=1e-4, *, most=200, at_least=1):
    pass
'''
    found = list(constants_in(ast.parse(text), "sph/a.py"))
    assert {one.name: one.values for one in found} == {
        "A, B": [0.6, 2.0], "C": [1.0 - 1e-9], "D": [0.64, 1.5], "Model.share": [0.25],
        "Model.other": [7.0], "solve(tolerance)": [1e-4], "solve(most)": [200.0],
    }  # fmt: skip
    first, share = found[0], next(one for one in found if one.name == "Model.share")
    assert first[3:6] == ("m/s", "Ends of a range", "Guard")
    assert share[3:] == ("1", "Of it", "Accuracy", "a quarter is enough.")
    row = next(line for line in constants_page(found).splitlines() if "A, B" in line)
    assert row == (
        "| `a.py: A, B` | 0.6, 2 | m/s | Ends of a range. *Guard*: "
        "[Xu et al. 2009](../references.md#xu2009), eq. (3) says so; `b | c` as well. |"
    )
