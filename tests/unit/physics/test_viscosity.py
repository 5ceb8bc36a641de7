"""Viscous exchange of two particles by hand."""

import numpy as np
import pytest

from lasersph.physics.viscosity import (
    RIGID,
    forced,
    momentum,
    predict,
    stiffness,
    transposed_force,
    transposed_terms,
    viscous_weight,
)

FIRST, SECOND = np.array([1.0, 0.0]), np.array([3.0, -2.0])
NO_FORCE = np.zeros(2)


def test_momentum():
    """g (v_j - v_i); what one gains the other loses."""
    assert momentum(0.5, FIRST, SECOND).tolist() == [1.0, -1.0]
    assert momentum(0.5, SECOND, FIRST).tolist() == [-1.0, 1.0]


def test_pair_of_different_viscosities():
    """Harmonic mean of 1 and 1/3: 1/2; the same both ways, and g itself between equals of 1."""
    assert viscous_weight(0.3, 1.0, 1.0) == 0.3
    assert viscous_weight(0.8, 1.0, 1.0 / 3.0) == pytest.approx(0.4)
    assert viscous_weight(0.8, 1.0 / 3.0, 1.0) == viscous_weight(0.8, 1.0, 1.0 / 3.0)


def test_what_rests_is_rigid():
    """Twice g m toward it, as if the wall lay halfway, and m itself of what flows."""
    assert stiffness(0.7, 1.0) == 0.7
    assert stiffness(0.7, 0.0) == RIGID
    assert viscous_weight(0.3, 0.7, RIGID) == pytest.approx(2.0 * 0.3 * 0.7)


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
