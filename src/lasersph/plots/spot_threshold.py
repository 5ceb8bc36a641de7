"""Squared diameters of the craters of a spot over ln F, and the volume that light removes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.plots import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def spot_threshold_figure(found: dict[str, Any]) -> Figure:
    """(a) D^2 over the fluence with the fitted line, (b) removal efficiency.

    Args:
        found: plain data of `studies.SpotThreshold`.
    """
    craters = found["craters"]

    # Fluences in J/cm^2, diameters in um, as in the field.
    fluence = 1e-4 * np.array([one["fluence"] for one in craters])
    square = 1e12 * np.array([one["diameter"] for one in craters]) ** 2
    efficiency = 1e12 * np.array([one["efficiency"] for one in craters])
    # D^2 = 2 w^2 ln(F / F_th): a line over ln F with the slope 2 w^2.
    threshold, slope = 1e-4 * found["threshold_J_m2"], 2e12 * found["radius_m"] ** 2
    figure, (left, right) = style.new_figure(1, 2, height=3.4)
    line = np.array([threshold, float(np.max(fluence)) * 1.05])
    text = f"$F_{{th}}$ = {threshold:.3g} J/cm$^2$, w = {1e6 * found['radius_m']:.3g} µm"
    left.plot(line, slope * np.log(line / threshold), color=style.GRAY, label=text)
    left.plot(fluence, square, "o", color=style.COLORS[0], label="craters")
    left.set_xscale("log")
    left.set_xticks(fluence, labels=[f"{value:.3g}" for value in fluence])
    left.minorticks_off()
    style.label(left, "peak fluence [J/cm$^2$]", "squared diameter [µm$^2$]", title="(a)")
    style.legend(left)
    right.plot(fluence, efficiency, "o-", color=style.COLORS[1], linewidth=1.0)
    style.label(right, "peak fluence [J/cm$^2$]", "removal efficiency [µm$^3$/µJ]", title="(b)")
    right.set_ylim(bottom=0.0)
    return figure
