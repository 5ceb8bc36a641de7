"""Tables and progress as text."""

import time

from lasersph.cli.progress import ProgressDisplay
from lasersph.cli.tables import aligned
from lasersph.simulation import RunProgress


def test_aligned_columns():
    """Columns as wide as their widest cell, a rule below the header, nothing trailing."""
    text = aligned([("a", "long name", "x"), ("bbb", "c")], header=True)
    assert text.splitlines() == ["a    long name  x", "---  ---------  -", "bbb  c"]
    assert aligned([]) == ""


def test_plain_progress_off_a_terminal(capsys, monkeypatch):
    """One line for each tenth of the time, with the time left, and no escape codes."""
    clock = iter(range(1000))
    monkeypatch.setattr(time, "monotonic", lambda: float(next(clock)))
    with ProgressDisplay(is_terminal=False) as progress:
        for step in range(1, 101):
            progress(RunProgress(step * 1e-9, 1e-7, step, 300.0 + step, step / 100))
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 10
    assert lines[0].startswith("  10 %  10 ns, step 10, 310 K")
    assert lines[4].endswith(" left")
    assert lines[-1] == " 100 %  100 ns, step 100, 400 K"
    assert "\x1b" not in "".join(lines)


def test_bar_on_a_terminal(capsys):
    """The bar names time, step and temperature."""
    with ProgressDisplay(is_terminal=True) as progress:
        progress(RunProgress(5e-8, 1e-7, 7, 1234.0, 0.5))
        progress(RunProgress(1e-7, 1e-7, 8, 1235.0, 1.0))
    assert "step 8, 1235 K" in capsys.readouterr().err


def test_compiling_is_said(capsys):
    """A line of its own, above the bar where there is one already."""
    with ProgressDisplay(is_terminal=False) as progress:
        progress.compiling()
    assert capsys.readouterr().err.startswith("compiling loops as they are needed")
    with ProgressDisplay(is_terminal=True) as progress:
        progress(RunProgress(5e-8, 1e-7, 7, 1234.0, 0.5))
        progress.compiling()
    assert "compiling loops as they are needed" in capsys.readouterr().err
