"""Divergence of a vector field [Demuth2020, eq. (47)] and of the positions [Alshaer2017, eq. (28)].

    D-_i{v}  = 1/rho_i sum_j m_j (v_j - v_i) . grad W_ij
    div x_i  = - sum_j V_j x_ij . grad W_ij

D- is skew-adjoint to the symmetric gradient: sum_i V_i G+_i{p} . v_i = - sum_i V_i p_i D-_i{v}.
The divergence of the positions is about d inside a body and falls where the support is cut: on a
cubic lattice with the cubic spline, h = 1.5 dx, it is 3.030 inside, 2.810 in the second layer and
1.985 at the surface. [Alshaer2017] prints eq. (28) without the minus sign.
"""

from __future__ import annotations

from collections.abc import Mapping

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot
from lasersph.particles.neighbor_lists import NeighborList

SURFACE_THRESHOLD = {1: 0.64, 2: 1.5, 3: 2.4}
"""Below it a particle of a lattice lies in the top layer, by dimension (cubic spline, h = 1.5 dx).
Geometry: the top and the second layer have 0.494 and 0.790, 1.231 and 1.799, 1.985 and 2.810;
[Alshaer2017] gives 2.4, which is for 3-D only."""


def difference_term(v_i, v_j, m_j, rho_i, x_ij, r_ij, dW_ij):
    """Term of D- (47): m_j / rho_i (v_j - v_i) . grad W_ij [unit of v / m].

    Args:
        v: vector field. m: mass [kg]. rho: density [kg/m^d]. x_ij: x_i - x_j [m].
        dW_ij: dW/dr [1/m^(d+1)].
    """
    return m_j / rho_i * dot(v_j - v_i, x_ij) * dW_ij / r_ij


def position_term(V_j, r_ij, dW_ij):
    """Term of the divergence of the positions (28): -V_j x_ij . grad W_ij = -V_j r_ij dW_ij [1].

    Args:
        V: volume [m^d]. r_ij: distance [m]. dW_ij: dW/dr [1/m^(d+1)].
    """
    # x_ij . grad W_ij = r_ij dW_ij
    return -V_j * r_ij * dW_ij


def divergence(
    backend: Backend, neighbors: NeighborList, fields: Mapping[str, Array], out: Array
) -> None:
    """Write D- (47) into `out`, shape (n,); fields v, shape (d, N), m and rho, shape (N,)."""
    backend.pair_sum(difference_term, neighbors, fields, out)
