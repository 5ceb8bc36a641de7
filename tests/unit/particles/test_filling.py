"""Particles in cells, and the dummies beyond each face."""

import numpy as np
import pytest

from lasersph.particles import Domain, Geometry, Lattice
from lasersph.particles.extended_lattice import DIRICHLET, FACES, FREE, GHOSTS, MIRROR, PERIODIC
from lasersph.particles.filling import fill
from lasersph.particles.layers import Layers, stack


def block(dimensions=2, depth=8e-7, width=6e-7):
    """Uniform block of 0.1 um cells."""
    domain = Domain(depth=depth, width=width if dimensions > 1 else None, breadth=None)
    return stack(domain, Lattice(spacing=1e-7), Geometry(dimensions), 0.0)


@pytest.mark.parametrize("dimensions", [1, 2, 3])
def test_real_particles_fill_the_box(dimensions):
    """Volumes add up to the box; particles sit in the middle of their cells, top layer first."""
    filling = fill(block(dimensions), surface=FREE, bottom=FREE, sides=FREE)
    count = filling.count
    assert filling.position.shape == (dimensions, count)
    box = 8e-7 * 6e-7 ** (dimensions - 1)
    assert filling.volume.sum() == pytest.approx(box, rel=1e-12)
    assert np.all(filling.source == np.arange(count))
    assert not filling.dirichlet.any()
    assert np.all(filling.layer[filling.surface] == 0)
    assert np.all(filling.position[-1, filling.surface] == pytest.approx(-0.5e-7))
    assert filling.surface.size == 6 ** (dimensions - 1)


def test_mirror_dummies_mirror_surface_bottom_and_sides():
    """Every dummy lies at the mirror image of its source about the face (twice at corners)."""
    filling = fill(block(), surface=MIRROR, bottom=MIRROR, sides=MIRROR)
    count = filling.count
    x, z = filling.position[:, count:]
    sx, sz = filling.position[:, filling.source[count:]]
    mirrored_x = np.where(x < -3e-7, -6e-7 - sx, np.where(x > 3e-7, 6e-7 - sx, sx))
    mirrored_z = np.where(z > 0.0, -sz, np.where(z < -8e-7, -16e-7 - sz, sz))
    assert x == pytest.approx(mirrored_x, abs=1e-18)
    assert z == pytest.approx(mirrored_z, abs=1e-18)
    assert x.size == (6 + 2 * GHOSTS) * (8 + 2 * GHOSTS) - count
    assert np.all(filling.source[count:] < count)
    assert np.all(filling.layer[count:][z > 0.0] < 0)


def test_periodic_dummies_are_translated():
    """Beyond a periodic side lies the same row shifted by the width."""
    filling = fill(block(), surface=FREE, bottom=FREE, sides=PERIODIC)
    count = filling.count
    x, z = filling.position[:, count:]
    sx, sz = filling.position[:, filling.source[count:]]
    assert z == pytest.approx(sz)
    assert np.abs(x - sx) == pytest.approx(np.full(x.size, 6e-7))


def test_narrow_patterns_are_unfolded():
    """One column: periodic images and mirror images all stand for the only particle of the row."""
    for sides in (MIRROR, PERIODIC):
        filling = fill(block(width=1e-7), surface=FREE, bottom=FREE, sides=sides)
        row = filling.layer == 3
        assert row.sum() == 1 + 2 * GHOSTS
        assert np.all(filling.source[row] == 3)
        assert np.diff(np.sort(filling.position[0, row])) == pytest.approx(
            np.full(2 * GHOSTS, 1e-7)
        )


def test_two_columns_are_reflected_repeatedly():
    """Columns a b between mirrors continue as b a | a b | b a a b ..."""
    filling = fill(block(width=2e-7), surface=FREE, bottom=FREE, sides=MIRROR)
    row = np.flatnonzero(filling.layer == 0)
    row = row[np.argsort(filling.position[0, row])]
    assert filling.source[row].tolist() == [0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1]


def test_dirichlet_faces_are_marked():
    """Dummies of a Dirichlet bottom have its index, at the corners too; mirrored sides none."""
    filling = fill(block(), surface=MIRROR, bottom=DIRICHLET, sides=MIRROR)
    beyond = filling.position[-1] < -8e-7
    assert np.all(filling.dirichlet[beyond] == FACES.index("bottom"))
    assert not filling.dirichlet[~beyond].any()


def test_corners_belong_to_the_bottom_where_both_hold():
    """Where sides and bottom hold temperatures, the corner dummies take that of the bottom."""
    filling = fill(block(), surface=FREE, bottom=DIRICHLET, sides=DIRICHLET)
    x, z = filling.position
    outside = np.abs(x) > 3e-7
    assert np.all(filling.dirichlet[z < -8e-7] == FACES.index("bottom"))
    assert np.all(filling.dirichlet[(z > -8e-7) & (x < -3e-7)] == FACES.index("left"))
    assert np.all(filling.dirichlet[(z > -8e-7) & (x > 3e-7)] == FACES.index("right"))
    assert not filling.dirichlet[~outside & (z > -8e-7)].any()
    assert not filling.dirichlet[: filling.count].any()


def test_ends_of_different_kind():
    """The left end holds, the right one mirrors; each marks its own dummies only."""
    filling = fill(block(), surface=FREE, bottom=FREE, sides=MIRROR, left=DIRICHLET)
    x = filling.position[0]
    assert np.all(filling.dirichlet[x < -3e-7] == FACES.index("left"))
    assert not filling.dirichlet[x > -3e-7].any()
    assert np.sum(x < -3e-7) == np.sum(x > 3e-7) == GHOSTS * 8
    cut = fill(block(), surface=FREE, bottom=FREE, sides=MIRROR, right=FREE)
    assert cut.position[0].max() < 3e-7


def test_periodic_in_depth():
    """Beyond surface and bottom lie the same columns shifted by the depth."""
    filling = fill(block(), surface=PERIODIC, bottom=PERIODIC, sides=PERIODIC)
    dummies = slice(filling.count, None)
    shift = filling.position[:, dummies] - filling.position[:, filling.source[dummies]]
    steps = shift / np.array([[6e-7], [8e-7]])
    assert steps == pytest.approx(np.rint(steps), abs=1e-9)
    assert set(np.rint(steps[1]).astype(int)) == {-1, 0, 1}
    assert np.sum(filling.position[-1] > 0.0) == GHOSTS * (6 + 2 * GHOSTS)
    assert not filling.dirichlet.any()


def test_above_is_the_surface_cell_over_a_particle():
    """Layers of fewer columns lie under the surface cell that holds their center."""
    layers = Layers(
        np.array([1e-7, 2e-7, 3e-7]), np.array([[6, 3, 2]]), ((-3e-7, 3e-7),), Geometry(2)
    )
    filling = fill(layers, surface=FREE, bottom=FREE, sides=FREE)
    assert filling.above[:6].tolist() == [0, 1, 2, 3, 4, 5]
    assert filling.above[6:9].tolist() == [1, 3, 5]
    assert filling.above[9:].tolist() == [1, 4]


def test_above_in_three_dimensions():
    """In 3-D the surface cell has the same x and y on a uniform lattice."""
    filling = fill(block(3), surface=FREE, bottom=FREE, sides=FREE)
    over = filling.position[:2, filling.above]
    assert over == pytest.approx(filling.position[:2, : filling.count])
