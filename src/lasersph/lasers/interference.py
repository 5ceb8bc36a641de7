"""Interference of n plane waves on the surface, as exact means over cells.

    f(x) = |sum_j E_j exp(i k_j.x)|^2 / sum_j |E_j|^2
         = 1 + sum_{j<l} c_jl cos((k_j - k_l).x + phi_j - phi_l),   c_jl = 2 E_j.E_l / sum |E|^2

with equal unit amplitudes the denominator is n. f has the mean 1. Two equal waves at the full
angle theta give [Demuth2020, eqs. 1 and 2]

    f = 1 + cos(2 pi x / period),   period = wavelength / (2 sin(theta/2))

with the maximum 2 at x = 0. The mean of a cosine over a cell is its value at the cell's center
times sin(K dx/2)/(K dx/2) for each direction, so cell means are exact for any number of waves.

Two, three or four beams may be counted instead of written one by one. They stand at the same angle
theta/2 to the normal, with s = sin(theta/2), and have q = k s along the surface:

    beams   azimuths [deg]     period                                     maxima
    2       0, 180             pi/q = wavelength/(2 s)                    lines along y
    3       0, 120, 240        4 pi/(3 q) = 2 wavelength/(3 s)            dots, hexagonal
    4       45, 135, 225, 315  sqrt(2) pi/q = wavelength/(sqrt(2) s)      dots, square

The period is the distance of neighboring maxima of parallel fields. Three beams repeat with it
along x and with sqrt(3) times it along y, four with it along both.

Demuth & Lasagni, Computation 8 (2020) 9.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from itertools import combinations
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, model_validator

from lasersph.input import Angle, Length, format_quantity, refusal
from lasersph.lasers.beams import BeamProfile, PositiveLength, plane_cells
from lasersph.lasers.wave import Polarization, Wave

Array = NDArray[np.float64]

PERIOD_TIMES_Q = {2: np.pi, 3: 4.0 * np.pi / 3.0, 4: np.sqrt(2.0) * np.pi}
"""Period of counted beams times their wavenumber q along the surface, see the table above."""
SHARES_SUM, PERIOD_FITS = 1e-6, 1e-3
"""By how much shares may miss 1, rounding of numbers written by hand; and a period the one of
wavelength and angle, which data sheets round: 5 um for 5.001 um."""
EXTREMES_GRID, EXTREMES_ZOOMS = 96, 12
"""Points along a period among which the extremes of a pattern are searched, many for each of its
waves, and how often this is repeated around the best, four times finer each time."""


class InterferenceBeam(BeamProfile):
    """n-wave interference: waves written one by one, or a number of beams and their period.

    Give one of: `period`; `wavelength` and `angle` or `period`, or all three where they agree;
    `wavelength` and `waves`.
    """

    kind: Literal["interference"] = "interference"
    period: PositiveLength | None = Field(
        default=None, description="of two beams along x; of three and four from dot to dot"
    )
    wavelength: PositiveLength | None = Field(default=None, description="of the light")
    angle: Annotated[Angle, Field(gt=0, lt=np.pi)] | None = Field(
        default=None, description="full angle between two waves; twice that to the normal"
    )
    waves: tuple[Wave, ...] = Field(
        default=(), max_length=64, description="each wave by its angles, amplitude and phase"
    )
    beams: Literal[2, 3, 4] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="number of beams with the same angle to the normal; 2 if left out",
    )
    polarization: Polarization | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description='of all beams: "s", "p" or the azimuth of the electric field; parallel fields '
        "if left out",
    )
    energy_shares: tuple[Annotated[float, Field(gt=0, lt=1)], ...] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="of each beam in the energy of a pulse; equal if left out",
        examples=[[0.5, 0.5]],
    )
    phases: tuple[Angle, ...] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="of each beam; 0 if left out",
    )
    shift: Length = Field(
        default=0.0,
        exclude_if=lambda given: given == 0.0,
        description="of the pattern along x from each pulse to the next",
        examples=["0.5 um"],
    )
    area: ClassVar[None] = None
    is_pattern: ClassVar[bool] = True

    @model_validator(mode="after")
    def _check_form(self) -> InterferenceBeam:
        given = {n for n in ("period", "wavelength", "angle") if getattr(self, n) is not None}
        given |= {"waves"} if self.waves else set()
        # exactly these sets of keys fix wavenumber and directions
        forms = (
            {"period"},
            {"wavelength", "angle"},
            {"wavelength", "period"},
            {"wavelength", "angle", "period"},
            {"wavelength", "waves"},
        )
        if given not in forms:
            got = " and ".join(sorted(given)) if given else "nothing"
            raise ValueError(
                f"cannot tell the interference pattern from {got}; give period, or wavelength and "
                "angle, or wavelength and waves"
            )
        if len(self.waves) == 1:
            raise ValueError("one wave alone does not interfere; give two or more in waves")
        # parallel fields and fields of a known direction do not mix
        polarized = [wave.polarization is not None for wave in self.waves]
        if any(polarized) and not all(polarized):
            raise ValueError(
                "some waves have a polarization and some have none; give it to all or to none"
            )
        self._check_beams()
        return self

    def _check_beams(self) -> None:
        """Whether number, angle, period, shares and polarization of the beams fit together."""
        keys = ("beams", "polarization", "energy_shares", "phases")
        if self.waves:
            beside = [key for key in keys if getattr(self, key) is not None]
            if beside:
                raise refusal((beside[0], "is said of each wave in waves already; leave it out"))
            return
        for key in ("energy_shares", "phases"):
            values = getattr(self, key)
            if values is not None and len(values) != self.count:
                raise refusal(
                    (key, f"has {len(values)} values for {self.count} beams; give each one")
                )
        if self.energy_shares and abs(sum(self.energy_shares) - 1.0) > SHARES_SUM:
            total = sum(self.energy_shares)
            raise refusal(("energy_shares", f"sum to {total:.6g}; give shares that sum to 1"))
        if self.wavelength is None:
            if self.polarization not in (None, "s"):
                raise refusal(
                    (
                        "polarization",
                        "decides with the angle how far the beams interfere; write e.g. "
                        'wavelength = "1064 nm" beside it',
                    )
                )
            return
        # sin(theta/2) = q wavelength / (2 pi) has to be below 1
        sine = self._along_surface * self.wavelength / (2.0 * np.pi)
        if sine >= 1.0:
            least = PERIOD_TIMES_Q[self.count] * self.wavelength / (2.0 * np.pi)
            raise refusal(
                (
                    "period",
                    f"{format_quantity(self.period, 'm')} is no period that {self.count} beams of "
                    f"{format_quantity(self.wavelength, 'm')} can make; give one above "
                    f"{format_quantity(least, 'm')}",
                )
            )
        if self.angle is not None and self.period is not None:
            fitting = PERIOD_TIMES_Q[self.count] / self._along_surface
            if abs(self.period / fitting - 1.0) > PERIOD_FITS:
                raise refusal(
                    (
                        "period",
                        f"{format_quantity(self.period, 'm')} does not fit the wavelength and the "
                        f"angle, which give {format_quantity(fitting, 'm', 6)}; leave it out",
                    )
                )

    @property
    def count(self) -> int:
        """Number of beams."""
        return len(self.waves) or self.beams or 2

    @property
    def pattern_wavelength(self) -> float | None:
        """Wavelength of the waves [m]; None where only their period is given."""
        return self.wavelength

    @property
    def pulse_shift(self) -> float:
        """Displacement of the pattern along x from each pulse to the next [m]."""
        return self.shift

    def of_one_pulse(self) -> InterferenceBeam:
        """The pattern of the first pulse, which is not displaced."""
        return self.model_copy(update={"shift": 0.0})

    @property
    def description(self) -> str:
        """Number of beams, period and contrast, in words."""
        sides = [
            f"{format_quantity(side, 'm')} along {axis}"
            for axis, side in (("x", self.lateral_period), ("y", self.lateral_period_y))
            if side is not None
        ]
        repeats = f"period {', '.join(sides)}" if sides else "no common period"
        contrast = "" if self.contrast is None else f", contrast {self.contrast:.4g}"
        return f"{self.count} beams, {repeats}{contrast}"

    @property
    def _along_surface(self) -> float:
        """q [1/m]: wavenumber along the surface of beams that are counted."""
        if self.angle is not None and self.wavelength is not None:
            return float(2.0 * np.pi / self.wavelength * np.sin(0.5 * self.angle))
        assert self.period is not None
        return PERIOD_TIMES_Q[self.count] / self.period

    @cached_property
    def _arrangement(self) -> tuple[float, tuple[Wave, ...]]:
        """Wavenumber [1/m] and waves."""
        if self.waves:
            assert self.wavelength is not None
            return 2.0 * np.pi / self.wavelength, self.waves
        # Without a wavelength fields are parallel or "s", the same under any angle.
        q, count = self._along_surface, self.count
        k = 2.0 * np.pi / self.wavelength if self.wavelength else 2.0 * q
        first = 0.25 * np.pi if count == 4 else 0.0
        waves = tuple(
            Wave(
                polar=float(np.arcsin(q / k)),
                azimuth=first + 2.0 * np.pi * number / count,
                amplitude=np.sqrt(self.energy_shares[number]) if self.energy_shares else 1.0,
                phase=self.phases[number] if self.phases else 0.0,
                polarization=self.polarization,
            )
            for number in range(count)
        )
        return k, waves

    @property
    def _is_plain(self) -> bool:
        """Whether two equal waves make lines along y."""
        special = (self.polarization, self.energy_shares, self.phases)
        return not self.waves and self.count == 2 and special == (None, None, None)

    @cached_property
    def terms(self) -> tuple[Array, Array, Array]:
        """c (m,), wave vectors K (2, m) [1/m] and phases (m,) of the cosines in f."""
        if self._is_plain:
            assert self.lateral_period is not None
            return np.ones(1), np.array([[2.0 * np.pi / self.lateral_period], [0.0]]), np.zeros(1)
        k, waves = self._arrangement
        total = sum(wave.amplitude**2 for wave in waves)
        # f is 1 and one cosine for each pair of waves
        pairs = list(combinations(waves, 2))
        c = np.array([2.0 * float(a.field() @ b.field()) / total for a, b in pairs])
        K = np.array([k * (a.direction() - b.direction())[:2] for a, b in pairs]).T
        c[np.abs(c) < 1e-12] = K[np.abs(K) < 1e-12 * k] = 0.0
        return c, K, np.array([a.phase - b.phase for a, b in pairs])

    @property
    def lateral_period(self) -> float | None:
        """Smallest period along x [m]; None where f has none or does not vary along x."""
        if not self.waves:
            return self.period or float(PERIOD_TIMES_Q[self.count] / self._along_surface)
        return _common_period(self.terms[1][0])

    @property
    def lateral_period_y(self) -> float | None:
        """Smallest period along y [m]; None where f has none or does not vary along y."""
        if not self.waves and self.count == 3:
            assert self.lateral_period is not None
            return float(np.sqrt(3.0) * self.lateral_period)
        return _common_period(self.terms[1][1]) if self.count > 2 or self.waves else None

    @property
    def varies_along_y(self) -> bool:
        """Whether f(x, y) differs from f(x, 0) anywhere: a wave across x that has not canceled."""
        c, K, _ = self.terms
        return bool(np.any((c != 0.0) & (K[1] != 0.0)))

    @cached_property
    def extremes(self) -> tuple[float, float] | None:
        """Smallest and largest value of f; None where three or more waves do not repeat."""
        c = self.terms[0]
        if c.size == 1:
            return float(1.0 - np.abs(c[0])), float(1.0 + np.abs(c[0]))
        # three waves or more: search one unit cell, if there is one
        sides = np.array([self.lateral_period or 0.0, self.lateral_period_y or 0.0])
        varies = np.any(self.terms[1] != 0.0, axis=1)
        if np.any(varies & (sides == 0.0)):
            return None
        return self._extreme(sides, np.min), self._extreme(sides, np.max)

    def _extreme(self, sides: Array, choose: Callable[[Array], Any]) -> float:
        """Smallest or largest f in the unit cell of `sides` [m]."""
        center, best = 0.5 * sides, 1.0
        for _ in range(EXTREMES_ZOOMS):
            x, y = (
                middle + side * np.linspace(-0.5, 0.5, EXTREMES_GRID + 1)
                for middle, side in zip(center, sides, strict=True)
            )
            places = np.stack([a.ravel() for a in np.meshgrid(x, y)])
            values = self.at(*places)
            best = float(choose(values))
            center, sides = places[:, int(np.flatnonzero(values == best)[0])], 0.25 * sides
        return best

    @property
    def contrast(self) -> float | None:
        """(largest - smallest)/(largest + smallest) value of f; None where it is open."""
        if self.extremes is None:
            return None
        low, high = self.extremes
        return (high - low) / (high + low)

    @property
    def peak(self) -> float | None:
        """Largest value of f; None where three or more waves do not repeat and have phases."""
        c, _, phase = self.terms
        if c.size == 1:
            return float(1.0 + np.abs(c[0]))
        if np.all(c * np.cos(phase) >= np.abs(c) * (1.0 - 1e-12)):
            return float(1.0 + np.abs(c).sum())
        return None if self.extremes is None else self.extremes[1]

    def at(self, x: ArrayLike, y: ArrayLike) -> Array:
        """f at places relative to the axis [m], any shape."""
        x, y = np.asarray(x, float), np.asarray(y, float)
        value = np.ones(np.broadcast_shapes(x.shape, y.shape))
        for c, K, phase in zip(self.terms[0], self.terms[1].T, self.terms[2], strict=True):
            value = value + c * np.cos(K[0] * x + K[1] * y + phase)
        return value

    @property
    def is_even(self) -> bool:
        """Whether f(-x, 0) = f(x, 0), so that half a period with symmetry at its ends will do; with
        a shift, of every pulse."""
        c, K, phase = self.terms
        odd = np.abs(np.sin(phase) * (K[0] != 0.0)) + np.abs(np.sin(K[0] * self.shift))
        return bool(np.all(np.abs(c) * odd < 1e-9))

    def is_mirrored(self, axis: int) -> bool:
        """Whether f is the same at -x (axis 0) or -y (axis 1), at all places, of the first pulse.

        Waves that the mirror takes to each other have the same amplitudes.
        """
        c, K, phase = self.terms
        # c cos(K r + phase) is one wave exp(i K r) and one of -K
        both, amplitude = np.hstack([K, -K]), c * np.exp(1j * phase)
        amplitude = np.concatenate([amplitude, amplitude.conj()])
        mirror = np.where(np.arange(2) == axis, -1.0, 1.0)[:, None]
        near = 1e-6 * np.abs(both).max()
        # amplitude at each place in the plane of waves, and at its mirror image
        for place in both.T:
            own, other = (
                amplitude[np.all(np.abs(both - at[:, None]) < near, axis=0)].sum()
                for at in (place, place * mirror[:, 0])
            )
            if abs(own - other) > 1e-9:
                return False
        return True

    @property
    def scale(self) -> float:
        """Length over which the profile changes [m]."""
        _, K, _ = self.terms
        return float(1.0 / max(np.abs(K).max(), 1e-300))

    def cell_means(self, lower: Array, upper: Array, axis: Array) -> Array:
        """Mean of f over each cell, shape (n,), in closed form."""
        low, high = plane_cells(lower, upper, axis)
        center, half = 0.5 * (high + low), 0.5 * (high - low)
        mean = np.ones(lower.shape[1])
        for c, K, phase in zip(self.terms[0], self.terms[1].T, self.terms[2], strict=True):
            smear = np.prod(np.sinc(K[:, None] * half / np.pi), axis=0)
            mean += c * smear * np.cos(K @ center + phase)
        return mean


def _common_period(wavenumbers: Array) -> float | None:
    """Period of which all the nonzero wavenumbers are whole multiples, or None."""
    k = np.abs(wavenumbers[wavenumbers != 0.0])
    if k.size == 0:
        return None
    for parts in range(1, 13):
        multiples = k * parts / k.min()
        if np.all(np.abs(multiples - np.round(multiples)) < 1e-6 * multiples):
            return float(2.0 * np.pi * parts / k.min())
    return None
