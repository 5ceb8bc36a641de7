"""Terms of the steps of `Flow`, of one particle or one pair, in a plane and of rings."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from lasersph.compute.vectors import dot
from lasersph.physics.viscosity import momentum
from lasersph.solvers.melt_pool.block_terms import weight_of
from lasersph.sph.correction import corrected_divergence_term
from lasersph.sph.density_drift import density_drift_source
from lasersph.sph.rings import (
    ring_diagonal,
    ring_divergence_term,
    ring_momentum,
    ring_resistance,
)

DRIFT_RATE = 0.1
"""Rate at which particles that are too dense part, over the largest speed per spacing; 0 where they
rest. Study: [Asai2012] leaves it open; without it the pressure under a pool differs by 0.3 %."""


def advect(x, v, step):
    """x + v dt [m] (67)."""
    return x + step * v


def move(x, v_old, v, step):
    """x + (v^n + v^(n+1)) dt / 2 [m] (71)."""
    return x + 0.5 * step * (v_old + v)


def divergence_terms(v_i, v_j, C_i, G_ij, VW_ij):
    """Terms of D [1/s] and of the kernel sum S [1], V_j W_ij."""
    return corrected_divergence_term(v_i, v_j, C_i, G_ij), VW_ij


def ring_divergence_terms(v_i, v_j, C_i, G_ij, VW_ij, mean_ij):
    """`divergence_terms` of rings."""
    return ring_divergence_term(v_i, v_j, C_i, G_ij, mean_ij), VW_ij


def ring_shares(g_ij, mean_ij, hoop_ij):
    """Shares of v_i that pairs of rings take by component, and of u_i that the hoop stress takes
    [m]."""
    return ring_diagonal(g_ij, mean_ij), ring_resistance(g_ij, mean_ij, hoop_ij)


def divergence_load(total_0, total_1, V, fraction, lattice_sum, rate):
    """rho / dt V (D - d) [Pa m^(d-2)]."""
    return fraction * V * (total_0 - density_drift_source(total_1, lattice_sum, rate))


def add_force(b, a):
    """b + a [m/s^2]."""
    return b + a


def take_back(v, a, step):
    """v - a dt [m/s]."""
    return v - step * a


def edge_pressure_terms(p_j, unknown_j, W_ij):
    """Terms of the mean pressure of the edge."""
    return unknown_j * p_j * W_ij, unknown_j * W_ij


def dummy_pressure(total_0, total_1, p, dummy):
    """Pressure of a dummy: the mean of the edge within its support; of others their own."""
    if dummy > 0.0:
        return total_0 / max(total_1, 1.0e-300)
    return p


def correct(total, v, v_old, step, density):
    """v - dt/rho G{p} [m/s] (70), -G{p}/rho [m/s^2], and |dv/dt|^2 of all forces of the step."""
    new = v - step / density * total
    a = (new - v_old) / step
    return new, -1.0 / density * total, dot(a, a)


def kinetic_energy(v, V, density):
    """Kinetic energy of a particle [J per meter], of a ring [J]."""
    return 0.5 * density * V * dot(v, v)


def divergence_sizes(total):
    """Square and size of the divergence."""
    return total * total, abs(total)


class FlowTerms(NamedTuple):
    """Pair functions of the flow that differ by geometry.

    Attributes:
        momentum: viscous force over eta that pairs pass on. shares: what they take of v_i, a number
            or one of each component by diagonal_shape, and of rings what the hoop stress takes
            beside it. has_hoop_stress: whether there are rings. divergence: of a velocity.
            divergence_terms: that, and the kernel sum. drift_rate: at which particles that are too
            dense part, over the largest speed per spacing.
    """

    momentum: Callable[..., Any]
    shares: Callable[..., Any]
    diagonal_shape: tuple[int, ...]
    has_hoop_stress: bool
    divergence: Callable[..., Any]
    divergence_terms: Callable[..., Any]
    drift_rate: float


PLANE = FlowTerms(
    momentum, weight_of, (), False, corrected_divergence_term, divergence_terms, DRIFT_RATE
)
RINGS = FlowTerms(
    ring_momentum,
    ring_shares,
    (2,),
    True,
    ring_divergence_term,
    ring_divergence_terms,
    0.0,
)
