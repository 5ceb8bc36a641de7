"""Charts of the validations, drawn from their records whenever the pages are built.

A point is one judged number: how far it lies from what it is judged by, in units of its tolerance.
Left of 1 it is met. Points at the left border agree to 1e-4 of the tolerance or better.
"""

import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from lasersph.plots import style
from lasersph.validation.records import State

LEAST, MOST = 1e-4, 30.0
"""Borders of the axis: what agrees better, or worse, stands at the border."""
MET, MISSED = style.COLORS[0], style.COLORS[1]
LABEL_WIDTH = 52
"""Characters of a line of a label; longer ones take two."""
MOST_ROWS = 40
"""Of a chart of one validation; of more numbers the worst are drawn."""


def draw_charts(states: Sequence[State], folder: Path) -> None:
    """Write validation-overview.svg and validation-NAME.svg of each that has judged numbers."""
    found = {state.name: judged(state.record) for state in states if state.record is not None}
    found = {name: rows for name, rows in found.items() if rows}
    figure, (axes,) = style.new_figure(height=1.0 + 0.22 * len(found))
    for k, rows in enumerate(found.values()):
        # points of one validation beside each other, so that none hides another
        beside = k + 0.5 * (np.arange(len(rows)) % 7 / 6.0 - 0.5)
        _draw(axes, list(rows.values()), beside)
    _finish(axes, list(found))
    figure.savefig(folder / "validation-overview.svg")
    for name, rows in found.items():
        worst = dict(sorted(rows.items(), key=lambda row: row[1])[-MOST_ROWS:])
        labels = [textwrap.fill(text, LABEL_WIDTH) for text in worst]
        row = 0.2 if all("\n" not in text for text in labels) else 0.3
        figure, (axes,) = style.new_figure(height=1.0 + row * len(worst))
        _draw(axes, list(worst.values()), np.arange(len(worst)))
        _finish(axes, labels)
        figure.savefig(folder / f"validation-{name}.svg")


def judged(record: Mapping[str, Any]) -> dict[str, float]:
    """By quantity the difference over the tolerance of each number that is met or missed."""
    rows = [row for row in record["rows"] if row["verdict"] is not None and not row["own"]]
    return {row["quantity"]: share for row in rows if (share := share_of(row)) is not None}


def share_of(row: Mapping[str, Any]) -> float | None:
    """Difference over tolerance; None where a row is judged otherwise than by a difference."""
    wanted = row["reference"] if row["reference"] is not None else row["published"]
    numbers = (wanted, row["computed"], row["tolerance"])
    if not all(isinstance(number, int | float) for number in numbers) or not row["tolerance"]:
        return None
    share = abs(row["computed"] - wanted) / row["tolerance"]
    return share if (share <= 1.0) == row["verdict"] else None


def _draw(axes: Axes, shares: Sequence[float], heights: np.ndarray) -> None:
    x = np.clip(shares, LEAST, MOST)
    colors = [MET if share <= 1.0 else MISSED for share in shares]
    axes.scatter(x, heights, s=14, c=colors, linewidths=0.0, alpha=0.85)


def _finish(axes: Axes, names: Sequence[str]) -> None:
    axes.set_xscale("log")
    axes.set_xlim(0.8 * LEAST, 1.3 * MOST)
    axes.axvline(1.0, color=style.GRAY, linewidth=1.0)
    axes.axvspan(1.0, 1.3 * MOST, color=MISSED, alpha=0.07, linewidth=0.0)
    axes.set_yticks(range(len(names)), [name.replace("$", r"\$") for name in names], fontsize=8)
    axes.set_ylim(len(names) - 0.3, -0.7)
    style.label(axes, "difference over tolerance", "")
