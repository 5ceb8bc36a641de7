"""What columns of a moving surface take from the particles below them, by hand."""

import numpy as np
import pytest

from lasersph.surface import loops
from lasersph.surface.column_loops import mean_velocity
from lasersph.surface.surface_fit import surface_velocity_of_grid, surface_velocity_of_line

COLUMNS, SPACING = 6, 2e-8


def surface_velocity(k, rows, slope=0.0):
    """u, w, T of column k and their weight, over rows at depths in spacings, each shifted along x.

    u = 3 + r + slope d + 5 d^2, w = 2 - 7 d^2, T = 100 + 10 r: r in columns from the middle of k, d
    in spacings.
    """
    shift = np.linspace(-0.3, 0.3, len(rows))
    place = (np.arange(COLUMNS)[:, None] + 0.5 + shift).ravel()
    d = np.tile(rows, COLUMNS)
    r = place - (k + 0.5)
    start = len(rows) * np.arange(COLUMNS + 1)
    zero = np.zeros(d.size)
    jump = zero - 2.0 * slope * d
    u, w, T = 3.0 + r + slope * d + 5.0 * d**2, 2.0 - 7.0 * d**2, 100.0 + 10.0 * r
    return surface_velocity_of_line(
        k,
        start,
        np.arange(d.size),
        list(np.stack([place * SPACING, -d * SPACING], axis=1)),
        d * SPACING,
        list(np.stack([u, w], axis=1)),
        list(np.stack([jump, zero], axis=1)),
        T,
        (0.0,),
        (1.0 / SPACING,),
        (COLUMNS,),
        (loops.PINNED,),
        (loops.PINNED,),
        SPACING,
    )


@pytest.mark.parametrize("k", [0, 2, 5])
def test_parabola_of_the_depth(k):
    """A profile that its slope and a parabola give is carried on exactly, at ends too."""
    (u, w), T, weight = surface_velocity(k, [0.4, 1.3, 2.2], slope=11.0)
    assert u == pytest.approx(3.0, abs=1e-12)
    assert w == pytest.approx(2.0, abs=1e-12)
    assert pytest.approx(100.0, abs=1e-12) == T
    assert weight > 0.0


def test_one_row():
    """Where all particles are as deep no parabola, and without particles no weight."""
    (u, w), _, weight = surface_velocity(2, [0.5])
    assert u == pytest.approx(3.0 + 5.0 * 0.25)
    assert w == pytest.approx(2.0 - 7.0 * 0.25)
    assert weight > 0.0
    assert surface_velocity(2, [3.0])[2] == 0.0
