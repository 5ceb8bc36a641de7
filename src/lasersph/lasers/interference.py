"""Interference of n plane waves on the surface, as exact means over cells.

    f(x) = |sum_j E_j exp(i k_j.x)|^2 / sum_j |E_j|^2
         = 1 + sum_{j<l} c_jl cos((k_j - k_l).x + phi_j - phi_l),   c_jl = 2 E_j.E_l / sum |E|^2

with equal unit amplitudes the denominator is n. f has the mean 1. Two equal waves at the full
angle theta give [Demuth2020, eqs. 1 and 2]

    f = 1 + cos(2 pi x / period),   period = wavelength / (2 sin(theta/2))

with the maximum 2 at x = 0. The mean of a cosine over a cell is its value at the cell's center
times sin(K dx/2)/(K dx/2) for each direction, so cell means are exact for any number of waves.

Demuth & Lasagni, Computation 8 (2020) 9.
"""

from __future__ import annotations

from functools import cached_property
from itertools import combinations
from typing import Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from lasersph.input import Angle, Model
from lasersph.lasers.beams import PositiveLength, plane_cells

Array = NDArray[np.float64]


class Wave(Model):
    """One plane wave that falls onto the surface.

    Its electric field points along the direction of azimuth `polarization` in the surface plane,
    made perpendicular to the wave. Left out for all waves, the fields are taken as parallel
    (E_j.E_l = |E_j| |E_l|), which is what s-polarized waves in one plane of incidence do.
    """

    polar: Annotated[Angle, Field(ge=0, lt=np.pi / 2)] = Field(
        description="angle between the wave and the surface normal"
    )
    azimuth: Angle = Field(default=0.0, description="direction along the surface, from x towards y")
    amplitude: float = Field(default=1.0, gt=0, description="of the electric field, relative")
    phase: Angle = 0.0
    polarization: Angle | None = Field(default=None, description="azimuth of the electric field")

    def direction(self) -> Array:
        """Unit vector of propagation, shape (3,), z upward."""
        sin = np.sin(self.polar)
        x, y = sin * np.cos(self.azimuth), sin * np.sin(self.azimuth)
        return np.array([x, y, -np.cos(self.polar)])

    def field(self) -> Array:
        """Electric field, shape (3,); along a fixed direction where no polarization is given."""
        if self.polarization is None:
            return np.array([0.0, 0.0, self.amplitude])
        along = np.array([np.cos(self.polarization), np.sin(self.polarization), 0.0])
        across = along - (along @ self.direction()) * self.direction()
        return self.amplitude * across / np.linalg.norm(across)


class InterferenceBeam(Model):
    """n-wave interference; two equal waves by wavelength and full angle, or by their period.

    Give one of: `period`; `wavelength` and `angle`; `wavelength` and `waves`.
    """

    kind: Literal["interference"] = "interference"
    period: PositiveLength | None = Field(default=None, description="of two waves, along x")
    wavelength: PositiveLength | None = None
    angle: Annotated[Angle, Field(gt=0, lt=np.pi)] | None = Field(
        default=None, description="full angle between two waves"
    )
    waves: tuple[Wave, ...] = Field(default=(), max_length=64)
    mean: ClassVar[float] = 1.0
    area: ClassVar[None] = None
    names_fluence: ClassVar[bool] = True

    @model_validator(mode="after")
    def _check_form(self) -> InterferenceBeam:
        given = {n for n in ("period", "wavelength", "angle") if getattr(self, n) is not None}
        given |= {"waves"} if self.waves else set()
        forms = ({"period"}, {"wavelength", "angle"}, {"wavelength", "waves"})
        if given not in forms:
            got = " and ".join(sorted(given)) if given else "nothing"
            raise ValueError(
                f"cannot tell the interference pattern from {got}; give period, or wavelength and "
                "angle, or wavelength and waves"
            )
        if len(self.waves) == 1:
            raise ValueError("one wave alone does not interfere; give two or more in waves")
        polarized = [wave.polarization is not None for wave in self.waves]
        if any(polarized) and not all(polarized):
            raise ValueError(
                "some waves have a polarization and some have none; give it to all or to none"
            )
        return self

    @cached_property
    def terms(self) -> tuple[Array, Array, Array]:
        """c (m,), wave vectors K (2, m) [1/m] and phases (m,) of the cosines in f."""
        if not self.waves:
            assert self.lateral_period is not None
            return np.ones(1), np.array([[2.0 * np.pi / self.lateral_period], [0.0]]), np.zeros(1)
        assert self.wavelength is not None
        k = 2.0 * np.pi / self.wavelength
        total = sum(wave.amplitude**2 for wave in self.waves)
        pairs = list(combinations(self.waves, 2))
        c = np.array([2.0 * float(a.field() @ b.field()) / total for a, b in pairs])
        K = np.array([k * (a.direction() - b.direction())[:2] for a, b in pairs]).T
        K[np.abs(K) < 1e-12 * k] = 0.0
        return c, K, np.array([a.phase - b.phase for a, b in pairs])

    @property
    def lateral_period(self) -> float | None:
        """Smallest period along x [m]; None where f has none or does not vary along x."""
        if self.period is not None:
            return self.period
        if self.angle is not None and self.wavelength is not None:
            return float(self.wavelength / (2.0 * np.sin(0.5 * self.angle)))
        return _common_period(self.terms[1][0])

    @property
    def lateral_period_y(self) -> float | None:
        """Smallest period along y [m]; None where f has none or does not vary along y."""
        return _common_period(self.terms[1][1]) if self.waves else None

    @property
    def peak(self) -> float | None:
        """Largest value of f; None where waves with phases leave it open (three or more)."""
        c, _, phase = self.terms
        if c.size == 1:
            return float(1.0 + np.abs(c[0]))
        aligned = bool(np.all(c * np.cos(phase) >= np.abs(c) * (1.0 - 1e-12)))
        return float(1.0 + np.abs(c).sum()) if aligned else None

    @property
    def is_even(self) -> bool:
        """Whether f(-x, 0) = f(x, 0), so that half a period with symmetry at its ends will do."""
        c, K, phase = self.terms
        return bool(np.all(np.abs(c * np.sin(phase) * (K[0] != 0.0)) < 1e-9))

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
