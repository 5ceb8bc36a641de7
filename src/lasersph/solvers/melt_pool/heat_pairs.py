"""Conduction between particles that move: the rows of the block renewed, the others kept."""

from __future__ import annotations

from dataclasses import replace

from lasersph.compute.splice import PairRows, splice
from lasersph.solvers.conduction.body import Body
from lasersph.solvers.melt_pool.block import Block, inner_weight, wall_terms, weight_of


def wall_sums(total_0, total_1, total_2, total_3):
    """Boundary coefficient A, flow A P_w + b and heat A T_w of a row."""
    return total_0, total_1 + total_3, total_2


def one(mark):
    """1 for every row."""
    return 1.0 + 0.0 * mark


class HeatPairs:
    """The pair operator of a body, which follows the particles."""

    def __init__(self, body: Body) -> None:
        self.backend, self.body = body.backend, body
        self._renewed = body.particles["has_moving_pairs"]

    def renew(self, block: Block) -> None:
        """Take the rows that the block has found, with the weights of its present positions.

        Rows of the margin below the block lack neighbors; nothing within their support moves.
        """
        backend, body, pairs = self.backend, self.body, self.body.pairs
        rows = backend.rows_where(backend.head(block.has_row, block.complete_rows), 1.0)
        weights = block.weights
        fields = {"g_ij": block.weights} | block.rules
        if block.has_walls:
            out = (pairs.boundary_coefficient, body.wall_flow, body.wall_heat)
            backend.pair_sum(wall_terms, block.pairs, fields, out, rows=rows, finish=wall_sums)
            weights = backend.zeros(block.weights.shape[0])
            backend.pair_values(inner_weight, block.pairs, fields, weights)
        backend.pair_sum(weight_of, block.pairs, {"g_ij": weights}, pairs.total, rows=rows)
        backend.pointwise(one, {"mark": self._renewed}, self._renewed, rows=rows)
        chosen, ones = backend.zeros(body.count, "flag"), backend.zeros(rows.shape[0], "flag")
        backend.fill(ones, 1)
        backend.scatter(ones, rows, chosen)
        first = PairRows(block.pairs.row_start, block.without_ghosts().neighbor, weights)
        rest = PairRows(pairs.neighbors.row_start, pairs.neighbors.neighbor, pairs.weights)
        joined = splice(backend, first, chosen, rest)
        pairs.neighbors = replace(
            pairs.neighbors, row_start=joined.row_start, neighbor=joined.neighbor
        )
        pairs.weights = joined.values
