"""GhostParticles of moving particles beyond the faces of a box, placed by hand."""

from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest

from lasersph.particles.ghosts import (
    LOWER,
    MIRROR,
    OPEN,
    PERIODIC,
    TANGENT,
    UPPER,
    FacePair,
    GhostParticles,
    Reach,
    ghost_types_of,
)

X, Z = (0.0, 1.0), (-1.0, 0.0)


@pytest.fixture
def ghosts(backend):
    """Finds the ghosts of `position` in the unit box and their places.

    Args of what it returns: kinds of left, right, bottom, top; `count` of the first particles that
    have ghosts.
    """

    def find(position, *kinds, search_radius=0.3, count=None):
        faces = (FacePair(kinds[0], kinds[1], *X), FacePair(kinds[2], kinds[3], *Z))
        position = np.array(position, float).T
        count = count or position.shape[1]
        found = GhostParticles(backend, count, ghost_types_of(faces))
        nothing, radius = backend.zeros(position.shape[1]), backend.asarray([search_radius] * count)
        found.find(backend.asarray(position), nothing, Reach(radius, radius, 0.0))
        source, ghost_type = (
            backend.to_host(part).astype(int) for part in (found.source, found.ghost_type)
        )
        assert source.size >= found.total and not source[found.total :].any()
        source, ghost_type = source[: found.total], ghost_type[: found.total]
        assert source[:count].tolist() == list(range(count))
        assert not ghost_type[:count].any() and ghost_type[count:].all()
        types = found.ghost_types
        sign, offset = types.sign[:, ghost_type], types.offset[:, ghost_type]
        place = sign * position[:, source] + offset
        assert np.array_equal(place[:, :count], position[:, :count])
        return SimpleNamespace(
            source=source[count:], sign=sign[:, count:], count=source.size - count,
            crossed=found.ghost_types.crossed[:, ghost_type[count:]],
        ), place[:, count:]  # fmt: skip

    return find


def test_far_from_all_faces(ghosts):
    """A particle in the middle has no ghost."""
    found, _ = ghosts([(0.5, -0.5)], *[MIRROR] * 4)
    assert found.count == 0


def test_mirror(ghosts):
    """x' = 2 x_face - x beyond the near face, the other coordinate kept; the far face has none."""
    found, place = ghosts([(0.5, -0.5), (0.9, -0.4)], *[MIRROR] * 4)
    assert found.source.tolist() == [1]
    assert place[:, 0] == pytest.approx([1.1, -0.4])
    assert found.sign[:, 0].tolist() == [-1.0, 1.0]
    assert found.crossed[:, 0].tolist() == [UPPER, 0]


def test_periodic(ghosts):
    """A particle near one side appears beyond the other; both ghost_types for two particles."""
    found, place = ghosts([(0.1, -0.5), (0.8, -0.5)], PERIODIC, PERIODIC, OPEN, OPEN)
    by_source = dict(zip(found.source.tolist(), place.T, strict=True))
    assert by_source[0] == pytest.approx([1.1, -0.5])
    assert by_source[1] == pytest.approx([-0.2, -0.5])
    assert np.all(found.sign == 1.0)
    crossed = dict(zip(found.source.tolist(), found.crossed[0].tolist(), strict=True))
    assert crossed == {0: UPPER, 1: LOWER}


def test_open(ghosts):
    """Beyond an open face there is nothing."""
    found, place = ghosts([(0.1, -0.9)], MIRROR, MIRROR, OPEN, MIRROR)
    assert place[:, 0] == pytest.approx([-0.1, -0.9])
    assert found.count == 1
    assert found.crossed[:, 0].tolist() == [LOWER, 0]


def test_corner(ghosts):
    """Near two faces: an ghost beyond each and one beyond both, which turns by 180 degrees."""
    found, place = ghosts([(0.1, -0.2)], *[MIRROR] * 4)
    places = {tuple(np.round(p, 12)) for p in place.T}
    assert places == {(-0.1, -0.2), (0.1, 0.2), (-0.1, 0.2)}
    (corner,) = np.flatnonzero((found.crossed != 0).all(axis=0))
    assert found.crossed[:, corner].tolist() == [LOWER, UPPER]
    assert found.sign[:, corner].tolist() == [-1.0, -1.0]


def test_corner_of_a_period_and_a_mirror(ghosts):
    """One period away and mirrored at the top at once."""
    found, place = ghosts([(0.9, -0.1)], PERIODIC, PERIODIC, MIRROR, MIRROR)
    (corner,) = np.flatnonzero((found.crossed != 0).all(axis=0))
    assert place[:, corner] == pytest.approx([-0.1, 0.1])
    assert found.sign[:, corner].tolist() == [1.0, -1.0]


def test_search_radius(ghosts):
    """Strictly closer than `search_radius`: 0.29 has a ghost, 0.3 has none."""
    found, _ = ghosts([(0.29, -0.5), (0.3, -0.5)], MIRROR, MIRROR, OPEN, OPEN)
    assert found.source.tolist() == [0]


def test_box_narrower_than_the_search_radius(ghosts):
    """A particle near both faces of a narrow box has a ghost beyond each."""
    _, place = ghosts([(0.4, -0.5)], MIRROR, MIRROR, OPEN, OPEN, search_radius=0.8)
    assert sorted(place[0]) == pytest.approx([-0.4, 1.6])


def test_reach_above_and_below_a_plane(backend):
    """Above it ghosts lie within the radius of a particle, below it within its reach."""
    found = GhostParticles(backend, 2, ghost_types_of(unit_box(MIRROR, OPEN)))
    place = backend.asarray(np.array([[0.2, 0.2], [0.6, 0.4]]))
    radius, reach = backend.asarray([0.1, 0.1]), backend.asarray([0.3, 0.3])
    found.find(place, backend.zeros(2), Reach(radius, reach, 0.5))
    assert backend.to_host(found.source)[: found.total].tolist() == [0, 1, 1]


def test_order(ghosts):
    """Those of x come first, then those of z with their corners; of each type in the order of i."""
    found, _ = ghosts([(0.9, -0.9), (0.5, -0.5), (0.1, -0.9), (0.2, -0.6)], *[MIRROR] * 4)
    ghost_types = [*zip(*found.crossed.tolist(), found.source.tolist(), strict=True)]
    left = [(LOWER, 0, 2), (LOWER, 0, 3), (UPPER, 0, 0)]
    assert ghost_types == [
        *left,
        (0, LOWER, 0),
        (0, LOWER, 2),
        (LOWER, LOWER, 2),
        (UPPER, LOWER, 0),
    ]


def unit_box(*kinds):
    """Faces of a box from 0 to 1 along each axis, of one kind of both."""
    return tuple(FacePair(kind, kind, 0.0, 1.0) for kind in kinds)


def found_at(backend, faces, place, below=(0.0, 0.0)):
    """Places and types of the ghosts of one particle within 0.3 of the faces."""
    types = ghost_types_of(faces)
    found = GhostParticles(backend, 1, types)
    distance, radius, reach = (backend.asarray([one]) for one in (*below, 0.3))
    found.find(backend.asarray(np.array(place)[:, None]), distance, Reach(radius, reach, 1.0))
    of_type = backend.to_host(found.ghost_type).astype(int)[1 : found.total]
    places = types.sign[:, of_type] * np.array(place)[:, None] + types.offset[:, of_type]
    return {tuple(np.round(one, 12)) for one in places.T}, types.crossed[:, of_type], of_type


def test_one_dimension(backend):
    """Beyond one end of a rod, and at none."""
    places, crossed, _ = found_at(backend, unit_box(MIRROR), [0.9])
    assert places == {(1.1,)} and crossed.tolist() == [[UPPER]]
    assert found_at(backend, unit_box(MIRROR), [0.5])[0] == set()


@pytest.mark.parametrize(
    ("place", "count"),
    [((0.5, 0.5, 0.5), 0), ((0.1, 0.5, 0.5), 1), ((0.1, 0.9, 0.5), 3), ((0.1, 0.9, 0.2), 7)],
)
def test_faces_edges_and_corners_in_space(backend, place, count):
    """One ghost beyond a face, three beside an edge, seven in a corner: every product of images."""
    found, _, _ = found_at(backend, unit_box(*[MIRROR] * 3), place)
    images = [(x, -x if x < 0.3 else 2.0 - x) if abs(x - 0.5) > 0.2 else (x,) for x in place]
    expected = {tuple(np.round(one, 12)) for one in product(*images)} - {place}
    assert len(expected) == count and found == expected


def test_corner_of_two_periods_and_an_open_face(backend):
    """One period away along x, along y and along both; nothing beyond the open top."""
    found, _, _ = found_at(backend, unit_box(PERIODIC, PERIODIC, OPEN), (0.1, 0.9, 0.9))
    assert found == {(1.1, 0.9, 0.9), (0.1, -0.1, 0.9), (1.1, -0.1, 0.9)}


def test_types_of_a_box_in_space():
    """27 products, the first axis first; a reflection turns its own axis around alone."""
    types = ghost_types_of(unit_box(MIRROR, MIRROR, MIRROR))
    assert types.count == 27 and types.crossed[:, :4].T.tolist() == [
        [0, 0, 0], [LOWER, 0, 0], [UPPER, 0, 0], [0, LOWER, 0],
    ]  # fmt: skip
    assert np.array_equal(types.sign, np.where(types.crossed > 0, -1.0, 1.0))
    assert np.array_equal(types.offset, np.where(types.crossed == UPPER, 2.0, 0.0))


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize(("distance", "near"), [(0.2, True), (0.4, False)])
def test_surface_instead_of_an_upper_face(backend, dimension, distance, near):
    """Ghosts across a tangent are told by the distance from it, not from the face; those beside it
    by a wider radius, 2.5 times as large."""
    top = FacePair(OPEN, TANGENT, 0.0, 1.0)
    place = (0.6,) * (dimension - 1) + (0.4,)
    faces = (*unit_box(*[MIRROR] * dimension)[1:], top)
    _, crossed, of_type = found_at(backend, faces, place, below=(distance, 0.3))
    types = ghost_types_of(faces)
    assert np.array_equal(types.crosses_surface, (types.crossed[-1] == UPPER).astype(float))
    assert types.sign[-1, :].tolist() == [1.0] * types.count
    # both sides lie within 0.75, alone or together with the tangent
    assert crossed.shape[1] == (2 * 3 ** (dimension - 1) - 1 if near else 0)
    assert np.count_nonzero(types.crosses_surface[of_type]) == (3 ** (dimension - 1) if near else 0)


def test_first_particles_alone(ghosts):
    """Particles beyond the first ones have no ghosts."""
    found, _ = ghosts([(0.5, -0.5), (0.1, -0.5), (0.2, -0.5)], *[MIRROR] * 4, count=2)
    assert found.source.tolist() == [1]
