"""`AblationSettings`: the `[solver]` table of a run whose matter moves, compresses and ablates."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from lasersph.boundaries.initial_motion import InitialMotion
from lasersph.boundaries.vessel import Vessel
from lasersph.input import Acceleration, Length, Velocity
from lasersph.solvers.ablation.ejection_settings import EjectionSettings
from lasersph.solvers.solver_settings import SolverSettings


class AblationSettings(SolverSettings):
    """Weakly compressible flow with heat, melting and ejection of the surface."""

    reads: ClassVar[frozenset[str]] = frozenset({"traces"})
    bytes_per_neighbor: ClassVar[int] = 12
    """Memory of a neighbor [B]. Forecast: a list alone, of 4 B a pair, with the thickest skin, 0.3,
    2.2 times the pairs in the support in 3-D, and room for a quarter more."""

    kind: Literal["ablation"] = "ablation"
    dimensions: Literal[1, 2, 3] = Field(
        default=3, description="of space: z alone, x and z, or x, y and z"
    )
    """Dimensions of space. Source: [Alshaer2017] computes in 3-D."""
    sound_speed: Annotated[Velocity, Field(gt=0)] = Field(
        description="c_0 of the equation of state [Alshaer2017, eq. (26)]; far above all speeds of "
        "condensed matter, and the time step falls with it",
        examples=["1000 m/s"],
    )
    viscosity_solid: Annotated[float, Field(ge=0)] = Field(
        default=5.0, description="alpha of the artificial viscosity [Alshaer2017, eq. (23)]"
    )
    """Source: [Alshaer2017, eq. (23)]."""
    viscosity_liquid: Annotated[float, Field(ge=0)] = Field(
        default=0.1, description="alpha of what is molten"
    )
    """Source: [Alshaer2017, eq. (23)]."""
    tension: bool = Field(
        default=False,
        description="whether condensed matter below its density is under tension (P < 0)",
    )
    gravity: Annotated[Acceleration, Field(ge=0)] = Field(
        default=0.0, description="along -z; within nanoseconds it does nothing"
    )
    weights: Literal["second-moment", "plain"] = Field(
        default="second-moment",
        description="conduction weights divided by their second moment on the lattice, or as "
        "printed",
    )
    phase_change: bool = Field(
        default=True, description="false: no latent heat of melting and vaporization"
    )
    courant_number: Annotated[float, Field(gt=0, le=1)] = Field(
        default=0.25,
        description="CFL number of sound and forces [Alshaer2017, eq. (31)]",
    )
    """Source: [Alshaer2017, eq. (31)]."""
    skin: Annotated[float, Field(gt=0, le=2)] = Field(
        default=0.3,
        description="how much further than their support moving particles look for neighbors at "
        "most, in spacings; a thinner skin serves slow ones",
    )
    """Cost: how long a list of pairs lasts; the neighbors within the support are the same."""
    active_region: bool = Field(
        default=True,
        description="whether only the region around heat and motion is computed, cold matter at "
        "rest being inactive (only where nothing moves at the start and there is no gravity)",
    )
    ejecta_height: Annotated[Length, Field(gt=0)] | None = Field(
        default=None,
        description="height over the surface up to which ejecta are followed; default: the depth",
    )
    vessel: Vessel | None = Field(default=None, description="walls around the block")
    motion: InitialMotion | None = Field(default=None, description="how matter starts")
    ejection: EjectionSettings | None = Field(
        default=None, description="how particles leave the surface under a laser"
    )

    @property
    def curve_plateau(self) -> Literal["hold"]:
        """Matter at the boiling point keeps its temperature while it takes up latent heat."""
        return "hold"

    @property
    def scheme_text(self) -> str:
        """How steps are taken, for a reader."""
        return "explicit"

    @property
    def is_explicit(self) -> bool:
        """Whether stability limits the steps of heat."""
        return True

    @property
    def leaves_rest_inactive(self) -> bool:
        """Whether cold matter at rest is left alone; under gravity nothing rests."""
        return self.active_region and self.gravity == 0.0
