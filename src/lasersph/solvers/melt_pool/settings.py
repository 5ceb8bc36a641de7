"""`MeltPoolSettings`: the `[solver]` table of a run that computes heat, melting and flow."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, field_validator

from lasersph.boundaries.flow_conditions import FlowConditions
from lasersph.input import Acceleration
from lasersph.solvers.heat_settings import HeatSettings


class MeltPoolSettings(HeatSettings):
    """Heat, melting and the incompressible flow of what is molten, or of a closed box."""

    bytes_per_particle: ClassVar[int] = 1200
    """Memory of a particle [B]. Forecast: as measured; nothing computed depends on it."""
    bytes_per_neighbor: ClassVar[int] = 64
    """Memory of a neighbor [B]. Forecast: 28 of a pair of the body: index and weight, twice while
    rows are renewed, and the weight in single precision; and 74 of a pair that moves, half of them,
    with room for more: weights of heat, viscosity and pressure, gradient and kernel, and two
    indices."""

    kind: Literal["melt-pool"] = "melt-pool"
    dimensions: Literal[2, 3] = Field(default=2, description="of space: x and z, or x, y and z")
    """Dimensions of space. Source: [Demuth2020] computes in 2-D."""

    @field_validator("dimensions", mode="before")
    @classmethod
    def _say_why_not_one(cls, value: Any) -> Any:
        """Refuse columns with the reason; the type refuses all else."""
        if value == 1:
            raise ValueError(
                "must be 2 or 3, got 1: a column of liquid has nowhere to flow; write "
                'dimensions = 2, or kind = "conduction" for heat and melting alone'
            )
        return value

    marangoni: bool = Field(
        default=True, description="whether the gradient of surface tension drives the surface"
    )
    pressure: Literal["multigrid", "published"] = Field(
        default="multigrid",
        description="conjugate gradients corrected on coarser grids, or the matrix of "
        "[Demuth2020, Table 1] with BiCGStab",
    )
    pressure_tolerance: Annotated[float, Field(gt=0, lt=1)] = Field(
        default=1e-4, description="residual of the pressure equation over its right-hand side"
    )
    """Study: with 1e-6 instead, speeds, pressure and width of the pool of `dlip-steel --quick`
    change by less than 1e-7, for half as many iterations again."""
    viscosity: Literal["implicit", "explicit"] = Field(
        default="implicit", description="whether viscous forces are those at the end of a step"
    )
    step_limits: Literal["corrected", "published"] = Field(
        default="corrected",
        description="each limit by what it keeps stable, or all of [Demuth2020, eqs. (59), (76)]",
    )
    frame: Literal["lagrangian", "eulerian"] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="particles move with the melt, or rest while it passes between them; default: "
        "eulerian in sections (r, z), and in boxes whose surface does not move, shifting is not "
        "given and no scheme is published or explicit; else lagrangian",
    )
    shifting: Annotated[float, Field(ge=0, le=0.5)] = Field(
        default=0.04,
        description="factor C of the particle shifting [Demuth2020, eq. (73)]; 0 for none",
    )
    """Study: [Xu2009] takes 0.01 to 0.1; `benchmarks/flow_numbers.py --only cavity`."""
    gravity: Annotated[Acceleration, Field(ge=0)] = Field(
        default=9.81, description="along -z; it acts on differences of density only (Boussinesq)"
    )
    """[m/s^2]. Source: standard gravity, 9.80665, as [Demuth2020] rounds it."""
    steady: Annotated[float, Field(gt=0, lt=1)] | None = Field(
        default=None,
        description="stop before the end once the flow is steady: range of its kinetic energy over "
        "the mean, while the fastest particle crosses the width five times",
    )
    flow: FlowConditions | None = Field(
        default=None,
        description="only for a closed box that is all fluid; without it what is molten flows",
    )

    @property
    def is_shifted(self) -> bool:
        """Whether the case says how particles that move are shifted."""
        return self.shifting != type(self).model_fields["shifting"].default

    @property
    def is_published(self) -> bool:
        """Whether a scheme of the flow is that of [Demuth2020]."""
        is_explicit = self.viscosity == "explicit"
        return is_explicit or "published" in (self.pressure, self.step_limits)

    @property
    def rests(self) -> bool:
        """Whether particles keep their columns and the melt passes between them."""
        return self.geometry == "axisymmetric" or self.frame == "eulerian"
