"""Density drift of particles, by hand on a lattice and on a pair."""

import pytest

from lasersph.sph.density_drift import density_drift_source, kernel_sum_term
from lasersph.sph.kernels import kernel
from lasersph.sph.lattice_sums import kernel_sum


def test_lattice():
    """The four nearest neighbors lie within the support: 4 W(1) of the cubic spline at l = 1.2."""
    shape = kernel("cubic-spline", 2)
    s = 1.0 / 1.2
    expected = 4.0 * shape.sigma / 1.2**2 * shape.shape(s)
    assert kernel_sum(shape, 1.2) == pytest.approx(expected)


def test_with_the_particle_itself():
    """With W(0) the sum is close to 1: the kernel's integral."""
    shape = kernel("quintic-spline", 2)
    own = shape.sigma / 3.75**2 * shape.shape(0.0)
    assert kernel_sum(shape, 3.75) + own == pytest.approx(1.0, abs=1e-4)


def test_term_and_relaxation():
    """2 m^2 times 3 per m^2; a surplus of 0.5 at 4 per second asks for 2 per second, none for 0."""
    assert kernel_sum_term(2.0, 3.0) == 6.0
    assert density_drift_source(1.5, 1.0, 4.0) == 2.0
    assert density_drift_source(1.0, 1.0, 4.0) == 0.0
