"""`Laser`: beam, pulse, absorption and the energy that sets their scale.

    energy on a cell in [t0, t1], per area:   F int f(x - x_c(t)) g(t) dt

f is the beam's profile (exact cell means), g the pulse (exact share of one pulse's energy), x_c
the position of the beam's axis and F the fluence at f = 1, from exactly one of

    fluence         of one pulse, mean or peak         F = fluence / (mean or peak of f)
    intensity       while the light is on, the same    F = intensity t_on / (mean or peak of f)
    pulse_energy    gaussian and top-hat beams, spots  F = pulse_energy / (integral of f or g)
    power           the same                           F = power t_on / (integral of f or g)

A pattern or a uniform beam may lie under a spot, the envelope g of `spot`: a domain that is a cell
of the spot receives F g(place) f, one that holds the whole spot F g f, whose mean over a cell is
taken as the product of both means (they differ by dx^2 g' f' / 12, dx the cell's width). Fluence
and intensity are then those at the spot's center.

The integral over a step of a moving beam is that of `path`.
"""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
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
from lasersph.lasers.path import LinearPath, Path, path_quadrature
from lasersph.lasers.pulses import Pulse
from lasersph.lasers.reflectivity import Reflectivity, reflectivity_nodes
from lasersph.lasers.shaped_beams import RingBeam, SuperGaussianBeam
from lasersph.lasers.spot import Spot, SpotFluence
from lasersph.materials import Material

Array = NDArray[np.float64]
Beam = Annotated[
    UniformBeam | TopHatBeam | GaussianBeam | SuperGaussianBeam | RingBeam | InterferenceBeam,
    Field(discriminator="kind"),
]
AMOUNTS = ("fluence", "intensity", "pulse_energy", "power")


class Laser(Model):
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
    position: tuple[Length, Length] = Field(
        default=(0.0, 0.0), description="x and y of the beam's axis"
    )
    path: Path | None = Field(default=None, description="of a moving spot")

    @model_validator(mode="after")
    def _check_amount(self) -> Laser:
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
    def _check_spot(self) -> Laser:
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
    def _check_path(self) -> Laser:
        if self.path is not None and not self.is_bounded and self.beam.is_uniform:
            raise ValueError("a uniform beam cannot move; leave path out or give another beam")
        tabulated = self.path is not None and not isinstance(self.path, LinearPath)
        if tabulated and self.position != (0.0, 0.0):
            raise ValueError("a tabulated path holds the positions already; leave position out")
        return self

    @model_validator(mode="after")
    def _check_shift(self) -> Laser:
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
    def _check_wavelength(self) -> Laser:
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
    def unit_fluence(self) -> float:
        """F [J/m^2]: the fluence of one pulse where the profile f is 1; at the place of the cell
        where the domain is a cell of a spot."""
        if self.spot is None or self.spot.extent == "whole":
            return self._center_fluence
        return self._center_fluence * float(self.spot.envelope.at(*self.spot.place))

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

    @property
    def mean_fluence(self) -> float:
        """Mean fluence of one pulse [J/m^2]; see `beams` for what it means."""
        return self.unit_fluence * self.beam.mean

    @property
    def peak_fluence(self) -> float:
        """Largest fluence of one pulse [J/m^2] (an upper bound where phases leave it open)."""
        if self.beam.peak is not None:
            return self.unit_fluence * self.beam.peak
        assert isinstance(self.beam, InterferenceBeam)
        return self.unit_fluence * float(1.0 + np.abs(self.beam.terms[0]).sum())

    @property
    def first_pulse(self) -> Laser:
        """The same laser with its first pulse alone."""
        pulse = self.pulse.model_copy(update={"count": 1})
        return self.model_copy(update={"pulse": pulse, "beam": self.beam.of_one_pulse()})

    @property
    def is_even(self) -> bool:
        """Whether the light is symmetric about x = 0 at all times."""
        if self.beam.is_uniform and not self.is_bounded:
            return True
        # nothing is known of the symmetry of a measured spot
        is_measured = self.spot is not None and self.spot.image is not None and self.is_bounded
        is_centered = self.path is None and self.position[0] == 0.0 and not is_measured
        return is_centered and self.beam.is_even

    @property
    def displacement(self) -> float | None:
        """Of the spot from one pulse to the next [m]; None where it rests or turns."""
        if self.spot is not None and self.spot.shift is not None:
            return self.spot.shift
        if self.beam.pulse_shift:
            return abs(self.beam.pulse_shift)
        speed = self.path.speed if isinstance(self.path, LinearPath) else None
        if self.spot is not None and self.spot.scan_speed is not None:
            speed = self.spot.scan_speed
        interval = self.pulse.interval
        return None if speed is None or interval is None else speed * interval

    def axis(self, time: ArrayLike) -> Array:
        """Position of the beam's axis at times [s], shape (2, ...) [m]."""
        time = np.asarray(time, float)
        start = np.reshape(np.array(self.position), (2,) + (1,) * time.ndim)
        if self.path is None:
            return np.broadcast_to(start, (2, *time.shape))
        return start + self.path.at(time)

    def resting_means(self, lower: Array, upper: Array) -> Array | None:
        """(n,) means of a beam that rests over cells, for `energy_density`; None where it moves."""
        if self.beam.pulse_shift or self.path is not None:
            return None
        return self._cell_means(lower, upper, self.axis(0.0))

    def energy_density(
        self,
        lower: ArrayLike,
        upper: ArrayLike,
        t0: float,
        t1: float,
        resting_means: Array | None = None,
    ) -> Array:
        """Energy that falls onto each surface cell from t0 to t1, per area [J/m^2], shape (n,).

        Args:
            lower, upper: corners of the cells, shape (dim - 1, n) [m]; dim - 1 = 0 is a column on
                the line x = y = 0, dim - 1 = 1 a strip of the line y = 0.
            resting_means: what the function of this name gives, where it is known.
        """
        low, high = np.asarray(lower, float), np.asarray(upper, float)
        if self.beam.pulse_shift:
            # each pulse of a shifted pattern by its own share
            shares = self.pulse.shares(t0, t1)
            total = np.zeros(low.shape[1])
            for number in np.flatnonzero(shares):
                axis = self.axis(t0) + np.array([number * self.beam.pulse_shift, 0.0])
                total += shares[number] * self.beam.cell_means(low, high, axis)
            return self.unit_fluence * total
        if self.path is None:
            # a beam that rests: exact means times the exact share of the pulse
            share = float(self.pulse.delivered(t0, t1))
            if share == 0.0:
                return np.zeros(low.shape[1])
            if resting_means is None:
                resting_means = self._cell_means(low, high, self.axis(t0))
            return self.unit_fluence * share * resting_means
        total = np.zeros(low.shape[1])
        scale = self.beam.scale
        if self.spot is not None and self.spot.extent == "whole":
            scale = min(scale, self.spot.envelope.scale)
        corners = self.path.breakpoints()
        times, shares = path_quadrature(self.pulse, self.axis, corners, scale, t0, t1)
        for time, share in zip(times, shares, strict=True):
            if share != 0.0:
                total += share * self._cell_means(low, high, self.axis(time))
        return self.unit_fluence * total

    def _cell_means(self, low: Array, high: Array, axis: Array) -> Array:
        """Mean over each cell of f, or of f g where the domain holds the whole spot."""
        means = self.beam.cell_means(low, high, axis)
        if self.spot is not None and self.spot.extent == "whole":
            means = means * self.spot.envelope.cell_means(low, high, axis)
        return means

    def reflectivity_table(
        self, material: Material, lower: float, upper: float
    ) -> tuple[Array, Array]:
        """Surface temperatures [K] and R for linear interpolation: given here, else the metal's.

        Raises:
            NoOptics: the material has no optics for this light.
            ValueError: neither the laser nor the material has a reflectivity.
        """
        metal = self._lit(material) if self.reflectivity is None else material
        return reflectivity_nodes(self.reflectivity, metal, lower, upper)

    def absorption_coefficient(self, material: Material) -> float:
        """alpha [1/m]: given here, else the metal's; inf for surface absorption.

        Raises:
            NoOptics: the material has no optics for this light.
            ValueError: Beer-Lambert absorption with no coefficient given anywhere.
        """
        if self.absorption.kind == "surface":
            return np.inf
        if self.absorption.absorption_coefficient is not None:
            return self.absorption.absorption_coefficient
        optics = self._lit(material).optics
        return self.absorption.coefficient(optics.absorption_coefficient if optics else None)

    def _lit(self, material: Material) -> Material:
        """The metal with its optics for this light.

        Without a wavelength of the laser that of interfering waves chooses, but only where the
        metal has no numbers for a light that is not named here.
        """
        wavelength, optics = self.wavelength, material.optics
        must_choose = optics is not None and optics.by_wavelength and optics.wavelength is None
        if wavelength is None and must_choose:
            wavelength = self.beam.pattern_wavelength
        return material.in_light(wavelength)
