"""`Unknowns`: particles that equations are solved for, which of them touch, and cells around them.

All of it follows from positions and a mask, and is found anew only where these have changed: melt
whose particles rest keeps it for as long as its front stays between the same ones, and the two
equations of a step in a box have the same. Equations that share one are set and solved in turns.
"""

from __future__ import annotations

from collections.abc import Sequence

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.linear_solvers.cells import FilledCells
from lasersph.linear_solvers.components import Components

WIDTH = 2.0 / 3.0
"""Width of the cells over the support radius, which is the spacing of the finest grid."""
Version = tuple[int, ...]
"""Numbers that tell positions and masks from those before."""


class Unknowns:
    """Those among `count` particles.

    Args:
        support: radius [m]. spacing: of the particles [m]. period: per axis [m], 0.0 where there is
            none.

    Attributes:
        components: pools, `components.count` of them. cells: around what belongs to one.
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        support: float,
        spacing: float,
        period: Sequence[float] = (0.0, 0.0),
    ) -> None:
        self.components = Components(backend, count, spacing, period)
        self.cells = FilledCells(backend, count, WIDTH * support, period)
        self._version: Version | None = None

    def find(self, position: Array, mask: Array, version: Version | None = None) -> None:
        """Find the particles with mask 1, unless the version is that of the last call.

        Args:
            position: (d, n) [m]. mask: (n,). version: of both, None where it is not known.
        """
        if version is not None and version == self._version:
            return
        self.components.find(position, mask)
        self.cells.update(position, self.components.mask)
        self._version = version
