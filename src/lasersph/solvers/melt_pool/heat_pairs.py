"""Conduction between particles that move: the rows of the block renewed, the others kept."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lasersph.compute.array_types import Rows
from lasersph.compute.graph import graph
from lasersph.compute.splice import PairRows, splice
from lasersph.compute.vectors import dot
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


def flux_length(g_ij, across_j, flux_j, normal_j, plane_j, x_j):
    """Length of a moving surface through which a pair passes a flux on [m]."""
    n_j = dot(x_j, normal_j) - plane_j
    return 2.0 * across_j * g_ij * n_j if flux_j != 0.0 else 0.0 * g_ij


def scaled_flux(flux, across, factor):
    """Flux [W/m^2], through a surface that moves times a factor."""
    return flux * factor if across > 0.0 else 1.0 * flux


class HeatPairs:
    """The pair operator of a body, which follows the particles."""

    def __init__(self, body: Body) -> None:
        self.backend, self.body = body.backend, body
        self._renewed = body.particles["has_moving_pairs"]

    def normalize_surface_flux(self, block: Block) -> None:
        """Scale the flux through a surface that moves so that all of it enters, however rows lie.

        Pairs across it see its length where rows are a spacing high. Those from which mass has
        evaporated are lower: three rows in D/v took 10 % more than the flux.
        """
        length_ratio = block.surface.length_ratio()
        if length_ratio is None or not block.walls.exchange_heat:
            return
        backend, fields = self.backend, {"g_ij": block.weights, "across": block.across}
        fields |= {name: block.walls.rules[name] for name in ("flux", "normal", "plane")}
        rows, out = block.rows_near_faces, (None,)
        (seen,) = backend.pair_sum(
            flux_length, block.pairs, fields, out, rows=rows, reduce=("sum",)
        )
        if seen > 0.0:
            low, high = block.conditions.box[0]
            length = (high - low) * float(np.mean(backend.to_host(length_ratio)))
            fields = {"flux": fields["flux"], "across": block.across}
            backend.pointwise(scaled_flux, fields, fields["flux"], factor=length / seen)

    def renew(self, block: Block) -> None:
        """Take the rows that the block has found, with the weights of its present positions.

        Rows of the margin below the block lack neighbors; nothing within their support moves. Where
        all rows are found, as in a box, the list of the block is that of the body. Weights of the
        block become those between particles: 0 toward ghosts beyond a Dirichlet face.
        """
        backend, body, pairs, rows = self.backend, self.body, self.body.pairs, None
        if block.has_row is not None:
            rows = backend.rows_where(backend.head(block.has_row, block.complete_rows), 1.0)
        self.weigh(block, rows)
        row_start, neighbor = block.pairs.row_start, block.without_ghosts().neighbor
        if rows is None:
            pairs.neighbors = replace(pairs.neighbors, row_start=row_start, neighbor=neighbor)
            pairs.weights = block.weights
            return
        chosen, ones = backend.zeros(body.count, "flag"), backend.zeros(rows.shape[0], "flag")
        backend.fill(ones, 1)
        backend.scatter(ones, rows, chosen)
        first = PairRows(row_start, neighbor, block.weights)
        rest = PairRows(pairs.neighbors.row_start, pairs.neighbors.neighbor, pairs.weights)
        joined = splice(backend, first, chosen, rest)
        pairs.neighbors = replace(
            pairs.neighbors, row_start=joined.row_start, neighbor=joined.neighbor
        )
        pairs.weights = joined.values

    @graph
    def weigh(self, block: Block, rows: Rows | None) -> None:
        """Terms of walls, weights between particles and their sums."""
        backend, body, pairs = self.backend, self.body, self.body.pairs
        fields = {"g_ij": block.weights} | block.walls.rules
        if block.walls.exchange_heat:
            out = (pairs.boundary_coefficient, body.wall_flow, body.wall_heat)
            near, closest = block.rows_near_faces, block.walls.closest
            backend.pointwise(no_walls, {"A": out[0]}, out, rows=rows)
            how = {"rows": near, "finish": wall_sums, "closest": closest}
            backend.pair_sum(wall_terms, block.pairs, fields, out, **how)
            backend.pair_values(inner_weight, block.pairs, fields, block.weights, rows=near)
        backend.pair_sum(weight_of, block.pairs, {"g_ij": block.weights}, pairs.total, rows=rows)
        backend.pointwise(one, {"mark": self._renewed}, self._renewed, rows=rows)
