"""Reflection of vectors and tensors in planes of any inclination."""

import numpy as np
import pytest

from lasersph.particles.reflection import reflected, reflected_tensor


def normal_of(rng, dimension):
    """A unit vector."""
    n = rng.normal(size=dimension)
    return n / np.linalg.norm(n)


def test_by_hand():
    """In the plane at 45 degrees x and z change places with the other sign; share 0: nothing."""
    n = np.array([1.0, 1.0]) / np.sqrt(2.0)
    assert reflected(np.array([2.0, 3.0]), n, 1.0) == pytest.approx([-3.0, -2.0], rel=1e-14)
    assert reflected(np.array([2.0, 3.0]), n, 0.0).tolist() == [2.0, 3.0]
    M = np.array([[1.0, 2.0], [3.0, 4.0]])
    assert reflected_tensor(M, n, 1.0) == pytest.approx(np.array([[4.0, 3.0], [2.0, 1.0]]))
    assert reflected_tensor(M, n, 0.0).tolist() == M.tolist()


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_twice_is_the_identity(dimension):
    """H H = I for vectors and tensors."""
    rng = np.random.default_rng(dimension)
    n, a, M = (
        normal_of(rng, dimension),
        rng.normal(size=dimension),
        rng.normal(size=(dimension,) * 2),
    )
    assert reflected(reflected(a, n, 1.0), n, 1.0) == pytest.approx(a, rel=1e-13, abs=1e-14)
    twice = reflected_tensor(reflected_tensor(M, n, 1.0), n, 1.0)
    assert twice == pytest.approx(M, rel=1e-13, abs=1e-14)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_vectors_and_tensors_agree(dimension):
    """(H M H)(H a) = H (M a), and lengths, products and traces stay."""
    rng = np.random.default_rng(10 + dimension)
    n, a, b = (normal_of(rng, dimension) for _ in range(3))
    M = rng.normal(size=(dimension,) * 2)
    seen, H_a = reflected_tensor(M, n, 1.0), reflected(a, n, 1.0)
    assert seen @ H_a == pytest.approx(reflected(M @ a, n, 1.0), abs=1e-14)
    assert H_a @ reflected(b, n, 1.0) == pytest.approx(a @ b, abs=1e-14)
    assert np.trace(seen) == pytest.approx(np.trace(M), abs=1e-14)
