"""Conduction between particles that move: the rows of the block renewed, the others kept."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.compute.splice import PairRows, splice
from lasersph.solvers.conduction.body import Body
from lasersph.solvers.melt_pool.block import Block, inner_weight, wall_terms, weight_of


def walls(total_0, total_1, total_2, total_3):
    """Pull A, flow A P_w + b and heat A T_w of a row."""
    return total_0, total_1 + total_3, total_2


class HeatPairs:
    """The pair operator of a body, which follows the particles."""

    def __init__(self, backend: Backend, body: Body) -> None:
        self.backend, self.body = backend, body
        pairs = body.pairs
        self._still = PairRows(pairs.neighbors.row_start, pairs.neighbors.neighbor, pairs.weights)

    def renew(self, block: Block) -> None:
        """Take the block's pairs and weights at its present positions."""
        backend, body, pairs = self.backend, self.body, self.body.pairs
        rows = backend.asarray(np.arange(block.rows), "index")
        weights: Any = block.weights
        fields = {"g_ij": block.weights} | block.rules
        if block.has_walls:
            out = (pairs.pull, body.wall_flow, body.wall_heat)
            backend.pair_sum(wall_terms, block.pairs, fields, out, rows=rows, finish=walls)
            weights = backend.zeros(block.weights.shape[0])
            backend.pair_values(inner_weight, block.pairs, fields, weights)
        backend.pair_sum(weight_of, block.pairs, {"g_ij": weights}, pairs.total, rows=rows)
        first = PairRows(block.pairs.row_start, block.folded().neighbor, weights)
        joined = splice(backend, first, block.rows, self._still)
        pairs.neighbors = replace(
            pairs.neighbors, row_start=joined.row_start, neighbor=joined.neighbor
        )
        pairs.weights = joined.values
