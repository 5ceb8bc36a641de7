"""Values of each pair at a set of positions: functions of its distance, computed once.

Root and divisions take most of the time of a sum over pairs; sums that read these have none.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.kept_array import KeptArray
from lasersph.compute.vectors import dot
from lasersph.particles.neighbor_lists import Mean, NeighborList
from lasersph.particles.support import common
from lasersph.solvers.conduction.body import Weighing
from lasersph.sph.correction import kernel_gradient
from lasersph.sph.density_drift import kernel_sum_term
from lasersph.sph.laplacian import layered_weight, weight


def pair_geometry(V_i, V_j, x_ij, r_ij, W_ij, dW_ij):
    """Weight g_ij, volume times kernel gradient G_ij and volume times kernel of a pair."""
    g = weight(V_i, V_j, r_ij, dW_ij)
    return g, kernel_gradient(V_j, x_ij, r_ij, dW_ij), kernel_sum_term(V_j, W_ij)


def layered_pair_geometry(
    V_i,
    V_j,
    layer_i,
    layer_j,
    normal_i,
    normal_j,
    lateral_i,
    lateral_j,
    x_ij,
    r_ij,
    W_ij,
    dW_ij,
    up,
):
    """`pair_geometry` with the weight of a lattice of layers."""
    N_i, N_j, a_i, a_j = normal_i, normal_j, lateral_i, lateral_j
    g = layered_weight(V_i, V_j, layer_i, layer_j, N_i, N_j, a_i, a_j, x_ij, r_ij, dW_ij, up)
    return g, kernel_gradient(V_j, x_ij, r_ij, dW_ij), kernel_sum_term(V_j, W_ij)


GEOMETRY = {weight: pair_geometry, layered_weight: layered_pair_geometry}
"""Function of a pair's values, by the function of its weight."""


def distance_square(x_ij):
    """Square of the distance of a pair [m^2]."""
    return dot(x_ij, x_ij)


def even_rows(x, has_row, even_above):
    """1 for a row above a plane, and 1 for one below."""
    if x[-1] > even_above:
        return has_row, 0.0 * has_row
    return 0.0 * has_row, has_row


class PairGeometry:
    """Arrays per pair, in memory that stays while the number of pairs changes a little.

    Attributes:
        arrays: of the list, weights (pairs,) g_ij, gradient (d, pairs) G_ij, kernel (pairs,).
    """

    def __init__(self, backend: Backend, weighing: Weighing, dimension: int) -> None:
        self.backend, self.weighing = backend, weighing
        self._kept = KeptArray(backend), KeptArray(backend, dimension), KeptArray(backend)
        self._others: dict[str, KeptArray] = {}
        self._rows: list[tuple[Mean, Rows | None]] = []
        self._set_count(0)

    def _set_count(self, count: int) -> None:
        """Take arrays of as many pairs."""
        g, G, W = self._kept
        self.arrays = g.of(count), G.of(count), W.of(count)

    def per_pair(self, name: str, kind: str = "real") -> Array:
        """(pairs,) an array that is kept under a name while lists have as many."""
        kept = self._others.setdefault(name, KeptArray(self.backend, kind=kind))
        return kept.of(self.arrays[0].shape[0])

    def set_pairs(self, pairs: NeighborList, has_row: Array | None, even_above: float) -> None:
        """Take a new list.

        Rows above a plane are set apart, where all neighbors have the support radius of the row:
        the mean of others takes a logarithm, which no loop does for several pairs at once. They
        follow from the place of a particle alone, so that those at rest never change their bits.

        Args:
            has_row: (n,) 1 for rows that are found; None for all. even_above: z of the plane [m].
        """
        backend, count = self.backend, pairs.neighbor.shape[0]
        self._set_count(count)
        # one support for all rows, or those with it apart
        self._rows = [(common, None)]
        if pairs.mean is common:
            return
        rows = pairs.row_start.shape[0] - 1
        if has_row is None:
            has_row = backend.zeros(rows)
            backend.fill(has_row, 1.0)

        # rows above the plane, and below it
        fields = {"x": pairs.position, "has_row": has_row}
        marks = (backend.zeros(rows), backend.zeros(rows))
        backend.pointwise(even_rows, fields, marks, even_above=even_above)
        self._rows = [
            (mean, backend.rows_where(mark, 1.0))
            for mean, mark in zip((common, pairs.mean), marks, strict=True)
        ]

    def find_weights(
        self, pairs: NeighborList, fields: Mapping[str, Array], out: Array, rows: Rows
    ) -> None:
        """Weights alone of some rows into `out` (pairs,)."""
        function, constants = GEOMETRY[self.weighing.function], self.weighing.constants
        self.backend.pair_values(function, pairs, fields, (out, None, None), rows=rows, **constants)

    def find(
        self, pairs: NeighborList, fields: Mapping[str, Array], *, has_kernel: bool = False
    ) -> None:
        """Set the arrays at the positions that the list has now; the kernel only if asked for."""
        weights, gradient, kernel = self.arrays
        out = (weights, gradient, kernel if has_kernel else None)
        function, constants = GEOMETRY[self.weighing.function], self.weighing.constants
        for mean, rows in self._rows:
            self.backend.pair_values(
                function, replace(pairs, mean=mean), fields, out, rows=rows, **constants
            )
