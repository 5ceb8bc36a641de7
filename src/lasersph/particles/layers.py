"""Layers: thicknesses from the surface down, and columns of each layer.

Graded layers grow by 1/ratio per layer [Demuth2020, Section 4.1]. Beside the fine columns, where a
fine width is given, columns grow sideways by the same ratio, the same ones in all layers.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.domain import Domain
from lasersph.particles.geometry import Geometry
from lasersph.particles.lattice import Lattice

Array = NDArray[np.float64]
SMALLEST_CUT = 0.25
"""A last layer thinner than this share of its full thickness is joined to the one above."""

LEAST_BESIDE = 1.5
"""Width beside the fine columns in supports of the thickest layer from which columns grow.
Geometry: all pairs that cross from fine to coarse columns end within one."""


@dataclass(frozen=True, eq=False)
class Layers:
    """Layers of cells from the surface down.

    Attributes:
        thickness: (layers,) [m]. columns: (dim - 1, layers) fine cells along x (and y).
        bounds: lower and upper bound along x (and y) or r [m]. geometry: that the layers lie in.
        beside: widths of the coarse columns beside the fine ones toward the lower and the upper
            bound of each of these axes, from the fine ones outward [m]; empty where there are none.
    """

    thickness: Array
    columns: NDArray[np.int64]
    bounds: tuple[tuple[float, float], ...]
    geometry: Geometry
    beside: tuple[tuple[Array, Array], ...] = ()

    @property
    def dimension(self) -> int:
        """Number of space dimensions."""
        return self.geometry.dimensions

    @property
    def fine_count(self) -> int:
        """Cells of the fine columns in all layers."""
        return int(np.prod(self.columns, axis=0).sum())

    @property
    def particle_count(self) -> int:
        """Cells in all layers."""
        if not self.beside:
            return self.fine_count
        # coarse columns are the same in all layers, beside those of the first one
        across = self.columns[:, 0] + [low.size + high.size for low, high in self.beside]
        coarse = int(np.prod(across) - np.prod(self.columns[:, 0]))
        return self.fine_count + self.thickness.size * coarse

    @property
    def fine_bounds(self) -> tuple[tuple[float, float], ...]:
        """Lower and upper bound of the fine columns along x (and y) or r [m]."""
        if not self.beside:
            return self.bounds
        return tuple(
            (lower + float(low.sum()), upper - float(high.sum()))
            for (lower, upper), (low, high) in zip(self.bounds, self.beside, strict=True)
        )

    @property
    def fine_only(self) -> Layers:
        """The block of the fine columns alone."""
        return Layers(self.thickness, self.columns, self.fine_bounds, self.geometry)

    @property
    def spacing(self) -> float:
        """Thickness of the finest layer [m]."""
        return float(self.thickness.min())

    @property
    def fine_depth(self) -> float:
        """Depth of the lower end of the layers as thin as the finest [m]."""
        fine = self.thickness <= self.spacing * (1.0 + 1e-9)
        return float(np.cumsum(self.thickness)[fine][-1])

    @property
    def extents(self) -> tuple[tuple[float, float], ...]:
        """Lower and upper bound of the block along each axis, z last [m]."""
        return (*self.bounds, (-float(self.thickness.sum()), 0.0))

    def center(self) -> Array:
        """z of the middle of each layer [m], below zero."""
        return 0.5 * self.thickness - np.cumsum(self.thickness)

    def solid_margin(self, support_ratio: float) -> float:
        """Width of solid beside what flows from which no pair reaches both it and a particle with
        pairs that reach coarse columns [m].

        Pairs between layers reach as far as the mean of both supports; what flows is in the finest
        layers.

        Args:
            support_ratio: support radius over the thickness of a layer.
        """
        support = support_ratio * self.thickness
        mean = 0.5 * (support + support[0])
        # layers that the lowest of the finest ones sees
        lowest = self.center()[self.thickness <= self.thickness[0] * (1.0 + 1e-9)][-1]
        is_seen = np.abs(self.center() - lowest) < mean
        return float((mean + support)[is_seen].max())

    def column_width(self) -> Array:
        """(dim - 1, layers) width of the cells [m]."""
        bounds = self.fine_bounds
        extent = np.array([upper - lower for lower, upper in bounds]).reshape(-1, 1)
        return extent / self.columns


def stack(
    domain: Domain,
    lattice: Lattice,
    geometry: Geometry,
    fine_depth: float,
    fine_width: float = np.inf,
) -> Layers:
    """Layers that fill the domain.

    Args:
        fine_depth: depth of the layers of finest spacing [m]; for graded arrangements. fine_width:
            from the middle or the axis outward of the columns of finest spacing [m].

    The spacing is rounded so that whole numbers of cells fill the width and, where uniform, the
    depth.
    """
    bounds = domain.lateral(geometry)
    spacing = lattice.spacing
    if bounds:
        # whole numbers of columns across, so that a period closes
        extent = bounds[0][1] - bounds[0][0]
        spacing = extent / max(1, round(extent / spacing))
    # whole numbers of layers, or layers that grow downward
    if lattice.arrangement == "uniform":
        count = max(1, round(domain.depth / spacing))
        thickness = np.full(count, domain.depth / count)
    else:
        thickness = _graded(spacing, lattice, domain.depth, fine_depth)
    # coarse columns where the block is wider than what is kept fine
    least = LEAST_BESIDE * lattice.support_over_spacing * float(thickness.max())
    beside: tuple[tuple[Array, Array], ...] = tuple(
        (
            _columns_beside(-lower, spacing, lattice, fine_width, least),
            _columns_beside(upper, spacing, lattice, fine_width, least),
        )
        for lower, upper in bounds
    )
    if not any(widths.size for widths in chain.from_iterable(beside)):
        beside = ()
    # fine columns of each layer as wide as it is thick
    fine = Layers(thickness, np.ones((len(bounds), 1), np.int64), bounds, geometry, beside)
    columns = [
        np.maximum(1, np.rint((upper - lower) / thickness)).astype(np.int64)
        for lower, upper in fine.fine_bounds
    ]
    counts = np.array(columns, np.int64).reshape(len(bounds), thickness.size)
    return Layers(thickness, counts, bounds, geometry, beside)


def _columns_beside(
    end: float, spacing: float, lattice: Lattice, fine_width: float, least: float
) -> Array:
    """Widths of the coarse columns out to the distance `end` from the middle [m], empty where less
    than `least` [m] lies beyond the fine ones."""
    if not fine_width < end:
        return np.empty(0)
    fine = max(1, int(np.ceil(fine_width / spacing - 1e-9))) * spacing
    if end - fine < least:
        return np.empty(0)
    return _graded(spacing, lattice, end - fine, 0.0)


def _graded(spacing: float, lattice: Lattice, depth: float, fine_depth: float) -> Array:
    """Thicknesses that grow from `spacing` to `lattice.coarsest` and end at `depth`."""
    # at least one fine layer; rounding must not add another
    fine = max(1, int(np.ceil(min(fine_depth, depth) / spacing - 1e-9)))
    layers = [spacing] * fine
    bottom = spacing * fine
    # each layer thicker by 1/ratio, up to the coarsest
    while bottom < depth * (1.0 - 1e-9):
        full = min(layers[-1] / lattice.ratio, max(lattice.coarsest, spacing))
        remaining = depth - bottom
        # a thin last layer would cut the time step: the one above takes it
        if remaining < SMALLEST_CUT * full:
            layers[-1] += remaining
            break
        layers.append(min(full, remaining))
        bottom += layers[-1]
    return np.array(layers)
