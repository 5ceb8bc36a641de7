"""Pair functions of the Laplacian on two particles, by hand."""

import numpy as np
import pytest

from lasersph.sph.laplacian import (
    conduction,
    diffusion,
    flow,
    harmonic_flow,
    layered_weight,
    weight,
)

V_I, V_J, R, SLOPE = 2.0, 3.0, 0.5, -4.0


def test_weight():
    """-2 * 2 * 3 * (-4) / 0.5 = 96, the same from both sides."""
    assert weight(V_I, V_J, R, SLOPE) == 96.0
    assert weight(V_J, V_I, R, SLOPE) == 96.0


def test_diffusion():
    """V_j (G_i + G_j)(f_i - f_j) / r dW = 3 * (5 + 7) * (1 - 2) / 0.5 * (-4) = 288."""
    assert diffusion(5.0, 7.0, 1.0, 2.0, V_J, R, SLOPE) == 288.0


def test_conduction_takes_the_harmonic_mean():
    """2 * 3 * 4 * 5 * 20 / 25 * (300 - 400) * (-4) / 0.5 = 76 800 W into the colder particle."""
    assert conduction(300.0, 400.0, 5.0, 20.0, V_I, V_J, R, SLOPE) == 76800.0
    assert conduction(400.0, 300.0, 20.0, 5.0, V_J, V_I, R, SLOPE) == -76800.0


def test_flows_from_weights():
    """g (P_j - P_i); with equal conductivities all means agree."""
    assert flow(96.0, 1.0, 3.0) == 192.0
    assert harmonic_flow(96.0, 300.0, 400.0, 5.0, 20.0) == 96.0 * 8.0 * 100.0
    assert harmonic_flow(96.0, 300.0, 400.0, 5.0, 20.0) == conduction(
        300.0, 400.0, 5.0, 20.0, V_I, V_J, R, SLOPE
    )
    same = harmonic_flow(96.0, 300.0, 400.0, 7.0, 7.0)
    assert same == flow(96.0, 7.0 * 300.0, 7.0 * 400.0)


def test_layered_weight():
    """e_n^2 = 0.64: factor 0.64 (N_i - N_j)/(2 - 5) + 0.36 (a_i + a_j)/2 on the weight 96."""
    x_ij = np.array([0.3, 0.4])
    up = np.array([0.0, 1.0])
    found = layered_weight(V_I, V_J, 2.0, 5.0, 1.9, 5.2, 1.1, 0.9, x_ij, R, SLOPE, up)
    assert found == pytest.approx(96.0 * (0.64 * 1.1 + 0.36 * 1.0), rel=1e-14)
    back = layered_weight(V_J, V_I, 5.0, 2.0, 5.2, 1.9, 0.9, 1.1, -x_ij, R, SLOPE, up)
    assert back == found


def test_layered_weight_within_a_layer():
    """Within a layer only the lateral factor acts: 96 * (1.2 + 1.0) / 2."""
    x_ij, up = np.array([0.5, 0.0]), np.array([0.0, 1.0])
    found = layered_weight(V_I, V_J, 3.0, 3.0, 9.0, 9.0, 1.2, 1.0, x_ij, R, SLOPE, up)
    assert found == pytest.approx(96.0 * 1.1, rel=1e-14)
