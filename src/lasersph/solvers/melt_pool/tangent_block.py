"""`TangentBlock`: a block below a surface that bends, whose ghosts lie across its local tangents.

Where the surface bends, the ghost of j is not as far from i as that of i from j. Weights toward
ghosts take both distances, so that what one particle gives the other gets; the pressure there is
given, and no pair across counts for it; heat finds its face in the tangent at each source.
"""

from __future__ import annotations

from dataclasses import replace
from math import prod, sqrt

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.vectors import dot
from lasersph.particles.ghosts import SLANTED, reach_at
from lasersph.particles.support import common
from lasersph.solvers.melt_pool.block import Block
from lasersph.surface.loops import inner_weight, mean_weight

NEAR, BEYOND = 1.0, 2.0
"""Marks of rows that ghosts across the surface lie within, and that have one themselves or not.
Format: rows are chosen by them."""


def place_below(x, distance, has_row, radius, reach, plane):
    """NEAR for a particle that finds others beyond the surface and has a ghost there itself; BEYOND
    for one that only finds others, where the surface rises beside it, 45 degrees at most; 0 where
    no pairs were found."""
    within = reach_at(x, radius, reach, plane)
    if distance < within:
        return NEAR * has_row
    return BEYOND * has_row if distance < sqrt(2.0) * within else 0.0 * has_row


def flux_length(g_ij, across_j, flux_j, normal_j, plane_j, x_j):
    """Length of a moving surface through which a pair passes a flux on [m]."""
    n_j = dot(x_j, normal_j) - plane_j
    return 2.0 * across_j * g_ij * n_j if flux_j != 0.0 else 0.0 * g_ij


def scaled_flux(flux, across, factor):
    """Flux [W/m^2], through a surface that moves times a factor."""
    return flux * factor if across > 0.0 else 1.0 * flux


class TangentBlock(Block):
    """A block whose surface is no plane."""

    reach = 2.0 * SLANTED

    def _adapt_weights(self, position: Array) -> None:
        """Make the weights toward ghosts across a tangent symmetric, and set the face of heat."""
        backend, ghosts = self.backend, self.ghosts
        ghosts.mark_crossing()

        # rows within the support of the surface, and those that may find ghosts beside them
        mark, reach = backend.zeros(self.count), self.layers.reach
        fields = {"distance": backend.head(ghosts.surface.distance, self.count)}
        fields |= {"x": backend.head(position, self.count)}
        fields |= {"radius": reach.radius, "reach": reach.reach}
        fields["has_row"] = self.has_row if self.has_row is not None else ghosts.particles.all_rows
        backend.pointwise(place_below, fields, mark, plane=reach.plane)
        rows, beyond = (backend.rows_where(mark, place) for place in (NEAR, BEYOND))
        self.rows_across = rows

        # weights of the way back, with the ghosts in the place of their sources; mean of both ways
        swapped = self._geometry.per_pair("swapped")
        pairs = replace(self.pairs, position=ghosts.places_swapped(position), mean=common)
        self._geometry.find_weights(pairs, self.layers.fields, swapped, rows)
        fields = {"g_ij": self.weights, "swapped_ij": swapped, "across": self.across}
        backend.pair_values(mean_weight, self.pairs, fields, self.weights, rows=rows)
        # a particle without a ghost is not seen from there, and so sees nothing there
        backend.pair_values(inner_weight, self.pairs, fields, self.weights, rows=beyond)

        # n . x = b of the tangent between each ghost and its source
        self.walls.find_tangents()

    def inner_weights(self) -> Array:
        """(pairs,) weights of the pressure: 0 toward ghosts across the surface."""
        found = self._geometry.per_pair("inner")
        fields = {"g_ij": self.weights, "across": self.across}
        self.backend.pair_values(inner_weight, self.pairs, fields, found, rows=self.rows)
        return found

    def normalize_surface_flux(self) -> None:
        """Scale the flux through the surface so that all of it enters, however rows lie.

        Pairs across it see its length where rows are a spacing high. Those from which mass has
        evaporated are lower: three rows in D/v took 10 % more than the flux.
        """
        if not self.walls.exchange_heat:
            return
        backend, rules = self.backend, self.walls.rules

        # length through which the pairs pass a flux on
        fields = {"g_ij": self.heat_weights, "across": self.across}
        fields |= {name: rules[name] for name in ("flux", "normal", "plane")}
        (seen,) = backend.pair_sum(
            flux_length, self.pairs, fields, (None,), rows=self.rows_near_faces, reduce=("sum",)
        )
        if seen <= 0.0:
            return

        # flux times the true length over that
        fields = {"flux": rules["flux"], "across": self.across}
        factor = self.surface_area() / seen
        backend.pointwise(scaled_flux, fields, rules["flux"], factor=factor)

    def surface_area(self) -> float:
        """True area of the surface [m^(d-1)]."""
        from_above = prod(high - low for low, high in self.conditions.box[:-1])
        length_ratio = self.surface.length_ratio()
        assert length_ratio is not None
        return from_above * float(np.mean(self.backend.to_host(length_ratio)))
