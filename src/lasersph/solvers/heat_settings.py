"""`HeatSettings`: the keys of `[solver]` that every solver with heat and melting shares."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from lasersph.solvers.solver_settings import SolverSettings


class HeatSettings(SolverSettings):
    """How heat and changes of phase are computed."""

    bytes_per_neighbor: ClassVar[int] = 56
    """Index and weight, and their copies while the list is assembled."""

    kind: str
    dimensions: Literal[1, 2, 3] = 2
    plateau: Literal["hold", "clip", "evaporate"] = Field(
        default="hold",
        description="at the vaporization temperature: hold it for any enthalpy; clip the enthalpy "
        "at the full latent heat; or no plateau but a surface that evaporates",
    )
    phase_change: bool = Field(default=True, description="false: neither melting nor vaporization")
    weights: Literal["second-moment", "plain"] = Field(
        default="second-moment",
        description="conduction weights corrected to conduct exactly on the lattice, or as printed",
    )
    tolerance: Annotated[float, Field(gt=0, lt=1e-2)] = Field(
        default=1e-8, description="residual of a step over the absorbed energy"
    )
