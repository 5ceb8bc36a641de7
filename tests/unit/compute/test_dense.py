"""Inverse of small dense matrices."""

import numpy as np
import pytest

from lasersph.compute.dense import invert


def test_inverse():
    """Of a positive definite matrix, as by a library."""
    B = np.random.default_rng(4).normal(size=(30, 30))
    A = B @ B.T + np.eye(30)
    assert invert(A.copy()) @ A == pytest.approx(np.eye(30), abs=1e-12)


def test_vanishing_pivots_are_left_out():
    """A singular matrix has the inverse of what remains, and 0 elsewhere."""
    A = np.array([[2.0, -2.0, 0.0], [-2.0, 2.0, 0.0], [0.0, 0.0, 4.0]])
    wanted = [[0.5, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.25]]
    assert invert(A, 1e-10).tolist() == wanted
