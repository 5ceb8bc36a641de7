"""The times of the README are those of the record, each with what it takes to run it again."""

import json
import re
import sys
from pathlib import Path

import pytest

from lasersph.case import load_case

ROOT = Path(__file__).resolve().parents[3]
RECORD = json.loads((ROOT / "docs" / "times.json").read_text(encoding="utf-8"))
ROWS = RECORD["runs"]
HASH = re.compile(r"\b(?=[0-9a-f]*[0-9])[0-9a-f]{7}\b")
"""A commit, as the record has it."""


@pytest.fixture
def times(monkeypatch):
    """The command that measures them."""
    monkeypatch.syspath_prepend(ROOT / "benchmarks")
    import readme_times

    yield readme_times
    sys.modules.pop("readme_times")


TABLES = {
    "README.md": ("runs",),
    "docs/speed.md": ("runs", "peers"),
    "benchmarks/README.md": ("parts",),
}
"""Lists of the record that each page shows."""
CHANGED = {"runs": {"seconds": 9999.0}, "peers": {"largest": 9.0}, "parts": {"measured": "9"}}


@pytest.mark.parametrize("page", TABLES)
def test_pages_hold_the_record(times, page):
    """A time or a ratio changed by hand in one of them is seen."""
    text = (ROOT / page).read_text(encoding="utf-8")
    assert times.with_tables(text, RECORD) == text
    for name in TABLES[page]:
        first, *others = RECORD[name]
        assert times.with_tables(text, RECORD | {name: [first | CHANGED[name], *others]}) != text


@pytest.mark.parametrize("page", TABLES)
def test_tables_show_no_commit(times, page):
    """The commit of a number stays in the record; pages have its date."""
    made = times.table(ROWS) + times.headline_table(ROWS)
    made += times.peer_table(RECORD["peers"]) + times.part_table(RECORD["parts"])
    listed = [one for name in ("runs", "peers", "parts") for one in RECORD[name]]
    commits = {word for one in listed for word in HASH.findall(one["commit"])}
    text = (ROOT / page).read_text(encoding="utf-8")
    assert commits and not [commit for commit in commits if commit in made + text]
    assert all(one["date"] and one["commit"] and one["machine"] for one in listed)


def test_each_benchmark_is_listed():
    """Every script of the folder stands in its README, and every recorded command is a script."""
    text = (ROOT / "benchmarks" / "README.md").read_text(encoding="utf-8")
    scripts = {file.name for file in (ROOT / "benchmarks").glob("*.py")}
    assert not [name for name in scripts if name not in text]
    named = {part["command"].split("benchmarks/")[1].split()[0] for part in RECORD["parts"]}
    assert named <= scripts


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["name"])
def test_rows_can_be_run(row):
    """Case and settings are read; date, commit and machine are there once it was measured."""
    load_case(row["case"], row["set"])
    if "seconds" in row:
        assert row["date"] and row["commit"] and row["machine"] and row["seconds"] > 0.0


def test_words_of_times(times):
    """Minutes only where there are some."""
    assert times.words_of_time(22.4) == "22 s"
    assert times.words_of_time(119.7) == "2 min 0 s"
