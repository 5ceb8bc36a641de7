"""`RingBlock`: a block of rings that stay where they are, in a section (r, z).

Pairs weigh as those of rings. Positions never change, and so no pair does: what has been found once
holds, and only rows that the melt comes near to for the first time are found anew.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.block_terms import either
from lasersph.sph.rings import ring_weight_off_axis


def join_new(found, near):
    """1 where one of two marks is 1, and 1 where only the second is."""
    return either(found, near), near - found * near


class RingBlock(Block):
    """A block whose particles are rings.

    Attributes:
        found: (count,) 1 for rows whose pairs are known. body_volume: (count,) of the rings [m^3].
            measure: (M,) their lengths, and of ghosts [m].
    """

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        geometry, position = self.lattice.geometry, self.lattice.position[:, : self.count]
        lengths = geometry.measure(position)
        self._lengths = self.measure = self.backend.asarray(lengths)
        self.body_volume = self.backend.asarray(lengths * self.lattice.volume[: self.count])
        self._radius = self.backend.asarray(np.ascontiguousarray(position[0]))
        self.found = self.backend.zeros(self.count)
        self._radii = self._radius

    @property
    def ring_fields(self) -> dict[str, Array]:
        """Distances from the axis of rings and ghosts [m], those of their sources."""
        return {"r": self._radii}

    def find_new_pairs(self, position: Array, near: Array) -> bool:
        """Find pairs where `near` (count,) marks rows that have none; whether there were any."""
        # rows with pairs, and those that have come to them
        fields = {"found": self.found, "near": near}
        (new,) = self.backend.pointwise(join_new, fields, (self.found, None), reduce=(None, "sum"))
        if new == 0.0:
            return False
        self.find_pairs(position, self.found, has_kernel=True)
        self._radii = self.gather(self._radius)
        self.correct_kernel(self.backend.rows_where(self.found, 1.0))
        return True

    def _adapt_weights(self, position: Array) -> None:
        """Weights of rings: those of the plane times their mean length, none across the axis."""
        self.measure = self.gather(self._lengths)
        fields = {"g_ij": self.weights, "measure": self.measure}
        self.backend.pair_values(
            ring_weight_off_axis, self.pairs, fields, self.weights, rows=self.rows
        )
