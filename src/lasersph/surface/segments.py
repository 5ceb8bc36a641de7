"""Parts of a surface that move: the line above each pool, pinned where the pool ends.

A column moves where the melt below it is thick enough; the others keep their heights. A line ends
as the whole one does at the ends of the domain, and is pinned at the height of the solid beside it
elsewhere, so that no slope is assumed there and nothing is smoothed across the edge of a pool.

Melt advances over the solid beside it where it stands there at more than 45 degrees: the next
column joins, and takes what flows into it, until the melt is less steep. Melt that withdraws leaves
a film too thin to move, which keeps its height.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.surface.height_field import HeightField
from lasersph.surface.smoothing import End, Ends

Array = NDArray[np.float64]
MIN_COLUMNS = 12
"""Columns of a part that moves, with those of its image. Accuracy: two smoothing lengths of six
columns; fewer show no curvature and are held."""

ADVANCE_HEIGHT = 0.5
"""Height of melt over the solid beside its last column, over the width of a column, above which it
advances. Study: 45 degrees from the pin at the side of that column to its middle, the steepest
slope of a wave; 1 changes a relief of 410 nm by 1 %."""


class Segment(NamedTuple):
    """Columns of the whole line in order, shape (m,), and their own line."""

    columns: NDArray[np.int64]
    line: HeightField


class SurfaceSegments:
    """Segments of a line, made anew where what is molten changes.

    Attributes:
        parts: the segments. is_molten: (count,) whether a column belongs to one.
    """

    def __init__(self, whole: HeightField) -> None:
        self.whole = whole
        self.is_molten = np.ones(whole.count, bool)
        self.parts = [Segment(np.arange(whole.count), whole)]
        self._lines: dict[tuple[int, Ends], HeightField] = {}

    def choose(self, thick: NDArray[np.bool_]) -> None:
        """Take the runs of columns under which the melt is thick, (count,), where long enough."""
        whole, count = self.whole, self.whole.count
        # one pool under the whole line
        if thick.all():
            self.is_molten = thick
            self.parts = [Segment(np.arange(count), whole)]
            return
        repeats = whole.ends[0][0] == "periodic"
        first = int(np.argmin(thick)) if repeats else 0  # of a solid column, to cut a period there

        # runs of thick columns: where the marks rise and where they fall
        marks = np.concatenate([[False], np.roll(thick, -first), [False]]).astype(np.int8)
        begins, ends = np.flatnonzero(np.diff(marks) == 1), np.flatnonzero(np.diff(marks) == -1)
        self.parts, self.is_molten = [], np.zeros(count, bool)
        for begin, end in zip(begins, ends, strict=True):
            # ends of the domain stay as they are, the others are pinned
            left: End = whole.ends[0][0] if begin == 0 and not repeats else "pinned"
            right: End = whole.ends[0][1] if end == count and not repeats else "pinned"
            with_image = 2 if "mirror" in (left, right) else 1
            if with_image * (end - begin) < MIN_COLUMNS:
                # too short for a curvature: its heights stay
                continue
            columns = (np.arange(begin, end) + first) % count
            self.is_molten[columns] = True
            self.parts.append(Segment(columns, self._line(columns, (left, right))))

    def update_heights(self) -> None:
        """Give the segments the heights of the whole line, and of the solid beside them."""
        whole = self.whole
        for columns, line in self.parts:
            if line is whole:
                # the whole line is its own segment
                continue
            line.height = whole.height[columns]
            # height of the solid beside each end, the line's own pin at an end of the domain
            beside = (columns[0] - 1) % whole.count, (columns[-1] + 1) % whole.count
            pins = (whole.height[beside[0]], whole.height[beside[1]])
            at_ends = columns[0] == 0, columns[-1] == whole.count - 1
            low, high = (
                float(own if is_end and whole.ends[0][0] != "periodic" else height)
                for own, is_end, height in zip(whole.pins[0], at_ends, pins, strict=True)
            )
            line.pins = ((low, high),)

    @property
    def slopes(self) -> Array:
        """(1, count) slopes of the smoothed line."""
        return self.whole.slopes

    def heights_after(self, step: float, flux: Sequence[Array]) -> Array:
        """Heights (count,) after `step` [s], with what flows through the sides of the columns
        [m^2/s], none through ends that are no period."""
        found = self.whole.height.copy()
        for columns, line in self.parts:
            sides = flux[0][np.append(columns, columns[-1] + 1)]
            # an end that is a wall, a plane of symmetry or the edge of a pool lets nothing through
            if line.ends[0][0] != "periodic":
                sides[[0, -1]] = 0.0
            found[columns] = line.heights_after(step, sides)
        return found

    def _line(self, columns: NDArray[np.int64], ends: Ends) -> HeightField:
        """A line of its own; smoothing is prepared once for each length and kind of ends."""
        key, whole = (columns.size, ends), self.whole
        if key not in self._lines:
            self._lines[key] = HeightField(
                whole.start,
                *(whole.widths, (columns.size,), (ends,), whole.cutoff),
                is_axisymmetric=whole.is_axisymmetric,
            )
        line = self._lines[key].copy()
        line.start = (whole.start[0] + float(columns[0]) * whole.widths[0],)
        return line


def overrun(whole: HeightField, thick: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(count,) columns over which melt advances from the thick ones, (count,), beside them."""
    marks, found = thick.reshape(whole.shape), np.zeros(whole.shape, bool)
    for axis, width in enumerate(whole.widths):
        for shift, first in ((1, 0), (-1, -1)):  # from the lower side, from the upper one
            # melt higher than half a column over a column that does not move falls onto it
            rise = np.roll(whole.height, shift, axis) - whole.height
            beside = np.roll(marks, shift, axis) & (rise > ADVANCE_HEIGHT * width)
            if whole.ends[axis][0] != "periodic":
                np.moveaxis(beside, axis, 0)[first] = False
            found |= beside
    return found.ravel()
