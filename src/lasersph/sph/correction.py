"""Kernel gradient correction: gradients exact on linear fields wherever there are neighbors.

    M_i = sum_j V_j grad W_ij (x) (x_j - x_i),      grad~ W_ij = M_i^-1 grad W_ij
    grad f_i = sum_j V_j (f_j - f_i) grad~ W_ij                   [Alshaer2017, eqs. (12)-(15)]

Inside a body M is close to +I. The paper prints x_i - x_j in M; here x_j - x_i, because otherwise
M = -I and every gradient changes its sign. Quadratic fields keep an error at a one-sided support.
Left out: particles whose neighbors lie on a line (2-D) or in a plane (3-D), where M is singular.

References: [Randles1996], [Bonet1999], [Alshaer2017].
"""

from __future__ import annotations

from collections.abc import Mapping

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import (
    determinant,
    dot,
    identity,
    inverse,
    matvec,
    outer,
    trace,
)
from lasersph.particles.neighbor_lists import NeighborList

LEAST_DETERMINANT, MOST_DETERMINANT = 0.6, 1.6
"""Range of det M within which C is its inverse. Guard: M grows as the density of the particles, and
det M as its square, so that the bounds are 0.77 to 1.26 of it. On lattices disturbed by up to 0.3
spacings det M is 0.69 to 1.28, with particles 1.3 times as dense 1.69; with half of the neighbors
gone it is 0.34 to 0.37, the inverse would amplify noise, and C = 1 is taken
(`tests/unit/sph/test_correction_bounds.py`)."""
MOST_ANISOTROPY = 5.5
"""Largest (tr M)^2 / det M in 2-D. Guard: it is 4 for M = 1, 4.2 at most on disturbed lattices, 4.6
to 5.4 in a strip of two rows; 5.5 is a ratio of 3.2 of the two directions, thinner than that (the
same test)."""


def correction_term(V_j, x_ij, r_ij, dW_ij):
    """Term of M (14): V_j grad W_ij (x) (x_j - x_i) [1], shape (d, d).

    Args:
        V: volume [m^d]. x_ij: x_i - x_j [m]. r_ij: distance [m]. dW_ij: dW/dr [1/m^(d+1)].
    """
    # grad W_ij = dW_ij x_ij / r_ij, and x_j - x_i = -x_ij gives the sign
    return -V_j * dW_ij / r_ij * outer(x_ij, x_ij)


def inverted(total):
    """M^-1 from the sum M."""
    return inverse(total)


def volume_difference_term(f_i, f_j, V_j, x_ij, r_ij, dW_ij):
    """Term of the standard gradient (12): V_j (f_j - f_i) grad W_ij [unit of f / m].

    Args:
        f: the field. Others as in `correction_term`.
    """
    return V_j * (f_j - f_i) * dW_ij / r_ij * x_ij


def corrected(total, C):
    """Corrected gradient C grad f, C = M^-1: the same for all neighbors of a particle."""
    return matvec(C, total)


def correction_matrix(
    backend: Backend, neighbors: NeighborList, fields: Mapping[str, Array], M: Array
) -> None:
    """Write M into `M`, shape (d, d, n); field V, shape (N,)."""
    backend.pair_sum(correction_term, neighbors, fields, M)


def inverse_correction(
    backend: Backend, neighbors: NeighborList, fields: Mapping[str, Array], C: Array
) -> None:
    """Write C = M^-1 into `C`, shape (d, d, n); field V, shape (N,)."""
    backend.pair_sum(correction_term, neighbors, fields, C, finish=inverted)


def standard_gradient(
    backend: Backend, neighbors: NeighborList, fields: Mapping[str, Array], gradient: Array
) -> None:
    """Write sum_j V_j (f_j - f_i) grad W_ij into `gradient`, shape (d, n); fields f and V."""
    backend.pair_sum(volume_difference_term, neighbors, fields, gradient)


def corrected_gradient(
    backend: Backend, neighbors: NeighborList, fields: Mapping[str, Array], gradient: Array
) -> None:
    """Write the corrected gradient into `gradient`, shape (d, n).

    Fields f and V, shape (N,), and C of `inverse_correction`, shape (d, d, n).
    """
    backend.pair_sum(volume_difference_term, neighbors, fields, gradient, finish=corrected)


def kernel_gradient(V_j, x_ij, r_ij, dW_ij):
    """G_ij = V_j grad W_ij [1/m], which terms below read per pair; args as of `correction_term`."""
    return V_j * dW_ij / r_ij * x_ij


def moment_term(G_ij, x_ij):
    """`correction_term` from the stored G_ij [1]."""
    return -outer(G_ij, x_ij)


def corrected_divergence_term(v_i, v_j, C_i, G_ij):
    """Term of the corrected D- of a vector field: (v_j - v_i) . C_i G_ij [unit of v / m].

    Exact on linear fields. Skew-adjoint to `corrected_symmetric_term`:
    sum_i V_i v_i . G_i{p} = - sum_i V_i p_i D_i{v}.
    """
    return dot(v_j - v_i, matvec(C_i, G_ij))


def corrected_symmetric_term(p_i, p_j, C_i, C_j, G_ij):
    """Term of the corrected G+: (p_i C_i + p_j C_j) G_ij [unit of p / m].

    With C = 1 the symmetric gradient of [Demuth2020, eq. (46)] for equal densities.
    """
    return p_i * matvec(C_i, G_ij) + p_j * matvec(C_j, G_ij)


def corrected_difference_term(p_i, p_j, C_i, C_j, G_ij):
    """Term of the corrected G-: (p_j - p_i) C_i G_ij [unit of p / m], exact on linear fields.

    Not adjoint to `corrected_divergence_term`. C_j is not read.
    """
    return (p_j - p_i) * matvec(C_i, G_ij)


def bounded_inverse(total):
    """M^-1 where M is near the unit tensor, else 1: next to a gap a correction would amplify."""
    # too few or too many neighbors: det M far from 1
    size, diagonal = determinant(total), trace(total)
    if size < LEAST_DETERMINANT or size > MOST_DETERMINANT:
        return identity(len(total))
    # neighbors nearly on a line: the two eigenvalues of M differ too much
    if diagonal * diagonal > MOST_ANISOTROPY * size:
        return identity(len(total))
    return inverse(total)
