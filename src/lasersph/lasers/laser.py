"""`Laser`: beam, pulse, absorption and the energy that sets their scale.

    energy on a cell in [t0, t1], per area:   F int f(x - x_c(t)) g(t) dt

f is the beam's profile (exact cell means), g the pulse (exact share of one pulse's energy), x_c
the position of the beam's axis and F the fluence at f = 1, see `laser_keys`.

A pattern or a uniform beam may lie under a spot, the envelope g of `spot`: a domain that is a cell
of the spot receives F g(place) f, one that holds the whole spot F g f, whose mean over a cell is
taken as the product of both means (they differ by dx^2 g' f' / 12, dx the cell's width). Fluence
and intensity are then those at the spot's center.

The integral over a step of a moving beam is that of `path`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lasersph.lasers.absorption import BeerLambertAbsorption
from lasersph.lasers.interference import InterferenceBeam
from lasersph.lasers.laser_keys import LaserKeys
from lasersph.lasers.path import LinearPath, path_quadrature
from lasersph.lasers.reflectivity import (
    AbsorptivityTable,
    ReflectivityTable,
    reflectivity_nodes,
)
from lasersph.materials import Material

if TYPE_CHECKING:
    from lasersph.materials.hot_optics import HotOptics

Array = NDArray[np.float64]


class Laser(LaserKeys):
    """Light that falls onto the surface, along -z."""

    @property
    def unit_fluence(self) -> float:
        """F [J/m^2]: the fluence of one pulse where the profile f is 1; at the place of the cell
        where the domain is a cell of a spot."""
        if self.spot is None or self.spot.extent == "whole":
            return self._center_fluence
        return self._center_fluence * float(self.spot.envelope.at(*self.spot.place))

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
        return self._is_centered(0) and self.beam.is_even

    def is_mirrored(self, axis: int) -> bool:
        """Whether the light is the same at -x (axis 0) or -y (axis 1), at all places and times."""
        return self._is_centered(axis) and self.beam.is_mirrored(axis)

    def _is_centered(self, axis: int) -> bool:
        """Whether its axis lies in the plane x = 0 or y = 0, as far as that matters."""
        if self.beam.is_uniform and not self.is_bounded:
            return True
        # nothing is known of the symmetry of a measured spot
        is_measured = self.spot is not None and self.spot.image is not None and self.is_bounded
        leaves = self.path is not None and self.path.leaves(axis)
        return self.position[axis] == 0.0 and not leaves and not is_measured

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

    @property
    def has_own_reflectivity(self) -> bool:
        """Whether reflectivity or absorptivity are given here, instead of the metal's."""
        return self.reflectivity is not None or self.absorptivity is not None

    @property
    def absorbs_over_time(self) -> bool:
        """Whether the absorptivity is a table over time."""
        return isinstance(self.absorptivity, AbsorptivityTable) and not self.absorptivity.table

    def reflectivity_table(
        self,
        material: Material,
        lower: float,
        upper: float,
        interval: tuple[float, float] | None = None,
    ) -> tuple[Array, Array]:
        """Surface temperatures [K] and R for linear interpolation: given here, else the metal's.

        Args:
            interval: begin and end of a step [s], over which an absorptivity over time is averaged;
                by default the first pulse.

        Raises:
            NoOptics: the material has no optics for this light.
            ValueError: neither the laser nor the material has a reflectivity.
        """
        given: float | ReflectivityTable | None = self.reflectivity
        if isinstance(self.absorptivity, AbsorptivityTable):
            law = self.absorptivity.law
            given = 1.0 - self.absorptivity.mean(self.pulse, interval) if law is None else law
        elif self.absorptivity is not None:
            given = 1.0 - self.absorptivity
        metal = self._lit(material) if given is None else material
        return reflectivity_nodes(given, metal, lower, upper)

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

    def carried_by(self, material: Material, reach: float) -> Laser:
        """The same light, absorbed over its depth and a range of electrons together.

        alpha = 1 / (1/alpha_0 + range) [Hohlfeld2000]

        Args:
            reach: ballistic range of the electrons [m]; 0 changes nothing.
        """
        if reach == 0.0:
            return self
        depth = 1.0 / self.absorption_coefficient(material) + reach
        absorption = BeerLambertAbsorption(absorption_coefficient=1.0 / depth)
        return self.model_copy(update={"absorption": absorption})

    def hot_optics(self, material: Material, reach: float = 0.0) -> HotOptics | None:
        """R and depth of this light in a metal with hot electrons; None where the metal lacks what
        that needs, or the laser a reflectivity of its own.

        Args:
            reach: ballistic range of the electrons [m], beside the depth.
        """
        if self.has_own_reflectivity:
            return None
        # loaded by runs alone, so that cases are read fast
        from lasersph.materials.hot_optics import hot_optics

        wavelength = self._wavelength_in(material)
        found = hot_optics(material, wavelength)
        if found is None:
            return None
        # an absorption that is given here stays as it is
        if self.absorption.kind == "surface" or self.absorption.absorption_coefficient is not None:
            found = found.in_depth(1.0 / self.absorption_coefficient(material))
        return found.with_range(reach)

    def _lit(self, material: Material) -> Material:
        """The metal with its optics for this light.

        Without a wavelength of the laser that of interfering waves chooses, but only where the
        metal has no numbers for a light that is not named here.
        """
        return material.in_light(self._wavelength_in(material))

    def _wavelength_in(self, material: Material) -> float | None:
        """Wavelength for which the optics of a metal are taken [m]; None where they name none."""
        wavelength, optics = self.wavelength, material.optics
        must_choose = optics is not None and optics.by_wavelength and optics.wavelength is None
        if wavelength is None and must_choose:
            wavelength = self.beam.pattern_wavelength
        return wavelength
