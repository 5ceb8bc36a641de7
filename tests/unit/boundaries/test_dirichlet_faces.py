"""Boundary coefficients of faces of given temperature."""

import numpy as np
import pytest

from lasersph.boundaries import Boundaries
from lasersph.boundaries.dirichlet_faces import DirichletFace, boundary_coefficients
from lasersph.particles import Domain, Geometry, Lattice
from lasersph.particles.extended_lattice import DIRICHLET, FREE
from lasersph.particles.filling import fill
from lasersph.particles.layers import stack

SPACING = 1.0


def column():
    """Four cells of 1 m under a free surface, dummies below."""
    layers = stack(Domain(depth=4.0), Lattice(spacing=SPACING), Geometry(1), 0.0)
    return fill(layers, surface=FREE, bottom=DIRICHLET, sides=FREE)


def coefficients_of(*, is_wall):
    """Pulls and weights left: particle 3 and two dummies, 2 and the first dummy, 2 and 3."""
    filling = column()
    below = np.argsort(-filling.position[-1, filling.count :]) + filling.count
    row = np.array([3, 3, 2, 2])
    neighbor = np.array([below[0], below[1], below[0], 3], np.uint32)
    weights = np.array([8.0, 2.0, 1.0, 5.0])
    found = boundary_coefficients(
        [DirichletFace("bottom", is_wall)], filling, weights, row, neighbor, ((-4.0, 0.0),)
    )
    return found["bottom"].total(4), weights


def test_wall_of_particles():
    """Dummies at the wall's temperature count with their weights: 8 + 2 and 1."""
    coefficient, weights = coefficients_of(is_wall=True)
    assert coefficient.tolist() == [0.0, 0.0, 1.0, 10.0]
    assert weights.tolist() == [0.0, 0.0, 0.0, 5.0]


def test_dirichlet_face():
    """Extrapolation through the face at -4 m: 8 * 1/0.5 + 2 * 2/0.5 = 24, and 1 * 2/1.5."""
    coefficient, _ = coefficients_of(is_wall=False)
    assert coefficient == pytest.approx([0.0, 0.0, 2.0 / 1.5, 24.0])


def test_dirichlet_sides_and_corner():
    """Beyond a side the distances along x count: n_ij = 1 m, n_i = 0.5 m."""
    layers = stack(
        Domain(depth=4.0, width=4.0, extent="full"), Lattice(spacing=1.0), Geometry(2), 0.0
    )
    filling = fill(layers, surface=FREE, bottom=FREE, sides=DIRICHLET)
    x, z = filling.position
    i = int(np.flatnonzero((x[:16] == -1.5) & (z[:16] == -0.5))[0])
    j = int(np.flatnonzero((x == -2.5) & (z == -1.5))[0])
    found = boundary_coefficients(
        [DirichletFace("left", False)], filling, np.array([3.0]), np.array([i]),
        np.array([j], np.uint32), layers.extents,
    )  # fmt: skip
    coefficient = found["left"]
    assert coefficient.total(16)[i] == pytest.approx(3.0 * 1.0 / 0.5)
    # the line from (-1.5, -0.5) to (-2.5, -1.5) crosses the face halfway
    assert coefficient.place[:, 0] == pytest.approx([-2.0, -1.0])
    assert coefficient.total(16, coefficient.place[1])[i] == pytest.approx(-6.0)


def test_temperature_of_a_face():
    """Dirichlet faces take their own temperature, else the initial one."""
    fixed = Boundaries(bottom="wall", sides="fixed-temperature", side_temperature=350.0)
    assert fixed.temperature_of("bottom", 300.0) == 300.0
    assert fixed.temperature_of("left", 300.0) == 350.0
    assert fixed.temperature_of("back", 300.0) == 350.0


def test_refusals():
    """A temperature without a Dirichlet face, and a Dirichlet surface without one, are refused."""
    with pytest.raises(ValueError, match="says nothing where bottom"):
        Boundaries(bottom_temperature=300.0)
    with pytest.raises(ValueError, match='is missing where surface = "wall"'):
        Boundaries(surface="wall")
