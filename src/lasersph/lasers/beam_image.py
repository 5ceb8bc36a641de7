"""A measured beam: the image of a camera, or a table of numbers, as the envelope of a spot.

The background is subtracted (see `beam_widths`), what does not stand out of the noise counts as
dark, and the rest is the envelope g, with the highest pixel 1. Between the centers of pixels g is
bilinear, so that means over cells of any size are exact: with the sums S of pixels up to each
position the integral of a bilinear function is

    D(x) = S_i (1 - t)^2/2 + S_(i+1) (1/2 + t - t^2) + S_(i+2) t^2/2,   t = (x - x_i)/pixel

along each direction, and its integral over the plane is the sum of all pixels: the envelope holds
the energy of a pulse to rounding. The centroid lies on the axis; x runs along the columns, y
against the rows.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lasersph.input import format_quantity
from lasersph.lasers.beam_widths import APERTURE, NO_BEAM, BeamWidths, beam_widths, stands_out
from lasersph.lasers.beams import plane_cells

Array = NDArray[np.float64]
LEAST_SIDE = 8
"""Pixels along each side without which an image shows no beam."""
LARGEST_SIDE = 8192
"""Pixels along a side up to which an image is read."""
SATURATED = 0.01
"""Share of a beam's square, in whole numbers, that has the highest value where a camera ends."""
RING_STEP = 0.25
"""Pixels from one circle to the next in means over the angle. Accuracy: g is linear over a pixel;
of a Gaussian beam 20 pixels wide the light within a circle errs by 1e-4."""
ANGLES = 720
"""Places on a circle for its mean. Accuracy: closer than a pixel up to 114 pixels outward."""
PICTURES = (".png", ".tif", ".tiff")
TABLES = (".csv", ".txt", ".dat")


@dataclass(frozen=True, eq=False)
class MeasuredEnvelope:
    """g of a measured beam.

    Attributes:
        pixels: (rows, columns), the highest 1, dark where nothing stands out. pixel: size [m].
            measured: widths and background, in pixels. saturated: pixels at the camera's end.
    """

    pixels: Array
    pixel: float
    measured: BeamWidths
    saturated: int

    @property
    def area(self) -> float:
        """Integral of g over the plane [m^2]."""
        return float(self.pixels.sum()) * self.pixel**2

    @property
    def radius(self) -> float:
        """Half of the diameter d_sigma [ISO11146-1] [m]."""
        return 0.5 * self.pixel * self.measured.diameter

    @property
    def scale(self) -> float:
        """Length over which g changes [m]."""
        return 0.5 * self.radius

    @property
    def shape(self) -> str:
        """Shape and widths, in words."""
        # rows run downward in the image and upward on the surface: the azimuth changes its sign
        first, second = (format_quantity(self.pixel * each, "m") for each in self.measured.widths)
        turned = f"{-np.degrees(self.measured.azimuth):.3g} deg from x"
        diameter = format_quantity(2.0 * self.radius, "m")
        return f"measured, ISO 11146 widths {first} ({turned}) and {second}, diameter {diameter}"

    @property
    def quality(self) -> str:
        """Size, background, noise and saturation of the image, in words."""
        rows, columns = self.pixels.shape
        text = (
            f"{columns} x {rows} pixels of {format_quantity(self.pixel, 'm')}, background "
            f"{100.0 * self.measured.background:.3g} % and noise "
            f"{100.0 * self.measured.noise:.2g} % of the highest pixel"
        )
        return f"{text}; {self.saturated} pixels look saturated" if self.saturated else text

    @cached_property
    def _tables(self) -> dict[tuple[bool, bool], Array]:
        """Pixels, rows upward, with zeros around; summed along x, y, or both."""
        # a border of zeros ends the bilinear function outside the image
        plain = np.pad(self.pixels[::-1], 1)
        tables = {}
        for along_x in (False, True):
            for along_y in (False, True):
                table = plain
                for axis, summed in ((1, along_x), (0, along_y)):
                    table = _sums(table, axis) if summed else table
                tables[along_x, along_y] = table
        return tables

    def _positions(self, corner: Array) -> Array:
        """Positions (2, n) [m] from the axis, in pixels of the padded table, rows upward."""
        # the centroid in the padded table, whose rows are turned over
        column, row = self.measured.center
        origin = np.array([column + 1.0, self.pixels.shape[0] - row])
        return corner / self.pixel + origin[:, None]

    def at(self, x: ArrayLike, y: ArrayLike) -> Array:
        """g at positions relative to the axis [m], any shape."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        positions = self._positions(np.stack([x.ravel(), y.ravel()]))
        return self._value(positions, (False, False)).reshape(x.shape)

    def cell_means(self, lower: Array, upper: Array, axis: Array) -> Array:
        """Mean of g over each cell, shape (n,), exact."""
        low, high = plane_cells(lower, upper, axis)
        # directions of the surface are integrated; one that is missing takes the value
        is_summed = (lower.shape[0] > 0, lower.shape[0] > 1)
        low, high = self._positions(low), self._positions(high)
        means = self._value(high, is_summed)
        # integral over the cell: D at its corners with alternating signs
        for k in range(lower.shape[0]):
            corner = high.copy()
            corner[k] = low[k]
            means = means - self._value(corner, is_summed)
        if lower.shape[0] == 2:
            means = means + self._value(low, is_summed)
        return means / np.prod((high - low)[: lower.shape[0]], axis=0)

    @property
    def ellipticity(self) -> float:
        """Smaller width over larger one [ISO11146-1], 1 of a round beam."""
        return min(self.measured.widths) / max(self.measured.widths)

    def enclosed(self, r: Array) -> Array:
        """Integral of g, averaged over the angle, over the circle of radius r [m] (n,) [m^2]."""
        radii, sums = self._rings
        return np.interp(r, radii, sums)

    @cached_property
    def _rings(self) -> tuple[Array, Array]:
        """Radii out to the farthest corner [m], and the light within each [m^2]; all of it is the
        area to rounding."""
        reach = self.pixel * float(np.hypot(*self.pixels.shape))
        radii = np.arange(0.0, reach, RING_STEP * self.pixel)
        angle = np.arange(ANGLES) * (2.0 * np.pi / ANGLES)
        mean = self.at(np.outer(radii, np.cos(angle)), np.outer(radii, np.sin(angle))).mean(axis=1)
        # trapezoids of 2 pi r g over r
        ring = 2.0 * np.pi * radii * mean
        sums = np.concatenate([[0.0], np.cumsum(0.5 * (ring[1:] + ring[:-1]) * np.diff(radii))])
        return radii, sums * (self.area / sums[-1])

    def _value(self, positions: Array, is_summed: tuple[bool, bool]) -> Array:
        """The bilinear function, or its integral from below along the summed directions."""
        # entries around each position and their weights, then the sum of their products
        table = self._tables[is_summed]
        (columns, at_x), (rows, at_y) = (
            _weights(position, size, summed)
            for position, size, summed in zip(positions, table.shape[::-1], is_summed, strict=True)
        )
        value = np.zeros(positions.shape[1])
        for row, wy in zip(rows, at_y, strict=True):
            for column, wx in zip(columns, at_x, strict=True):
                value += wy * wx * table[row, column]
        return value


def _sums(table: Array, axis: int) -> Array:
    """Sums of all entries before each position along an axis, and once more of all."""
    total = np.cumsum(table, axis=axis)
    first, last = (np.take(total, [end], axis=axis) for end in (0, -1))
    return np.concatenate([0.0 * first, total, last], axis=axis)


def _weights(position: Array, size: int, summed: bool) -> tuple[list[Any], list[Array]]:
    """Entries of a table along one direction and their weights, see the formula above."""
    # last entry that has its neighbors; positions outside take the value at the border
    most = size - (3 if summed else 2)
    position = np.clip(position, 0.0, float(most if summed else most + 1))
    i = np.minimum(position.astype(np.intp), most)
    t = position - i
    # of D above, or of a straight line between two pixels
    weights = [0.5 * (1.0 - t) ** 2, 0.5 + t - t * t, 0.5 * t * t] if summed else [1.0 - t, t]
    return [i + k for k in range(len(weights))], weights


def digest_of(file: str | Path) -> str:
    """Name of the content of a file."""
    return hashlib.sha256(Path(file).read_bytes()).hexdigest()


@lru_cache(maxsize=8)
def measured_envelope(file: str, digest: str, pixel: float) -> MeasuredEnvelope:
    """The envelope in an image file.

    Args:
        digest: of its content, so that another content is read again. pixel: size of one [m].

    Raises:
        ValueError: not an image of a beam; says what is wrong and what would be right.
        OSError: cannot be read.
    """
    raw = read_image(Path(file))
    highest = float(raw.max())
    if highest <= float(raw.min()):
        raise ValueError("has the same value in all pixels; give the image of a beam")
    # widths from the moments of the image, with its highest pixel as 1
    measured = beam_widths(raw / highest if highest > 0.0 else raw)

    # the whole beam has to lie in the image
    row_count, column_count = raw.shape
    reach = 0.5 * max(measured.widths)
    for position, side in zip(measured.center, (column_count, row_count), strict=True):
        if position - reach < -0.5 or position + reach > side - 0.5:
            raise ValueError(NO_BEAM)

    # subtract the background; what does not stand out of the noise or lies far away is dark
    lit = raw / highest - measured.background
    lit = np.where(stands_out(lit, measured.diameter, measured.noise), np.maximum(lit, 0.0), 0.0)
    y, x = np.mgrid[:row_count, :column_count]
    far = np.hypot(x - measured.center[0], y - measured.center[1])
    lit[far > 0.5 * APERTURE * max(measured.widths)] = 0.0

    # many pixels at one value in whole numbers: the camera has reached its end
    at_end = int(np.sum(raw == highest))
    is_saturated = bool(np.all(raw == np.round(raw))) and at_end > SATURATED * measured.diameter**2
    return MeasuredEnvelope(lit / lit.max(), pixel, measured, at_end if is_saturated else 0)


def read_image(file: Path) -> Array:
    """Pixels (rows, columns) of a PNG or TIFF, or of a table of numbers.

    Raises:
        ValueError: another format, colors, too few or too many pixels, no numbers.
        OSError: cannot be read.
    """
    ending = file.suffix.lower()
    if ending in PICTURES:
        pixels = _picture(file)
    elif ending in TABLES:
        pixels = _table(file)
    else:
        raise ValueError("is no PNG, TIFF or CSV; export the image as one of them")
    if pixels.ndim != 2 or min(pixels.shape) < LEAST_SIDE or max(pixels.shape) > LARGEST_SIDE:
        size = " x ".join(str(side) for side in pixels.shape[::-1])
        raise ValueError(f"has {size} pixels; give {LEAST_SIDE} to {LARGEST_SIDE} along each side")
    if not np.all(np.isfinite(pixels)):
        raise ValueError("has pixels without a number; fill them with the background")
    return pixels


def _picture(file: Path) -> Array:
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(file) as image:
            pixels = np.asarray(image, float)
    except (UnidentifiedImageError, Image.DecompressionBombError, SyntaxError, TypeError):
        raise ValueError("cannot be read as an image; export it as gray PNG or TIFF") from None
    # color channels that are all alike are gray; a channel of opacity is left out
    if pixels.ndim == 3:
        gray = pixels[..., :3] if pixels.shape[2] >= 3 else pixels[..., :1]
        if np.ptp(gray, axis=2).any():
            raise ValueError("is in color, not in intensities; export it as gray PNG or TIFF")
        pixels = gray[..., 0]
    return pixels


def _table(file: Path) -> Array:
    text = file.read_text(encoding="utf-8-sig", errors="replace")
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    # the first mark in the first line separates the columns
    between = next((mark for mark in ";\t," if lines and mark in lines[0]), None)
    try:
        rows = [[float(each) for each in line.rstrip(";,\t ").split(between)] for line in lines]
        return np.array(rows, float)
    except ValueError:
        raise ValueError(
            "is no table of numbers with as many in each row; export the pixels alone, with a "
            "point as decimal mark"
        ) from None
