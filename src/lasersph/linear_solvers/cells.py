"""Square cells around a set of particles, which follow these.

The smallest box of cells around the particles with mask 1, made anew from their positions, so that
nothing of it needs to survive a step. On a periodic axis whole cells fill the period.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor
from typing import Any

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.particles.cell_grid import cell_along, place_along

FAR = 1e30


@dataclass(frozen=True)
class Axis:
    """Cells along one axis, and the nodes between them.

    Attributes:
        cells: their number. spacing: their width [m]. wraps: whether the axis is periodic.
    """

    cells: int
    spacing: float
    wraps: bool

    @property
    def nodes(self) -> int:
        """Number of nodes."""
        return self.cells if self.wraps else self.cells + 1

    @property
    def step(self) -> int:
        """2 where the next coarser axis has every other node, 0 where one, 1 where the same."""
        if self.nodes <= 2:
            return 0 if self.nodes == 2 else 1
        return 1 if self.wraps and self.cells % 2 else 2

    def coarser(self) -> Axis:
        """The next coarser axis."""
        if self.step == 0:
            return Axis(0, self.spacing, False)
        if self.step == 1:
            return self
        return Axis(ceil(self.cells / 2), 2.0 * self.spacing, self.wraps)


def box(x, mask):
    """Coordinates of a particle with mask 1, for the smallest box around all of them."""
    if mask > 0.0:
        return x[0], x[0], x[1], x[1]
    return FAR, -FAR, FAR, -FAR


def place(x, mask, lower, inverse, cells, cell_lines, x_wraps, z_wraps):
    """Place (u, w) in units of the spacing, and number of the cell; the last where mask is 0."""
    u = place_along(x[0], lower[0], inverse[0], cells, x_wraps)
    w = place_along(x[1], lower[1], inverse[1], cell_lines, z_wraps)
    if mask <= 0.0:
        return u, w, cells * cell_lines
    return u, w, cell_along(u, cells) * cell_lines + cell_along(w, cell_lines)


class Cells:
    """Cells for `count` particles.

    Args:
        width: wanted width of a cell [m]. period: per axis [m], 0.0 where there is none.

    Attributes:
        x, z: axes. u, w: (n,) place of each particle, in cells from the lower corner.
        number: (n,) kind "index", cell of each particle, line after line within a column; the
            number of cells where the mask is 0.
    """

    def __init__(self, backend: Backend, count: int, width: float, period: Sequence[float]) -> None:
        self.backend, self.width, self.period = backend, width, tuple(period)
        self.u, self.w = backend.zeros(count), backend.zeros(count)
        self.number = backend.zeros(count, "index")
        self.x = self.z = Axis(1, width, False)

    @property
    def count(self) -> int:
        """Number of cells."""
        return self.x.cells * self.z.cells

    @property
    def shape(self) -> dict[str, Any]:
        """Numbers of cells by the names of `place`."""
        x, z = self.x, self.z
        return {
            "cells": x.cells,
            "cell_lines": z.cells,
            "x_wraps": int(x.wraps),
            "z_wraps": int(z.wraps),
        }

    def place(self, position: Array, mask: Array) -> None:
        """Make the cells around the particles with mask 1; position (2, n) [m], mask (n,)."""
        fields = {"x": position, "mask": mask}
        bounds = self.backend.pointwise(
            box, fields, (None,) * 4, reduce=("min", "max", "min", "max")
        )
        x_low, self.x = _axis(self.width, self.period[0], *bounds[:2])
        z_low, self.z = _axis(self.width, self.period[1], *bounds[2:])
        lower, inverse = (x_low, z_low), (1.0 / self.x.spacing, 1.0 / self.z.spacing)
        out = (self.u, self.w, self.number)
        self.backend.pointwise(place, fields, out, lower=lower, inverse=inverse, **self.shape)


def _axis(width: float, period: float, low: float, high: float) -> tuple[float, Axis]:
    """Lower end [m] and cells of an axis; those of a period can be joined by twos down to eight."""
    if period:
        cells = max(period / width, 2.0)
        pairs = 2 ** max(int(np.log2(cells)) - 2, 0)
        cells = round(cells / pairs) * pairs
        return 0.0, Axis(cells, period / cells, True)
    if high < low:
        return 0.0, Axis(1, width, False)
    first = floor(low / width)
    return first * width, Axis(floor(high / width) - first + 1, width, False)
