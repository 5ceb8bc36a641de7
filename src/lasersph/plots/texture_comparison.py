"""A measured profile or map over ours, and their difference."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.plots import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def comparison_figure(
    x: np.ndarray, measured: np.ndarray, ours: np.ndarray, content: dict[str, Any]
) -> Figure:
    """Above: measured and computed heights over x. Below: their difference, and what noise and
    interpolation explain of it, twice.

    Args:
        x: (n,) aligned places [m]; of a map those near one line. measured, ours: (n,) heights [m].
        content: of comparison.json.
    """
    figure, (first, second) = style.new_figure(2, height=5.2, share_x=True)
    order = np.argsort(x, kind="stable")
    x, measured, ours = x[order], measured[order], ours[order]
    along = style.unit_for(float(np.max(np.abs(x))), style.LENGTHS)
    up = style.fitting_unit("m", float(np.max(np.abs(measured))))
    first.plot(
        x * along.factor, measured * up.factor, ".", ms=2.5, color=style.COLORS[1], label="measured"
    )
    first.plot(x * along.factor, ours * up.factor, lw=1.2, color=style.COLORS[0], label="computed")
    style.label(first, "", f"height [{up.name}]")
    style.legend_above(figure, first, columns=2)
    left = measured - ours
    expected = 2.0 * content["difference"]["expected_rms_m"]
    fine = style.fitting_unit("m", max(float(np.max(np.abs(left))), expected))
    band = expected * fine.factor
    second.axhspan(-band, band, color=style.COLORS[0], alpha=0.15, linewidth=0.0)
    second.plot(x * along.factor, left * fine.factor, ".", ms=2.5, color=style.GRAY)
    second.set_xlim(x[0] * along.factor, x[-1] * along.factor)
    style.label(second, f"x [{along.name}]", f"measured less computed [{fine.name}]")
    return figure
