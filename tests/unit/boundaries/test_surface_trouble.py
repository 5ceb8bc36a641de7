"""What a surface that cannot be computed any further says."""

import numpy as np
import pytest

from lasersph.boundaries.surface_line import SurfaceLine
from lasersph.boundaries.surface_segments import SurfaceSegments
from lasersph.boundaries.surface_trouble import trouble_of

COLUMNS, WIDTH = 200, 1e-8


def trouble(steep, slope, bottom=-1e-6):
    """Of a ramp of 300 nm at x = `steep` [m] of a surface whose right half has frozen."""
    line = SurfaceLine(0.0, WIDTH, COLUMNS, ("mirror", "mirror"), 6.0 * WIDTH)
    line.height = slope * np.clip(line.x - steep, -1.5e-7, 1.5e-7)
    segments = SurfaceSegments(line)
    segments.choose(np.arange(COLUMNS) < COLUMNS // 2)
    return trouble_of(segments, bottom, WIDTH)


@pytest.mark.parametrize(
    ("steep", "slope", "said"),
    [
        (0.4e-6, 0.9, ""),
        (0.4e-6, 1.2, "the surface has the slope"),
        (0.98e-6, 1.2, "at the edge of its pool"),
    ],
)
def test_slope(steep, slope, said):
    """Above 1 in the middle of a pool it is another trouble than at its edge."""
    found = trouble(steep, slope)
    assert found.startswith(said) or said in found
    assert bool(found) == bool(said) and ("edge" in found) == ("edge" in said)


def test_thin_liquid():
    """Less than three rows above the wall."""
    assert "the liquid is 25 nm thick at x = 5 nm, less than 3 spacings" in trouble(
        0.4e-6, 0.5, bottom=-1e-7
    )
