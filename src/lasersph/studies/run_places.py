"""Places between the runs of a process map, and how a number is interpolated there."""

from __future__ import annotations

from typing import cast

import numpy as np
from contourpy import FillType, contour_generator
from numpy.typing import NDArray
from scipy.interpolate import LinearNDInterpolator, RegularGridInterpolator
from scipy.spatial import Delaunay

from lasersph.studies.emulator import Box, fit_emulator

Array = NDArray[np.float64]
PLACES = {1: 401, 2: 161}
"""Places of the field along each axis of a map over one key and over two."""


class RunPlaces:
    """Where the runs of a map lie, how numbers are interpolated between them, and the places of
    the field."""

    def __init__(self, box: Box, points: Array) -> None:
        self.box, self.points = box, points
        self.x = box.scaled(points)
        keys = points.shape[1]
        # a regular field over the box, in SI for the axes
        shares = np.linspace(0.0, 1.0, PLACES[keys])
        self.shares = np.stack(np.meshgrid(*[shares] * keys, indexing="xy"), axis=-1)
        corner = box.restored(np.repeat(shares[:, None], keys, axis=1))
        self.grids = tuple(corner.T)

    def emulate(self, values: Array, noise: float) -> tuple[Array, Array]:
        """Mean and standard deviation of an emulator at the places where `interpolate` knows the
        number as well."""
        good, unknown = np.isfinite(values), np.isnan(self.interpolate(values))
        found = fit_emulator(self.points[good], values[good], box=self.box, noise=noise)
        places = self.box.restored(self.shares).reshape(-1, self.points.shape[1])
        mean, deviation = (one.reshape(unknown.shape) for one in found.predict(places))
        return np.where(unknown, np.nan, mean), np.where(unknown, np.nan, deviation)

    def interpolate(self, values: Array) -> Array:
        """A number of each run (runs,) at all places, linearly; NaN outside the runs and beside
        one without the number."""
        if self.x.shape[1] == 1:
            order = np.argsort(self.x[:, 0], kind="stable")
            return np.interp(self.shares[..., 0], self.x[order, 0], values[order])
        if (grid := self.grid_order()) is not None:
            (first, second), order = grid
            found = RegularGridInterpolator((first, second), values[order])
            return found(np.clip(self.shares, 0.0, 1.0))
        return LinearNDInterpolator(Delaunay(self.x), values)(self.shares)

    def grid_order(self) -> tuple[tuple[Array, Array], NDArray[np.int_]] | None:
        """Scaled lines of a grid and the run at each crossing; None where the runs are no grid."""
        # a grid: as many runs as crossings of its lines, one at each
        lines = [np.unique(np.round(column, 9)) for column in self.x.T]
        if len(lines) != 2 or lines[0].size * lines[1].size != len(self.x):
            return None
        place = [
            np.searchsorted(one, np.round(c, 9)) for one, c in zip(lines, self.x.T, strict=True)
        ]
        order = np.full((lines[0].size, lines[1].size), -1)
        order[place[0], place[1]] = np.arange(len(self.x))
        return None if np.any(order < 0) else ((lines[0], lines[1]), order)

    def rows(self) -> list[NDArray[np.int_]]:
        """Runs along the first key, one after the other: on each line of a grid, or over a single
        key; empty where the runs are scattered."""
        if self.x.shape[1] == 1:
            return [np.argsort(self.x[:, 0], kind="stable")]
        grid = self.grid_order()
        return [] if grid is None else list(grid[1].T)

    def lines(self, values: Array) -> tuple[Array, ...]:
        """Where a number of each run passes zero."""
        return self.contour(self.interpolate(values), 0.0)

    def area(self, field: Array) -> tuple[Array, ...]:
        """Where a field is positive: rings (k, 2) around it and around its holes, or the ends
        (2, 1) of each stretch of a single key."""
        if field.ndim == 1:
            # a single key: pairs of ends
            ends = np.concatenate([np.empty((0, 1)), *self.contour(field, 0.0)])
            return tuple(ends[: len(ends) // 2 * 2].reshape(-1, 2, 1))
        step = np.linspace(0.0, 1.0, field.shape[0])
        generator = contour_generator(
            step, step, np.ma.masked_invalid(field), fill_type=FillType.OuterOffset
        )
        found = generator.filled(0.0, np.nanmax(field, initial=0.0) + 1.0)
        # outlines one by one, each with the places at which its outer ring and its holes begin
        points, offsets = cast(tuple[list[Array], list[NDArray[np.int_]]], found)
        return tuple(
            self.box.restored(ring)
            for outline, begins in zip(points, offsets, strict=True)
            for ring in np.split(outline, begins[1:-1])
        )

    def contour(self, field: Array, level: float) -> tuple[Array, ...]:
        """Where a field passes a level: lines (k, 2), or one array (k, 1) over a single key."""
        if field.ndim == 1:
            # a single key: crossings between neighbors, linearly
            above = field > level
            known = np.isfinite(field[1:]) & np.isfinite(field[:-1])
            k = np.flatnonzero((above[1:] != above[:-1]) & known)
            share = (level - field[k]) / (field[k + 1] - field[k])
            places = (k + share) / (field.size - 1)
            return (self.box.restored(places[:, None]),) if k.size else ()
        step = np.linspace(0.0, 1.0, field.shape[0])
        found = contour_generator(step, step, np.ma.masked_invalid(field)).lines(level)
        return tuple(self.box.restored(line) for line in cast(list[Array], found))
