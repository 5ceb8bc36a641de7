"""`ConductionSettings`: the `[solver]` table of a run that computes heat and melting."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from lasersph.solvers.heat_settings import HeatSettings


class ConductionSettings(HeatSettings):
    """Heat conduction with melting and vaporization in particles that do not move."""

    kind: Literal["conduction"] = "conduction"
    scheme: Literal["implicit", "explicit"] = Field(
        default="implicit",
        description="implicit enthalpy [Demuth2020, eqs. (64)-(66)] or explicit "
        "predictor-corrector [Alshaer2017, eqs. (29), (30)]",
    )
    iteration: Literal["newton", "published"] = Field(
        default="newton",
        description="of the implicit scheme: Newton, or one Jacobi-CG step between updates of the "
        "fractions [Demuth2020, Section 4.2]",
    )

    @property
    def scheme_text(self) -> str:
        """How steps are taken, for a reader."""
        return self.scheme

    @property
    def is_explicit(self) -> bool:
        """Whether stability limits the steps of heat."""
        return self.scheme == "explicit"
