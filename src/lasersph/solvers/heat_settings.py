"""`HeatSettings`: the keys of `[solver]` that every solver with heat and melting shares."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from lasersph.input import refusal
from lasersph.solvers.solver_settings import SolverSettings


class HeatSettings(SolverSettings):
    """How heat and changes of phase are computed."""

    bytes_per_neighbor: ClassVar[int] = 36
    """Memory of a neighbor [B]: index and weight, and their copies while the list is assembled.
    Forecast: as measured; nothing computed depends on it."""

    kind: str
    dimensions: Literal[1, 2, 3] = Field(
        default=2, description="of space: z alone, x and z, or x, y and z"
    )
    """Dimensions of space. Source: [Demuth2020] computes in 2-D."""
    plateau: Literal["hold", "clip", "evaporate"] = Field(
        default="hold",
        description="at the vaporization temperature: hold it for any enthalpy; clip the enthalpy "
        "at the full latent heat; or no plateau but a surface that evaporates",
    )
    vaporization: Literal["plateau", "flux"] | None = Field(
        default=None,
        description="what holds at the vaporization temperature: the plateau; or none, and vapor "
        "leaves a surface that may be hotter, against boundaries.ambient_pressure, and pushes one "
        "that moves; default: flux where the surface of a pool moves, unless plateau is given, "
        "else the plateau",
    )
    phase_change: bool = Field(default=True, description="false: neither melting nor vaporization")
    weights: Literal["second-moment", "plain"] = Field(
        default="second-moment",
        description="conduction weights corrected to conduct exactly on the lattice, or as printed",
    )
    tolerance: Annotated[float, Field(gt=0, lt=1e-2)] = Field(
        default=1e-8, description="residual of a step over the absorbed energy"
    )
    """Accuracy: the balance of a run closes to it or better, and the reference program of the
    texturing cases has the same."""

    heat: Literal["one-temperature", "two-temperature"] = Field(
        default="one-temperature",
        exclude_if=lambda given: given == "one-temperature",
        description="of electrons and lattice together, or of each by itself, as under pulses "
        "shorter than some 100 ps; needs the metal's electrons",
    )
    step_error: Annotated[float, Field(gt=0, lt=0.5)] = Field(
        default=0.01,
        exclude_if=lambda given: given == 0.01,
        description="with two temperatures: change of the temperatures where a step is halved, "
        "over their rise, that bounds the steps",
    )
    """Accuracy: errors of a step are of second order, far below this change, which is of first."""
    equal_within: Annotated[float, Field(gt=0, lt=0.5)] = Field(
        default=0.01,
        exclude_if=lambda given: given == 0.01,
        description="with two temperatures: share of the lattice's within which they are one, "
        "where no light comes",
    )
    """Accuracy: a hundredth of T in electrons that hold some 3 % of the heat moves T by 3e-4."""

    @model_validator(mode="after")
    def _check_plateau(self) -> HeatSettings:
        if self.has_vapor_flux and self.plateau != "hold":
            raise refusal(
                (
                    "plateau",
                    f'"{self.plateau}" says nothing where vaporization = "flux"; leave it out',
                )
            )
        return self

    @property
    def has_two_temperatures(self) -> bool:
        """Whether electrons and lattice have a temperature each."""
        return self.heat == "two-temperature"

    @property
    def curve_plateau(self) -> Literal["hold", "clip", "evaporate"]:
        """Course of the caloric curve at the vaporization temperature."""
        return "evaporate" if self.has_vapor_flux else self.plateau

    @property
    def evaporates(self) -> bool:
        """Whether vapor leaves the surface as a flux; under plateau = "evaporate" into vacuum."""
        return self.curve_plateau == "evaporate"

    @property
    def has_vapor_flux(self) -> bool:
        """Whether it does so against the pressure of the surroundings, hotter than boiling."""
        return self.vaporization == "flux"
