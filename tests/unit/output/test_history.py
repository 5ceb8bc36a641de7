"""history.csv and events.jsonl: exact numbers, cuts, torn lines."""

import math

import numpy as np
import pytest

from lasersph.output.errors import OutputError
from lasersph.output.history import Events, History, read_events, read_history


def rows(count, start=0):
    return [{"time_s": k * 0.1, "step": k, "limit": "pulse"} for k in range(start, start + count)]


def write(path, count):
    history = History(path, buffer_rows=3)
    for row in rows(count):
        history.append(row)
    history.flush(sync=True)
    return history


def test_numbers_read_back_to_the_same_bits(tmp_path):
    """Every double survives, also the ones without a short decimal form."""
    values = [0.1 + 0.2, 1e-300, -math.pi, 5e-324, float("nan"), float("inf")]
    history = History(tmp_path / "history.csv")
    for value in values:
        history.append({"time_s": np.float64(value)})
    history.flush()
    found = read_history(history.path)["time_s"]
    assert found.tobytes() == np.array(values).tobytes()


def test_columns_keep_their_kind(tmp_path):
    """Whole numbers stay whole numbers, text stays text."""
    found = read_history(write(tmp_path / "history.csv", 5).path)
    assert found["step"].dtype == np.int64
    assert found["time_s"].dtype == np.float64
    assert list(found["limit"]) == ["pulse"] * 5


def test_cut_and_go_on_gives_the_uninterrupted_file(tmp_path):
    """Cut back to 4 rows and written again, the file equals one that was never interrupted."""
    whole = write(tmp_path / "whole.csv", 9).path.read_bytes()
    write(tmp_path / "cut.csv", 7)
    history = History(tmp_path / "cut.csv")
    history.cut(4)
    for row in rows(5, start=4):
        history.append(row)
    history.flush()
    assert history.path.read_bytes() == whole
    assert history.rows == 9


def test_torn_last_line_is_ignored(tmp_path):
    """A line without its newline, left by a kill, counts as not written."""
    path = write(tmp_path / "history.csv", 6).path
    path.write_bytes(path.read_bytes()[:-3])
    assert len(read_history(path)["step"]) == 5
    assert History(path).rows == 5


def test_cut_beyond_the_end_is_an_error(tmp_path):
    """A history shorter than its checkpoint is reported, not extended."""
    with pytest.raises(OutputError, match="fewer rows"):
        write(tmp_path / "history.csv", 3).cut(4)


def test_rows_with_other_columns_are_refused(tmp_path):
    """The first row fixes the columns."""
    history = write(tmp_path / "history.csv", 1)
    with pytest.raises(ValueError, match="other columns"):
        history.append({"time_s": 1.0, "step": 1, "extra": 2})


def test_full_disk_leaves_the_rows_written_before(tmp_path):
    """A failed flush reports the full disk in one line and loses no earlier row."""
    history = History(tmp_path / "history.csv")
    history.append({"time_s": 0.0})
    history.path.symlink_to("/dev/full")
    with pytest.raises(OutputError, match=r"cannot write .*: the disk is full"):
        history.flush()


def test_events_are_cut_like_the_history(tmp_path):
    """Events later than the checkpoint disappear."""
    events = Events(tmp_path / "events.jsonl")
    for k in range(4):
        events.append("snapshot", time=k * 1e-9, step=k, number=np.int64(k))
    events.cut(2)
    events.append("melting", time=5e-9, step=5)
    found = read_events(events.path)
    assert [entry["event"] for entry in found] == ["snapshot", "snapshot", "melting"]
    assert Events(events.path).count == 3
    with pytest.raises(OutputError, match="fewer events"):
        events.cut(9)
