"""Moving least squares: exact for polynomials on disordered particles."""

import numpy as np
import pytest

from lasersph.observers.interpolation import interpolate, local_fit


def disordered(seed=0, count=20):
    """Particles of a lattice of unit spacing, displaced by up to a fifth of it; (2, n)."""
    nodes = np.arange(count) + 0.5
    lattice = np.array([grid.ravel() for grid in np.meshgrid(nodes, nodes)])
    return lattice + np.random.default_rng(seed).uniform(-0.2, 0.2, lattice.shape)


@pytest.mark.parametrize("degree", [1, 2])
def test_polynomials_are_exact(degree):
    """Value and slopes of 1 + 2x - 3z (+ xz - z^2), inside, at a corner and at a wall."""
    x, z = position = disordered()
    places = np.array([[7.3, 0.0, 20.0], [9.1, 0.0, 4.2]])

    def field(x, z):
        return 1.0 + 2.0 * x - 3.0 * z + (degree - 1) * (x * z - z * z)

    value, along_x, along_z = local_fit(position, field(x, z), places, degree=degree)
    a, b = places
    assert value == pytest.approx(field(a, b), abs=1e-9)
    assert along_x == pytest.approx(2.0 + (degree - 1) * b, abs=1e-9)
    assert along_z == pytest.approx(-3.0 + (degree - 1) * (a - 2.0 * b), abs=1e-9)


def test_several_fields_at_once():
    """Fields keep their order, and units of length do not matter."""
    position = 1e-9 * disordered()
    fields = np.stack([position[0], -position[1], np.full(position.shape[1], 7.0)])
    places = 1e-9 * np.array([[3.0, 4.0], [5.0, 6.0]])
    expected = [[3e-9, 4e-9], [-5e-9, -6e-9], [7.0, 7.0]]
    assert interpolate(position, fields, places) == pytest.approx(np.array(expected), rel=1e-9)


def test_particles_on_one_line():
    """A row of particles has no slope across it: none is invented."""
    position = np.array([np.arange(10.0), np.zeros(10)])
    value, along, across = local_fit(position, 2.0 * position[0], np.array([[4.5], [0.0]]))
    assert value[0] == pytest.approx(9.0)
    assert along[0] == pytest.approx(2.0)
    assert across[0] == pytest.approx(0.0)
