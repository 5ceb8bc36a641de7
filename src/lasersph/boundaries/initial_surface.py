"""Heights that a surface which moves starts from: a wave, a bump, a cap, or the relief that a run
has left."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, ValidationInfo, model_validator

from lasersph.input import Length, Model, format_quantity, refusal, with_rows_of_file

if TYPE_CHECKING:
    from lasersph.boundaries.relief_grid import ReliefGrid
    from lasersph.boundaries.surface_shapes import SurfaceShape

Array = NDArray[np.float64]
COLUMNS = ("x_m", "height_m")
OVER_BOTH = ("x_m", "y_m", "height_m")
"""Columns of a relief over x and y."""
BEYOND = 1.0
"""Widths of its columns by which a relief may end before the surface does. Geometry: columns have
heights in their middle, and those of another run may be wider."""
STEEPEST = 1.0
"""Slope up to which the surface is computed. Guard: ghosts across tangents steeper than 45 degrees
meet."""
MIN_LAYERS = 3
"""Thickness of the liquid over the spacing, down to which it is. Guard: fewer rows of a box see no
profile of the flow."""
SHAPE_KEYS = ("amplitude", "period", "radius", "cap_height", "cap_radius")
"""Keys of a wave, a bump and a cap."""
PARTNERS = {
    "amplitude": ("period", 'period = "5 um" for a wave, or radius = "5 um" for a bump'),
    "period": ("amplitude", 'amplitude = "50 nm"'),
    "radius": ("amplitude", 'amplitude = "50 nm"'),
    "cap_height": ("cap_radius", 'cap_radius = "2 um"'),
    "cap_radius": ("cap_height", 'cap_height = "50 nm"'),
}
"""Key that each key of a shape needs beside it, with an example."""
SHAPES = (("amplitude", "period"), ("amplitude", "radius"), ("cap_height", "cap_radius"))
SHAPES_IN_WORDS = (
    "amplitude and period of a wave, amplitude and radius of a bump, or cap_height and cap_radius"
)


class InitialSurface(Model):
    """Height of the surface at the start: a wave amplitude cos(2 pi x / period), in 3-D times
    cos(2 pi y / period_y), a bump amplitude
    exp(-r^2 / radius^2), the cap of a sphere (of a cylinder in a plane), or that of a file."""

    amplitude: Length | None = Field(
        default=None, description="of a wave, at x = 0; of a bump, at r = 0"
    )
    period: Annotated[Length, Field(gt=0)] | None = Field(default=None, description="of a wave")
    period_y: Annotated[Length, Field(gt=0)] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="of a wave along y; 3-D; default: nothing varies along y",
    )
    radius: Annotated[Length, Field(gt=0)] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="of a bump, where it has fallen to 1/e",
    )
    cap_height: Length | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="of a cap, at r = 0; negative for a hollow",
    )
    cap_radius: Annotated[Length, Field(gt=0)] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="of a cap, of the disc that it covers",
    )
    path: str = Field(
        default="",
        exclude_if=lambda given: not given,
        description="instead: surface.csv of an earlier run, with columns x_m, height_m, in "
        "3-D y_m between them",
    )
    rows: tuple[Annotated[tuple[float, ...], Field(min_length=2, max_length=3)], ...] = Field(
        default=(),
        exclude_if=lambda given: not given,
        description="the same as numbers, instead of a file; the file's are kept here",
    )

    @model_validator(mode="before")
    @classmethod
    def _fill(cls, data: Any, info: ValidationInfo) -> Any:
        """Rows from the file, which counts from the folder of the case file."""
        return with_rows_of_file(data, info, COLUMNS, wider=OVER_BOTH)

    @model_validator(mode="after")
    def _check(self) -> InitialSurface:
        given = [key for key in SHAPE_KEYS if getattr(self, key) is not None]
        if self.rows and given:
            raise refusal(("path", f"contradicts {given[0]} beside it; leave one of them out"))
        if self.period_y is not None and self.period is None:
            raise refusal(("period_y", 'says nothing without period; write e.g. period = "5 um"'))
        # Two keys belong together; others are of two shapes.
        if len(given) == 1:
            partner, example = PARTNERS[given[0]]
            raise refusal((partner, f"is missing; write e.g. {example}"))
        if given and tuple(given) not in SHAPES:
            raise refusal(
                (given[-1], f"is not of one shape with {given[0]}; write {SHAPES_IN_WORDS}")
            )
        # A cap that is higher than half of a sphere has two heights at one place.
        if abs(self.cap_height or 0.0) >= (self.cap_radius or np.inf):
            raise refusal(
                (
                    "cap_height",
                    "is that of half a sphere or more; write less than cap_radius, "
                    f"{format_quantity(self.cap_radius or 0.0, 'm')}",
                )
            )
        if self._is_over_both:
            if self.grid is None:
                raise refusal(
                    (
                        "path",
                        "needs a height for each x_m and each y_m of a grid, in rows whose y_m "
                        "rises for each x_m in turn",
                    )
                )
        elif self.rows and (len(self.rows) < 2 or not np.all(np.diff(self.x) > 0.0)):
            raise refusal(("path", "needs two rows or more whose x_m rises"))
        return self

    @property
    def _is_over_both(self) -> bool:
        """Whether rows of a file have a place along y."""
        return any(len(row) == 3 for row in self.rows)

    @cached_property
    def grid(self) -> ReliefGrid | None:
        """Heights of a file over x and y; None where there are none."""
        from lasersph.boundaries.relief_grid import ReliefGrid

        is_even = self._is_over_both and all(len(row) == 3 for row in self.rows)
        return ReliefGrid.of(np.array(self.rows)) if is_even else None

    @property
    def x(self) -> Array:
        """Places of the rows [m]."""
        return np.array([row[0] for row in self.rows])

    @property
    def heights(self) -> Array:
        """Heights of the rows [m]."""
        return np.array([row[-1] for row in self.rows])

    @property
    def shape(self) -> SurfaceShape | None:
        """The wave, the bump or the cap; None for heights of a file, or none."""
        from lasersph.boundaries.surface_shapes import Bump, Cap, Wave  # few cases have one

        if self.amplitude is not None and self.period is not None:
            return Wave(self.amplitude, self.period, self.period_y)
        if self.amplitude is not None and self.radius is not None:
            return Bump(self.amplitude, self.radius)
        if self.cap_height is not None and self.cap_radius is not None:
            return Cap(self.cap_height, self.cap_radius)
        return None

    def at(self, x: NDArray[np.floating], width: float = 0.0, *, is_ring: bool = False) -> Array:
        """Height [m] at x [m], any shape.

        Args:
            width: of columns around x, in the mean over which a shape is taken [m]. is_ring:
                whether these are rings about x = 0.
        """
        place: Array = np.asarray(x, np.float64)
        if self.shape is None:
            return np.interp(place, self.x, self.heights) if self.rows else np.zeros(place.shape)
        if width == 0.0:
            return self.shape.at(place)
        half = 0.5 * width
        return self.shape.mean(place - half, place + half, is_ring=is_ring)

    def shape_at(self, x: Array, y: Array) -> Array:
        """Height [m] at x and y [m]; rows of a file without y hold for all y."""
        if self.grid is not None:
            return self.grid.at(x, y)
        return self.at(x) if self.shape is None else self.shape.at(x, y)

    def mean_over_columns(self, places: tuple[Array, Array], widths: tuple[float, float]) -> Array:
        """Mean height [m] over the columns of a body around places along x and y [m]; rows of a
        file without y hold for all y."""
        if self.shape is None:
            return self.shape_at(*places)
        return self.shape.mean_over_columns(places, widths)

    @property
    def depth(self) -> float:
        """How far it begins below z = 0 at most [m]; of a file, its largest distance from there."""
        if self.shape is None:
            return max((abs(height) for height in self.heights), default=0.0)
        return -self.shape.lowest

    def steepest(self, width: float) -> float:
        """Largest slope; of the rows of a file over a width [m]."""
        if self.shape is not None:
            return self.shape.steepest
        if self.grid is not None:
            return self.grid.steepest(width)
        rise = self.at(self.x + 0.5 * width) - self.at(self.x - 0.5 * width)
        return float(np.max(np.abs(rise), initial=0.0)) / width

    def covers(self, axis: int, low: float, high: float) -> bool:
        """Whether it has heights from `low` to `high` [m] along an axis; all but a file have
        everywhere, and one without y has along y."""
        if self.grid is not None:
            return self.grid.covers(axis, low, high, BEYOND)
        if not self.rows or axis == 1:
            return True
        # columns at the ends of the relief reach half of their width further
        margin = BEYOND * (self.x[-1] - self.x[0]) / (len(self.rows) - 1)
        return bool(self.x[0] - margin <= low and high <= self.x[-1] + margin)
