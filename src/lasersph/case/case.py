"""`Case`: the whole problem as one frozen model made of the rooms' own models, in SI units."""

from __future__ import annotations

import json
from typing import Annotated, Any, Literal, Self

from pydantic import Field, PrivateAttr, model_validator

from lasersph.boundaries import Boundaries, FlowConditions, InitialMotion, Vessel
from lasersph.case.checks import problems_of
from lasersph.case.material_choice import MaterialChoice
from lasersph.case.outputs import OutputSettings
from lasersph.case.solver_choice import SolverChoice
from lasersph.input import Model, Temperature, refusal
from lasersph.lasers import Laser
from lasersph.observers import Probe, Trace
from lasersph.particles import Domain, Lattice
from lasersph.solvers.ablation.ejection_settings import EjectionSettings
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.time_settings import TimeSettings

SCHEMA_VERSION = 1


class Case(Model):
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
    _name: str = PrivateAttr("")
    _text: str = PrivateAttr("")

    @model_validator(mode="after")
    def _check_together(self) -> Self:
        """What no room can see alone."""
        found = problems_of(self)
        if found:
            raise refusal(*found)
        return self

    @property
    def name(self) -> str:
        """Name of the shipped case or stem of the file; the title of a case built in Python."""
        return self._name or self.title or "case"

    @property
    def text(self) -> str:
        """The case file as given, headed by its overrides as comments."""
        return self._text or "# Built in Python: all values are in resolved.json.\n"

    def named(self, name: str, text: str) -> Self:
        """The same case with the name and the text of its file."""
        copy = self.model_copy()
        copy._name, copy._text = name, text
        return copy

    def resolved(self) -> dict[str, Any]:
        """Everything with all defaults filled in, SI, as plain data for JSON."""
        return json.loads(self.model_dump_json())

    def hash(self) -> str:
        """Short name of the content: equal for equal cases however they were written."""
        from lasersph.output import hash_of_case

        return hash_of_case(self.resolved())
