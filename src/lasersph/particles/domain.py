"""`Domain`: the block of metal that is computed, with its surface at z = 0."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from lasersph.input import Length, Model
from lasersph.particles.faces import FRONT, LEFT
from lasersph.particles.geometry import Geometry

Size = Annotated[Length, Field(gt=0)]


class Domain(Model):
    """Size of the block. x runs from -width/2 to width/2, y from -breadth/2 to breadth/2, or from 0
    where half or a quarter is computed; in a section (r, z) r runs from the axis, r = 0, to the
    width."""

    depth: Size = Field(description="from the surface to the bottom", examples=["10 um"])
    width: Size | None = Field(
        default=None,
        description="along x; 2-D and 3-D; the period of a pattern; the radius of an axisymmetric "
        "block",
        examples=["20 um"],
    )
    breadth: Size | None = Field(default=None, description="along y; 3-D; default: the width")
    extent: Literal["full", "half", "quarter"] = Field(
        default="full",
        description="half: only x > 0 is computed, symmetric about x = 0; quarter: only x > 0 and "
        "y > 0, symmetric about both; 3-D",
    )

    def lateral(self, geometry: Geometry) -> tuple[tuple[float, float], ...]:
        """Lower and upper bound along x (and y) or r [m], empty in 1-D.

        Raises:
            ValueError: no width although the run has more than one dimension.
        """
        if geometry.dimensions == 1:
            return ()
        if self.width is None:
            raise ValueError(f"a {geometry.dimensions}-D domain needs a width")
        if geometry.is_axisymmetric:
            return ((0.0, self.width),)
        half = 0.5 * self.width
        x = (-half if self.extent == "full" else 0.0, half)
        if geometry.dimensions == 2:
            return (x,)
        other = 0.5 * (self.breadth or self.width)
        return (x, (0.0 if self.extent == "quarter" else -other, other))

    @property
    def planes_of_symmetry(self) -> tuple[str, ...]:
        """Faces in which the computed part is mirrored: that at x = 0, that at y = 0."""
        return {"full": (), "half": (LEFT,), "quarter": (LEFT, FRONT)}[self.extent]

    @property
    def part(self) -> str:
        """Words for the part that is computed."""
        return {"full": "all of", "half": "half", "quarter": "a quarter of"}[self.extent]

    @property
    def symmetry_factor(self) -> int:
        """How many times the computed part fits into the whole along x."""
        return 1 if self.extent == "full" else 2
