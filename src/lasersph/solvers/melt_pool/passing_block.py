"""Blocks of particles that keep their columns, between which the melt passes.

Below a flat surface, and in a box, they stay where they are: positions never change, and so no pair
does. What has been found once holds, and only rows that the melt comes near to for the first time
are found anew.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.block_terms import either


def join_new(found, near):
    """1 where one of two marks is 1, and 1 where only the second is."""
    return either(found, near), near - found * near


class PassingBlock(Block):
    """Particles that melt passes between.

    Attributes:
        measure: (count,) what a cell stands for: 2 pi r of rings [m], else 1 [1]. unfolded: (d, M)
            places, of images those of the sources along the axes that are mirrored [m]. crossing:
            (M,) -1 for images beyond planes, 1 for the ghost of a particle across the tangent of a
            surface that moves, 2 for that of its image beyond a side, 0 for all others.
    """

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        geometry, types = self.lattice.geometry, self.ghosts.particles.ghost_types
        position = self.lattice.position[:, : self.count]
        self.measure = self.backend.asarray(geometry.measure(position))
        beside = np.any(types.crossed[:-1] != 0, axis=0)
        is_plane = (types.sign < 0).any(axis=0) & (types.crosses_surface == 0.0)
        table = self.ghosts.particles.table
        self._crossing = table(types.crosses_surface * (1.0 + beside) - is_plane)
        self.crossing = self.unfolded = self.measure

    def _renewed(self, before: Array, values: Array) -> Array:
        """Values in the place of those before, if there are as many: loops are bound to that."""
        if before is self.measure or before.shape != values.shape:
            return values
        self.backend.copy(values, before)
        return before

    def _adapt_weights(self, position: Array) -> None:
        """Give ghosts what they have of their sources and of their types."""
        super()._adapt_weights(position)
        of_type = self.ghosts.of_type
        self.unfolded = self._renewed(self.unfolded, self.ghosts.unfold(position))
        self.crossing = self._renewed(self.crossing, of_type(self._crossing))

    def renew_pairs(self, position: Array, near: Array | None) -> None:
        """Find the pairs of the rows that `near` (count,) marks; None for all."""
        self.find_pairs(position, near, has_kernel=True)
        rows = self.ghosts.particles.all_rows if near is None else near
        self.correct_kernel(self.backend.rows_where(rows, 1.0))


class RestingBlock(PassingBlock):
    """Particles below a flat surface or in a box, which rest.

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
        if new > 0.0:
            super().renew_pairs(position, self.found)
