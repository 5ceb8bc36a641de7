"""`Vessel`: walls that stand away from the block, for liquids that run out of it.

Without it walls lie at the faces of the block and rise to its surface.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from lasersph.input import Length, Model

Clearance = Annotated[Length, Field(ge=0)]


class Vessel(Model):
    """Clearance between the block and the walls around it."""

    left: Clearance = Field(default=0.0, description="between the block and the wall at smaller x")
    right: Clearance = Field(default=0.0, description="between the block and the wall at larger x")
    above: Clearance = Field(default=0.0, description="height of the side walls over the surface")

    def box(self, bounds: tuple[tuple[float, float], ...]) -> tuple[tuple[float, float], ...]:
        """Bounds of the vessel [m] around a block of given bounds, x first and z last."""
        *lateral, (bottom, top) = bounds
        # only x has walls: vessels are two-dimensional
        if lateral:
            lower, upper = lateral[0]
            lateral[0] = (lower - self.left, upper + self.right)
        return (*lateral, (bottom, top + self.above))
