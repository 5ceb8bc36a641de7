"""Tables and progress as text."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from lasersph.cli.progress import STILL_COMPILING, ProgressDisplay, RunDisplay
from lasersph.input.text_table import text_table
from lasersph.observers.observer_list import OBSERVERS
from lasersph.simulation import RunProgress


def test_text_table():
    """Columns as wide as their widest cell, a rule below the head, numbers below one another."""
    rows = [("first", "12.5 nm", "–", "7 runs failed"), ("second", "8 nm"), ("3rd", "-", "40", "x")]
    assert text_table(rows, ("run", "depth", "order", "remark")).splitlines() == [
        "run       depth  order  remark",
        "------  -------  -----  -------------",
        "first   12.5 nm      –  7 runs failed",
        "second     8 nm",
        "3rd           -     40  x",
    ]
    assert text_table([("case", "1"), ("time", "20 ns")]) == "case  1\ntime  20 ns"
    assert text_table([]) == ""
    with pytest.raises(ValueError, match="more than two need a head"):
        text_table(rows)


STATUS = RunProgress(time=0.2194, end=1.0, steps=1207, hottest=301.6, work_done=0.42)


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({}, " 42 %  219.4 ms, step 1207, 302 K"),
        ({"remaining_s": 105.0}, " 42 %  219.4 ms, step 1207, 302 K, 1 min 45 s left"),
        ({"time": 2.5e-8, "remaining_s": 4.2}, " 42 %  25 ns, step 1207, 302 K, 4 s left"),
        ({"time": 3e-12, "work_done": 0.001}, "  0 %  3 ps, step 1207, 302 K"),
        ({"time": 7300.0, "work_done": 1.2}, "100 %  7300 s, step 1207, 302 K"),
    ],
)
def test_words_of_progress(changes, text):
    """Times in a unit that fits them, and the time left once it is known."""
    assert str(replace(STATUS, **changes)) == text


def test_plain_progress_off_a_terminal(capsys):
    """One line for each tenth of the work, and no escape codes."""
    with ProgressDisplay(str, is_terminal=False) as progress:
        for step in range(1, 101):
            progress(RunProgress(step * 1e-9, 1e-7, step, 300.0 + step, step / 100, 100.0 - step))
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 10
    assert lines[0] == " 10 %  10 ns, step 10, 310 K, 1 min 30 s left"
    assert lines[-1] == "100 %  100 ns, step 100, 400 K, 0 s left"
    assert "\x1b" not in "".join(lines)


def test_resumed_run_shows_what_is_new(capsys):
    """What was done before the first step of this process is not said again."""
    with ProgressDisplay(str, is_terminal=False) as progress:
        for percent in (50, 55, 60):
            progress(replace(STATUS, work_done=percent / 100))
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_line_on_a_terminal(capsys, monkeypatch):
    """One line with a bar, drawn over, no wider than the terminal, and left as it ends."""
    monkeypatch.setenv("COLUMNS", "60")
    with ProgressDisplay(str, is_terminal=True) as progress:
        progress(replace(STATUS, work_done=0.5))
        progress(replace(STATUS, work_done=1.0, remaining_s=0.0))
    shown = capsys.readouterr().err
    assert shown.count("\n") == 1
    first, *_, last = shown.rstrip("\n").split("\r\x1b[K")[1:]
    assert first == "[============            ]  50 %  219.4 ms, step 1207, 302 "
    assert last.startswith("[========================] 100 %  219.4 ms")
    assert len(last) <= 59


def test_compiling_is_said(capsys):
    """A line of its own, above the bar where there is one already."""
    text = "compiling loops as they are needed, some seconds in all; later runs find them\n"
    with RunDisplay(is_terminal=False) as progress:
        progress.compiling()
    assert capsys.readouterr().err == text
    with RunDisplay(is_terminal=True) as progress:
        progress(STATUS)
        progress.compiling()
    assert f"\r\x1b[K{text}[=====" in capsys.readouterr().err


def test_compiling_has_its_own_progress(capsys, monkeypatch):
    """How many loops and how long; nothing of the time that is left to compute until no further
    loop has come for some steps."""
    monkeypatch.setenv("COLUMNS", "100")
    compiling = SimpleNamespace(loops=50, seconds=20.0)
    with RunDisplay(138, is_terminal=True) as progress:
        progress.compiled(compiling)
        assert (
            "compiled 50 loops of up to 138 in 20 s, 35 s more at most" in capsys.readouterr().err
        )
        progress.compiled(SimpleNamespace(loops=1, seconds=6.0))
        said = capsys.readouterr().err
        assert "compiled 1 loops of up to 138 in 6 s" in said and "at most" not in said
        progress(replace(STATUS, remaining_s=7.0))
        assert " left" not in capsys.readouterr().err
        monkeypatch.setattr("lasersph.cli.progress.REDRAW", 0.0)
        for _ in range(STILL_COMPILING):
            progress(replace(STATUS, remaining_s=7.0))
        assert "7 s left" in capsys.readouterr().err
    capsys.readouterr()
    with RunDisplay(is_terminal=False) as progress:
        for loops in range(1, 52):
            progress.compiled(SimpleNamespace(loops=loops, seconds=0.4 * loops))
    assert len(capsys.readouterr().err.splitlines()) == 2


def test_names_of_numbers_leave_room_for_the_numbers():
    """In a terminal of 80 columns, with an error and a time behind them."""
    main = [one.words for kind in OBSERVERS for one in kind.all_results() if one.is_main]
    assert max(map(len, main)) + len("  12.34 +- 0.56 um at 78.9 ns") <= 80
