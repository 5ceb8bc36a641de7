"""Matrix on a list of pairs, not necessarily symmetric, and its product with a vector.

    (A p)_i = d_i p_i + sum_j a_ij p_j

Entries are stored pair by pair, in the order of the list; the neighbors must all have rows (a
list `without_ghosts` where there are dummies). Left out: dense and blocked forms.
"""

from __future__ import annotations

from dataclasses import dataclass

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.particles.neighbor_lists import NeighborList


@dataclass(frozen=True)
class PairMatrix:
    """Rows of a matrix.

    Attributes:
        neighbors: list of pairs. entries: (pairs,) a_ij. diagonal: (n,) d_i, not 0.
    """

    neighbors: NeighborList
    entries: Array
    diagonal: Array


def entry_times(a_ij, p_j):
    """Term of (A p)_i beside the diagonal."""
    return a_ij * p_j


def subtract_product(total, d, p, b):
    """Residual b_i - (A p)_i, and its square for the norm."""
    r = b - d * p - total
    return r, r * r


def residual(backend: Backend, matrix: PairMatrix, x: Array, b: Array, r: Array) -> float:
    """Write b - A x into `r`; returns its 2-norm."""
    fields = {"a_ij": matrix.entries, "d": matrix.diagonal, "p": x, "b": b}
    (square,) = backend.pair_sum(
        entry_times,
        matrix.neighbors,
        fields,
        (r, None),
        finish=subtract_product,
        reduce=(None, "sum"),
    )
    return square**0.5
