"""Tornado chart: how much each part contributes to the errors of the main results."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lasersph.input import format_with_error
from lasersph.input.key_units import amount_dimension, unit_in
from lasersph.observers.observer_list import OBSERVERS
from lasersph.output import RunOrFolder, open_run
from lasersph.plots import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROW_HEIGHT = 0.23
HEAD_HEIGHT = 0.62
"""Of a bar, and of what stands around the bars of a result [inches]."""
LEAST_SHARE = 1e-9
"""Errors below this share of the value are rounding."""


def tornado_chart(run: RunOrFolder) -> Figure | None:
    """One panel a main result: bars of its parts in percent of it, the longest above; None without
    uncertainty.json or without any error."""
    run = open_run(run)
    found = run.uncertainty
    if found is None:
        return None

    # Panels of main results that have an error with parts.
    panels = []
    for one in (one for kind in OBSERVERS for one in kind.all_results() if one.is_main):
        entry = found["numbers"].get(one.key)
        bars = parts_of(entry, found["coverage"]) if entry else []
        if bars:
            unit = unit_in(one.unit, amount_dimension(run.summary))
            text = format_with_error(entry["value"], entry["error"], unit, typographic=True)
            panels.append((f"{one.words}: {text}", bars))
    if not panels:
        return None

    # Every bar has the same height in all panels.
    heights = [HEAD_HEIGHT + ROW_HEIGHT * len(bars) for _, bars in panels]
    figure, all_axes = style.new_figure(len(panels), 1, height=sum(heights) + 0.3)
    if (grid := all_axes[0].get_gridspec()) is not None:
        grid.set_height_ratios(heights)
    for axes, (title, bars) in zip(all_axes, panels, strict=True):
        names, lows, highs, colors = zip(*reversed(bars), strict=True)
        sizes = [high - low for low, high in zip(lows, highs, strict=True)]
        axes.barh(names, sizes, left=lows, color=colors, height=0.66)
        axes.axvline(0.0, color="0.2", linewidth=0.8)
        largest = max(-min(lows), max(highs))
        axes.set_xlim(-1.08 * largest, 1.08 * largest)
        axes.grid(False, axis="y")
        axes.set_ylim(-0.6, len(bars) - 0.4)
        axes.set_title(title, fontsize=10, loc="right")
    all_axes[-1].set_xlabel("change of the result [%]", fontsize=10)
    return figure


def parts_of(entry: dict[str, Any], coverage: float) -> list[tuple[str, float, float, str]]:
    """Name, lower and upper end in percent of the value, and color of each part, largest first."""
    value = entry["value"]
    if not value:
        return []
    # The numerical part to both sides, each input by its change up and down.
    bars = []
    if entry["numerical"]:
        share = 100.0 * entry["numerical"] / abs(value)
        bars.append(("numerical", -share, share, style.GRAY))
    for key, part in entry["inputs"].items():
        ends = [coverage * (part[side] or 0.0) * 100.0 / abs(value) for side in ("up", "down")]
        name = key.removeprefix("material.").replace(".", ", ").replace("_", " ")
        bars.append((name, min(*ends, 0.0), max(*ends, 0.0), style.COLORS[0]))
    # Parts that are rounding are left out, the longest bar comes first.
    bars = [bar for bar in bars if max(-bar[1], bar[2]) > 100.0 * LEAST_SHARE]
    return sorted(bars, key=lambda bar: bar[1] - bar[2])
