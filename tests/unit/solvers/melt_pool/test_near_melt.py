"""Which particles are near the melt."""

import numpy as np
import pytest
from flow_boxes import block_of, place_of, pool

from lasersph.compute.search import EscapedParticle
from lasersph.solvers.melt_pool.near_melt import NearMelt, within_reach

BOUNDS = ((0.0, 9.0), (-1.0, 0.0))
RADIUS = 0.3


def found(backend, position, fluid, **settings):
    """Host array of who is near."""
    options = {"repeats": (False, False)} | settings
    cells = NearMelt(backend, np.full(position.shape[1], RADIUS), 0.0, BOUNDS, **options)
    place, flows = backend.asarray(position), backend.asarray(np.array(fluid, float))
    return backend.to_host(cells.find(place, flows)) > 0.0


@pytest.fixture
def cloud():
    """Forty particles, three of which flow."""
    random = np.random.default_rng(6)
    x, z = random.uniform(0.0, 9.0, 40), random.uniform(-1.0, 0.0, 40)
    return np.array([x, z]), np.arange(40) < 3


@pytest.mark.parametrize("repeats", [False, True])
def test_radius(backend, cloud, repeats):
    """Whoever is closer than the radius to a fluid one is found, none beyond two cells."""
    position, fluid = cloud
    near = found(backend, position, fluid, repeats=(repeats, False))
    apart = np.abs(position[:, :, None] - position[:, None, fluid])
    if repeats:
        apart[0] = np.minimum(apart[0], 9.0 - apart[0])
    assert near[(np.hypot(*apart) < RADIUS).any(axis=1)].all()
    # cells are up to a third wider than the radius along an axis of four of them
    assert not near[(apart.max(axis=0) > 2.0 * 4.0 / 3.0 * RADIUS).all(axis=1)].any()
    assert near[fluid].all() and not near.all()


def test_across_the_period(backend):
    """A fluid particle at the right end reaches those at the left where the box repeats."""
    position = np.array([[8.95, 0.05, 4.5], [-0.5, -0.5, -0.5]])
    assert found(backend, position, [1, 0, 0], repeats=(True, False)).tolist() == [
        True,
        True,
        False,
    ]
    assert found(backend, position, [1, 0, 0]).tolist() == [True, False, False]


def test_nothing_flows(backend, cloud):
    """Then nobody is near."""
    assert not found(backend, cloud[0], np.zeros(40)).any()


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -1e30, 9.31])
def test_escaped(backend, wrong):
    """A place that is none, or farther than the radius beyond a face, is refused by its number."""
    position = np.array([[1.0, wrong], [-0.5, -0.5]])
    with pytest.raises(EscapedParticle, match="particle 1 escaped"):
        found(backend, position, [1, 1])


@pytest.mark.parametrize("dimension", [1, 3])
@pytest.mark.parametrize("is_periodic", [False, True])
def test_radius_on_a_line_and_in_space(backend, dimension, is_periodic):
    """Whoever is closer than the radius is found, around the ends of every axis that repeats; z
    never does."""
    random, repeats = np.random.default_rng(8), (is_periodic,) * (dimension - 1) + (False,)
    position, fluid = random.uniform(0.0, 3.0, (dimension, 60)), np.arange(60) < 2
    bounds = ((0.0, 3.0),) * dimension
    cells = NearMelt(backend, np.full(60, RADIUS), 0.0, bounds, repeats=repeats)
    given = (position, np.array(fluid, float))
    near = backend.to_host(cells.find(*map(backend.asarray, given))) > 0.0
    apart = np.abs(position[:, :, None] - position[:, None, fluid])
    if is_periodic:
        apart[:-1] = np.minimum(apart[:-1], 3.0 - apart[:-1])
    assert near[(np.linalg.norm(apart, axis=0) < RADIUS).any(axis=1)].all()
    assert not near[(apart.max(axis=0) > 2.5 * RADIUS).all(axis=1)].any()
    assert near[fluid].all() and not near.all()


def test_depth_and_reach_by_hand():
    """Down to what a particle sees below the deepest melt, and a fifth more."""
    cells = {"cell": 0, "fine_cell": 1, "melt_depth": 0.3, "reach": 0.2}
    for depth, near, expected in ((0.4, 1.0, 1.0), (0.53, 1.0, 1.0), (0.55, 1.0, 0.0)):
        x, no = np.array([0.5, -depth]), (0.0, 0.0)
        marked = {"marks": (near, 0.0), "fine_marks": no, **cells}
        assert within_reach(x, finest=0.1, **marked) == expected
        # the finest by cells of their own
        marked = {"marks": no, "fine_marks": (0.0, near), **cells}
        assert within_reach(x, finest=0.1, **marked) == 0.0
        assert within_reach(x, finest=0.2, **marked) == expected


def test_rows_of_graded_layers():
    """Whoever has a fluid particle within the support of the pair is found; deeper ones are not."""
    solver = pool(lambda x, z: (np.abs(x) < 6e-7) & (z > -4e-7))
    block = block_of(solver)
    host, fluid = solver.backend.to_host, solver.kinds.fluid
    near = host(block.near_melt.find(solver.position, fluid)) > 0.0
    place, reach = place_of(solver)[:, : block.count], block.layers.reach_of_melt
    flows = host(fluid)[: block.count] > 0.0
    apart = np.linalg.norm(place[:, :, None] - place[:, None, flows], axis=0)
    assert flows.any() and near[(apart < reach[:, None]).any(axis=1)].all()
    deep = place[1] < place[1, flows].min() - 1.21 * reach
    assert deep.any() and not near[deep].any()


def test_finest_particles_see_two_columns_further(backend):
    """The finest are near melt up to two columns beyond their reach, where a surface that moves
    changes; coarse ones, to whom melt lies as far, by their own reach."""
    column, reach = 0.1, np.array([0.3, 0.3, 0.3, 0.9])
    melt, beside, far, coarse = (3.1, -0.05), (3.42, -0.05), (4.3, -0.05), (3.8, -0.8)
    position = backend.asarray(np.array([melt, beside, far, coarse]).T)
    near = NearMelt(backend, reach, column, BOUNDS, repeats=(False, False))
    fluid = backend.asarray([1.0, 0.0, 0.0, 0.0])
    assert backend.to_host(near.find(position, fluid)).tolist() == [1.0, 1.0, 0.0, 1.0]
