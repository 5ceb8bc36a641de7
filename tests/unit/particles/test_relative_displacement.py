"""The bound of how far particles have moved relative to others near them."""

import numpy as np
import pytest
from moving_matter import DRIFTING_BLOCK, host, moving, put

from lasersph.particles.kinds import INTERIOR, LEAVING
from lasersph.particles.relative_displacement import (
    RelativeDisplacement,
    bound_square,
    difference_square,
    predicted_displacement,
)


def relative_of(solver, distance):
    """The bound for the particles of a solver whose lists have this search radius [m]."""
    pairs = solver.pairs
    fields = solver.particles.by_symbol()
    return RelativeDisplacement(solver.backend, fields, pairs.box, distance)


def block(dimension, backend=None):
    """A block that is periodic on all sides, and how its cells have moved."""
    settings = (f"solver.dimensions={dimension}", "domain.depth=24 um", "domain.width=12 um")
    _, solver = moving("sound-wave", *DRIFTING_BLOCK, *settings, "motion=", backend=backend)
    return solver, relative_of(solver, 3.3e-6)


def test_predicted_displacement():
    """From where it was listed to where it will be; what has left counts as at rest."""
    x, listed, v = np.array([3.0, 4.0]), np.array([1.0, 1.0]), np.array([2.0, 0.0])
    assert predicted_displacement(x, listed, v, INTERIOR, 0.5).tolist() == [3.0, 3.0]
    assert predicted_displacement(x, listed, v, LEAVING, 0.5).tolist() == [0.0, 0.0]


def test_bound_of_a_cell():
    """The largest difference of each component; a cell without particles has none."""
    assert difference_square(2.0, 1.0, 5.0, 0.5) == 16.0
    assert difference_square(-np.inf, np.inf, 5.0, 0.5) == 0.0
    two, three = np.array([2.0, 3.0]), np.array([5.0, 4.0])
    assert bound_square(two, two, three, two) == 9.0 + 1.0
    assert bound_square(two[:1], two[:1], three[:1], two[:1]) == 9.0
    assert bound_square(*(np.append(a, 1.0) for a in (two, two, three, two))) == 10.0


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_bounds_all_that_is_near(dimension):
    """No pair up to `clear` has moved further apart, and the bound is not far above."""
    solver, relative = block(dimension)
    size = np.array([[12e-6]] * (dimension - 1) + [[24e-6]])
    x = host(solver, "position")
    rng = np.random.default_rng(3)
    phase = 2.0 * np.pi * (x[-1] / 24e-6 + rng.random((dimension, 1)))
    displacement = 1e-6 * np.sin(phase) + 1e-8 * rng.uniform(-1.0, 1.0, x.shape)
    put(solver, "velocity", 0.5 * displacement / 1e-9)
    put(solver, "position", x + 0.5 * displacement)
    bound = relative.bound(1e-9)
    largest = 0.0
    for i in range(0, x.shape[1], 1 + x.shape[1] // 200):
        apart = x - x[:, [i]]
        apart -= size * np.round(apart / size)
        near = np.sum(apart**2, axis=0) < relative.clear**2
        largest = max(
            largest,
            float(np.linalg.norm((displacement - displacement[:, [i]])[:, near], axis=0).max()),
        )
    assert largest <= bound < 2.0 * largest


def test_nothing_apart_in_uniform_motion():
    """However far all have moved."""
    solver, relative = block(2)
    put(solver, "velocity", np.full(host(solver, "velocity").shape, 1e3))
    assert relative.bound(1e-9) < 1e-20


def test_every_backend(backend):
    """Largest values are the same wherever they are found, but for the rounding of squares."""
    bounds = []
    for solver, relative in (block(2), block(2, backend)):
        x = host(solver, "position")
        put(solver, "velocity", np.random.default_rng(4).uniform(-1.0, 1.0, x.shape))
        bounds.append(relative.bound(2.0**-20))
    assert bounds[1] == pytest.approx(bounds[0], rel=1e-14)
    assert bounds[0] > 2.0**-20


def test_cells_are_made_anew():
    """What is forgotten is found again from the places of the list."""
    solver, relative = block(2)
    x = host(solver, "position")
    put(solver, "velocity", np.where(x[-1] > x[-1].mean(), 1.0, 0.0) * np.ones((2, 1)))
    assert relative.bound(1.0) == pytest.approx(2.0**0.5)
    swapped = solver.backend.to_host(solver.pairs.listed)[:, ::-1].copy()
    put(solver, "velocity", 0.0)
    solver.backend.copy(solver.backend.asarray(swapped), solver.pairs.listed)
    relative.reset()
    most = np.abs(x - swapped).max()
    assert relative.bound(1.0) > most


def test_no_more_cells_than_particles():
    """A sparse vessel has wider cells."""
    _, solver = moving("dam-break", "particles.spacing=5.715 mm")
    wide = relative_of(solver, 1e-4)
    assert wide.clear > 4e-4
    assert wide.bound(1.0) == 0.0
