"""Banded Cholesky factors: two unknowns by hand, a grid beside dense elimination, a lost pivot."""

import numpy as np
import pytest
from scipy.sparse import csr_matrix, diags, identity, kron

from lasersph.linear_solvers.banded import factorize


def test_two_unknowns_by_hand():
    """4 x + 2 y = 2, 2 x + 4 y = -2: x = 1, y = -1; L has 2 and 1, and the root of 3."""
    found = factorize(csr_matrix([[4.0, 2.0], [2.0, 4.0]]))
    assert found.solve(np.array([2.0, -2.0])) == pytest.approx([1.0, -1.0])
    assert found.lower[:, 0] == pytest.approx([2.0, 1.0])
    assert found.lower[0, 1] == pytest.approx(np.sqrt(3.0))


def test_numbers_in_any_order():
    """A shuffled grid of 12 by 7: the band is that of 7 columns, x that of dense elimination."""
    line = [diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(n, n)) for n in (12, 7)]
    grid = kron(line[0], identity(7)) + kron(identity(12), line[1]) + identity(84)
    shuffled = np.random.default_rng(3).permutation(84)
    A = csr_matrix(grid)[shuffled][:, shuffled]
    b = np.random.default_rng(4).normal(size=84)
    found = factorize(A)
    assert found.lower.shape[0] <= 9
    assert found.solve(b) == pytest.approx(np.linalg.solve(A.toarray(), b), rel=1e-10)


def test_direction_without_a_pivot():
    """(1, -1) counts less than nothing by rounding: the rest of the solution is right."""
    found = factorize(csr_matrix([[1e8, 1e8], [1e8, 1e8 * (1.0 - 1e-15)]]))
    x = found.solve(np.array([2e8, 2e8]))
    assert np.sum(x) == pytest.approx(2.0, rel=1e-9) and np.all(np.abs(x - 1.0) < 0.1)
