"""Which particles lie at the surface of what is condensed, with normals and open areas.

Found from the divergence of the positions (28); what has been ejected does not count. As long as
no particle has moved or left, nothing is computed again.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.sph.divergence import SURFACE_THRESHOLD
from lasersph.sph.free_surface import SMALLEST_NORMAL, surface_state, surface_terms
from lasersph.surface.surface import upward


class FreeSurface:
    """The surface of the condensed particles.

    Args:
        threshold: of the divergence; None for that of the cubic spline with h = 1.5 dx.

    Attributes:
        divergence: (n,) of the positions [1]. at_surface: (n,) 1 there, else 0. normal:
            (dim, n) outward unit normal there, else 0. area: (n,) open to the surroundings
            [m^(dim-1)].
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        dimension: int,
        spacing: float,
        threshold: float | None = None,
    ) -> None:
        self.backend = backend
        self.divergence, self.at_surface, self.area = (backend.zeros(count) for _ in range(3))
        self.normal = backend.zeros((dimension, count))
        self._constants = {
            "threshold": SURFACE_THRESHOLD[dimension] if threshold is None else threshold,
            "up": upward(dimension),
            "least": SMALLEST_NORMAL / spacing,
            "face": spacing ** (dimension - 1),
        }

    def find(
        self, pairs: NeighborList, volume: Array, opaque: Array, rows: Rows | None = None
    ) -> None:
        """Set divergence, surface, normals and areas of `rows`.

        Args:
            volume: (N,) [m^dim]. opaque: (N,) 1 for what is condensed or a wall, 0 for what has
                left.
        """
        # divergence of the positions (28), and from it marks, normals and areas in one loop
        fields = {"V": volume, "o": opaque}
        out = (self.divergence, self.at_surface, self.normal, self.area)
        self.backend.pair_sum(
            surface_terms, pairs, fields, out, finish=surface_state, rows=rows, **self._constants
        )
