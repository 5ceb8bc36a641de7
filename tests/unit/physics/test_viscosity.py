"""Viscous exchange of two particles by hand, explicit and implicit."""

import numpy as np
import pytest

from lasersph.physics.viscosity import (
    advance,
    forced,
    momentum,
    multiply,
    predict,
    start,
    transposed_force,
    transposed_terms,
    turn,
    viscous_weight,
    weight_of,
)

FIRST, SECOND = np.array([1.0, 0.0]), np.array([3.0, -2.0])
NO_FORCE = np.zeros(2)


def test_momentum():
    """g (v_j - v_i); what one gains the other loses."""
    assert momentum(0.5, FIRST, SECOND).tolist() == [1.0, -1.0]
    assert momentum(0.5, SECOND, FIRST).tolist() == [-1.0, 1.0]
    assert weight_of(0.5) == 0.5


def test_pair_of_different_viscosities():
    """Harmonic mean of 1 and 1/3: 1/2; the same both ways, and g itself between equals of 1."""
    assert viscous_weight(0.3, 1.0, 1.0) == 0.3
    assert viscous_weight(0.8, 1.0, 1.0 / 3.0) == pytest.approx(0.4)
    assert viscous_weight(0.8, 1.0 / 3.0, 1.0) == viscous_weight(0.8, 1.0, 1.0 / 3.0)


def test_transposed_force():
    """grad v = ((1, 2), (3, -1)), grad m = (5, 7), nu = 2: 2 (5 + 3 * 7, 2 * 5 - 7) over b.

    Both gradients from neighbors at unit distances along x and z, whose G are half unit vectors.
    """
    gradient, slope, C = np.array([[1.0, 2.0], [3.0, -1.0]]), np.array([5.0, 7.0]), np.eye(2)
    terms = [
        transposed_terms(0.0 * e, gradient @ e, 2.0, 2.0 + slope @ e, 0.5 * e)
        for e in (*np.eye(2), *-np.eye(2))
    ]
    sums = (sum(one) for one in zip(*terms, strict=True))
    found = transposed_force(*sums, C, np.array([1.0, 10.0]), 2.0)
    assert found.tolist() == pytest.approx([53.0, 16.0])
    same = transposed_force(gradient, 0.0 * slope, C, FIRST, 2.0)
    assert same.tolist() == FIRST.tolist()


def test_explicit():
    """v + dt (nu / V sum + b) with nu = 2, V = 4, dt = 0.1: 1 + 0.1 (0.5 * 1 + 3)."""
    total = momentum(0.5, FIRST, SECOND)
    b = np.array([3.0, 0.0])
    assert predict(total, FIRST, 4.0, 2.0, b, 0.1).tolist() == pytest.approx([1.35, -0.05])
    assert forced(FIRST, b, 0.1).tolist() == pytest.approx([1.3, 0.0])


def test_implicit_between_two_particles():
    """V = 1, s g = 0.5: the difference shrinks to 1 / (1 + 2 s g) = 1/2 in one step of the method.

    With equal diagonals the first direction is an eigenvector.
    """
    g, s = 0.5, 1.0
    v = [FIRST, SECOND]
    begun = [start(momentum(g, v[i], v[1 - i]), v[i], 1.0, v[i], g, s) for i in range(2)]
    r, z = [b[0] for b in begun], [b[1] for b in begun]
    q_and_dq = [multiply(momentum(g, z[i], z[1 - i]), z[i], 1.0, s) for i in range(2)]
    alpha = sum(b[2] for b in begun) / sum(pair[1] for pair in q_and_dq)
    ended = [advance(v[i], r[i], z[i], q_and_dq[i][0], 1.0, g, alpha, s) for i in range(2)]
    mean, half = 0.5 * (FIRST + SECOND), 0.25 * (FIRST - SECOND)
    assert ended[0][0] == pytest.approx(mean + half)
    assert ended[1][0] == pytest.approx(mean - half)
    assert sum(e[4] for e in ended) == pytest.approx(0.0, abs=1e-30)


def test_directions():
    """z + beta d."""
    assert turn(FIRST, SECOND, 2.0).tolist() == [7.0, -4.0]
