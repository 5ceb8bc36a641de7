"""Pairs of rings: two of them by hand, and what the operator of the radial velocity leaves."""

import numpy as np
import pytest

from lasersph.sph.rings import (
    hoop_share,
    mean_share,
    ring_diagonal,
    ring_divergence_term,
    ring_momentum,
    ring_pair,
    ring_resistance,
    ring_weight,
    ring_weight_off_axis,
)

INNER, OUTER = 1.0, 3.0


def test_weight_is_that_of_the_mean_ring():
    """Lengths 2 and 6: twice four of a pair of weight two, none beyond the axis."""
    assert ring_weight(2.0, 2.0, 6.0) == 8.0
    assert ring_weight_off_axis(2.0, INNER, OUTER) == pytest.approx(8.0 * np.pi)
    assert ring_weight_off_axis(2.0, INNER, -INNER) == 0.0


def force_of_pair(v_i, v_j, r_i, r_j, g=1.0):
    """Viscous force on ring i beside ring j, through the pair and by the hoop stress."""
    mean, hoop = mean_share(r_i, r_j, 1.0 / r_i), hoop_share(r_i, r_j, 1.0 / r_i, 1.0 / r_j)
    through_pair = ring_momentum(g, np.array(v_i), np.array(v_j), hoop)
    return through_pair - np.array([ring_resistance(g, mean, hoop) * v_i[0], 0.0])


def test_momentum_of_two_rings():
    """At r = 1 and 3, r_ij = 2: 4/3 of u_j less 4 of u_i, and the plain difference along z."""
    found = force_of_pair([1.0, 2.0], [6.0, 5.0], INNER, OUTER, g=0.5)
    assert found == pytest.approx([0.5 * (4.0 / 3.0 * 6.0 - 4.0 * 1.0), 0.5 * 3.0])


@pytest.mark.parametrize(("r_i", "r_j"), [(INNER, OUTER), (OUTER, INNER), (0.5, 1.5)])
def test_stretching_has_no_friction(r_i, r_j):
    """u = a r: divergence without shear along r, and hoop stress and Laplacian cancel."""
    found = force_of_pair([2.0 * r_i, 1.0], [2.0 * r_j, 1.0], r_i, r_j)
    assert found == pytest.approx([0.0, 0.0], abs=1e-15)


def test_matrix_is_symmetric():
    """What u_j counts for in the row of i is what u_i counts for in that of j."""
    e, none = [1.0, 0.0], [0.0, 0.0]
    of_j = force_of_pair(none, e, INNER, OUTER)[0]
    of_i = force_of_pair(none, e, OUTER, INNER)[0]
    assert of_j == pytest.approx(of_i) == pytest.approx(4.0 / 3.0)


def test_diagonal_is_what_the_row_itself_loses():
    """By component, through its pairs and beside them."""
    diagonal = ring_diagonal(1.0, mean_share(INNER, OUTER, 1.0 / INNER))
    assert diagonal == pytest.approx(-force_of_pair([1.0, 1.0], [0.0, 0.0], INNER, OUTER))


def test_values_of_a_pair():
    """Its weight for flow and heat and the mean ring, 0 beyond the axis, and what u_j counts
    for."""
    r_and_c = (INNER, OUTER, 1.0 / INNER, 1.0 / OUTER)
    found = ring_pair(2.0, *r_and_c)
    assert found == pytest.approx((8.0 * np.pi, 8.0 * np.pi, 2.0, 4.0 / 3.0))
    assert ring_pair(2.0, INNER, -OUTER, *r_and_c[2:])[:3] == (0.0, 0.0, 0.0)


def test_divergence_of_two_rings():
    """r_ij/r_i = 2: twice (u_j - u_i + 2 u_i) G_r + (w_j - w_i) G_z; nothing across the axis,
    where it counts for 0."""
    v_i, v_j, G = np.array([1.0, 2.0]), np.array([6.0, 5.0]), np.array([0.5, 0.25])
    mean = mean_share(INNER, OUTER, 1.0 / INNER)
    found = ring_divergence_term(v_i, v_j, np.eye(2), G, mean)
    assert found == 2.0 * (7.0 * 0.5 + 3.0 * 0.25)
    assert ring_divergence_term(v_i, v_j, np.eye(2), G, 0.0) == 0.0
