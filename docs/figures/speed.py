"""The chart of speeds beside other programs, from docs/times.json."""

import json
from math import sqrt
from pathlib import Path

from figures.stored import StoredFigure, store_figure
from lasersph.plots import style

RECORD = Path(__file__).parents[1] / "times.json"
CASES = {
    "wcsph": "matter that moves, a right-hand side with its share of lists",
    "wcsph-steps": "matter that moves, whole steps: two right-hand sides here, one there",
    "heat": "heat between particles, whole steps",
    "heat-sum": "heat between particles, the sum over pairs alone",
    "implicit": "heat, an implicit step: 43 entries a row here, 5 there",
    "hot-electrons": "a pulse of 150 fs in 1-D, to an error of 1 % and of 0.1 or 0.3 %",
}
"""What is compared, by the case of `benchmarks/peers/run.py`, in the order of the chart."""
SLOWEST, FASTEST = 0.3, 60.0
"""Ends of the axis: the least ratio of the record is 0.5, the largest 23 with its words beside."""
GAP = 0.3
"""Between two cases, in heights of a row."""


def draw_peers(target: Path) -> None:
    """A bar for each program: how many times as fast lasersph is, and the range over rounds."""
    peers = json.loads(RECORD.read_text(encoding="utf-8"))["peers"]
    figure, (axes,) = style.new_figure(height=5.0)
    place, places = 0.0, []
    for case, name in CASES.items():
        axes.text(1.06, place, name, fontsize=9, va="center", color=style.GRAY)
        rows = sorted((one for one in peers if one["case"] == case), key=lambda one: one["least"])
        for one in rows:
            place += 1.0
            _draw_bar(axes, place, one["least"], one["largest"])
            places.append((place, one["peer"]))
        place += 1.0 + GAP
    axes.set_xscale("log")
    axes.set_xlim(SLOWEST, FASTEST)
    axes.set_xticks([0.5, 1, 2, 5, 10, 20, 50], ["0.5", "1", "2", "5", "10", "20", "50"])
    axes.minorticks_off()
    axes.set_yticks([at for at, _ in places], [peer for _, peer in places])
    axes.set_ylim(place - GAP - 0.4, -0.7)
    axes.grid(False, axis="y")
    axes.axvline(1.0, color=style.GRAY, linewidth=1.0)
    style.label(axes, "lasersph is so many times as fast", "")
    store_figure(figure, target)


def _draw_bar(axes, place: float, least: float, largest: float) -> None:
    """A bar from 1 to the geometric mean of a range, the range as a line, and its ends in words."""
    middle = sqrt(least * largest)
    color = style.COLORS[0] if middle > 1.0 else style.COLORS[1]
    axes.barh(place, middle - 1.0, left=1.0, height=0.72, color=color)
    axes.plot([least, largest], [place, place], color="0.15", linewidth=1.5)
    words = f"{least:g}" if least == largest else f"{least:g} to {largest:g}"
    axes.text(1.06 * max(largest, 1.0), place, words, fontsize=8.5, va="center")


PEERS = StoredFigure("speed-peers", draw_peers, ("docs/figures/speed.py", "docs/times.json"))
