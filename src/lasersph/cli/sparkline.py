"""Small curves: the same on a terminal, in a file and in a pipe."""

from __future__ import annotations

import sys
from collections.abc import Sequence

BLOCKS, PLAIN = "▁▂▃▄▅▆▇█", "_.-:=+*#"
"""Heights of a curve from low to high, and where the output cannot show blocks."""
CURVE_WIDTH = 40
"""Characters of a curve: with its name and largest value it fits 80 columns."""


def sparkline(times: Sequence[float], values: Sequence[float]) -> str:
    """A curve over time in one line of characters, from its least to its largest value.

    Each character shows the largest value of its part of the time, or the value before where
    no step ends in it.

    Args:
        times, values: (n,), n >= 1, rising times.
    """
    # Largest value in each part of the time.
    start, span = times[0], (times[-1] - times[0]) or 1.0
    tops: list[float | None] = [None] * CURVE_WIDTH
    for time, value in zip(times, values, strict=True):
        k = min(int((time - start) / span * CURVE_WIDTH), CURVE_WIDTH - 1)
        top = tops[k]
        tops[k] = value if top is None else max(top, value)
    # Blocks where the output can show them.
    low, high = min(values), max(values)
    encoding = sys.stdout.encoding or "ascii"
    marks = BLOCKS if encoding.lower().startswith("utf") else PLAIN
    # A part in which no step ends keeps the value before it.
    line, last = [], values[0]
    for top in tops:
        last = last if top is None else top
        share = (last - low) / (high - low) if high > low else 0.0
        line.append(marks[round(share * (len(marks) - 1))])
    return "".join(line)
