"""The README fits two screens, and what it says of validations stands in their records."""

import json
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
RECORDS = ROOT / "docs" / "validation"
COMPARED = {
    "its front": ("stefan", r"front after 1000 ns, spacing 100 nm"),
    "temperatures": ("gaussian-pulse", r"T of the particle at the maximum"),
    "speed of its surface": ("marangoni-layer", r"speed of the surface"),
    "heat transfer": ("natural-convection", r"Nusselt number"),
    "its speed": ("moving-recession", r"speed of the surface"),
    "depth of ablation": ("ablation-depth", r"^(15|20) J/cm2 in 10 ns, 0.05 um: with"),
}
"""Validation and numbers of each row of the table, by words of its first cell."""


def rows(head):
    """Cells of the rows of the table below a head."""
    section = README.partition(f"\n## {head}\n")[2].partition("\n## ")[0]
    lines = [line for line in section.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def judged(name):
    """The judged numbers of a validation, as recorded."""
    rows = json.loads((RECORDS / f"{name}.json").read_text(encoding="utf-8"))["rows"]
    return [row for row in rows if row["verdict"] is not None and not row["own"]]


def test_readme_fits_two_screens():
    """A screen shows some 55 lines, a row of a table as many as two."""
    lines = README.splitlines()
    assert len(lines) + sum(line.startswith("|") for line in lines) <= 80


@pytest.mark.parametrize("what", COMPARED)
def test_numbers_differ_by_what_is_said(what):
    """By no more, and what is said is no more than twice that."""
    name, pattern = COMPARED[what]
    (said,) = (cells[2] for cells in rows("Is it right?") if what in cells[0])
    found = [row for row in judged(name) if re.search(pattern, row["quantity"])]
    differences = [abs(row["computed"] / row["reference"] - 1.0) for row in found]
    assert 0.5 * percent(said) <= 100.0 * max(differences) <= percent(said)


def percent(text):
    """The number of a cell as 0.5 %."""
    return float(text.removesuffix(" %"))


def test_every_row_is_compared():
    """None is only said."""
    assert len(rows("Is it right?")) == len(COMPARED)


def test_validations_are_counted():
    """How many there are, and which has numbers that are not met."""
    records = sorted(RECORDS.glob("*.json"))
    missed = {}
    for record in records:
        all_of_it = judged(record.stem)
        if wrong := sum(row["verdict"] is False for row in all_of_it):
            missed[record.stem] = (wrong, len(all_of_it))
    assert f"[{len(records)} validations](docs/validation.md)" in README
    text = " ".join(README.split())
    assert f"; {len(records) - len(missed)} meet all their numbers, " in text
    for name, (wrong, count) in missed.items():
        assert f"`{name}` misses {wrong} of its {count}" in text
