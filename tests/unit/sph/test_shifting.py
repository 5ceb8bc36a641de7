"""Shifts: none on a lattice, apart where particles are close, never through a face."""

import numpy as np
import pytest
from lattices import lattice, with_neighbors

from lasersph.sph.correction import kernel_gradient
from lasersph.sph.shifting import repulsion_terms, shift

FAR = (-np.inf, -np.inf), (np.inf, np.inf)
FREE = {
    "is_fluid": 1.0,
    "at_surface": 0.0,
    "position": np.zeros(2),
    "low": np.array(FAR[0]),
    "high": np.array(FAR[1]),
    "close_push": 1e9,
    "scale": 0.1,
    "limit": 1e9,
}


def shifts(
    backend,
    place,
    *,
    is_fluid=1.0,
    at_surface=0.0,
    between=FAR,
    close_push=1e9,
    scale=0.04,
    limit=1e9,
    support=3.5,
):
    """Shift of all particles at `place` [m]; `between` lower and upper places no wall is near."""
    count = place.shape[1]
    neighbors = with_neighbors(backend, place, support)
    fields = {
        "is_fluid": backend.asarray(np.full(count, is_fluid)),
        "at_surface": backend.asarray(np.full(count, at_surface)),
        "position": backend.asarray(place),
    }
    fields["G_ij"] = backend.zeros((place.shape[0], neighbors.neighbor.shape[0]))
    volume = {"V": backend.asarray(np.ones(count))}
    backend.pair_values(kernel_gradient, neighbors, volume, fields["G_ij"])
    out = backend.zeros((place.shape[0], count))
    low, high = between
    numbers = {"low": low, "high": high, "close_push": close_push, "scale": scale, "limit": limit}
    backend.pair_sum(repulsion_terms, neighbors, fields, out, finish=shift, **numbers)
    return backend.to_host(out)


def test_none_on_a_lattice(backend):
    """All neighbors cancel inside a lattice."""
    place = lattice(2, 9)
    inside = ((place > 3.4) & (place < 4.6)).all(axis=0)
    assert inside.any()
    assert shifts(backend, place)[:, inside] == pytest.approx(0.0, abs=1e-15)


def test_two_particles_by_hand():
    """Neighbor at distance 2 along -x: R = r^2 / r^2 e_x = e_x, whatever the distance."""
    terms = repulsion_terms(np.array([2.0, 0.0]), 2.0, np.array([-1.0, 0.0]))
    assert terms[0].tolist() == [0.25, 0.0]
    assert terms[1:] == (2.0, 1.0)
    assert shift(*terms, **FREE).tolist() == [0.1, 0.0]


def test_beyond_the_support():
    """A pair of the search beyond the support counts nothing."""
    terms = repulsion_terms(np.array([2.0, 0.0]), 2.0, np.zeros(2))
    assert not terms[0].any() and terms[1:] == (0.0, 0.0)
    assert shift(*terms, **FREE).tolist() == [0.0, 0.0]


def test_two_close_particles(backend):
    """A particle next to another's place: both are pushed apart, along their line."""
    place = lattice(2, 9)
    first, second = 40, 41  # 41 is one up
    place[1, second] -= 0.6
    found = shifts(backend, place)
    assert found[1, first] < -1e-3
    assert found[1, second] > 1e-3
    assert found[0, [first, second]] == pytest.approx(0.0, abs=1e-15)


def test_at_a_surface(backend):
    """No part along the normal; the part along the surface is that of a free particle."""
    place = lattice(2, 9) + np.random.default_rng(4).uniform(-0.2, 0.2, (2, 81))
    free, bound = shifts(backend, place), shifts(backend, place, at_surface=1.0)
    assert np.all(bound[1] == 0.0)
    assert bound[0] == pytest.approx(free[0], rel=1e-12)
    assert np.abs(free[1]).max() > 1e-3


def test_near_walls(backend):
    """Near a wall at x = 0 nothing along x, near one at z = 8 nothing along z, all of it between;
    in the corner no shift."""
    place = lattice(2, 9) + np.random.default_rng(4).uniform(-0.2, 0.2, (2, 81))
    free = shifts(backend, place)
    found = shifts(backend, place, between=((3.0, -np.inf), (np.inf, 5.0)))
    side, top = place[0] <= 3.0, place[1] >= 5.0
    assert side.any() and top.any() and np.abs(free).min() > 0.0
    assert np.array_equal(found[0], np.where(side, 0.0, free[0]))
    assert np.array_equal(found[1], np.where(top, 0.0, free[1]))


def test_close_at_a_wall():
    """Neighbor at distance 2 along -x, beside a wall: pushed by 1/4 1/m^2, moved where that is more
    than a close neighbor would push, not where it is less."""
    terms = repulsion_terms(np.array([2.0, 0.0]), 2.0, np.array([-1.0, 0.0]))
    beside = FREE | {"low": np.array([1.0, 0.0])}
    assert shift(*terms, **beside | {"close_push": 1 / 5}).tolist() == [0.1, 0.0]
    assert shift(*terms, **beside | {"close_push": 1 / 3}).tolist() == [0.0, 0.0]


def test_limit_and_rest(backend):
    """No shift is longer than the limit, and it keeps its direction; solids do not shift."""
    place = lattice(2, 9) + np.random.default_rng(4).uniform(-0.2, 0.2, (2, 81))
    free, limited = shifts(backend, place, scale=1.0), shifts(backend, place, scale=1.0, limit=0.1)
    size = np.linalg.norm(limited, axis=0)
    assert size.max() == pytest.approx(0.1)
    cross = free[0] * limited[1] - free[1] * limited[0]
    assert cross == pytest.approx(0.0, abs=1e-14)
    assert np.all(shifts(backend, place, is_fluid=0.0) == 0.0)
