"""Beams of shaped spots: super-Gaussian, and a ring of even fluence.

    super-gaussian  f = exp(-2 (r/w)^(2 n))          peak 1, n = 1 is the Gaussian beam
    ring            f = 1 for inner < r < radius     peak 1, mean 1 (over the ring)

The light of a super-Gaussian within a circle is, with the regularized incomplete gamma function P,

    2 pi int_0^r f r dr = A P(1/n, 2 (r/w)^(2 n)),   A = pi w^2 2^(-1/n) Gamma(1 + 1/n)
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, model_validator

from lasersph.input import format_quantity, refusal
from lasersph.lasers.beams import BeamProfile, PositiveLength, TopHatBeam, plane_cells

Array = NDArray[np.float64]
QUADRATURE = 8
"""Points along each side of a cell for its mean. Accuracy: exact for polynomials of degree 15; the
edge of order 20 over a cell as wide as the flank errs by 1e-6."""


class SuperGaussianBeam(BeamProfile):
    """f = exp(-2 (r/w)^(2 n)): a top hat with soft edges, w where 1/e^2 of the peak is left."""

    kind: Literal["super-gaussian"] = "super-gaussian"
    radius_1e2: PositiveLength = Field(
        description="w, where 1/e^2 is left, half of the diameter", examples=["40 um"]
    )
    order: Annotated[float, Field(ge=1, le=20)] = Field(
        default=4.0, description="n of exp(-2 (r/w)^(2 n)): 1 is Gaussian, 20 nearly a top hat"
    )
    peak: ClassVar[float] = 1.0
    names_fluence: ClassVar[bool] = False

    @property
    def radius(self) -> float:
        """w [m], the radius at 1/e^2."""
        return self.radius_1e2

    @property
    def shape(self) -> str:
        """Shape and diameter, in words."""
        diameter = format_quantity(2.0 * self.radius, "m")
        return f"super-Gaussian of order {self.order:g}, {diameter} where 1/e^2 of its peak is left"

    @property
    def lateral_length(self) -> float:
        """Diameter where 1/e^2 of the peak is left [m]."""
        return 2.0 * self.radius

    @property
    def area(self) -> float:
        """Integral of f over the plane [m^2]."""
        from math import gamma

        n = self.order
        return float(np.pi * self.radius**2 * 2.0 ** (-1.0 / n) * gamma(1.0 + 1.0 / n))

    @property
    def mean(self) -> float:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Energy over the circle of radius w, over that at the peak."""
        return self.area / (np.pi * self.radius**2)

    @property
    def scale(self) -> float:
        """Length over which f changes [m]: the flank is steeper by the order."""
        return 0.5 * self.radius / self.order

    def at(self, x: ArrayLike, y: ArrayLike) -> Array:
        """f at places relative to the axis [m], any shape."""
        square = (np.square(np.asarray(x, float)) + np.square(np.asarray(y, float))) / (
            self.radius**2
        )
        return np.exp(-2.0 * square**self.order)

    def enclosed(self, r: Array) -> Array:
        """Integral of f over the circle of radius r [m], any shape [m^2]."""
        from scipy.special import gammainc  # takes long to load

        return self.area * gammainc(1.0 / self.order, 2.0 * (r / self.radius) ** (2.0 * self.order))

    def cell_means(self, lower: Array, upper: Array, axis: Array) -> Array:
        """Mean of f over each cell, shape (n,), by Gauss and Legendre."""
        low, high = plane_cells(lower, upper, axis)
        points, weights = np.polynomial.legendre.leggauss(QUADRATURE)
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        # points along each side of the cell; a direction that is missing has one
        along = [
            (middle[k] + np.multiply.outer(points, half[k]), 0.5 * weights)
            if k < lower.shape[0]
            else (middle[k][None], np.ones(1))
            for k in range(2)
        ]
        (x, at_x), (y, at_y) = along
        return np.einsum("i,j,ijn->n", at_x, at_y, self.at(x[:, None], y[None]))


class RingBeam(BeamProfile):
    """Constant fluence between two circles, as of a fiber with a ring core."""

    kind: Literal["ring"] = "ring"
    radius: PositiveLength = Field(description="where the light ends", examples=["40 um"])
    inner_radius: PositiveLength = Field(description="where it begins", examples=["20 um"])
    peak: ClassVar[float] = 1.0

    @model_validator(mode="after")
    def _check_radii(self) -> RingBeam:
        if self.inner_radius >= self.radius:
            outer = format_quantity(self.radius, "m")
            raise refusal(("inner_radius", f"lies outside of radius, {outer}; give a smaller one"))
        return self

    @property
    def _circles(self) -> tuple[TopHatBeam, TopHatBeam]:
        """The disc of the outer circle, and the dark one in it."""
        return TopHatBeam(radius=self.radius), TopHatBeam(radius=self.inner_radius)

    @property
    def shape(self) -> str:
        """Shape and diameters, in words."""
        inner, outer = (format_quantity(2.0 * r, "m") for r in (self.inner_radius, self.radius))
        return f"ring from {inner} to {outer}"

    @property
    def area(self) -> float:
        """Area of the ring [m^2]."""
        return float(np.pi * (self.radius**2 - self.inner_radius**2))

    @property
    def scale(self) -> float:
        """Length over which the profile changes [m]."""
        return min(self.inner_radius, self.radius - self.inner_radius)

    def at(self, x: ArrayLike, y: ArrayLike) -> Array:
        """f at places relative to the axis [m], any shape."""
        disc, dark = self._circles
        return disc.at(x, y) - dark.at(x, y)

    def enclosed(self, r: Array) -> Array:
        """Integral of f over the circle of radius r [m], any shape [m^2]."""
        disc, dark = self._circles
        return disc.enclosed(r) - dark.enclosed(r)

    def cell_means(self, lower: Array, upper: Array, axis: Array) -> Array:
        """Share of each cell inside the ring, shape (n,), exact in every dimension."""
        disc, dark = self._circles
        return disc.cell_means(lower, upper, axis) - dark.cell_means(lower, upper, axis)
