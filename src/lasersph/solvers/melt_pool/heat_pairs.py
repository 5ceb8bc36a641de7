"""Conduction between particles that move: the rows of the block renewed, the others kept."""

from __future__ import annotations

from dataclasses import replace

from lasersph.compute.array_types import Rows
from lasersph.compute.graph import graph
from lasersph.compute.row_renewal import PairRows, RenewedRows
from lasersph.solvers.conduction.body import Body
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.block_terms import inner_weight, wall_terms, weight_of


def wall_sums(total_0, total_1, total_2, total_3):
    """Boundary coefficient A, flow A P_w + b and heat A T_w of a row."""
    return total_0, total_1 + total_3, total_2


def no_walls(A):
    """`wall_sums` of a row far from all faces."""
    return 0.0 * A, 0.0 * A, 0.0 * A


def one(mark):
    """1 for every row."""
    return 1.0 + 0.0 * mark


class HeatPairs:
    """The pair operator of a body, which follows the particles."""

    def __init__(self, body: Body) -> None:
        self.backend, self.body = body.backend, body
        self._renewed = body.particles["has_moving_pairs"]
        self._rows: RenewedRows | None = None

    def update(self, block: Block) -> None:
        """Take the rows that the block has found, with the weights of its present positions.

        Rows of the margin below the block lack neighbors; nothing within their support moves. Where
        all rows are found, as in a box, the list of the block is that of the body. Weights of the
        block become those between particles: 0 toward ghosts beyond a Dirichlet face.
        """
        backend, pairs, rows = self.backend, self.body.pairs, None
        if block.has_row is not None:
            rows = backend.rows_where(backend.head(block.has_row, block.complete_rows), 1.0)

        # g_ij of the block's rows, with walls taken out
        self.weigh(block, rows)
        row_start, neighbor = block.pairs.row_start, block.without_ghosts().neighbor
        if rows is None:
            pairs.neighbors = replace(pairs.neighbors, row_start=row_start, neighbor=neighbor)
            pairs.weights = block.heat_weights
            return

        # rows of the block in the place of the old ones, all others as they are
        if self._rows is None:
            there = pairs.neighbors.row_start, pairs.neighbors.neighbor, pairs.weights
            self._rows = RenewedRows(backend, PairRows(*there))
        self._rows.update(rows, PairRows(row_start, neighbor, block.heat_weights))
        now = {name: getattr(self._rows, name) for name in ("row_start", "row_end", "neighbor")}
        pairs.neighbors, pairs.weights = replace(pairs.neighbors, **now), self._rows.values

        # those that it began with lie in the same memory
        row_start, neighbor, weights = self._rows.first
        first = replace(pairs.neighbors, row_start=row_start, row_end=None, neighbor=neighbor)
        pairs.first = first, weights

    @graph
    def weigh(self, block: Block, rows: Rows | None) -> None:
        """Terms of walls, weights between particles and their sums."""
        backend, body, pairs = self.backend, self.body, self.body.pairs
        fields = {"g_ij": block.heat_weights} | block.walls.rules
        # A, A P_w + b and A T_w of rows near faces, 0 of others; g_ij = 0 toward Dirichlet faces
        if block.walls.exchange_heat:
            out = (pairs.boundary_coefficient, body.wall_flow, body.wall_heat)
            near = block.rows_near_faces
            backend.pointwise(no_walls, {"A": out[0]}, out, rows=rows)
            backend.pair_sum(
                wall_terms,
                block.pairs,
                fields,
                out,
                rows=near,
                finish=wall_sums,
                min_distance=block.walls.min_distance,
            )
            backend.pair_values(inner_weight, block.pairs, fields, block.heat_weights, rows=near)

        # S_i = sum_j g_ij, and the mark of rows that have moved
        backend.pair_sum(
            weight_of, block.pairs, {"g_ij": block.heat_weights}, pairs.total, rows=rows
        )
        backend.pointwise(one, {"mark": self._renewed}, self._renewed, rows=rows)
