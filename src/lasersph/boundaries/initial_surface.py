"""Heights that a surface which moves starts from: a wave, or the relief that a run has left."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, ValidationInfo, model_validator

from lasersph.input import Length, Model, refusal

Array = NDArray[np.float64]
COLUMNS = ("x_m", "height_m")
STEEPEST = 1.0
"""Slope up to which the surface is computed. Guard: ghosts across tangents steeper than 45 degrees
meet."""
MIN_LAYERS = 3
"""Thickness of the liquid over the spacing, down to which it is. Guard: fewer rows of a box see no
profile of the flow."""
BEYOND = 1.0
"""Widths of its columns by which a relief may end before the surface does. Geometry: columns have
heights in their middle, and those of another run may be wider."""


class InitialSurface(Model):
    """Height of the surface at the start: amplitude cos(2 pi x / period), or that of a file."""

    amplitude: Length | None = Field(default=None, description="of a wave, at x = 0")
    period: Annotated[Length, Field(gt=0)] | None = Field(default=None, description="of a wave")
    path: str = Field(
        default="",
        exclude_if=lambda given: not given,
        description="instead: surface.csv of an earlier run, with columns x_m and height_m",
    )
    rows: tuple[tuple[float, float], ...] = Field(
        default=(),
        exclude_if=lambda given: not given,
        description="the same as numbers, instead of a file; the file's are kept here",
    )

    @model_validator(mode="before")
    @classmethod
    def _fill(cls, data: Any, info: ValidationInfo) -> Any:
        """Rows from the file, which counts from the folder of the case file."""
        if isinstance(data, dict) and isinstance(data.get("path"), str) and not data.get("rows"):
            from lasersph.input.csv_rows import read_rows  # few cases name a file

            folder = (info.context or {}).get("folder") or Path()
            file = Path(folder) / Path(data["path"]).expanduser()
            return data | {"rows": read_rows(file, COLUMNS)}
        return data

    @model_validator(mode="after")
    def _check(self) -> InitialSurface:
        is_wave = (self.amplitude is not None, self.period is not None)
        if self.rows and any(is_wave):
            # a wave has both of its keys or none
            raise refusal(("path", "contradicts the wave beside it; leave it out"))
        if any(is_wave) and not all(is_wave):
            key, example = ("period", "5 um") if is_wave[0] else ("amplitude", "50 nm")
            raise refusal((key, f'is missing; write e.g. {key} = "{example}"'))
        if self.rows and (len(self.rows) < 2 or not np.all(np.diff(self.x) > 0.0)):
            raise refusal(("path", "needs two rows or more whose x_m rises"))
        return self

    @property
    def x(self) -> Array:
        """Places of the rows [m]."""
        return np.array([row[0] for row in self.rows])

    def at(self, x: NDArray[np.floating], width: float = 0.0) -> Array:
        """Height [m] at x [m]; of a wave the mean over columns of a width [m] around x."""
        if self.rows:
            return np.interp(x, self.x, [row[1] for row in self.rows])
        if self.amplitude is None or self.period is None:
            return np.zeros(np.shape(x))
        # the mean of a cosine over a width is the cosine times sinc
        wave = np.cos(2.0 * np.pi * np.asarray(x, float) / self.period)
        return self.amplitude * np.sinc(width / self.period) * wave

    @property
    def extent(self) -> float:
        """Largest distance from z = 0 [m]."""
        return max([abs(self.amplitude or 0.0), *(abs(row[1]) for row in self.rows)])

    def steepest(self, width: float) -> float:
        """Largest slope; of the rows of a file over a width [m]."""
        if self.rows:
            rise = self.at(self.x + 0.5 * width) - self.at(self.x - 0.5 * width)
            return float(np.max(np.abs(rise))) / width
        return 2.0 * np.pi * self.extent / self.period if self.period else 0.0

    def covers(self, low: float, high: float) -> bool:
        """Whether it has heights from x = low to high [m]; a wave has everywhere."""
        if not self.rows:
            # columns at the ends of the relief reach half of their width further
            return True
        margin = BEYOND * (self.x[-1] - self.x[0]) / (len(self.rows) - 1)
        return bool(self.x[0] - margin <= low and high <= self.x[-1] + margin)
