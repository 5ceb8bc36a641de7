"""Images of moving particles beyond the faces of a box, placed by hand."""

import numpy as np
import pytest

from lasersph.particles.images import LOWER, MIRROR, OPEN, PERIODIC, UPPER, FacePair, images_of

X, Z = (0.0, 1.0), (-1.0, 0.0)


def images(position, *kinds, reach=0.3):
    """Images of `position` in the unit box and their places; kinds of left, right, bottom, top."""
    faces = (FacePair(kinds[0], kinds[1], *X), FacePair(kinds[2], kinds[3], *Z))
    position = np.array(position, float).T
    found = images_of(position, reach, faces)
    return found, found.sign * position[:, found.source] + found.offset


def test_far_from_all_faces():
    """A particle in the middle has no image."""
    found, _ = images([(0.5, -0.5)], *[MIRROR] * 4)
    assert found.count == 0


def test_mirror():
    """x' = 2 x_face - x beyond the near face, the other coordinate kept; the far face has none."""
    found, place = images([(0.5, -0.5), (0.9, -0.4)], *[MIRROR] * 4)
    assert found.source.tolist() == [1]
    assert place[:, 0] == pytest.approx([1.1, -0.4])
    assert found.sign[:, 0].tolist() == [-1.0, 1.0]
    assert found.crossed[:, 0].tolist() == [UPPER, 0]


def test_periodic():
    """A particle near one side appears beyond the other; both ways for two particles."""
    found, place = images([(0.1, -0.5), (0.8, -0.5)], PERIODIC, PERIODIC, OPEN, OPEN)
    by_source = dict(zip(found.source.tolist(), place.T, strict=True))
    assert by_source[0] == pytest.approx([1.1, -0.5])
    assert by_source[1] == pytest.approx([-0.2, -0.5])
    assert np.all(found.sign == 1.0)
    crossed = dict(zip(found.source.tolist(), found.crossed[0].tolist(), strict=True))
    assert crossed == {0: UPPER, 1: LOWER}


def test_open():
    """Beyond an open face there is nothing."""
    found, place = images([(0.1, -0.9)], MIRROR, MIRROR, OPEN, MIRROR)
    assert place[:, 0] == pytest.approx([-0.1, -0.9])
    assert found.count == 1
    assert found.crossed[:, 0].tolist() == [LOWER, 0]


def test_corner():
    """Near two faces: an image beyond each and one beyond both, which turns by 180 degrees."""
    found, place = images([(0.1, -0.2)], *[MIRROR] * 4)
    places = {tuple(np.round(p, 12)) for p in place.T}
    assert places == {(-0.1, -0.2), (0.1, 0.2), (-0.1, 0.2)}
    (corner,) = np.flatnonzero((found.crossed != 0).all(axis=0))
    assert found.crossed[:, corner].tolist() == [LOWER, UPPER]
    assert found.sign[:, corner].tolist() == [-1.0, -1.0]


def test_corner_of_a_period_and_a_mirror():
    """One period away and mirrored at the top at once."""
    found, place = images([(0.9, -0.1)], PERIODIC, PERIODIC, MIRROR, MIRROR)
    (corner,) = np.flatnonzero((found.crossed != 0).all(axis=0))
    assert place[:, corner] == pytest.approx([-0.1, 0.1])
    assert found.sign[:, corner].tolist() == [1.0, -1.0]


def test_reach():
    """Strictly closer than `reach`: 0.29 has an image, 0.3 has none."""
    found, _ = images([(0.29, -0.5), (0.3, -0.5)], MIRROR, MIRROR, OPEN, OPEN)
    assert found.source.tolist() == [0]


def test_box_narrower_than_the_reach():
    """A particle near both faces of a narrow box has an image beyond each."""
    _, place = images([(0.4, -0.5)], MIRROR, MIRROR, OPEN, OPEN, reach=0.8)
    assert sorted(place[0]) == pytest.approx([-0.4, 1.6])


def test_one_and_three_dimensions():
    """A corner of a cube has seven images, an end of a line one."""
    faces = [FacePair(MIRROR, MIRROR, 0.0, 1.0)] * 3
    assert images_of(np.full((3, 1), 0.1), 0.3, faces).count == 7
    assert images_of(np.full((1, 1), 0.1), 0.3, faces[:1]).count == 1
