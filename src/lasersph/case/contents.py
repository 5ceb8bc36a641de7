"""`CaseContents`: the keys of a case, of the rooms' own models, not yet checked together."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, ValidationInfo, field_validator, model_validator

from lasersph.boundaries import Boundaries, FlowConditions, InitialMotion, Vessel
from lasersph.boundaries.initial_surface import InitialSurface
from lasersph.case.material_choice import MaterialChoice
from lasersph.case.solver_choice import (
    SolverChoice,
    has_pool,
    surface_moves,
    with_frame,
    with_vaporization,
)
from lasersph.input import Model, Temperature
from lasersph.lasers import Laser
from lasersph.output.settings import OutputSettings, Probe, Trace
from lasersph.particles import Domain, Geometry, Lattice
from lasersph.solvers.ablation.ejection_settings import EjectionSettings
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.solver_settings import SolverSettings
from lasersph.solvers.time_settings import TimeSettings

SCHEMA_VERSION = 2


class CaseContents(Model):
    """One problem: metal, light, block, particles, boundaries, solver, times, what is stored."""

    schema_version: Literal[2] = Field(
        default=SCHEMA_VERSION, description="of the case file's format"
    )
    title: str = Field(default="", max_length=200, description="one line for reports")
    material: MaterialChoice = Field(
        description="name of a material, path of a material file (relative to the case file), or "
        "a table with base and what differs from it, or a whole material as a table"
    )
    initial_temperature: Annotated[Temperature, Field(gt=0)] = Field(
        default=298.15, description="of all particles; enthalpies count from it"
    )
    domain: Domain = Field(description="size of the block")
    particles: Lattice = Field(description="their spacing and arrangement")
    boundaries: Boundaries = Field(
        default=Boundaries.model_validate({}), description="what holds at each side"
    )
    laser: Laser | None = Field(default=None, description="the light; none: nothing is lit")
    solver: SolverChoice = Field(
        default=ConductionSettings.model_validate({}),
        validate_default=True,
        description="what is computed: heat, flow of the melt, ablation",
    )
    time: TimeSettings = Field(description="how long, and in which steps")
    probes: tuple[Probe, ...] = Field(
        default=(), description="places whose temperature is recorded"
    )
    traces: tuple[Trace, ...] = Field(
        default=(), description="only where matter moves (ablation): particles that are followed"
    )
    output: OutputSettings = Field(
        default=OutputSettings.model_validate({}), description="what is stored, and how often"
    )

    @field_validator("solver")
    @classmethod
    def _say_defaults(cls, solver: SolverSettings, info: ValidationInfo) -> SolverSettings:
        """Fill the defaults in that depend on the metal, where that could be read."""
        material = info.data.get("material")
        if material is None:
            return solver
        return with_frame(with_vaporization(solver, material), material)

    @model_validator(mode="after")
    def _say_support(self) -> Self:
        """Fill in how far particles of a box see that rest, where the case does not say."""
        if self.flow is None or getattr(self.solver, "frame", None) != "eulerian":
            return self
        return self.model_copy(update={"particles": self.particles.at_rest()})

    @property
    def geometry(self) -> Geometry:
        """The space that the block stands for."""
        return Geometry(self.solver.dimensions, self.solver.geometry == "axisymmetric")

    @property
    def symmetry_factor(self) -> int:
        """How many times the section that is computed fits into the whole: 2 of half of it."""
        return 2 if self.geometry.is_axisymmetric else self.domain.symmetry_factor

    @property
    def flow(self) -> FlowConditions | None:
        """`solver.flow`: a closed box that is all fluid; None for a pool in a block."""
        flow = getattr(self.solver, "flow", None)
        return None if self.has_pool else flow

    @property
    def has_pool(self) -> bool:
        """Whether `solver.flow` only names the surface of a pool in a metal that melts."""
        return has_pool(self.solver, self.material)

    @property
    def surface_moves(self) -> bool:
        """Whether the surface of a flow moves."""
        return surface_moves(self.solver)

    @property
    def initial_surface(self) -> InitialSurface | None:
        """`solver.flow.initial_surface`: heights of a surface that moves, at the start."""
        flow = getattr(self.solver, "flow", None)
        return None if flow is None else flow.initial_surface

    @property
    def pause(self) -> Literal["compute", "spread", "remove"]:
        """Treatment of the pauses between the pulses of a train, see `TimeSettings.pause`."""
        # One pulse has no pause; with several, a surface that moves is worth the time of melt only.
        if self.laser is None or self.laser.pulse.count == 1:
            return "compute"
        return self.time.pause or ("remove" if self.surface_moves else "compute")

    @property
    def end_of_pulse(self) -> float:
        """Time to compute of each pulse [s]: until the end, where pauses are jumped over after the
        start of the last one."""
        if self.pause == "compute" or self.laser is None:
            return self.time.end
        pulse = self.laser.pulse
        return self.time.end - (pulse.count - 1) * (pulse.interval or 0.0)

    @property
    def vessel(self) -> Vessel | None:
        """`solver.vessel`: walls around the block; None without."""
        return getattr(self.solver, "vessel", None)

    @property
    def motion(self) -> InitialMotion | None:
        """`solver.motion`: how matter starts; None where it rests."""
        return getattr(self.solver, "motion", None)

    @property
    def ejection(self) -> EjectionSettings | None:
        """`solver.ejection`: how particles leave the surface; None for the usual way."""
        return getattr(self.solver, "ejection", None)
