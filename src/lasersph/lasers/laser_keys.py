"""`LaserKeys`: the keys of [laser], what they say together, and what contradicts in them.

The amount of light is exactly one of

    fluence         of one pulse, mean or peak         F = fluence / (mean or peak of f)
    intensity       while the light is on, the same    F = intensity t_on / (mean or peak of f)
    pulse_energy    gaussian and top-hat beams, spots  F = pulse_energy / (integral of f or g)
    power           the same                           F = power t_on / (integral of f or g)

with f the beam's profile, g the envelope of a spot and F the fluence where both are 1.
"""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from lasersph.input import (
    Energy,
    Fluence,
    Intensity,
    Length,
    Model,
    Power,
    format_quantity,
    refusal,
)
from lasersph.lasers.absorption import Absorption
from lasersph.lasers.beams import GaussianBeam, TopHatBeam, UniformBeam
from lasersph.lasers.interference import InterferenceBeam
from lasersph.lasers.path import LinearPath, Path
from lasersph.lasers.pulses import Pulse
from lasersph.lasers.reflectivity import Absorptivity, Reflectivity
from lasersph.lasers.shaped_beams import RingBeam, SuperGaussianBeam
from lasersph.lasers.spot import Spot, SpotFluence

Array = NDArray[np.float64]
Beam = Annotated[
    UniformBeam | TopHatBeam | GaussianBeam | SuperGaussianBeam | RingBeam | InterferenceBeam,
    Field(discriminator="kind"),
]
AMOUNTS = ("fluence", "intensity", "pulse_energy", "power")


class LaserKeys(Model):
    """Light that falls onto the surface, along -z."""

    fluence: Annotated[Fluence, Field(gt=0)] | None = Field(
        default=None, description="of one pulse", examples=["1 J/cm^2"]
    )
    fluence_kind: Literal["mean", "peak"] | None = Field(
        default=None,
        description="what fluence or intensity means; mean for interference (its spatial mean), "
        "needed for a gaussian beam (mean = energy over the circle of radius 1/e^2)",
    )
    intensity: Annotated[Intensity, Field(gt=0)] | None = Field(
        default=None, description="of square pulses, or of the value 1 of a tabulated one"
    )
    pulse_energy: Annotated[Energy, Field(gt=0)] | None = Field(
        default=None, description="of one pulse"
    )
    power: Annotated[Power, Field(gt=0)] | None = Field(
        default=None, description="of square pulses, or of the value 1 of a tabulated one"
    )
    wavelength: Annotated[Length, Field(gt=0)] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="chooses the optics of a metal that has them for several wavelengths",
        examples=["1064 nm"],
    )
    beam: Beam = Field(default=UniformBeam(), description="how the light lies on the surface")
    spot: Spot | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="under which an interference pattern or a uniform beam lies",
    )
    pulse: Pulse = Field(description="how the light comes in time")
    absorption: Absorption = Field(description="how deep the light goes")
    reflectivity: Reflectivity | None = Field(default=None, description="instead of the material's")
    absorptivity: Absorptivity | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="instead of a reflectivity; also over time, as measured",
    )
    position: tuple[Length, Length] = Field(
        default=(0.0, 0.0), description="x and y of the beam's axis"
    )
    path: Path | None = Field(default=None, description="of a moving spot")

    @model_validator(mode="after")
    def _check_amount(self) -> LaserKeys:
        given = [name for name in AMOUNTS if getattr(self, name) is not None]
        if len(given) != 1:
            got = " and ".join(given) or "none"
            example = (
                'fluence = "1 J/cm^2"' if self.beam.names_fluence else 'pulse_energy = "10 uJ"'
            )
            line = f"write e.g. {example} (one of {', '.join(AMOUNTS)})"
            hint = f"leave all but one of {got} out" if given else line
            raise ValueError(f"a laser needs one statement of its energy, got {got}; {hint}")
        # a power says nothing without the time for which the light is on
        name = given[0]
        if name in ("intensity", "power") and self.pulse.on_time is None:
            raise ValueError(
                f"{name} does not fix the energy of a gaussian pulse; write instead "
                + ('fluence = "1 J/cm^2"' if name == "intensity" else 'pulse_energy = "10 uJ"')
            )
        if name in ("pulse_energy", "power"):
            if self.area is None:
                raise ValueError(
                    f"{name} has no meaning for the unbounded {self.beam.kind} beam; write e.g. "
                    'spot = { diameter = "50 um", definition = "1/e^2" }, or fluence'
                )
            if self.fluence_kind is not None:
                raise refusal(("fluence_kind", f"says nothing beside {name}; leave it out"))
        elif self.fluence_kind is None and not self.beam.names_fluence:
            raise ValueError(
                f"{name} of a {self.beam.kind} beam may be its mean or its peak "
                f"({1.0 / self.beam.mean:.3g} times the mean); write fluence_kind = "
                '"peak" or "mean"'
            )
        if self.fluence_kind == "peak" and self.beam.peak is None:
            raise ValueError(
                "the peak of this interference pattern depends on the phases of its waves; write "
                'fluence_kind = "mean" with the mean fluence'
            )
        return self

    @model_validator(mode="after")
    def _check_absorptivity(self) -> LaserKeys:
        if self.absorptivity is not None and self.reflectivity is not None:
            raise refusal(
                (
                    "absorptivity",
                    "says the same as reflectivity, which is 1 - absorptivity; leave one of them "
                    "out",
                )
            )
        return self

    @model_validator(mode="after")
    def _check_spot(self) -> LaserKeys:
        if self.spot is None:
            return self
        if self.beam.area is not None:
            raise refusal(
                ("spot", f"a {self.beam.kind} beam is a spot by itself; leave spot out"),
            )
        if self.spot.scan_speed is not None and self.pulse.interval is None:
            raise refusal(
                (
                    "spot.scan_speed",
                    "needs the time between pulses; write e.g. repetition_rate "
                    '= "10 kHz" in [laser.pulse]',
                )
            )
        if self.spot.image is not None and (self.pulse_energy or self.power) is None:
            raise ValueError(
                "fluence and intensity of a measured beam would be those of one pixel; write e.g. "
                'pulse_energy = "10 uJ" instead'
            )
        period, diameter = self.beam.lateral_period, self.spot_fluence.diameter
        if period is not None and diameter < period:
            raise refusal(
                (
                    "spot.diameter",
                    f"{format_quantity(diameter, 'm')} is smaller than a period of the pattern, "
                    f"{format_quantity(period, 'm')}; write a spot of several periods",
                )
            )
        return self

    @model_validator(mode="after")
    def _check_path(self) -> LaserKeys:
        if self.path is not None and not self.is_bounded and self.beam.is_uniform:
            raise ValueError("a uniform beam cannot move; leave path out or give another beam")
        tabulated = self.path is not None and not isinstance(self.path, LinearPath)
        if tabulated and self.position != (0.0, 0.0):
            raise ValueError("a tabulated path holds the positions already; leave position out")
        return self

    @model_validator(mode="after")
    def _check_shift(self) -> LaserKeys:
        if not self.beam.pulse_shift:
            return self
        if self.pulse.count == 1:
            raise refusal(
                ("beam.shift", "says nothing with one pulse; leave it out, or give more pulses")
            )
        if self.path is not None or self.is_bounded:
            raise refusal(("beam.shift", "is not computed of a spot or its path; leave it out"))
        return self

    @model_validator(mode="after")
    def _check_wavelength(self) -> LaserKeys:
        waves = self.beam.pattern_wavelength
        if self.wavelength is not None and waves is not None and self.wavelength != waves:
            own, beams = (format_quantity(one, "m", 6) for one in (self.wavelength, waves))
            raise refusal(
                (
                    "wavelength",
                    f"is {own}, but that of the waves that interfere, laser.beam.wavelength, is "
                    f"{beams}; leave it out here, or change both",
                )
            )
        return self

    @property
    def area(self) -> float | None:
        """Integral of the spot's envelope, or of the beam's profile [m^2]; None if unbounded."""
        return self.beam.area if self.spot is None else self.spot.envelope.area

    @property
    def is_bounded(self) -> bool:
        """Whether the light on the domain ends: a spot lies in it."""
        is_whole = self.spot is not None and self.spot.extent == "whole"
        return is_whole or self.beam.area is not None

    @property
    def _center_fluence(self) -> float:
        """The fluence of one pulse where f and g are 1 [J/m^2]."""
        on_time, area = self.pulse.on_time, self.area
        # F from whichever of the four amounts is given, see the table above
        if self.pulse_energy is not None and area is not None:
            return self.pulse_energy / area
        if self.power is not None and area is not None and on_time is not None:
            return self.power * on_time / area
        reference = self.beam.peak if self.fluence_kind == "peak" else self.beam.mean
        assert reference is not None
        if self.intensity is not None and on_time is not None:
            return self.intensity * on_time / reference
        assert self.fluence is not None
        return self.fluence / reference

    @property
    def spot_fluence(self) -> SpotFluence:
        """The local fluence over the spot of the light.

        Raises:
            ValueError: the light has no spot: a uniform beam or a pattern without `spot`.
        """
        envelope = self.beam if self.spot is None else self.spot.envelope
        if isinstance(envelope, UniformBeam | InterferenceBeam):
            raise ValueError(
                f"the {self.beam.kind} beam has no spot; write e.g. spot = {{ diameter = "
                '"50 um", definition = "1/e^2" } in [laser]'
            )
        energy, period = self._center_fluence * envelope.area, self.beam.lateral_period
        return SpotFluence(envelope, energy, 2.0 * envelope.radius, envelope.shape, period)
