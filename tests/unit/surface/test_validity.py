"""What a surface that cannot be computed any further says."""

import numpy as np
import pytest
from surface_lines import line_of

from lasersph.surface.height_field import HeightField
from lasersph.surface.pools import SurfacePools
from lasersph.surface.segments import SurfaceSegments
from lasersph.surface.validity import validity_error

COLUMNS, WIDTH = 200, 1e-8


def trouble(steep, slope, bottom=-1e-6):
    """Of a ramp of 100 nm at x = `steep` [m] of a surface whose right half has frozen."""
    line = line_of(0.0, WIDTH, COLUMNS, ("mirror", "mirror"), 6.0 * WIDTH)
    line.height = slope * np.clip(line.centers() - steep, -5e-8, 5e-8)
    segments = SurfaceSegments(line)
    segments.choose(np.arange(COLUMNS) < COLUMNS // 2)
    return validity_error(segments, bottom, WIDTH)


@pytest.mark.parametrize(
    ("steep", "slope", "said"),
    [
        (0.4e-6, 0.9, ""),
        (0.4e-6, 1.2, "the surface has the slope"),
        (0.99e-6, 1.2, ""),
        (0.99e-6, 2.4, "at the edge of its pool, and would fall over the solid"),
    ],
)
def test_slope(steep, slope, said):
    """None above 1 in the middle of a pool, above 2 at its edge."""
    found = trouble(steep, slope)
    assert said in found and bool(found) == bool(said)


def test_thin_liquid():
    """Less than three rows above the wall."""
    assert "the liquid is 25 nm thick at x = 5 nm, less than 3 spacings" in trouble(
        0.4e-6, 0.5, bottom=-5e-8
    )


def on_a_slope(slope):
    """Of columns over x and y, all molten, that rise along the diagonal."""
    grid = HeightField((0.0, 0.0), (WIDTH, WIDTH), (40, 40), (("mirror",) * 2,) * 2, 6.0 * WIDTH)
    x, y = grid.places
    along = np.clip((x + y) / np.sqrt(2.0) - 2.8e-7, -8e-8, 8e-8)
    grid.height = slope * along
    pools = SurfacePools(grid)
    pools.choose(np.ones(grid.count, bool))
    pools.update_heights()
    return validity_error(pools, -1e-6, WIDTH)


def test_slope_in_space():
    """That of both axes together counts: 0.8 along each is steeper than 45 degrees; both places are
    named."""
    assert on_a_slope(0.8) == ""
    found = on_a_slope(0.8 * np.sqrt(2.0))
    assert "the surface has the slope 1." in found
    assert "at x = " in found and ", y = " in found and "take a weaker drive" in found
