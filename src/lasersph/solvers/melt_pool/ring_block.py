"""Blocks of rings, in a section (r, z): pairs weigh as those of rings, none across the axis.

Below a flat surface particles stay where they are: positions never change, and so no pair does.
What has been found once holds, and only rows that the melt comes near to for the first time are
found anew. Below a surface that moves they ride with it, and pairs are found in every step. Heat
takes weights of its own, those of the flow with what makes rings even along z (`sph.even_rings`);
pressure and viscosity do not: beside the axis they are off as the divergence is.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.array_types import Array, Constants
from lasersph.particles.ghosts import LOWER
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.block_terms import either
from lasersph.solvers.melt_pool.tangent_block import TangentBlock
from lasersph.sph.rings import STEPS, evened_ring_weight, ring_pair
from lasersph.surface.columns import product


def join_new(found, near):
    """1 where one of two marks is 1, and 1 where only the second is."""
    return either(found, near), near - found * near


class Rings(Block):
    """Particles that are rings.

    Attributes:
        measure: (M,) 2 pi r of rings, and of ghosts that of their sources [m]. tangents: (M,) 1 for
            the ghost of a particle across the tangent of a surface that moves, 2 for that of its
            image beyond a side, 0 for all others. beyond_axis: (M,) 1 for images beyond the axis.
    """

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        position = self.lattice.position[:, : self.count]
        self._lengths = self.backend.asarray(self.lattice.geometry.measure(position))
        self._radius = self.backend.asarray(np.ascontiguousarray(position[0]))
        self._curvature = self.backend.asarray(1.0 / position[0])
        types = self.ghosts.particles.ghost_types
        beside = np.any(types.crossed[:-1] != 0, axis=0)
        self._tangents = self.ghosts.particles.table(types.crosses_surface * (1.0 + beside))
        self._crosses_axis = self.ghosts.particles.table((types.crossed[0] == LOWER).astype(float))
        self.measure = self._radii = self._curvatures = self._lengths
        self.tangents = self.beyond_axis = self._lengths
        self._numbers = self.backend.asarray(np.arange(float(self.count)))
        self._heat = self._hoop = self.weights
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
        """Distances from the axis of rings and ghosts [m], those of their sources, and 1/r [1/m];
        which lie beyond it; of pairs what the hoop stress makes of u (`sph.rings.hoop_share`)
        [1]."""
        return self._distances | {"hoop_ij": self._hoop}

    @property
    def _distances(self) -> dict[str, Array]:
        """Distances from the axis of rings and ghosts [m], 1/r [1/m], and which lie beyond it."""
        return {"r": self._radii, "c": self._curvatures, "beyond": self.beyond_axis}

    def _renewed(self, before: Array, values: Array) -> Array:
        """Values in the place of those before, if there are as many: loops are bound to that."""
        if before is self._lengths or before.shape != values.shape:
            return values
        self.backend.copy(values, before)
        return before

    def _adapt_weights(self, position: Array) -> None:
        """Weights of rings: those of the plane times their mean length, none across the axis."""
        super()._adapt_weights(position)
        self.measure = self._renewed(self.measure, self.gather(self._lengths))
        self._radii = self._renewed(self._radii, self.gather(self._radius))
        self._curvatures = self._renewed(self._curvatures, self.gather(self._curvature))
        self.tangents = self._renewed(self.tangents, self.ghosts.of_type(self._tangents))
        self.beyond_axis = self._renewed(self.beyond_axis, self.ghosts.of_type(self._crosses_axis))
        # of the flow and of heat, and what the hoop stress makes of u
        self._heat, self._hoop = (self._geometry.per_pair(name) for name in ("heat", "hoop"))
        fields = {"g_ij": self.weights, "measure": self.measure, **self._distances}
        out = (self.weights, self._heat, self._hoop)
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


class RingBlock(Rings):
    """Rings below a flat surface, which rest.

    Attributes:
        found: (count,) 1 for rows whose pairs are known.
    """

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self.found = self.backend.zeros(self.count)

    def renew_pairs(self, position: Array, near: Array | None) -> None:
        """Find pairs where `near` (count,) marks rows that have none; None for all."""
        near = self.ghosts.particles.all_rows if near is None else near
        # rows with pairs, and those that have come to them
        fields = {"found": self.found, "near": near}
        (new,) = self.backend.pointwise(join_new, fields, (self.found, None), reduce=(None, "sum"))
        if new == 0.0:
            return
        self.find_pairs(position, self.found, has_kernel=True)
        self.correct_kernel(self.backend.rows_where(self.found, 1.0))


class RingTangentBlock(Rings, TangentBlock):
    """Rings below a surface that moves, which ride with it."""

    def surface_area(self) -> float:
        """True area of the surface [m^2]."""
        low, high = self.conditions.box[0]
        length_ratio = self.surface.length_ratio()
        assert length_ratio is not None
        ratio = self.backend.to_host(length_ratio)
        ring = self.backend.to_host(self._lengths)[: ratio.size]
        return (high - low) * float(np.mean(ratio * ring))

    def renew_pairs(self, position: Array, near: Array | None) -> None:
        """Find the pairs of the rows that `near` (count,) marks; None for all."""
        self.find_pairs(position, near, has_kernel=True)
        rows = self.ghosts.particles.all_rows if near is None else near
        self.correct_kernel(self.backend.rows_where(rows, 1.0))
