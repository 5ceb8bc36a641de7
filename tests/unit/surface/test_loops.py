"""What columns of a moving surface take from the particles below them, by hand."""

import numpy as np
import pytest

from lasersph.surface import loops
from lasersph.surface.column_loops import mean_velocity
from lasersph.surface.surface_fit import surface_velocity_of_grid, surface_velocity_of_line

COLUMNS, SPACING = 6, 2e-8


def surface_velocity(k, rows, slope=0.0):
    """u, w, T of column k and their weight, over rows at depths in spacings, each shifted along x.

    u = 3 + r + slope d + 5 d^2, w = 2 - 7 d^2, T = 100 + 10 r - 60 (d - 1/2): r in columns from the
    middle of k, d in spacings.
    """
    shift = np.linspace(-0.3, 0.3, len(rows))
    place = (np.arange(COLUMNS)[:, None] + 0.5 + shift).ravel()
    d = np.tile(rows, COLUMNS)
    r = place - (k + 0.5)
    start = len(rows) * np.arange(COLUMNS + 1)
    zero = np.zeros(d.size)
    jump = zero - 2.0 * slope * d
    u, w, T = (
        3.0 + r + slope * d + 5.0 * d**2,
        2.0 - 7.0 * d**2,
        100.0 + 10.0 * r - 60.0 * (d - 0.5),
    )
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
    """A profile that its slope and a parabola give is carried on exactly, at ends too; T is that of
    half a spacing below the surface."""
    (u, w), T, weight = surface_velocity(k, [0.4, 1.3, 2.2], slope=11.0)
    assert u == pytest.approx(3.0, abs=1e-12)
    assert w == pytest.approx(2.0, abs=1e-12)
    assert pytest.approx(100.0, abs=1e-12) == T
    assert weight > 0.0


def test_one_row():
    """Where all particles are as deep no parabola, and without particles no weight."""
    (u, w), T, weight = surface_velocity(2, [0.5])
    assert pytest.approx(100.0) == T
    assert u == pytest.approx(3.0 + 5.0 * 0.25)
    assert w == pytest.approx(2.0 - 7.0 * 0.25)
    assert weight > 0.0
    assert surface_velocity(2, [3.0])[2] == 0.0


GRID = {"start": (0.0, 0.0), "inverse_width": (1.0, 1.0), "columns": (6.0, 5.0)}
WALLS = {"low_end": (loops.PINNED,) * 2, "high_end": (loops.PINNED,) * 2}


def grid_particles(rows, columns=(6, 5)):
    """One particle of each row and column of a grid of columns 1 m wide, some way off its middle:
    members of the columns, and places (n, 3) at depths in spacings."""
    i, j = np.unravel_index(np.repeat(np.arange(30), len(rows)), columns)
    depth = np.tile(rows, 30)
    shift = 0.2 * np.sin(np.arange(depth.size))
    return len(rows) * np.arange(31), np.stack([i + 0.5 + shift, j + 0.5 - shift, -depth], axis=1)


@pytest.mark.parametrize("k", [0, 12, 29])
def test_fit_of_a_grid(k):
    """u = 3 + 2 r_x - r_y + 5 d^2 is carried on exactly, in corners too; T, linear, is that
    of half a spacing below the surface."""
    start, x = grid_particles([0.4, 1.3, 2.2])
    r_x, r_y = x[:, 0] - (k // 5 + 0.5), x[:, 1] - (k % 5 + 0.5)
    d = -x[:, 2]
    v = np.stack([3.0 + 2.0 * r_x - r_y + 5.0 * d**2, r_y - d**2, 1.0 + 0.0 * d], axis=1)
    T = 100.0 + 10.0 * r_x - 4.0 * r_y - 60.0 * (d - 0.5)
    jump = np.zeros(v.shape)
    arrays = start, np.arange(d.size), list(x), d, list(v), list(jump), T
    found, T_s, weight = surface_velocity_of_grid(k, *arrays, **GRID, **WALLS, spacing=1.0)
    assert found == pytest.approx([3.0, 0.0, 1.0], abs=1e-9)
    assert pytest.approx(100.0, abs=1e-9) == T_s
    assert weight > 0.0


def test_flow_through_a_side_of_a_grid():
    """Melt that moves evenly: v of the side's normal, whatever it has along the side."""
    start, x = grid_particles([0.5])
    arrays = start, np.arange(30), list(x), [np.array([2.0, -3.0, 7.0])] * 30
    for along, side, expected in (((1.0, 0.0), 2 * 5 + 1, 2.0), ((0.0, 1.0), 2 * 6 + 1, -3.0)):
        mean, solid = mean_velocity(
            side, *arrays, np.ones(30), np.ones(30), along=along, **GRID, **WALLS
        )
        assert mean == pytest.approx(expected)
        assert solid == 0.0


def test_cubic_surface_of_a_grid():
    """x y^2 with its slopes and eta_xy = 2 y, between the nodes."""
    i, j = np.meshgrid(np.arange(6.0) - 1.5, np.arange(7.0) - 1.5, indexing="ij")
    height, twist = (i * j**2).ravel(), (2.0 * j).ravel()
    slope = list(np.stack([(j**2).ravel(), (2.0 * i * j).ravel()], axis=1))
    grid = {"start": (0.0, 0.0), "inverse_width": (1.0, 1.0), "nodes": (6.0, 7.0)}
    x = np.array([0.7, 2.1, -5.0])
    top, slopes = loops.surface_over(x, **grid, height=height, slope=slope, twist=twist)
    assert top == pytest.approx(0.7 * 2.1**2)
    assert slopes == pytest.approx([2.1**2, 2.0 * 0.7 * 2.1])


def test_ghost_beyond_an_inclined_surface_of_a_grid():
    """s = (1, 2, s_z) in the plane of slopes (0.5, 1): s_z = 2.5; and -n div v."""
    S = 1.5
    n = np.array([-0.5, -1.0, 1.0]) / S
    grid = {"start": (0.0, 0.0), "inverse_width": (1.0, 1.0), "nodes": (6.0, 6.0)}
    ones = np.ones(36)
    jump, along, p, T, gradient = loops.surface_values(
        np.array([0.7, 0.9, 0.0]), n, 0.5, **grid, shear=[np.array([1.0, 2.0])] * 36,
        strain_rate=3.0 * ones, p_b=4.0 * ones, T_line=5.0 * ones, gradient=6.0 * ones,
    )  # fmt: skip
    assert jump == pytest.approx(np.array([1.0, 2.0, 2.5]) - 3.0 * n)
    assert along == pytest.approx([1.0, 2.0, 2.5])
    assert (p, T, gradient) == (4.0, 5.0, 6.0)
