"""Preconditioner of damped Jacobi sweeps, on the backend's loops alone.

    z = r / d,   then  z <- z + w (r - A z) / d  for each further sweep

One sweep is the diagonal scaling. Several make a polynomial in A that damps the short waves of a
Laplacian; w = 2/3 suits matrices with non-negative weights. A fixed linear map, as Krylov methods
need. Left out: coarse levels, which long waves in large bodies ask for. Reference: [Saad2003].
"""

from __future__ import annotations

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.linear_solvers.matrix import PairMatrix, entry_times


def scale(r, d):
    """First sweep, from z = 0: r_i / d_i."""
    return r / d


def sweep(total, d, p, r, w):
    """p_i + w (r_i - (A p)_i) / d_i."""
    return p + w * (r - d * p - total) / d


class Jacobi:
    """Damped Jacobi sweeps.

    Args:
        sweeps: number of sweeps, each but the first one product with the matrix.
        damping: w of the sweeps after the first.

    Raises:
        ValueError: no sweep.
    """

    def __init__(
        self, backend: Backend, matrix: PairMatrix, *, sweeps: int = 1, damping: float = 2.0 / 3.0
    ) -> None:
        if sweeps < 1:
            raise ValueError(f"sweeps must be at least 1, not {sweeps}")
        self.backend, self.matrix, self.sweeps, self.damping = backend, matrix, sweeps, damping
        self._other = backend.zeros(matrix.diagonal.shape[0]) if sweeps > 1 else None

    def apply(self, r: Array, z: Array) -> None:
        """Write the approximate solution of A z = r into `z`."""
        backend, matrix = self.backend, self.matrix
        backend.pointwise(scale, {"r": r, "d": matrix.diagonal}, z)
        for _ in range(self.sweeps - 1):
            assert self._other is not None
            backend.copy(z, self._other)
            fields = {"a_ij": matrix.entries, "d": matrix.diagonal, "p": self._other, "r": r}
            backend.pair_sum(entry_times, matrix.neighbors, fields, z, finish=sweep, w=self.damping)
