"""Sums over a lattice: second moments, thresholds of the free surface, fastest modes."""

import numpy as np
import pytest

from lasersph.sph.divergence import SURFACE_THRESHOLD
from lasersph.sph.kernels import kernel
from lasersph.sph.lattice_sums import (
    diffusive_rate,
    lattice_neighbors,
    second_moment,
    surface_threshold,
)


@pytest.mark.parametrize(("dimension", "count"), [(1, 4), (2, 24), (3, 92)])
def test_neighbors_within_three_spacings(dimension, count):
    """4, 24 and 92 of them, none at the support itself."""
    place, slope = lattice_neighbors(kernel("cubic-spline", dimension), 3.0)
    assert place.shape == (dimension, count)
    assert (slope > 0.0).all()


@pytest.mark.parametrize(("dimension", "value"), [(1, 0.98765432), (2, 1.00672451), (3, 1.0101228)])
def test_second_moment(dimension, value):
    """Cubic spline, h = 1.5 dx; 3.030 / 3 in 3-D."""
    assert second_moment(kernel("cubic-spline", dimension), 3.0) == pytest.approx(value, abs=1e-7)


def test_second_moment_of_a_wide_quintic_spline():
    """Nearly 1."""
    assert second_moment(kernel("quintic-spline", 1), 3.75) == pytest.approx(1.0012, abs=1e-4)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_surface_threshold(dimension):
    """Halfway between the first and the second layer: the rounded ones in use."""
    found = surface_threshold(kernel("cubic-spline", dimension), 3.0)
    assert found == pytest.approx(SURFACE_THRESHOLD[dimension], abs=0.02)


@pytest.mark.parametrize(("dimension", "limit"), [(1, 0.84375), (2, 0.79), (3, 0.741)])
def test_diffusive_limit(dimension, limit):
    """The midpoint rule bears 2 / L."""
    rate = diffusive_rate(kernel("cubic-spline", dimension), 3.0)
    assert 2.0 / rate == pytest.approx(limit, abs=5e-4)


@pytest.mark.parametrize(("ratio", "error"), [(3.75, 0.37), (3.1, 0.255)])
def test_gradient_of_a_wave(ratio, error):
    """A wave sin kx has the slope k (1 - error k^2 dx^2) on a lattice; 1/6 for differences."""
    (x, z), slope = lattice_neighbors(kernel("quintic-spline", 2), ratio)
    weight, k = slope / np.hypot(x, z), 0.1
    found = np.sum(weight * x * np.sin(k * x)) / np.sum(weight * x * x)
    assert (1.0 - found / k) / k**2 == pytest.approx(error, abs=0.01)
