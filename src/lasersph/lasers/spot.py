"""Spots: the envelope of a pulse's energy on the surface, under which a pattern or even light lies.

    F(x, y) = E g(x, y) / A,   A = integral of g over the plane

E is the energy of one pulse and g the envelope, 1 at its highest place. F is the local fluence of a
spot: the mean over one period of the pattern at (x, y), or the fluence itself without a pattern.
The pattern f of mean 1 (see `interference`) makes F f of it.

    definition   what `diameter` is                           g
    1/e^2        where g has fallen to 1/e^2, 2 w             exp(-2 r^2/w^2)
    fwhm         where g has fallen to 1/2, w sqrt(2 ln 2)    exp(-2 r^2/w^2)
    top-hat      where the light ends                         1 inside, 0 outside

or the image of a measured beam, see `beam_image`.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, ValidationInfo, model_validator

from lasersph.input import Length, Model, Velocity, refusal
from lasersph.lasers.beam_image import MeasuredEnvelope, digest_of, measured_envelope
from lasersph.lasers.beams import GaussianBeam, PositiveLength, TopHatBeam

Array = NDArray[np.float64]


class Envelope(Protocol):
    """How a pulse's energy is distributed over the surface; at most 1."""

    @property
    def area(self) -> float:
        """Integral of g over the plane [m^2]."""
        ...

    @property
    def scale(self) -> float:
        """Length over which g changes [m]."""
        ...

    def at(self, x: ArrayLike, y: ArrayLike) -> Array:
        """g at places relative to the axis [m], any shape."""
        ...

    def cell_means(self, lower: Array, upper: Array, axis: Array) -> Array:
        """Mean of g over each cell, shape (n,); see `beams`."""
        ...

    def enclosed(self, r: Array) -> Array:
        """Integral of g over the circle of radius r [m], any shape [m^2]."""
        ...


class Spot(Model):
    """The spot under which an interference pattern or a uniform beam lies.

    Give `diameter` and `definition`, or `image` and `pixel_size`.
    """

    diameter: PositiveLength | None = Field(
        default=None, description="of the spot, where `definition` says", examples=["50 um"]
    )
    definition: Literal["1/e^2", "fwhm", "top-hat"] | None = Field(
        default=None,
        description="what diameter is: of a Gaussian spot where 1/e^2 or half of the peak is left, "
        "or of a circle of even fluence",
    )
    image: str | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="of a measured beam: gray PNG or TIFF, or CSV; relative to the case file",
        examples=["beam.png"],
    )
    pixel_size: PositiveLength | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="of image, on the surface",
        examples=["1.2 um"],
    )
    image_digest: str = Field(
        default="",
        exclude_if=lambda given: not given,
        description="of the content of image; filled in",
    )
    extent: Literal["cell", "whole"] = Field(
        default="cell",
        description="what the domain holds: a unit cell of the pattern, small against the spot, "
        "whose fluence is that at `place`; or the whole spot with its decay toward the edge",
    )
    place: tuple[Length, Length] = Field(
        default=(0.0, 0.0), description="x and y in the spot at which a cell lies; its center if 0"
    )

    shift: PositiveLength | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="of the spot from pulse to pulse, of which `check` says the overlap",
        examples=["10 um"],
    )
    scan_speed: Annotated[Velocity, Field(gt=0)] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="of the spot instead of shift, by the repetition rate of the pulses",
        examples=["0.1 m/s"],
    )

    @model_validator(mode="after")
    def _check_form(self) -> Spot:
        if self.image is not None:
            self._check_image()
        elif self.pixel_size is not None:
            raise refusal(("pixel_size", "says nothing without an image; leave it out"))
        elif self.diameter is None:
            raise ValueError('a spot needs its diameter; write e.g. diameter = "50 um"')
        elif self.definition is None:
            raise ValueError(
                "the diameter of a spot may be that where 1/e^2 or half of the peak is left, or "
                'of a top hat; write definition = "1/e^2", "fwhm" or "top-hat"'
            )
        # a whole spot has no place for a cell
        if self.extent == "whole" and self.place != (0.0, 0.0):
            raise ValueError("place says where a cell lies in the spot; leave it out for a whole")
        if self.shift is not None and self.scan_speed is not None:
            raise refusal(("scan_speed", "says the same as shift; leave one of them out"))
        return self

    @model_validator(mode="before")
    @classmethod
    def _name_content(cls, data: Any, info: ValidationInfo) -> Any:
        """Complete the path of the image, and name its content: another one is another case."""
        if not isinstance(data, dict) or not isinstance(data.get("image"), str):
            return data
        folder = (info.context or {}).get("folder", Path())
        # relative to the case file
        file = str((Path(folder) / Path(data["image"]).expanduser()).absolute())
        try:
            return {"image_digest": digest_of(file), **data, "image": file}
        except OSError:
            return data | {"image": file}  # reported with the reason where it is read

    def _check_image(self) -> None:
        """Whether the image can be read and shows a beam."""
        for key in ("diameter", "definition"):
            if getattr(self, key) is not None:
                raise refusal((key, "is that of the image; leave it out"))
        if self.pixel_size is None:
            raise refusal(("pixel_size", 'missing; write e.g. pixel_size = "1.2 um"'))
        assert self.image is not None
        try:
            # a case stands for one content of the image: another one would be another case
            if digest_of(self.image) != self.image_digest:
                raise ValueError("has changed since its digest was taken; leave image_digest out")
            _ = self.envelope
        except OSError as error:
            reason = error.strerror or str(error)
            raise refusal(("image", f"{self.image} cannot be read: {reason}")) from None
        except ValueError as error:
            raise refusal(("image", f"{self.image} {error}")) from None

    @property
    def envelope(self) -> GaussianBeam | TopHatBeam | MeasuredEnvelope:
        """g."""
        if self.image is not None and self.pixel_size is not None:
            return measured_envelope(self.image, self.image_digest, self.pixel_size)
        assert self.diameter is not None
        # a Gaussian of the width where half or 1/e^2 of its peak is left
        if self.definition == "top-hat":
            return TopHatBeam(radius=0.5 * self.diameter)
        if self.definition == "fwhm":
            return GaussianBeam(diameter_fwhm=self.diameter)
        return GaussianBeam(diameter_1e2=self.diameter)


@dataclass(frozen=True)
class SpotFluence:
    """Local fluence of one pulse over a spot, mean over a period of the pattern.

    Attributes:
        envelope: g. energy: of one pulse [J]. diameter: where 1/e^2 of the peak is left, of a
            top hat, or d_sigma of a measured beam [m]. shape: in words. period: of the pattern
            along x [m], None without one.
    """

    envelope: Envelope
    energy: float
    diameter: float
    shape: str
    period: float | None = None

    def at(self, x: ArrayLike, y: ArrayLike = 0.0) -> Array:
        """Local fluence at places relative to the center of the spot [m], any shape [J/m^2]."""
        return self.energy / self.envelope.area * self.envelope.at(x, y)

    @property
    def center(self) -> float:
        """Local fluence at the center [J/m^2]."""
        return float(self.at(0.0))

    @property
    def mean(self) -> float:
        """Energy over the circle of the diameter [J/m^2], the fluence over the spot."""
        return self.energy / (0.25 * np.pi * self.diameter**2)

    def overlap(self, displacement: float) -> float:
        """Share of the diameter that two pulses have in common; 0 where they do not touch."""
        return max(0.0, 1.0 - displacement / self.diameter)
