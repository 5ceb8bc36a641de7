"""Second derivatives at a cut support: the table of operators in 1-D, and 3-D surfaces."""

import numpy as np
import pytest
from lattices import lattice, with_neighbors

from lasersph.sph import correction, schwaiger
from lasersph.sph.laplacian import diffusion

LINE = 1.0 + 0.25 * np.arange(17)


@pytest.fixture
def line(backend):
    """Particles at 1 + 0.25 i, h = 0.375, and fields V, mu, C."""
    neighbors = with_neighbors(backend, LINE[None, :], 0.75)
    fields = {"V": backend.asarray(np.full(17, 0.25)), "mu": backend.asarray(np.ones(17))}
    fields["C"] = backend.zeros((1, 1, 17))
    correction.inverse_correction(backend, neighbors, fields, fields["C"])
    return neighbors, fields


def set_f(backend, fields, values):
    fields["f"] = backend.asarray(values)
    fields["G"] = fields["mu"]


def first(values):
    """Values at particles 0, 1, 2 and one inside."""
    return np.ravel(values)[[0, 1, 2, 8]]


def test_moments(backend, line):
    """M and the raw Gamma are the same in 1-D."""
    neighbors, fields = line
    M = backend.zeros((1, 1, 17))
    correction.correction_matrix(backend, neighbors, fields, M)
    expected = [0.49382716, 0.79012346, 0.98765432, 0.98765432]
    np.testing.assert_allclose(first(backend.to_host(M)), expected, atol=1e-8)
    backend.fill(fields["C"], 1.0)
    Gamma = backend.zeros((1, 1, 17))
    backend.pair_sum(schwaiger.gamma_term, neighbors, fields, Gamma)
    np.testing.assert_allclose(first(backend.to_host(Gamma)), expected, atol=1e-8)


def test_corrected_gradient_of_a_square(backend, line):
    """The error of grad x^2 at the end of the line."""
    neighbors, fields = line
    set_f(backend, fields, LINE**2)
    out = backend.zeros((1, 17))
    correction.corrected_gradient(backend, neighbors, fields, out)
    error = backend.to_host(out)[0] - 2.0 * LINE
    np.testing.assert_allclose(first(error), [0.35, 0.125, 0.0, 0.0], atol=1e-6)


def test_laplacians_of_a_square(backend, line):
    """Brookshaw's against Schwaiger's with corrected gradients; exact 2."""
    neighbors, fields = line
    set_f(backend, fields, LINE**2)
    out = backend.zeros(17)
    backend.pair_sum(diffusion, neighbors, fields, out)
    np.testing.assert_allclose(
        first(backend.to_host(out)), [7.308642, 3.555556, 1.975309, 1.975309], atol=1e-6
    )
    schwaiger.schwaiger_laplacian(backend, neighbors, fields, out)
    np.testing.assert_allclose(first(backend.to_host(out)), [-0.24, 1.875, 2.0, 2.0], atol=1e-6)


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("use_gamma", [True, False])
def test_schwaiger_is_exact_on_linear_fields(backend, dimension, use_gamma):
    """Zero at corners, edges, faces and inside, in every dimension."""
    position = lattice(dimension, 5)
    n = position.shape[1]
    neighbors = with_neighbors(backend, position, 3.0)
    fields = {"V": backend.asarray(np.ones(n)), "mu": backend.asarray(np.ones(n))}
    fields["f"] = backend.asarray(1.0 + np.arange(1.0, dimension + 1.0) @ position)
    fields["C"] = backend.zeros((dimension, dimension, n))
    correction.inverse_correction(backend, neighbors, fields, fields["C"])
    out = backend.zeros(n)
    schwaiger.schwaiger_laplacian(backend, neighbors, fields, out, use_gamma=use_gamma)
    np.testing.assert_allclose(backend.to_host(out), 0.0, atol=1e-11)
