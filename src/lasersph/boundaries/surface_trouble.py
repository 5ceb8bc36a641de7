"""Where a moving surface can be computed no further."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.boundaries.initial_surface import FEWEST_ROWS, STEEPEST
from lasersph.input import format_quantity

if TYPE_CHECKING:
    from lasersph.boundaries.surface_segments import SurfaceSegments


def trouble_of(segments: SurfaceSegments, bottom: float, spacing: float) -> str:
    """Slope above 1, or too little liquid above the wall at z = `bottom` [m]; empty for neither.

    At the edge of a pool, within a smoothing length of it, the melt runs against the solid at which
    it is pinned. Elsewhere a wave is about to break, or a jet to leave.
    """
    line = segments.whole
    slope, thickness = np.abs(line.slope), line.height - bottom
    steep, thin = int(np.argmax(slope)), int(np.argmin(thickness))
    if slope[steep] > STEEPEST:
        solid = line.x[~segments.is_molten]
        is_edge = bool(np.any(np.abs(solid - line.x[steep]) < line.cutoff))
        place = f"{slope[steep]:.3g} at x = {format_quantity(line.x[steep], 'm', 3)}"
        what = f"the surface has the slope {place}, and none above {STEEPEST:.0f} is computed"
        if is_edge:
            what = (
                f"the melt has the slope {place}, at the edge of its pool, and would run over the "
                f"solid beside it: no slope above {STEEPEST:.0f} is computed, nor melt that does"
            )
        return f"{what}; take a weaker drive or an earlier end"
    if thickness[thin] < FEWEST_ROWS * spacing:
        return (
            f"the liquid is {format_quantity(thickness[thin], 'm', 3)} thick at x = "
            f"{format_quantity(line.x[thin], 'm', 3)}, less than {FEWEST_ROWS} spacings of "
            "particles; take a finer spacing, a weaker drive or an earlier end"
        )
    return ""
