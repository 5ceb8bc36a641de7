"""Where a moving surface can be computed no further."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.boundaries.initial_surface import MIN_LAYERS, STEEPEST
from lasersph.input import format_quantity

if TYPE_CHECKING:
    from lasersph.surface.segments import SurfaceSegments

STEEPEST_EDGE = 2.0
"""Slope up to which the edge of a pool is computed. Guard: melt that runs over solid, freezing from
below, stands at up to 52 degrees in textures; above 63 it would fall over its own foot."""


def validity_error(segments: SurfaceSegments, bottom: float, spacing: float) -> str:
    """Slope above 1, above 2 at the edge of a pool, or too little liquid above the wall at
    z = `bottom` [m]; empty for none.

    At the edge of a pool, within a smoothing length of solid, the melt runs over the solid beside
    it. Elsewhere a wave is about to break, or a jet to leave.
    """
    line = segments.whole
    slope, thickness = np.abs(line.slopes[0]), line.height - bottom
    thin = int(np.argmin(thickness))
    if slope.max() > STEEPEST:
        # columns with solid within a smoothing length: the edge of a pool, where steeper melt is
        # computed
        window = np.ones(2 * round(line.cutoff / line.widths[0]) + 1)
        solid_near = np.convolve(~segments.is_molten, window)[window.size // 2 :][: line.count]
        limit = np.where(solid_near > 0.0, STEEPEST_EDGE, STEEPEST)
        steep = int(np.argmax(slope / limit))

        # the steepest place, measured by the limit that holds there
        if slope[steep] > limit[steep]:
            at = format_quantity(line.centers()[steep], "m", 3)
            place = f"the slope {slope[steep]:.3g} at x = {at}"
            what = f"the surface has {place}"
            if solid_near[steep]:
                what = (
                    f"the melt has {place}, at the edge of its pool, and would fall over the solid "
                    "beside it"
                )
            return (
                f"{what}; none above {limit[steep]:.0f} is computed there, take a weaker drive or "
                "an earlier end"
            )

    # the shallowest place
    if thickness[thin] < MIN_LAYERS * spacing:
        return (
            f"the liquid is {format_quantity(thickness[thin], 'm', 3)} thick at x = "
            f"{format_quantity(line.centers()[thin], 'm', 3)}, less than {MIN_LAYERS} spacings of "
            "particles; take a finer spacing, a weaker drive or an earlier end"
        )
    return ""
