"""Schwaiger's operator: div(mu grad f) that stays right where the support is cut.

    L_i = tr(Gamma_i^-1) / d { sum_j V_j (mu_i + mu_j) (f_i - f_j) F_ij - 2 mu_i grad f_i . N_i }
    F_ij = x_ij . grad~ W_ij / r_ij^2,   N_i = sum_j V_j x_ij F_ij,
    Gamma_i = - sum_j V_j F_ij x_ij (x) x_ij                       [Alshaer2017, eqs. (16), (17)]

grad~ W = C grad W with C = M^-1 of `correction`, or C = I for the raw kernel; sums, Gamma and
grad f take the same one. The paper prints Gamma without V_j and with the other sign: here +I inside
a body. It prints the second sum as sum V_j grad~ W_ij, which leaves 0.222/dx for a linear function
at a flat 3-D surface; with N_i above a linear function gives exactly zero. Its bracket
grad(mu f) - f grad mu + mu grad f is 2 mu grad f. Without Gamma the factor in front is 1.

References: [Schwaiger2008], [Alshaer2017].
"""

from __future__ import annotations

from collections.abc import Mapping

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, inverse, matvec, outer, trace
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.sph.correction import corrected_gradient


def normal_weight(C_i, x_ij, r_ij, dW_ij):
    """F_ij = x_ij . C_i grad W_ij / r_ij^2 [1/m^(d+2)]; dW_ij / r_ij for C = I.

    Args:
        C: inverse correction matrix [1], shape (d, d). x_ij: x_i - x_j [m]. r_ij: distance [m].
        dW_ij: dW/dr [1/m^(d+1)].
    """
    return dot(x_ij, matvec(C_i, x_ij)) * dW_ij / (r_ij * r_ij * r_ij)


def gamma_term(C_i, V_j, x_ij, r_ij, dW_ij):
    """Term of Gamma (17): -V_j F_ij x_ij (x) x_ij [1], shape (d, d).

    Args:
        V: volume [m^d]. Others as in `normal_weight`.
    """
    return -V_j * normal_weight(C_i, x_ij, r_ij, dW_ij) * outer(x_ij, x_ij)


def normal_term(C_i, V_j, x_ij, r_ij, dW_ij):
    """Term of N: V_j x_ij F_ij [1/m], shape (d,).

    Args:
        V: volume [m^d]. Others as in `normal_weight`.
    """
    return V_j * normal_weight(C_i, x_ij, r_ij, dW_ij) * x_ij


def second_difference_term(mu_i, mu_j, f_i, f_j, C_i, V_j, x_ij, r_ij, dW_ij):
    """Term of the first sum of (16): V_j (mu_i + mu_j) (f_i - f_j) F_ij [unit of mu f / m^2].

    Args:
        mu: diffusion coefficient. f: the field. V: volume [m^d]. Others as in `normal_weight`.
    """
    return V_j * (mu_i + mu_j) * (f_i - f_j) * normal_weight(C_i, x_ij, r_ij, dW_ij)


def without_gradient(total, mu, df, N):
    """Brace of (16): the sum less 2 mu grad f . N [unit of mu f / m^2].

    Args:
        df: gradient of f, shape (d,). N: shape (d,).
    """
    return total - 2.0 * mu * dot(df, N)


def prefactor(Gamma):
    """tr(Gamma^-1) / d of (16) [1]."""
    return trace(inverse(Gamma)) / len(Gamma)


def scaled(total, mu, df, N, factor):
    """Operator (16): `prefactor` times the brace [unit of mu f / m^2]."""
    return factor * without_gradient(total, mu, df, N)


def schwaiger_laplacian(
    backend: Backend,
    neighbors: NeighborList,
    fields: Mapping[str, Array],
    out: Array,
    *,
    use_gamma: bool = True,
) -> None:
    """Write div(mu grad f) into `out`, shape (n,).

    Args:
        fields: f, mu and V, shape (N,); C, shape (d, d, n): `correction.inverse_correction` for
            the corrected kernel gradient, unit tensors for the raw one.
        use_gamma: divide by Gamma, (17); without it the factor in front is 1.
    """
    assert neighbors.position is not None
    d, n = neighbors.position.shape[0], out.shape[0]
    # grad f with the same kernel gradient as the sums
    work = dict(fields, df=backend.zeros((d, n)))
    corrected_gradient(backend, neighbors, work, work["df"])

    # brace of (16) times the factor in front
    work |= _moments(backend, neighbors, fields, n, use_gamma)
    backend.pair_sum(second_difference_term, neighbors, work, out, finish=scaled)


def _moments(
    backend: Backend, neighbors: NeighborList, fields: Mapping[str, Array], n: int, use_gamma: bool
) -> dict[str, Array]:
    """N, shape (d, n), and the factor in front, shape (n,)."""
    assert neighbors.position is not None
    d = neighbors.position.shape[0]
    found = {"N": backend.zeros((d, n)), "factor": backend.zeros(n)}
    backend.pair_sum(normal_term, neighbors, fields, found["N"])
    # the factor in front: 1, or tr(Gamma^-1) / d of (17)
    if not use_gamma:
        backend.fill(found["factor"], 1.0)
        return found
    Gamma = backend.zeros((d, d, n))
    backend.pair_sum(gamma_term, neighbors, fields, Gamma)
    backend.pointwise(prefactor, {"Gamma": Gamma}, found["factor"])
    return found
