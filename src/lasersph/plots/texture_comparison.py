"""A measured profile or map over ours, and their difference."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.plots import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def comparison_figure(
    x: np.ndarray,
    measured: np.ndarray,
    ours: np.ndarray,
    content: dict[str, Any],
    across: str = "x",
) -> Figure:
    """Above: measured and computed heights over x. Below: their difference, and what noise and
    interpolation explain of it, twice.

    Args:
        x: (n,) aligned places [m]; of a map those near one line. measured, ours: (n,) heights [m].
        content: of comparison.json. across: letter of the places.
    """
    figure, (first, second) = style.new_figure(2, height=5.2, share_x=True)
    order = np.argsort(x, kind="stable")
    x = x[order]
    measured = measured[order]
    ours = ours[order]
    along = style.unit_for(float(np.max(np.abs(x))), style.LENGTHS)
    up = style.fitting_unit("m", float(np.max(np.abs(measured))))
    first.plot(
        x * along.factor, measured * up.factor, ".", ms=2.5, color=style.COLORS[1], label="measured"
    )
    first.plot(x * along.factor, ours * up.factor, lw=1.2, color=style.COLORS[0], label="computed")
    style.label(first, "", f"height [{up.name}]")
    style.legend_above(figure, first, columns=2)
    # The difference against twice what noise and interpolation explain.
    left = measured - ours
    expected = 2.0 * content["difference"]["expected_rms_m"]
    fine = style.fitting_unit("m", max(float(np.max(np.abs(left))), expected))
    band = expected * fine.factor
    second.axhspan(-band, band, color=style.COLORS[0], alpha=0.15, linewidth=0.0)
    second.plot(x * along.factor, left * fine.factor, ".", ms=2.5, color=style.GRAY)
    second.set_xlim(x[0] * along.factor, x[-1] * along.factor)
    style.label(second, f"{across} [{along.name}]", f"measured less computed [{fine.name}]")
    return figure


def comparison_maps(x: np.ndarray, y: np.ndarray, measured: np.ndarray, ours: np.ndarray) -> Figure:
    """Maps of measured and computed heights on one scale, and of their difference.

    Args:
        x, y: (n,) aligned places [m]. measured, ours: (n,) heights [m].
    """
    from lasersph.plots.notebook_figure import NotebookFigure

    along = style.unit_for(float(max(np.ptp(x), np.ptp(y))), style.LENGTHS)
    figure = NotebookFigure(figsize=(style.WIDTH, 3.2), layout="constrained")
    panels = figure.subplots(1, 3, sharex=True, sharey=True)
    size = (150.0 / np.sqrt(x.size)) ** 2  # points side by side in a panel 150 points wide
    words = ("measured", "computed", "measured less computed")
    largest = float(np.max(np.abs(ours)))
    # Measured and computed heights share a scale; the difference has its own.
    for axes, z, title in zip(panels, (measured, ours, measured - ours), words, strict=True):
        end = 1.2 * largest if title != words[2] else 3.0 * float(np.std(z)) or largest
        up = style.fitting_unit("m", end)
        place, most = (along.factor * x, along.factor * y), up.factor * end
        shown = axes.scatter(*place, c=up.factor * z, s=size, marker="s", linewidths=0)
        shown.set(cmap="RdBu_r", clim=(-most, most))
        axes.set_aspect("equal")
        axes.set_title(title, fontsize=9, loc="left")
        style.label(axes, f"x [{along.name}]", f"y [{along.name}]" if title == words[0] else "")
        figure.colorbar(shown, ax=axes, label=f"[{up.name}]", location="bottom")
    return figure
