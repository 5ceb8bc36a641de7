"""`CaseContents`: the keys of a case, of the rooms' own models, not yet checked together."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from lasersph.boundaries import Boundaries, FlowConditions, InitialMotion, Vessel
from lasersph.case.material_choice import MaterialChoice
from lasersph.case.solver_choice import SolverChoice
from lasersph.input import Model, Temperature
from lasersph.lasers import Laser
from lasersph.output.settings import OutputSettings, Probe, Trace
from lasersph.particles import Domain, Lattice
from lasersph.solvers.ablation.ejection_settings import EjectionSettings
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.time_settings import TimeSettings

SCHEMA_VERSION = 1


class CaseContents(Model):
    """One problem: metal, light, block, particles, boundaries, solver, times, what is stored."""

    schema_version: Literal[1] = Field(
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
    domain: Domain
    particles: Lattice
    boundaries: Boundaries = Boundaries.model_validate({})
    laser: Laser | None = None
    flow: FlowConditions | None = Field(
        default=None,
        description="only for a closed box that is all fluid; without it what is molten flows",
    )
    vessel: Vessel | None = Field(
        default=None, description="only where matter moves (ablation): walls around the block"
    )
    motion: InitialMotion | None = Field(
        default=None, description="only where matter moves (ablation): how it starts"
    )
    ejection: EjectionSettings | None = Field(
        default=None, description="only where a laser ablates: how particles leave the surface"
    )
    solver: SolverChoice = ConductionSettings.model_validate({})
    time: TimeSettings
    probes: tuple[Probe, ...] = ()
    traces: tuple[Trace, ...] = Field(
        default=(), description="only where matter moves (ablation): particles that are followed"
    )
    output: OutputSettings = OutputSettings.model_validate({})
