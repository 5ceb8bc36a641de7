"""Gradients, divergences, kernel correction: two particles by hand, lattices, laws."""

import numpy as np
import pytest
from lattices import lattice, with_neighbors

from lasersph.sph import correction, divergence, gradient, schwaiger

X = np.array([[3.0, 4.0], [0.0, 0.0]]).T  # columns are the particles i and j: x_ij = (3, 4)


def test_terms_by_hand():
    """Two particles at distance 5 with dW/dr = -0.5: grad W = (-0.3, -0.4)."""
    x_ij, r_ij, dW_ij = np.array([3.0, 4.0]), 5.0, -0.5
    np.testing.assert_allclose(
        gradient.difference_term(1.0, 4.0, 6.0, 2.0, x_ij, r_ij, dW_ij), [-2.7, -3.6]
    )
    # rho_i m_j (f_i / rho_i^2 + f_j / rho_j^2) = 2 * 6 * (1/4 + 4/16) = 6
    np.testing.assert_allclose(
        gradient.symmetric_term(1.0, 4.0, 6.0, 2.0, 4.0, x_ij, r_ij, dW_ij), [-1.8, -2.4]
    )
    v_i, v_j = np.array([1.0, 0.0]), np.array([2.0, 2.0])
    assert divergence.difference_term(v_i, v_j, 6.0, 2.0, x_ij, r_ij, dW_ij) == pytest.approx(
        6.0 / 2.0 * (1.0 * -0.3 + 2.0 * -0.4)
    )
    assert divergence.position_term(2.0, r_ij, dW_ij) == pytest.approx(5.0)
    np.testing.assert_allclose(
        correction.correction_term(2.0, x_ij, r_ij, dW_ij), [[1.8, 2.4], [2.4, 3.2]]
    )
    C_i, C_j, G_ij = np.diag([2.0, 1.0]), np.diag([1.0, 3.0]), np.array([-0.6, -0.8])
    np.testing.assert_allclose(
        correction.corrected_difference_term(1.0, 4.0, C_i, C_j, G_ij), [-3.6, -2.4]
    )
    np.testing.assert_allclose(
        correction.corrected_symmetric_term(1.0, 4.0, C_i, C_j, G_ij), [-3.6, -10.4]
    )


def test_schwaiger_terms_by_hand():
    """With C = I the weight is dW/dr / r = -0.1; C = 2 I doubles it."""
    x_ij, r_ij, dW_ij, one = np.array([3.0, 4.0]), 5.0, -0.5, np.eye(2)
    assert schwaiger.normal_weight(one, x_ij, r_ij, dW_ij) == pytest.approx(-0.1)
    assert schwaiger.normal_weight(2.0 * one, x_ij, r_ij, dW_ij) == pytest.approx(-0.2)
    np.testing.assert_allclose(schwaiger.normal_term(one, 2.0, x_ij, r_ij, dW_ij), [-0.6, -0.8])
    np.testing.assert_allclose(
        schwaiger.gamma_term(one, 2.0, x_ij, r_ij, dW_ij), [[1.8, 2.4], [2.4, 3.2]]
    )
    assert schwaiger.second_difference_term(
        1.0, 3.0, 5.0, 2.0, one, 2.0, x_ij, r_ij, dW_ij
    ) == pytest.approx(2.0 * 4.0 * 3.0 * -0.1)
    assert schwaiger.prefactor(0.5 * one) == pytest.approx(2.0)
    df, N = np.array([1.0, 2.0]), np.array([0.5, 0.25])
    assert schwaiger.scaled(3.0, 0.5, df, N, 2.0) == pytest.approx(2.0 * (3.0 - 1.0))


def test_sums_over_two_particles(backend):
    """The loops give what the terms give by hand, on both particles."""
    neighbors = with_neighbors(backend, X, 8.0)
    slope = neighbors.kernel.derivative(5.0, 8.0)
    fields = {name: backend.asarray(np.array(pair)) for name, pair in {
        "f": [1.0, 4.0], "m": [3.0, 6.0], "rho": [2.0, 4.0], "V": [1.5, 1.5]}.items()}  # fmt: skip
    fields["v"] = backend.asarray(np.array([[1.0, 2.0], [0.0, 2.0]]))
    out, number = backend.zeros((2, 2)), backend.zeros(2)
    unit = np.array([[0.6, -0.6], [0.8, -0.8]])
    for function, factors in (
        (gradient.difference_gradient, [9.0, 3.0 / 4.0 * -3.0]),
        (gradient.symmetric_gradient, [6.0, 4.0 * 3.0 * 0.5]),
        (correction.standard_gradient, [4.5, -4.5]),
    ):
        function(backend, neighbors, fields, out)
        np.testing.assert_allclose(backend.to_host(out), slope * unit * factors, rtol=1e-13)
    divergence.divergence(backend, neighbors, fields, number)
    np.testing.assert_allclose(backend.to_host(number), slope * 2.2 * np.array([3.0, 0.75]))
    backend.pair_sum(divergence.position_term, neighbors, fields, number)
    np.testing.assert_allclose(backend.to_host(number), -1.5 * 5.0 * slope)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_symmetric_gradient_is_skew_adjoint_to_divergence(backend, dimension):
    """sum_i V_i G+_i{p} . v_i = - sum_i V_i p_i D-_i{v} on a disturbed lattice."""
    random = np.random.default_rng(dimension)
    position = lattice(dimension, 6)
    position += 0.2 * random.random(position.shape)
    n = position.shape[1]
    neighbors = with_neighbors(backend, position, 2.5, "quintic-spline")
    m, rho, p = (random.random(n) + 0.5 for _ in range(3))
    v = random.random((dimension, n)) - 0.5
    fields = {name: backend.asarray(a) for name, a in zip(["m", "p", "v"], (m, p, v), strict=True)}
    fields |= {"rho": backend.asarray(rho), "f": fields["p"]}
    G, D = backend.zeros((dimension, n)), backend.zeros(n)
    gradient.symmetric_gradient(backend, neighbors, fields, G)
    divergence.divergence(backend, neighbors, fields, D)
    left = np.sum(m / rho * np.sum(backend.to_host(G) * v, axis=0))
    right = -np.sum(m / rho * p * backend.to_host(D))
    assert left == pytest.approx(right, rel=1e-12)


@pytest.mark.parametrize(
    ("dimension", "values"),
    [(1, (0.494, 0.790)), (2, (1.231, 1.799)), (3, (1.985, 2.810, 3.030))],
)
def test_position_divergence_at_a_flat_surface(backend, dimension, values):
    """Surface, second layer, interior; the threshold parts the first from the second."""
    side = 9
    position = lattice(dimension, side)
    neighbors = with_neighbors(backend, position, 3.0)
    out = backend.zeros(position.shape[1])
    fields = {"V": backend.asarray(np.ones(position.shape[1]))}
    backend.pair_sum(divergence.position_term, neighbors, fields, out)
    middle = backend.to_host(out).reshape((side,) * dimension)[(side // 2,) * (dimension - 1)]
    np.testing.assert_allclose(middle[: len(values[:2])], values[:2], atol=6e-4)
    if dimension == 3:
        assert middle[side // 2] == pytest.approx(values[2], abs=6e-4)
    assert middle[0] < divergence.SURFACE_THRESHOLD[dimension] < middle[1]


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_corrected_gradient_is_exact_on_linear_fields(backend, dimension):
    """At corners, edges and faces alike."""
    position = lattice(dimension, 5)
    n = position.shape[1]
    neighbors = with_neighbors(backend, position, 3.0)
    slope = np.arange(1.0, dimension + 1.0)
    fields = {"V": backend.asarray(np.ones(n)), "f": backend.asarray(2.0 + slope @ position)}
    fields["C"] = backend.zeros((dimension, dimension, n))
    correction.inverse_correction(backend, neighbors, fields, fields["C"])
    out = backend.zeros((dimension, n))
    correction.corrected_gradient(backend, neighbors, fields, out)
    np.testing.assert_allclose(
        backend.to_host(out), np.repeat(slope[:, None], n, axis=1), rtol=1e-12
    )
