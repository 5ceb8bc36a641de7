"""`Geometry`: the space that a block stands for, a line, a section or a body.

A planar block of d axes stands for itself per unit length of each axis that it lacks. An
axisymmetric one is the section (r, z) of a body of revolution about r = 0: its particles are rings,
and sums over them are those of the whole revolution.

    measure      2 pi r of a ring, 1 of a planar cell: body over cell, per length or area
    mass         rho V measure
    weight       g_ij (measure_i + measure_j)/2, symmetric: what one ring loses another one gains

No pair reaches across the axis: through r = 0 no heat flows, whatever lies beside it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.faces import LEFT, faces_of

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Geometry:
    """Axes of the block, and whether the first is the distance from an axis of revolution.

    Attributes:
        dimensions: d, of the block. is_axisymmetric: whether it is a section (r, z).
    """

    dimensions: int
    is_axisymmetric: bool = False

    @property
    def amount_dimension(self) -> int:
        """Dimensions that sums cover: 3 of a whole revolution, else those of the block."""
        return 3 if self.is_axisymmetric else self.dimensions

    @property
    def faces(self) -> tuple[str, ...]:
        """Faces of the block; an axis of revolution is none."""
        return tuple(
            face for face in faces_of(self.dimensions) if face != LEFT or not self.is_axisymmetric
        )

    def measure(self, position: Array) -> Array:
        """(n,) what a cell at `position` (d, n) [m] stands for: 2 pi r [m], or 1 [1]."""
        if self.is_axisymmetric:
            return 2.0 * np.pi * np.abs(position[0])
        return np.ones(position.shape[1])

    def face_area(self, axis: int, place: float, extents: tuple[tuple[float, float], ...]) -> float:
        """Area of a face normal to an axis at a place [m^(amount_dimension - 1)].

        Args:
            axis: its number, from the first or from the last one. extents: lower and upper end of
                the block along each axis [m].
        """
        sides = [ends for number, ends in enumerate(extents) if number != axis % len(extents)]
        if not self.is_axisymmetric:
            return float(np.prod([high - low for low, high in sides]))
        # a cylinder of the radius of the face, or a disc
        low, high = sides[0]
        return 2.0 * np.pi * place * (high - low) if axis == 0 else np.pi * (high**2 - low**2)
