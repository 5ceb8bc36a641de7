"""Where a moving surface can be computed no further."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries.initial_surface import MIN_LAYERS, STEEPEST
from lasersph.input import format_quantity

if TYPE_CHECKING:
    from lasersph.surface.height_field import HeightField
    from lasersph.surface.pools import SurfacePools
    from lasersph.surface.segments import SurfaceSegments

STEEPEST_EDGE = 2.0
"""Slope up to which the edge of a pool is computed. Guard: melt that runs over solid, freezing from
below, stands at up to 52 degrees in textures; above 63 it would fall over its own foot."""


def validity_error(segments: SurfaceSegments | SurfacePools, bottom: float, spacing: float) -> str:
    """Slope above 1, above 2 at the edge of a pool, or too little liquid above the wall at
    z = `bottom` [m]; empty for none.

    At the edge of a pool, within a smoothing length of solid, the melt runs over the solid beside
    it. Elsewhere a wave is about to break, or a jet to leave.
    """
    line = segments.whole
    slope, thickness = np.hypot.reduce(segments.slopes), line.height.ravel() - bottom
    thin = int(np.argmin(thickness))
    if slope.max() > STEEPEST:
        # columns with solid within a smoothing length: the edge of a pool, where steeper melt is
        # computed
        solid_near = near_solid(segments)
        limit = np.where(solid_near, STEEPEST_EDGE, STEEPEST)
        steep = int(np.argmax(slope / limit))

        # the steepest place, measured by the limit that holds there
        if slope[steep] > limit[steep]:
            place = f"the slope {slope[steep]:.3g} at {place_of(line, steep)}"
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
            f"the liquid is {format_quantity(thickness[thin], 'm', 3)} thick at "
            f"{place_of(line, thin)}, less than {MIN_LAYERS} spacings of "
            "particles; take a finer spacing, a weaker drive or an earlier end"
        )
    return ""


def near_solid(segments: SurfaceSegments | SurfacePools) -> NDArray[np.bool_]:
    """(count,) whether a column lies within a smoothing length of solid along the axes."""
    from scipy.ndimage import maximum_filter1d  # few runs have a steep surface

    line = segments.whole
    found = (~segments.is_molten).reshape(line.shape).astype(np.uint8)
    for axis, width in enumerate(line.widths):
        columns = 2 * round(line.cutoff / width) + 1
        found = maximum_filter1d(found, columns, axis=axis, mode="constant")
    return found.ravel() > 0


def place_of(line: HeightField, column: int) -> str:
    """Place of a column in words, "x = ..." and y of a grid."""
    names = zip("xy", (places.ravel() for places in line.places), strict=False)
    return ", ".join(f"{name} = {format_quantity(at[column], 'm', 3)}" for name, at in names)
