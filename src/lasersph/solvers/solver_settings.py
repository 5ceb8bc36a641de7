"""`SolverSettings`: what a case and a forecast may ask the settings of any solver.

They ask for what a solver does, never for its kind.
"""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from lasersph.input import Model


class SolverSettings(Model):
    """The `[solver]` table of a case."""

    reads: ClassVar[frozenset[str]] = frozenset()
    """Of the keys of a case that not every solver reads, those that this one does."""
    bytes_per_particle: ClassVar[int] = 400
    """Memory of a particle [B]: fields, what is kept of them for a checkpoint, and vectors of a
    step. Forecast: as measured; nothing computed depends on it."""
    bytes_per_neighbor: ClassVar[int]
    """Most memory that a particle takes for each neighbor with which it is computed [B]."""

    geometry: Literal["planar", "axisymmetric"] = Field(
        default="planar",
        exclude_if=lambda given: given == "planar",
        description="of the block: a line, a plane section or a body; or the section (r, z) of a "
        "body of revolution about the axis of the beam, with dimensions = 2",
    )

    @property
    def scheme_text(self) -> str:
        """How steps are taken, for a reader."""
        return "heat implicit"

    @property
    def is_explicit(self) -> bool:
        """Whether stability limits the steps of heat, and `time.step` only from above."""
        return False

    @property
    def evaporates(self) -> bool:
        """Whether vapor leaves the surface as a flux."""
        return False

    @property
    def has_vapor_flux(self) -> bool:
        """Whether it does so against the pressure of the surroundings, hotter than boiling."""
        return False

    @property
    def leaves_rest_inactive(self) -> bool:
        """Whether cold matter at rest is left alone until heat comes near."""
        return False
