"""Where a moving surface can be computed no further."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.boundaries.initial_surface import FEWEST_ROWS, STEEPEST
from lasersph.input import format_quantity

if TYPE_CHECKING:
    from lasersph.boundaries.surface_line import SurfaceLine


def trouble_of(line: SurfaceLine, bottom: float, spacing: float) -> str:
    """Slope above 1, or too little liquid above the wall at z = `bottom` [m]; empty for neither."""
    slope, thickness = np.abs(line.slope), line.height - bottom
    steep, thin = int(np.argmax(slope)), int(np.argmin(thickness))
    if slope[steep] > STEEPEST:
        return (
            f"the surface has the slope {slope[steep]:.3g} at x = "
            f"{format_quantity(line.x[steep], 'm', 3)}, and none above {STEEPEST:.0f} is "
            "computed; take a weaker drive or an earlier end"
        )
    if thickness[thin] < FEWEST_ROWS * spacing:
        return (
            f"the liquid is {format_quantity(thickness[thin], 'm', 3)} thick at x = "
            f"{format_quantity(line.x[thin], 'm', 3)}, less than {FEWEST_ROWS} spacings of "
            "particles; take a finer spacing, a weaker drive or an earlier end"
        )
    return ""
