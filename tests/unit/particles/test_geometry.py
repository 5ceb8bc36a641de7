"""The space that a block stands for: rings and cells by hand."""

import numpy as np
import pytest

from lasersph.particles import Domain, Geometry, Lattice
from lasersph.particles.extended_lattice import DIRICHLET, MIRROR
from lasersph.particles.filling import fill
from lasersph.particles.layers import stack

SECTION, PLANE = Geometry(2, is_axisymmetric=True), Geometry(2)


def ring_filling(sides=MIRROR):
    """Four columns of 1 um from the axis, six layers."""
    domain = Domain(width=4e-6, depth=6e-6)
    layers = stack(domain, Lattice(spacing=1e-6), SECTION, 0.0)
    return fill(layers, surface=MIRROR, bottom=MIRROR, sides=sides)


def test_two_rings():
    """A ring is 2 pi r long; a cell of a plane counts once."""
    place = np.array([[0.5, 1.5], [-1.0, -1.0]])
    assert SECTION.measure(place) == pytest.approx([np.pi, 3.0 * np.pi])
    assert PLANE.measure(place).tolist() == [1.0, 1.0]


@pytest.mark.parametrize(
    ("geometry", "axis", "place", "area"),
    [
        (Geometry(1), -1, 0.0, 1.0),
        (PLANE, 0, 3.0, 2.0),
        (PLANE, -1, 0.0, 3.0),
        (SECTION, 0, 3.0, 2.0 * np.pi * 3.0 * 2.0),
        (SECTION, -1, 0.0, np.pi * 9.0),
    ],
)
def test_area_of_a_face(geometry, axis, place, area):
    """Of a block 3 wide and 2 deep: lengths, a cylinder, a disc."""
    extents = ((0.0, 3.0), (-2.0, 0.0))[-geometry.dimensions :]
    assert geometry.face_area(axis, place, extents) == pytest.approx(area)


def test_axis_is_no_face():
    """A section has three faces, and its amounts are those of a body."""
    assert SECTION.faces == ("surface", "bottom", "right")
    assert (SECTION.amount_dimension, PLANE.amount_dimension) == (3, 2)


def test_rings_fill_the_body():
    """Volumes and areas are those of the cylinder, and nothing lies beyond its axis."""
    filling = ring_filling()
    assert filling.body_volume.sum() == pytest.approx(np.pi * 16e-12 * 6e-6, rel=1e-14)
    assert filling.cross_section[filling.surface].sum() == pytest.approx(np.pi * 16e-12, rel=1e-14)
    assert filling.position[0].min() == pytest.approx(0.5e-6)


def test_dummies_have_the_ring_of_their_source():
    """So that mirrored pairs weigh the same both ways; beyond a wall they have their own."""
    mirrored, wall = ring_filling(), ring_filling(sides=DIRICHLET)
    beyond = mirrored.position[0] > 4e-6
    sources = mirrored.source[beyond]
    assert np.array_equal(mirrored.measure[beyond], mirrored.measure[sources])
    beyond = (wall.position[0] > 4e-6) & (wall.dirichlet > 0)
    assert wall.measure[beyond] == pytest.approx(2.0 * np.pi * wall.position[0, beyond])
