"""Blocks of rings, in a section (r, z): pairs weigh as those of rings, none across the axis.

Heat takes weights of its own, those of the flow with what makes rings even along z
(`sph.even_rings`); pressure and viscosity do not: beside the axis they are off as the divergence
is.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.array_types import Array, Constants
from lasersph.particles.ghosts import LOWER
from lasersph.solvers.melt_pool.passing_block import PassingBlock, RestingBlock
from lasersph.solvers.melt_pool.tangent_block import TangentBlock
from lasersph.sph.rings import STEPS, evened_ring_weight, ring_pair
from lasersph.surface.columns import product


class Rings(PassingBlock):
    """Particles that are rings."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        position = self.lattice.position[:, : self.count]
        self._radius = self.backend.asarray(np.ascontiguousarray(position[0]))
        self._curvature = self.backend.asarray(1.0 / position[0])
        self._radii = self._curvatures = self.measure
        beyond = self.ghosts.particles.ghost_types.crossed[0] == LOWER
        self._sides = self.ghosts.particles.table(np.where(beyond, -1.0, 1.0))
        self._numbers = self.backend.asarray(np.arange(float(self.count)))
        self._heat = self._mean = self._hoop = self.weights
        self._is_uneven = self._find_uneven(position[0])

    def _find_uneven(self, r: np.ndarray) -> Array | None:
        """(count,) 1 where rings at these distances from the axis [m] may see one with additions to
        its weights of heat; None where no ring has any."""
        if self.lattice.additions is None:
            return None
        additions = self.backend.to_host(self.lattice.additions).reshape(-1, STEPS)
        has_some = self.lattice.position[0, : additions.shape[0]][additions.any(axis=1)]
        distance = np.full(r.shape, np.inf)
        for place in np.unique(has_some):
            np.minimum(distance, np.abs(r - place), out=distance)
        return self.backend.asarray(distance <= self.layers.search_radius, "real")

    @property
    def heat_weights(self) -> Array:
        """(pairs,) weights of heat [m]."""
        return self._heat

    @property
    def ring_fields(self) -> dict[str, Array]:
        """Of pairs the mean ring over that of the row, and what the hoop stress makes of u [1], see
        `sph.rings`."""
        return {"mean_ij": self._mean, "hoop_ij": self._hoop}

    def _adapt_weights(self, position: Array) -> None:
        """Weights of rings: those of the plane times their mean length, none across the axis."""
        super()._adapt_weights(position)
        radii = self.gather(self._radius)
        fields = {"a": radii, "b": self.ghosts.of_type(self._sides)}
        self.backend.pointwise(product, fields, radii)
        self._radii = self._renewed(self._radii, radii)
        self._curvatures = self._renewed(self._curvatures, self.gather(self._curvature))
        # of the flow and of heat, and what both rings are over one of them
        names = ("heat", "mean", "hoop")
        self._heat, self._mean, self._hoop = (self._geometry.per_pair(name) for name in names)
        fields = {"g_ij": self.weights, "r": self._radii, "c": self._curvatures}
        out = (self.weights, self._heat, self._mean, self._hoop)
        self.backend.pair_values(ring_pair, self.pairs, fields, out, rows=self.rows)
        if self._is_uneven is not None:
            self._even_heat(self._is_uneven)

    def _even_heat(self, is_uneven: Array) -> None:
        """Weights of heat that make rings even along z, where some have additions."""
        backend, rows = self.backend, is_uneven
        if self.has_row is not None:
            rows = backend.zeros(self.count)
            backend.pointwise(product, {"a": is_uneven, "b": self.has_row}, rows)
        fields = {"g_ij": self.weights, "layer": self.layers.fields["layer"]}
        fields |= {"ring": self.gather(self._numbers), "has_none": self.walls.rules["dirichlet"]}
        additions = self.lattice.additions
        table: Constants = {"additions": additions, "layers": float(self.lattice.layers)}
        backend.pair_values(
            evened_ring_weight,
            self.pairs,
            fields,
            self._heat,
            rows=backend.rows_where(rows, 1.0),
            **table,
        )


class RingBlock(Rings, RestingBlock):
    """Rings below a flat surface, which rest."""


class RingTangentBlock(Rings, TangentBlock):
    """Rings below a surface that moves, which ride with it."""

    def surface_area(self) -> float:
        """True area of the surface [m^2]."""
        low, high = self.conditions.box[0]
        length_ratio = self.surface.length_ratio()
        assert length_ratio is not None
        ratio = self.backend.to_host(length_ratio)
        ring = self.backend.to_host(self.measure)[: ratio.size]
        return (high - low) * float(np.mean(ratio * ring))
