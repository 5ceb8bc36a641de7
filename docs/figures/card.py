"""The chart of a graphics card beside the processors of the same machine, from docs/card.json."""

import json
from pathlib import Path

from figures.stored import StoredFigure, store_figure
from lasersph.plots import style

RECORD = Path(__file__).parents[1] / "card.json"
NAMES = {
    "pair sum 3-D": "right-hand side in 3-D",
    "neighbor list 3-D": "neighbor list in 3-D",
    "matrix times vector": "matrix times vector",
    "CG iteration": "iteration of implicit heat",
    "BiCGStab iteration": "iteration of a published pressure solve",
    "multigrid cycle": "cycle of heat's multigrid",
    "pressure grid cycle": "cycle of the pressure's grids",
    "step of a lid-driven cube": "whole step of a liquid in 3-D",
}
"""Lines of the record that both have, as the chart calls them."""
FASTEST = 40.0


def ratios() -> list[tuple[str, int, float]]:
    """Name, particles, and how many times as fast the card is, in double precision."""
    lines = json.loads(RECORD.read_text(encoding="utf-8"))["lines"]
    times: dict[tuple[str, int], dict[bool, float]] = {}
    for one in lines:
        if one["precision"] == "float64" and one["name"] in NAMES:
            both = times.setdefault((one["name"], one["particles"]), {})
            both[one["device"].endswith("threads")] = one["seconds"]
    return [
        (NAMES[name], particles, both[True] / both[False])
        for (name, particles), both in times.items()
        if len(both) == 2
    ]


def draw_card(target: Path) -> None:
    """A bar for each loop and number of particles: how many times as fast the card is."""
    figure, (axes,) = style.new_figure(height=4.6)
    found = sorted(ratios(), key=lambda one: (list(NAMES.values()).index(one[0]), one[1]))
    for place, (_, particles, ratio) in enumerate(found):
        color = style.COLORS[0 if particles > 500_000 else 1]
        axes.barh(place, ratio - 1.0, left=1.0, height=0.72, color=color)
        axes.text(1.06 * ratio, place, f"{ratio:.1f}", fontsize=8.5, va="center")
    axes.set_xscale("log")
    axes.set_xlim(1.0, FASTEST)
    axes.set_xticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
    axes.minorticks_off()
    words = [f"{name}, {1e-6 * particles:.1f} M" for name, particles, _ in found]
    axes.set_yticks(range(len(found)), words)
    axes.set_ylim(len(found) - 0.4, -0.6)
    axes.grid(False, axis="y")
    style.label(axes, "the card is so many times as fast as 16 processors", "")
    store_figure(figure, target)


CARD = StoredFigure("card", draw_card, ("docs/figures/card.py", "docs/card.json"))
