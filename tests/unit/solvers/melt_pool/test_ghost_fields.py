"""What ghosts have of their sources: two particles by hand, products of planes, linear fields."""

import numpy as np
import pytest

from lasersph.particles.ghosts import MIRROR, TANGENT, FacePair, ghost_types_of
from lasersph.particles.reflection import reflected
from lasersph.solvers.melt_pool.ghost_fields import (
    ghost_position,
    ghost_pressure,
    ghost_tensor,
    ghost_vector,
    ghost_velocity,
    velocity_at_wall,
    velocity_change,
)

NO_PLANE = {"crosses_surface": [0.0, 0.0]}


def entries(value):
    """A table as plain Python indexes it: 0 for the source itself, then the value."""
    value = np.array(value, float)
    return [np.zeros_like(value), value]


@pytest.mark.parametrize(
    ("sign", "place", "a", "M"),
    [
        # a face, and a corner, of the faces x = 0 and z = 0
        ((-1, 1), (-2, 3), (-5, 7), [[1, -2], [-3, 4]]),
        ((-1, -1), (-2, -3), (-5, -7), [[1, 2], [3, 4]]),
    ],
)
def test_faces_and_corners_of_a_plane(sign, place, a, M):
    """Source at (2, 3) with the vector (5, 7) and the tensor ((1, 2), (3, 4))."""
    still = entries((0, 0))
    planes = {"sign": entries(sign), "normal": still, **NO_PLANE}
    images = {"sign": entries(sign), "offset": still, "shift": still, **NO_PLANE}
    assert ghost_position(1, 1, entries((2, 3)), **images).tolist() == list(place)
    assert ghost_vector(1, 1, entries((5, 7)), **planes).tolist() == list(a)
    assert ghost_tensor(1, 1, entries([[1, 2], [3, 4]]), **planes).tolist() == M


@pytest.mark.parametrize(
    ("sign", "off_diagonal"),
    [
        # a face, an edge and a corner: xy, xz and yz change their sign with one of both
        ((-1, 1, 1), (-2, -3, 6)),
        ((-1, -1, 1), (2, -3, -6)),
        ((-1, -1, -1), (2, 3, 6)),
    ],
)
def test_faces_edges_and_corners_in_space(sign, off_diagonal):
    """Products of one, two and three reflections in the faces of the unit box at 1."""
    still, offset = entries((0, 0, 0)), entries([2 * (s < 0) for s in sign])
    images = {"sign": entries(sign), "offset": offset, "shift": still, **NO_PLANE}
    place = ghost_position(1, 1, entries((0.75, 0.5, 0.875)), **images)
    expected = [2 - x if s < 0 else x for x, s in zip((0.75, 0.5, 0.875), sign, strict=True)]
    assert place.tolist() == expected
    planes = {"sign": entries(sign), "normal": still, **NO_PLANE}
    assert ghost_vector(1, 1, entries((5, 7, 9)), **planes).tolist() == [
        s * a for s, a in zip(sign, (5, 7, 9), strict=True)
    ]
    M = ghost_tensor(1, 1, entries([[1, 2, 3], [2, 4, 6], [3, 6, 9]]), **planes)
    assert (M[0, 1], M[0, 2], M[1, 2]) == off_diagonal and np.diag(M).tolist() == [1, 4, 9]


@pytest.mark.parametrize(
    ("v", "factor", "added", "expected"),
    [
        # beyond a wall that moves along x at 4, and one that moves along y in space
        ((1, 3), (-1, -1), (8, 0), (7, -3)),
        ((1, 3, 5), (-1, -1, -1), (0, 8, 0), (-1, 5, -5)),
        # in an edge with a plane of symmetry at x = 0 as well
        ((1, 3, 5), (1, -1, -1), (0, 8, 0), (1, 5, -5)),
    ],
)
def test_velocity_beyond_a_wall_that_moves(v, factor, added, expected):
    """2 v_wall - v along the wall, so that the mean with the source is the wall's."""
    walls, jump = {"stressed": [0.0, 0.0]}, entries(np.full(len(v), 0.25))
    walls |= {"factor": entries(factor), "added": entries(added)}
    assert ghost_velocity(1, 1, entries(v), jump, **walls).tolist() == list(expected)
    change = velocity_change(1, 1, entries(v), entries(factor))
    assert change.tolist() == [s * one for s, one in zip(factor, v, strict=True)]


def test_velocity_beyond_a_stressed_surface():
    """The tangential velocity goes on, 2 + 0.25; beyond a side as well, all of it turned around."""
    rules = {"stressed": [0.0, 1.0], "added": entries((0, 0))}
    v, jump = entries((2, 3)), entries((0.25, 0.0))
    assert ghost_velocity(1, 1, v, jump, factor=entries((1, -1)), **rules).tolist() == [2.25, -3]
    assert ghost_velocity(1, 1, v, jump, factor=entries((-1, -1)), **rules).tolist() == [-2.25, -3]


def test_velocity_in_the_edge_of_two_planes():
    """Beyond x = 0, y = 0 and a stressed surface at once: the jump first, then both mirrors."""
    rules = {"stressed": [0.0, 1.0], "added": entries((0, 0, 0))}
    v, jump = entries((2, 3, 5)), entries((0.25, 0.5, 0.0))
    for factor, expected in (
        ((-1, 1, -1), [-2.25, 3.5, -5]),
        ((1, -1, -1), [2.25, -3.5, -5]),
        ((-1, -1, -1), [-2.25, -3.5, -5]),
    ):
        found = ghost_velocity(1, 1, v, jump, factor=entries(factor), **rules)
        assert found.tolist() == expected


def test_velocity_at_wall():
    """- d^2/nu b along a wall 1 before the ghost: - 1 / (4 * 0.5) 6 = -3."""
    wall = {"along": entries((1, 0)), "normal": entries((0, 1)), "plane": [0.0, -2.0]}
    given = {"m": [0.0, 0.5], "b": entries((6, 7)), "nu": 4.0}
    v, x = np.array([1.0, 2.0]), np.array([5.0, -3.0])
    assert velocity_at_wall(1, 1, x, v, **given, **wall).tolist() == [-2.0, 2.0]


def slanted(dimension):
    """A plane through 0 with a random normal, a source below it, and the way across."""
    rng = np.random.default_rng(dimension)
    n, x = rng.normal(size=dimension), rng.normal(size=dimension)
    n /= np.linalg.norm(n)
    n *= -np.sign(x @ n)
    return rng, n, x, -2.0 * (x @ n) * n


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_tangent_plane(dimension):
    """Position and vector are reflected in it; reflecting the ghost again gives the source."""
    rng, n, x, shift = slanted(dimension)
    one, zero = entries(np.ones(dimension)), entries(np.zeros(dimension))
    crosses = {"crosses_surface": [0.0, 1.0], "sign": one}
    place = ghost_position(1, 1, entries(x), entries(shift), offset=zero, **crosses)
    assert place == pytest.approx(reflected(x, n, 1.0), rel=1e-13)
    back = ghost_position(1, 1, entries(place), entries(-shift), offset=zero, **crosses)
    assert back == pytest.approx(x, rel=1e-13)
    a, M = rng.normal(size=dimension), rng.normal(size=(dimension, dimension))
    twice = ghost_vector(1, 1, entries(a), entries(n), **crosses)
    twice = ghost_vector(1, 1, entries(twice), entries(n), **crosses)
    assert twice == pytest.approx(a, rel=1e-13, abs=1e-14)
    seen = ghost_tensor(1, 1, entries(M), entries(n), **crosses)
    a_seen = ghost_vector(1, 1, entries(a), entries(n), **crosses)
    M_a = ghost_vector(1, 1, entries(M @ a), entries(n), **crosses)
    assert seen @ a_seen == pytest.approx(M_a, abs=1e-13)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_linear_fields_go_on_across_a_tangent(dimension):
    """v = v_0 + G x with the jump G d_s, and p = a . x with its value below the source."""
    rng, _, x, shift = slanted(dimension)
    v_0, G, a = (rng.normal(size=(dimension,) * k) for k in (1, 2, 1))
    rules = {"stressed": [0.0, 1.0], "factor": entries(np.ones(dimension))}
    rules["added"] = entries(np.zeros(dimension))
    found = ghost_velocity(1, 1, entries(v_0 + G @ x), entries(G @ shift), **rules)
    assert found == pytest.approx(v_0 + G @ (x + shift), rel=1e-13)
    foot = x + 0.5 * shift
    p = ghost_pressure(1, 1, [0.0, a @ x], [0.0, a @ foot], [0.0, 1.0])
    assert p == pytest.approx(a @ (x + shift), rel=1e-13)
    assert ghost_pressure(1, 1, [0.0, 3.0], [0.0, 7.0], [0.0, 0.0]) == 3.0


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_loops_give_products_of_reflections(backend, dimension):
    """Every type of a box under a surface: H of the tangent first, then that of each face."""
    rng, d = np.random.default_rng(7), dimension
    sides = [FacePair(MIRROR, MIRROR, -1.0, 1.0) for _ in range(d - 1)]
    types = ghost_types_of((*sides, FacePair(MIRROR, TANGENT, -1.0, 1.0)))
    source, of_type = np.arange(types.count) % 3, np.arange(types.count)
    x, shift, a = (rng.normal(size=(d, 3)) for _ in range(3))
    M, n = rng.normal(size=(d, d, 3)), rng.normal(size=(d, 3))
    n /= np.linalg.norm(n, axis=0)
    fields = {"source": backend.asarray(source, "index")}
    fields["ghost_type"] = backend.asarray(of_type, "index")
    tables = {"sign": backend.asarray(types.sign)}
    tables["crosses_surface"] = backend.asarray(types.crosses_surface)
    place, vector, tensor = (backend.zeros((d,) * k + (types.count,)) for k in (1, 1, 2))
    given = {name: backend.asarray(one) for name, one in (("x", x), ("shift", shift))}
    given["offset"] = backend.asarray(types.offset)
    backend.pointwise(ghost_position, fields, place, **tables, **given)
    planes = tables | {"normal": backend.asarray(n)}
    backend.pointwise(ghost_vector, fields, vector, a=backend.asarray(a), **planes)
    backend.pointwise(ghost_tensor, fields, tensor, M=backend.asarray(M), **planes)
    for k, s in enumerate(source):
        H, at = np.eye(d), x[:, s]
        if types.crosses_surface[k]:
            H, at = H - 2.0 * np.outer(n[:, s], n[:, s]), at + shift[:, s]
        for axis, face in enumerate(types.crossed[:, k]):
            if face and not (axis == d - 1 and types.crosses_surface[k]):
                normal, plane = np.eye(d)[axis], {1: -1.0, 2: 1.0}[face]
                H = (np.eye(d) - 2.0 * np.outer(normal, normal)) @ H
                at = at + 2.0 * (plane - normal @ at) * normal
        assert backend.to_host(place)[:, k] == pytest.approx(at, rel=1e-13)
        assert backend.to_host(vector)[:, k] == pytest.approx(H @ a[:, s], rel=1e-12, abs=1e-14)
        expected = H @ M[..., s] @ H.T
        np.testing.assert_allclose(
            backend.to_host(tensor)[..., k], expected, rtol=1e-12, atol=1e-14
        )
