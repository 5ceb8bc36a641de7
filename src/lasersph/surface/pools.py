"""`SurfacePools`: the pools of a surface on a grid of columns, pinned where the solid begins.

A pool is a set of columns that are joined by sides: two that touch in a corner exchange no volume,
and nothing is smoothed across that corner. Pools merge, split and freeze as columns melt and
freeze. Columns whose melt is too thin, and pools of too few columns, keep their heights. Melt
advances over the solid beside it as in a section, see `segments`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.surface.height_field import HeightField
from lasersph.surface.pool_field import PoolField
from lasersph.surface.segments import MIN_COLUMNS

Array = NDArray[np.float64]
Marks = NDArray[np.bool_]
MIN_AREA = 0.7854 * MIN_COLUMNS**2
"""Columns of a pool that moves, with those of its images. Derived: a disc as wide as the shortest
line that does."""


class Pool(NamedTuple):
    """Numbers (m,) of the columns of a pool, and the heights over them."""

    columns: NDArray[np.int64]
    line: PoolField


class SurfacePools:
    """Pools of a grid, made anew where what is molten changes.

    Attributes:
        parts: the pools. is_molten: (count,) whether a column belongs to one.
    """

    def __init__(self, whole: HeightField) -> None:
        self.whole = whole
        self._label = np.zeros(whole.count, int)
        self.is_molten = np.ones(whole.count, bool)
        self.parts: list[Pool] = []
        self._thick = np.zeros(whole.count, bool)
        self.choose(self.is_molten)

    def choose(self, thick: Marks) -> None:
        """Take the pools of columns under which the melt is thick, (count,), where large enough."""
        if np.array_equal(thick, self._thick) and self.parts:
            return
        self._thick = thick.copy()
        label = joined_columns(thick.reshape(self.whole.shape), self.whole).ravel()
        known = {part.columns.tobytes(): part for part in self.parts}
        self.parts, self._label = [], np.zeros(thick.size, int)
        for number in range(1, label.max(initial=0) + 1):
            columns = np.flatnonzero(label == number)
            if columns.size * self._images(columns) < MIN_AREA:
                # too few for a curvature: its heights stay
                continue
            self._label[columns] = number
            # factors of the smoothing are kept while the pool stays
            part = known.get(columns.tobytes()) or Pool(columns, PoolField(self.whole, columns))
            self.parts.append(part)
        self.is_molten = self._label > 0

    def _images(self, columns: NDArray[np.int64]) -> int:
        """How often planes of symmetry show a pool that they cut: 1, 2 or 4."""
        whole, times = self.whole, 1
        place = np.unravel_index(columns, whole.shape)
        for axis, ends in enumerate(whole.ends):
            at_ends = place[axis].min() == 0, place[axis].max() == whole.shape[axis] - 1
            mirrors = (
                is_there and end == "mirror" for is_there, end in zip(at_ends, ends, strict=True)
            )
            times *= 2 if any(mirrors) else 1
        return times

    def update_heights(self) -> None:
        """Give the pools the heights of the grid, and of the solid beside them."""
        heights = self.whole.height.ravel()
        for columns, pool in self.parts:
            pool.height = heights[columns]
            # walls hold the surface where it was laid out
            pool.at_pins = np.where(pool.rim < 0, pool.wall_heights, heights[pool.rim])

    @property
    def slopes(self) -> Array:
        """(2, count) slopes of the smoothed pools, 0 elsewhere."""
        found = np.zeros((2, self.whole.count))
        for columns, pool in self.parts:
            found[:, columns] = pool.slopes
        return found

    def heights_after(self, step: float, flux: Sequence[Array]) -> Array:
        """Heights (count,) after `step` [s], with what flows through the sides of the columns
        [m^2/s]; none through sides between melt and solid, walls and planes of symmetry."""
        whole, label = self.whole, self._label.reshape(self.whole.shape)
        inside = []
        for axis, Q in enumerate(flux):
            along = np.moveaxis(label, axis, 0)
            repeats = whole.ends[axis][0] == "periodic"
            before = np.concatenate([repeats * along[-1:], along])
            after = np.concatenate([along, repeats * along[:1]])
            open_sides = (before == after) & (before > 0)
            inside.append(np.where(np.moveaxis(open_sides, 0, axis), Q, 0.0))
        return whole.heights_after(step, *inside).ravel()


def joined_columns(marks: Marks, whole: HeightField) -> NDArray[np.int64]:
    """Number of the pool of each column from 1 on, 0 where there is none; columns that share a
    side belong together, around a period as well."""
    from scipy.ndimage import label  # few runs have a grid of columns
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import connected_components

    found = np.zeros(marks.shape, np.int64)
    label(marks, output=found)
    count = int(found.max(initial=0))
    pairs = [
        np.stack([np.take(found, 0, axis), np.take(found, -1, axis)])
        for axis, ends in enumerate(whole.ends)
        if ends[0] == "periodic"
    ]
    both = np.concatenate([np.zeros((2, 0), int), *pairs], axis=1)
    one, other = both[:, np.all(both > 0, axis=0)]
    joined = csr_matrix((np.ones(one.size), (one, other)), shape=(count + 1, count + 1))
    # the number 0 of no pool stays the first
    _, number = connected_components(joined, directed=False)
    return number[found]
