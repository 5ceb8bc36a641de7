"""Which particles are near the melt."""

import numpy as np
import pytest

from lasersph.compute.search import EscapedParticle
from lasersph.solvers.melt_pool.near_melt import NearMelt

BOUNDS = ((0.0, 9.0), (-1.0, 0.0))
RADIUS = 0.3


def found(backend, position, fluid, **settings):
    """Host array of who is near."""
    options = {"repeats": False} | settings
    cells = NearMelt(backend, position.shape[1], BOUNDS, RADIUS, **options)
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
    near = found(backend, position, fluid, repeats=repeats)
    apart = np.abs(position[:, :, None] - position[:, None, fluid])
    if repeats:
        apart[0] = np.minimum(apart[0], 9.0 - apart[0])
    assert near[(np.hypot(*apart) < RADIUS).any(axis=1)].all()
    # columns near the ends of a period share what is marked in any of them
    farther = RADIUS * (9.0 if repeats else 2.0)
    assert not near[(apart.max(axis=0) > farther).all(axis=1)].any()
    assert near[fluid].all() and not near.all()


def test_across_the_period(backend):
    """A fluid particle at the right end reaches those at the left where the box repeats."""
    position = np.array([[8.95, 0.05, 4.5], [-0.5, -0.5, -0.5]])
    assert found(backend, position, [1, 0, 0], repeats=True).tolist() == [True, True, False]
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
