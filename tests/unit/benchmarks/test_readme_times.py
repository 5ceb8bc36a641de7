"""The times of the README are those of the record, each with what it takes to run it again."""

import json
import sys
from pathlib import Path

import pytest

from lasersph.case import load_case

ROOT = Path(__file__).resolve().parents[3]
RECORD = json.loads((ROOT / "docs" / "times.json").read_text(encoding="utf-8"))
ROWS = RECORD["runs"]


@pytest.fixture
def times(monkeypatch):
    """The command that measures them."""
    monkeypatch.syspath_prepend(ROOT / "benchmarks")
    import readme_times

    yield readme_times
    sys.modules.pop("readme_times")


@pytest.mark.parametrize("page", ["README.md", "docs/speed.md"])
def test_pages_hold_the_record(times, page):
    """A time or a ratio changed by hand in either is seen."""
    text = (ROOT / page).read_text(encoding="utf-8")
    assert times.with_tables(text, RECORD) == text
    slower = [ROWS[0] | {"seconds": 2.0 * ROWS[0]["seconds"]}, *ROWS[1:]]
    assert times.with_tables(text, RECORD | {"runs": slower}) != text
    if page == "README.md":
        peers = [RECORD["peers"][0] | {"largest": 9.0}, *RECORD["peers"][1:]]
        assert times.with_tables(text, RECORD | {"peers": peers}) != text


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
