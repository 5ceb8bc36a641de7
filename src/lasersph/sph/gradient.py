"""Gradient of a scalar field, in the two forms of [Demuth2020, eqs. (45) and (46)].

    G-_i{f}  = 1/rho_i sum_j m_j (f_j - f_i) grad W_ij                         difference (45)
    G+_i{f}  = rho_i sum_j m_j (f_i / rho_i^2 + f_j / rho_j^2) grad W_ij       symmetric (46)

with grad W_ij = dW/dr x_ij / r_ij. The difference form is exactly zero on a constant; the
symmetric one conserves momentum and is skew-adjoint to `divergence`. Left out: corrections of the
kernel where the support is cut, see `correction`.
"""

from __future__ import annotations

from collections.abc import Mapping

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.particles.neighbor_lists import NeighborList


def difference_term(f_i, f_j, m_j, rho_i, x_ij, r_ij, dW_ij):
    """Term of G- (45): m_j / rho_i (f_j - f_i) grad W_ij [unit of f / m].

    Args:
        f: the field. m: mass [kg]. rho: density [kg/m^d]. x_ij: x_i - x_j [m].
        dW_ij: dW/dr [1/m^(d+1)].
    """
    return m_j / rho_i * (f_j - f_i) * dW_ij / r_ij * x_ij


def symmetric_term(f_i, f_j, m_j, rho_i, rho_j, x_ij, r_ij, dW_ij):
    """Term of G+ (46): rho_i m_j (f_i / rho_i^2 + f_j / rho_j^2) grad W_ij [unit of f / m].

    Args:
        f: the field. m: mass [kg]. rho: density [kg/m^d]. Others as in `difference_term`.
    """
    # m_i / rho_i times it changes its sign with i and j: momentum is conserved
    return rho_i * m_j * (f_i / (rho_i * rho_i) + f_j / (rho_j * rho_j)) * dW_ij / r_ij * x_ij


def difference_gradient(
    backend: Backend, neighbors: NeighborList, fields: Mapping[str, Array], gradient: Array
) -> None:
    """Write G- (45) into `gradient`, shape (d, n); fields f, m and rho, shape (N,)."""
    backend.pair_sum(difference_term, neighbors, fields, gradient)


def symmetric_gradient(
    backend: Backend, neighbors: NeighborList, fields: Mapping[str, Array], gradient: Array
) -> None:
    """Write G+ (46) into `gradient`, shape (d, n); fields f, m and rho, shape (N,)."""
    backend.pair_sum(symmetric_term, neighbors, fields, gradient)
