"""Parts of a table that grows: whole rows only, from any place where a row begins."""

import pytest

from lasersph.output import OutputError
from lasersph.output.growing_table import LARGEST_PART, last_row, new_rows, some_values


@pytest.fixture
def table(tmp_path):
    """A table of three rows and a torn one."""
    path = tmp_path / "history.csv"
    path.write_bytes(b"time_s,limit,value\n0.0,,1.0\n1.0,end,2.0\n2.0,end,3.0\n3.0,en")
    return path


def test_whole_rows_come_in_order(table):
    """The torn row comes when it is whole."""
    rows, following = new_rows(table, 0)
    assert rows.count(b"\n") == 4
    assert new_rows(table, following) == (b"", following)
    with table.open("ab") as stream:
        stream.write(b"d,4.0\n")
    assert new_rows(table, following)[0] == b"3.0,end,4.0\n"


def test_table_that_was_cut_back_gives_nothing_until_it_is_long_again(table):
    """A resumed run writes the same bytes again."""
    _, following = new_rows(table, 0)
    table.write_bytes(table.read_bytes()[: following - 12])
    assert new_rows(table, following) == (b"", following)


@pytest.mark.parametrize("start", [-5, 3])
def test_places_where_no_row_begins_are_refused(table, start):
    """A negative place, and one inside of a row."""
    with pytest.raises(ValueError, match=r"negative|no row begins"):
        new_rows(table, start)


def test_part_is_never_larger_than_its_limit(tmp_path):
    """A long table comes in parts that join to the whole."""
    path = tmp_path / "history.csv"
    path.write_bytes(b"a,b\n" + b"1.0,2.0\n" * (LARGEST_PART // 6))
    parts, start = [], 0
    while True:
        part, start = new_rows(path, start)
        if not part:
            break
        assert len(part) <= LARGEST_PART
        parts.append(part)
    assert len(parts) == 2
    assert b"".join(parts) == path.read_bytes()


def test_last_row(table, tmp_path):
    """Numbers by column; words are left out; nothing of a table that has no row yet."""
    assert last_row(table) == {"time_s": 2.0, "value": 3.0}
    empty = tmp_path / "empty.csv"
    empty.write_bytes(b"time_s,va")
    assert last_row(empty) == {}


def test_some_values_are_spread_over_the_table(tmp_path):
    """Of many rows some, in their order; of few rows no more than there are."""
    path = tmp_path / "history.csv"
    path.write_text("t,v\n" + "".join(f"{k},{k}\n" for k in range(1000)))
    values = some_values(path, "v", 10)
    assert values == sorted(values)
    assert len(values) == 10 and values[0] == 0 and values[-1] > 850
    assert some_values(path, "missing", 10) == []


def test_missing_table_is_one_line(tmp_path):
    """As of every file of a run folder."""
    with pytest.raises(OutputError, match=r"cannot read .*none\.csv"):
        new_rows(tmp_path / "none.csv", 0)
