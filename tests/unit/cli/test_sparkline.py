"""Curves in a line of characters."""

import pytest

from lasersph.cli import sparkline as curves


class Output:
    """Stands for a terminal with some encoding."""

    def __init__(self, encoding: str) -> None:
        self.encoding = encoding


@pytest.mark.parametrize(("encoding", "marks"), [("utf-8", "▁▄█"), ("ascii", "_:#")])
def test_sparkline_follows_time(encoding, marks, monkeypatch):
    """It counts times, not steps: many short steps take no more room than their time."""
    monkeypatch.setattr(curves.sys, "stdout", Output(encoding))
    times = [0.0, *(1.0 + 1e-3 * k for k in range(50)), 2.0, 4.0]
    values = [0.0, *(50 * [3.0]), 7.0, 7.0]
    line = curves.sparkline(times, values)
    assert len(line) == curves.CURVE_WIDTH
    low, middle, high = marks
    quarter = curves.CURVE_WIDTH // 4
    assert line == low * quarter + middle * quarter + high * 2 * quarter


def test_sparkline_of_a_constant():
    """Nothing that varies is a low line."""
    assert len(set(curves.sparkline([0.0, 1.0], [5.0, 5.0]))) == 1
    assert len(curves.sparkline([1.0], [5.0])) == curves.CURVE_WIDTH
