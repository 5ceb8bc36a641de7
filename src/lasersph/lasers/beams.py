"""Beams: how the fluence is distributed over the surface, as exact means over cells.

A profile f(x, y) is dimensionless; `Laser` multiplies it with a fluence. Every beam says which
value of f is its peak and its mean, and the area (integral of f) where it is finite:

    uniform       f = 1                  peak 1, mean 1
    top-hat       f = 1 for r < radius   peak 1, mean 1 (over the spot), area pi r^2
    gaussian      f = exp(-2 r^2/w^2)    peak 1, mean 1/2 (energy over pi w^2), area pi w^2/2
    interference  see `interference`     mean 1

Cells come as lower and upper corners, shape (surface dimensions, n), relative to the beam's axis.
With one surface dimension the surface is the line y = 0 of the plane, with none the point (0, 0).
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, model_validator

from lasersph.input import Length, Model, format_quantity

Array = NDArray[np.float64]
PositiveLength = Annotated[Length, Field(gt=0)]


def plane_cells(lower: Array, upper: Array, axis: Array) -> tuple[Array, Array]:
    """Corners relative to the beam's axis in both plane directions, shape (2, n).

    lower, upper: (0..2, n) [m]; axis: (2,) position of the beam's axis [m]. Directions that the
    surface does not have become points at 0.
    """
    low, high = (np.zeros((2, corner.shape[1])) for corner in (lower, upper))
    # directions that the surface lacks stay points at 0
    low[: lower.shape[0]], high[: upper.shape[0]] = lower, upper
    return low - axis[:, None], high - axis[:, None]


class BeamProfile(Model):
    """Members of every beam, as they are of one that rests and makes no pattern.

    A beam adds `kind`, `peak`, `area`, `scale` (length over which f changes [m]), `cell_means`,
    `enclosed` where it is round, and `at`, `radius` and `shape` where it is bounded.

    Attributes:
        mean: of f. names_fluence: whether "fluence" alone says which one. is_uniform: whether f is
            the same everywhere. is_pattern: whether waves interfere.
    """

    mean: ClassVar[float] = 1.0
    names_fluence: ClassVar[bool] = True
    is_uniform: ClassVar[bool] = False
    is_pattern: ClassVar[bool] = False

    @property
    def lateral_period(self) -> float | None:
        """Smallest period along x [m]; None where f does not repeat, or is the same."""
        return None

    @property
    def lateral_period_y(self) -> float | None:
        """Smallest period along y [m]; None where f does not repeat, or is the same."""
        return None

    @property
    def lateral_length(self) -> float | None:
        """Length over which f repeats along x, or falls off [m]; None where it does neither."""
        return self.lateral_period

    @property
    def pattern_wavelength(self) -> float | None:
        """Wavelength of the waves that interfere [m]; None where none do, or none is given."""
        return None

    @property
    def pulse_shift(self) -> float:
        """Displacement of the pattern along x from each pulse to the next [m]."""
        return 0.0

    @property
    def is_even(self) -> bool:
        """Whether f(-x, 0) = f(x, 0)."""
        return True

    def is_mirrored(self, axis: int) -> bool:
        """Whether f is the same at -x (axis 0) or -y (axis 1), at all places."""
        return True

    def of_one_pulse(self) -> Self:
        """The beam of a single pulse."""
        return self


class UniformBeam(BeamProfile):
    """The same fluence everywhere."""

    kind: Literal["uniform"] = "uniform"
    peak: ClassVar[float] = 1.0
    area: ClassVar[None] = None
    scale: ClassVar[float] = np.inf
    is_uniform: ClassVar[bool] = True

    def cell_means(self, lower: Array, upper: Array, axis: Array) -> Array:
        """Mean of f over each cell, shape (n,): 1."""
        return np.ones(lower.shape[1])

    def enclosed(self, r: Array) -> Array:
        """Integral of f over the circle of radius r [m], any shape [m^2]."""
        return np.pi * np.square(r)


class TopHatBeam(BeamProfile):
    """Constant fluence inside a circle."""

    kind: Literal["top-hat"] = "top-hat"
    radius: PositiveLength = Field(
        description="of the spot, half of its diameter", examples=["40 um"]
    )
    peak: ClassVar[float] = 1.0

    @property
    def shape(self) -> str:
        """Shape and diameter, in words."""
        return f"top hat of {format_quantity(2.0 * self.radius, 'm')}"

    @property
    def area(self) -> float:
        """Area of the spot [m^2]."""
        return float(np.pi * self.radius**2)

    @property
    def scale(self) -> float:
        """Length over which the profile changes [m]."""
        return self.radius

    def at(self, x: ArrayLike, y: ArrayLike) -> Array:
        """f at places relative to the axis [m], any shape."""
        return np.asarray(np.hypot(x, y) <= self.radius, float)

    def enclosed(self, r: Array) -> Array:
        """Integral of f over the circle of radius r [m], any shape [m^2]."""
        return np.pi * np.square(np.minimum(r, self.radius))

    def cell_means(self, lower: Array, upper: Array, axis: Array) -> Array:
        """Share of each cell inside the circle, shape (n,), exact in every dimension."""
        low, high = plane_cells(lower, upper, axis)
        low, high = low / self.radius, high / self.radius
        # a point, a chord of the circle, or an area
        if lower.shape[0] == 0:
            return (low[0] ** 2 + low[1] ** 2 <= 1.0).astype(float)
        if lower.shape[0] == 1:
            chord = np.sqrt(np.maximum(0.0, 1.0 - low[1] ** 2))
            inside = np.clip(high[0], -chord, chord) - np.clip(low[0], -chord, chord)
            return inside / (high[0] - low[0])
        # four rectangles from the center, with alternating signs
        inside = (
            _disc_area(high[0], high[1])
            - _disc_area(low[0], high[1])
            - _disc_area(high[0], low[1])
            + _disc_area(low[0], low[1])
        )
        return inside / np.prod(high - low, axis=0)


def _disc_area(x: Array, y: Array) -> Array:
    """Area shared by the unit disc and the rectangle from (0, 0) to (x, y), signed like x y."""
    sign = np.sign(x) * np.sign(y)
    x, y = np.minimum(np.abs(x), 1.0), np.minimum(np.abs(y), 1.0)
    flat = np.minimum(x, np.sqrt(1.0 - y**2))  # up to here the rectangle's top is inside
    return sign * (flat * y + _arc_integral(x) - _arc_integral(flat))


def _arc_integral(x: Array) -> Array:
    """Integral of sqrt(1 - s^2) from 0 to x."""
    return 0.5 * (x * np.sqrt(1.0 - x**2) + np.arcsin(x))


class GaussianBeam(BeamProfile):
    """f = exp(-2 r^2/w^2), w the radius where the fluence has fallen to 1/e^2 of its peak.

    Give exactly one of the three widths; diameter_fwhm = w sqrt(2 ln 2).
    """

    kind: Literal["gaussian"] = "gaussian"
    radius_1e2: PositiveLength | None = Field(default=None, description="w, where 1/e^2 is left")
    diameter_1e2: PositiveLength | None = Field(default=None, description="2 w")
    diameter_fwhm: PositiveLength | None = Field(
        default=None, description="full width at half maximum"
    )
    peak: ClassVar[float] = 1.0
    mean: ClassVar[float] = 0.5
    names_fluence: ClassVar[bool] = False

    @model_validator(mode="after")
    def _check_width(self) -> GaussianBeam:
        names = ("radius_1e2", "diameter_1e2", "diameter_fwhm")
        given = [name for name in names if getattr(self, name) is not None]
        if len(given) != 1:
            got = " and ".join(given) if given else "none"
            raise ValueError(
                f"a gaussian beam needs one width, got {got}; give one of " + ", ".join(names)
            )
        return self

    @property
    def radius(self) -> float:
        """w [m], the radius at 1/e^2."""
        # w of whichever width is given; at half maximum exp(-2 r^2 / w^2) = 1/2
        if self.radius_1e2 is not None:
            return self.radius_1e2
        if self.diameter_1e2 is not None:
            return 0.5 * self.diameter_1e2
        assert self.diameter_fwhm is not None
        return float(self.diameter_fwhm / np.sqrt(2.0 * np.log(2.0)))

    @property
    def shape(self) -> str:
        """Shape and diameters, in words."""
        diameter = format_quantity(2.0 * self.radius, "m")
        half = format_quantity(np.sqrt(2.0 * np.log(2.0)) * self.radius, "m")
        return f"Gaussian, {diameter} where 1/e^2 of its peak is left, {half} where half is"

    @property
    def lateral_length(self) -> float:
        """Diameter where 1/e^2 of the peak is left [m]."""
        return 2.0 * self.radius

    @property
    def area(self) -> float:
        """Integral of f over the plane, pi w^2/2 [m^2]."""
        return float(0.5 * np.pi * self.radius**2)

    @property
    def scale(self) -> float:
        """Length over which the profile changes [m]."""
        return 0.5 * self.radius

    def at(self, x: ArrayLike, y: ArrayLike) -> Array:
        """f at places relative to the axis [m], any shape."""
        square = np.square(np.asarray(x, float)) + np.square(np.asarray(y, float))
        return np.exp(-2.0 * square / self.radius**2)

    def enclosed(self, r: Array) -> Array:
        """Integral of f over the circle of radius r [m], any shape [m^2]."""
        return -self.area * np.expm1(-2.0 * np.square(r) / self.radius**2)

    def cell_means(self, lower: Array, upper: Array, axis: Array) -> Array:
        """Mean of f over each cell, shape (n,): a product of differences of erf."""
        from scipy.special import erf  # takes as long to load as all else that reads a case

        low, high = plane_cells(lower, upper, axis)
        low, high = low * np.sqrt(2.0) / self.radius, high * np.sqrt(2.0) / self.radius
        mean = np.ones(lower.shape[1])
        for k in range(2):
            # mean over the cell's extent, or the value where the direction is missing
            if k < lower.shape[0]:
                integral = 0.5 * np.sqrt(np.pi) * (erf(high[k]) - erf(low[k]))
                mean = mean * integral / (high[k] - low[k])
            else:
                mean = mean * np.exp(-(low[k] ** 2))
        return mean
