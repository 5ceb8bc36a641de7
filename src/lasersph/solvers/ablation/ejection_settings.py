"""`EjectionSettings`: the `[solver.ejection]` table, how particles leave the surface.

Two presets reproduce what [Alshaer2017] reports with the published rule; no setting gives both:

    timeline   R = 0.80, has left after 0.677 spacings     melting, boiling, speeds; too deep
    depth      R = 0.90, has left after 2 h                 depth; boils too late
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field, model_validator

from lasersph.input import Model, refusal


@dataclass(frozen=True)
class Preset:
    """Numbers of a preset: reflectivity, and distance of leaving in spacings or supports."""

    reflectivity: float
    spacings: float = 0.0
    supports: float = 0.0


PRESETS = {
    "timeline": Preset(reflectivity=0.80, spacings=0.677),
    "depth": Preset(reflectivity=0.90, supports=1.0),
}
OF_PUBLISHED = ("preset", "leave", "leave_distance")


class EjectionSettings(Model):
    """How particles leave the surface."""

    model: Literal["enthalpy", "published"] = Field(
        default="enthalpy",
        description="enthalpy: a particle leaves when all latent heat is in, converges with the "
        "spacing; published: the rule of [Alshaer2017], from the boiling temperature on and "
        "without latent heats, whose depth depends on when a particle counts as left",
    )
    velocity: Literal["effusion", "mean-normal"] = Field(
        default="effusion",
        description="of the vapor: sqrt(R T / (2 pi M)), which gives the velocities that "
        "[Alshaer2017] reports, or twice that, its eq. (6) as printed",
    )
    preset: Literal["timeline", "depth"] | None = Field(
        default=None,
        description="published: timeline (reflectivity 0.80, left after 0.677 spacings) or depth "
        "(reflectivity 0.90, left after two smoothing lengths)",
    )
    leave: Literal["layer-below", "distance"] | None = Field(
        default=None,
        description="published: when a particle has left and absorbs no longer: when the "
        "particles that it covered are exposed (default), or after a distance",
    )
    leave_distance: Annotated[float, Field(gt=0, le=100)] | None = Field(
        default=None, description='published, for leave = "distance": in spacings'
    )

    @model_validator(mode="after")
    def _check_model(self) -> EjectionSettings:
        # keys of the published rule say nothing beside the balance of enthalpy
        given = [key for key in OF_PUBLISHED if getattr(self, key) is not None]
        if self.model == "enthalpy" and given:
            reason = (
                'says nothing where model = "enthalpy"; leave it out or write model = "published"'
            )
            raise refusal(*((key, reason) for key in given))

        # a preset says all of them
        if self.preset is not None and len(given) > 1:
            raise refusal(
                *(
                    (key, f'preset = "{self.preset}" says that already; leave one of them out')
                    for key in given[1:]
                )
            )

        # a distance and the rule that needs it go together
        if self.leave == "distance" and self.leave_distance is None:
            raise refusal(
                ("leave_distance", 'missing for leave = "distance"; write e.g. 0.677, in spacings')
            )
        if self.leave_distance is not None and self.leave != "distance":
            raise refusal(("leave", 'a leave_distance needs leave = "distance"; write both'))
        return self

    @property
    def has_latent_heats(self) -> bool:
        """Whether melting and evaporation take latent heat."""
        return self.model == "enthalpy"

    @property
    def reflectivity(self) -> float | None:
        """Reflectivity that the preset asks for; None where laser and material say it."""
        return PRESETS[self.preset].reflectivity if self.preset is not None else None

    def left_after(self, spacing: float, support: float) -> float:
        """Distance after which a leaving particle has left [m]; -1: when it covers none.

        Args:
            spacing: of the particles [m]. support: their support radius, 2 h [m].
        """
        if self.preset is not None:
            preset = PRESETS[self.preset]
            return preset.spacings * spacing + preset.supports * support
        return -1.0 if self.leave_distance is None else self.leave_distance * spacing
