"""docs/keys.md is current, and says of each key its kind of value, default and meaning."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "docs" / "_extensions"))
from case_keys import PAGE, keys_page  # noqa: E402  (the folder is no package)

ROWS = [
    [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
    for line in keys_page().splitlines()
    if line.startswith("| `")
]


def test_page_is_current():
    """`python docs/_extensions/case_keys.py` writes it anew."""
    assert PAGE.read_text(encoding="utf-8") == keys_page()


def test_every_key_is_told():
    """No cell is empty, no value is "any", no default leads elsewhere."""
    assert len(ROWS) > 200
    for row in ROWS:
        assert len(row) == 4 and all(row), row
        assert "any" not in row[1].split() and "see its table" not in row[2], row
        assert not re.search(r"\bdefault:", row[3]), row


def test_required_keys_have_no_default():
    """A key that is required names no default in its meaning, and the liquidus is not required."""
    assert not [row for row in ROWS if "required" in row[2] and "default" in row[3]]
    (liquidus,) = (row for row in ROWS if row[0] == "`liquidus`")
    assert liquidus[2] == "that of `base`, else the solidus"


@pytest.mark.parametrize(
    ("key", "kind"),
    [
        ("viscosity", 'viscosity, `"1.3 mPa s"`, or a [law]'),
        ("sulfur", "fraction"),
        ("critical_temperature", "temperature"),
    ],
)
def test_keys_of_a_material_have_their_kind(key, kind):
    """As those of other tables have."""
    assert any(row[0] == f"`{key}`" and row[1].startswith(kind) for row in ROWS)


def test_page_of_cases_leads_there():
    """Its source, too, as a code host shows it."""
    text = (ROOT / "docs" / "cases.md").read_text(encoding="utf-8")
    assert "](keys.md)" in text and "{include}" not in text


def test_brackets_of_a_cell_close():
    """No default is cut within its brackets."""
    assert [cell for row in ROWS for cell in row if cell.count("(") != cell.count(")")] == []
