"""Pairs of rings: two of them by hand, and what the operator of the radial velocity leaves."""

import numpy as np
import pytest

from lasersph.sph.rings import (
    ring_diagonal,
    ring_divergence_term,
    ring_momentum,
    ring_weight,
    ring_weight_off_axis,
)

INNER, OUTER = 1.0, 3.0


def test_weight_is_that_of_the_mean_ring():
    """Lengths 2 and 6: twice four of a pair of weight two, none beyond the axis."""
    assert ring_weight(2.0, 2.0, 6.0) == 8.0
    assert ring_weight_off_axis(2.0, 2.0, 6.0, np.array([0.1, -1.0])) == 8.0
    assert ring_weight_off_axis(2.0, 2.0, 2.0, np.array([-0.1, -1.0])) == 0.0


def test_momentum_of_two_rings():
    """At r = 1 and 3, r_ij = 2: 4/3 of u_j less 4 of u_i, and the plain difference along z."""
    found = ring_momentum(0.5, np.array([1.0, 2.0]), np.array([6.0, 5.0]), INNER, OUTER)
    assert found == pytest.approx([0.5 * (4.0 / 3.0 * 6.0 - 4.0 * 1.0), 0.5 * 3.0])


@pytest.mark.parametrize(("r_i", "r_j"), [(INNER, OUTER), (OUTER, INNER), (0.5, 1.5)])
def test_stretching_has_no_friction(r_i, r_j):
    """u = a r: divergence without shear along r, and hoop stress and Laplacian cancel."""
    found = ring_momentum(1.0, np.array([2.0 * r_i, 1.0]), np.array([2.0 * r_j, 1.0]), r_i, r_j)
    assert found == pytest.approx([0.0, 0.0], abs=1e-15)


def test_matrix_is_symmetric():
    """What u_j counts for in the row of i is what u_i counts for in that of j."""
    e, none = np.array([1.0, 0.0]), np.zeros(2)
    of_j = ring_momentum(1.0, none, e, INNER, OUTER)[0]
    of_i = ring_momentum(1.0, none, e, OUTER, INNER)[0]
    assert of_j == pytest.approx(of_i) == pytest.approx(4.0 / 3.0)


def test_diagonal_is_what_the_row_itself_loses():
    """By component."""
    v = np.array([1.0, 1.0])
    lost = -ring_momentum(1.0, v, np.zeros(2), INNER, OUTER)
    assert ring_diagonal(1.0, INNER, OUTER) == pytest.approx(lost)


def test_divergence_of_two_rings():
    """r_ij/r_i = 2: twice (u_j - u_i + 2 u_i) G_r + (w_j - w_i) G_z; nothing across the axis."""
    v_i, v_j, G = np.array([1.0, 2.0]), np.array([6.0, 5.0]), np.array([0.5, 0.25])
    pair = (v_i, v_j, np.eye(2), G, INNER, OUTER)
    assert ring_divergence_term(*pair, np.array([OUTER, 0.0])) == 2.0 * (7.0 * 0.5 + 3.0 * 0.25)
    assert ring_divergence_term(*pair, np.array([-OUTER, 0.0])) == 0.0
