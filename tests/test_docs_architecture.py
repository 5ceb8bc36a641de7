"""What ARCHITECTURE.md shows and names is there: its picture, and the tests of its rules."""

import ast
import re

import pytest
from draw_architecture import ROOT, TARGET, svg, without_implied

NAMED = re.findall(r"`(tests/[\w/]+\.py)(?:::(\w+))?`", (ROOT / "ARCHITECTURE.md").read_text())


def test_picture_is_up_to_date():
    """The stored picture is the one that the imports give now."""
    stored = TARGET.read_text(encoding="utf-8")
    assert stored == svg(), "run: python docs/draw_architecture.py"


def test_implied_imports_have_no_arrow():
    """From a to c over b, the arrow from a to c is left out."""
    imports = {"a": {"b", "c", "d"}, "b": {"c"}, "c": set(), "d": set()}
    assert without_implied(imports) == {"a": ["b", "d"], "b": ["c"], "c": [], "d": []}


@pytest.mark.parametrize(("file", "function"), NAMED)
def test_rules_name_tests_that_exist(file, function):
    """A rule of ARCHITECTURE.md points to a file of tests, or to one test in it."""
    tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
    tests = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    assert function in tests if function else any(name.startswith("test_") for name in tests)
