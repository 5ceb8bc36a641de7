"""`ConductionSettings`: the `[solver]` table of a run that computes heat and melting."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from lasersph.reading import Model


class ConductionSettings(Model):
    """Heat conduction with melting and vaporization in particles that do not move."""

    kind: Literal["conduction"] = "conduction"
    dimensions: Literal[1, 2, 3] = 2
    scheme: Literal["implicit", "explicit"] = Field(
        "implicit",
        description="implicit enthalpy [Demuth2020, eqs. (64)-(66)] or explicit "
        "predictor-corrector [Alshaer2017, eqs. (29), (30)]",
    )
    plateau: Literal["hold", "clip", "evaporate"] = Field(
        "hold",
        description="at the vaporization temperature: hold it for any enthalpy; clip the enthalpy "
        "at the full latent heat; or no plateau but a surface that evaporates",
    )
    phase_change: bool = Field(True, description="false: neither melting nor vaporization")
    weights: Literal["second-moment", "plain"] = Field(
        "second-moment",
        description="conduction weights corrected to conduct exactly on the lattice, or as printed",
    )
    iteration: Literal["newton", "published"] = Field(
        "newton",
        description="of the implicit scheme: Newton, or one Jacobi-CG step between updates of the "
        "fractions [Demuth2020, Section 4.2]",
    )
    tolerance: Annotated[float, Field(gt=0, lt=1e-2)] = Field(
        1e-8, description="residual of a step over the absorbed energy"
    )
