"""Filling a domain: a particle in the middle of each cell, and dummy particles beyond the faces.

Fine columns are those of `extended_lattice`. Beside coarse columns (`coarse_columns`) dummies of
fine particles stand for the cells there; these have one layer of dummies of their own. `sides` are
the faces normal to x and y.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.coarse_columns import NONE, CoarseColumns
from lasersph.particles.extended_lattice import DIRICHLET, FACES, FREE, fine_cells
from lasersph.particles.faces import BACK, BOTTOM, ENDS, FRONT, LEFT, RIGHT, SURFACE, faces_of
from lasersph.particles.layers import Layers

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Beside:
    """Coarse columns beside the fine ones, and the dummies of both.

    Attributes:
        columns: the coarse ones. joined: (k,) dummies of fine particles that stand for coarse
            cells. place: (dim, k) where in the block these lie [m]: mirrored or a period away
            where beyond another face, too. owner: (m,) coarse particles beside the last m dummies,
            which lie beyond a face normal to `axis`, (m,).
    """

    columns: CoarseColumns
    joined: NDArray[np.int64]
    place: Array
    owner: NDArray[np.int64]
    axis: NDArray[np.int64]


@dataclass(frozen=True)
class Filling:
    """Host arrays of the particles; the first `count` of N are real, the others dummies.

    Attributes:
        position, width: (dim, N) [m]. layer: (N,) number of the layer, negative above z = 0.
        source: (N,) the inner particle that a dummy stands for; the particle itself where real.
        dirichlet: (N,) index in FACES of the Dirichlet face that a dummy lies beyond, 0 if none.
        surface: the particles of the first layer. above: (count,) place in `surface` of the
            particle over each.
        measure: (N,) what a cell stands for, the length of its ring [m] or 1 [1]; of a dummy that
            of its source, so that mirrored pairs weigh the same, but beyond a Dirichlet face.
        is_axisymmetric: whether the particles are rings. fine_count, fine_surface: how many
            particles, and of those at the surface, are in the fine columns; these come first.
        beside: coarse columns, if there are any.
    """

    count: int
    position: Array
    width: Array
    layer: NDArray[np.int64]
    source: NDArray[np.uint32]
    dirichlet: NDArray[np.uint8]
    surface: NDArray[np.int64]
    above: NDArray[np.int64]
    measure: Array
    is_axisymmetric: bool
    fine_count: int
    fine_surface: int
    beside: Beside | None = None

    @property
    def fine_numbers(self) -> NDArray[np.int64] | slice:
        """The particles of the fine columns and their dummies."""
        if self.beside is None:
            return slice(None)
        last = self.position.shape[1] - self.beside.owner.size
        return np.concatenate([np.arange(self.fine_count), np.arange(self.count, last)])

    @property
    def depth(self) -> Array:
        """(N,) depth of the centers below the surface [m], which lies at z = 0."""
        return -self.position[-1]

    @cached_property
    def volume(self) -> Array:
        """(N,) cell volumes [m^dim], with which pairs are weighed."""
        return np.prod(self.width, axis=0)

    @cached_property
    def body_volume(self) -> Array:
        """(count,) volumes of the body that the particles stand for, rings [m^3] or cells."""
        return self.volume[: self.count] * self.measure[: self.count]

    @cached_property
    def cross_section(self) -> Array:
        """(count,) areas of the particles seen from above, rings [m^2] or cells [m^(dim - 1)]."""
        return np.prod(self.width[:-1, : self.count], axis=0) * self.measure[: self.count]


def fill(
    layers: Layers,
    *,
    surface: str,
    bottom: str,
    sides: str,
    left: str | None = None,
    right: str | None = None,
    front: str | None = None,
    back: str | None = None,
) -> Filling:
    """Particles of the layers with dummies as the faces ask: FREE, MIRROR, PERIODIC or DIRICHLET.

    Left, right, front and back are as the sides where not given; opposite faces are periodic in
    pairs. Nothing lies beyond an axis of revolution.
    """
    kinds = {LEFT: left or sides, RIGHT: right or sides, FRONT: front or sides, BACK: back or sides}
    if layers.geometry.is_axisymmetric:
        kinds[LEFT] = FREE
    kinds |= {SURFACE: surface, BOTTOM: bottom}
    real, dummies = fine_cells(layers, kinds)
    count = fine_count = layers.fine_count
    surface_cells = np.arange(int(np.prod(layers.columns[:, 0])))
    above = _above(layers, np.concatenate([one["position"][:-1] for one in real], axis=1))
    fine_surface = surface_cells.size

    # coarse columns: their cells after those of the fine ones, and so with the dummies
    columns = CoarseColumns(layers, count) if layers.beside else None
    owner = axis = np.empty(0, np.int64)
    if columns is not None:
        count += columns.count
        cells, over = _coarse_cells(columns)
        outside, owner, axis = _coarse_dummies(columns, kinds)
        real, dummies = [*real, cells], [*dummies, outside]
        above = np.concatenate([above, fine_surface + over])
        surface_cells = np.concatenate([surface_cells, fine_count + np.unique(over)])
    merged = {
        key: np.concatenate([block[key] for block in real + dummies], axis=-1) for key in real[0]
    }
    source = merged["source"].astype(np.uint32)
    measure = layers.geometry.measure(merged["position"])
    keeps_own = (merged["dirichlet"] > 0) | merged["joined"]
    measure = np.where(keeps_own, measure, measure[source])
    beside = None
    if columns is not None:
        joined = np.flatnonzero(merged["joined"])
        beside = Beside(columns, joined, merged["place"][:, joined], owner, axis)
    return Filling(
        count=count,
        position=np.ascontiguousarray(merged["position"]),
        width=np.ascontiguousarray(merged["width"]),
        layer=merged["layer"],
        source=source,
        dirichlet=merged["dirichlet"].astype(np.uint8),
        surface=surface_cells,
        above=above,
        measure=measure,
        is_axisymmetric=layers.geometry.is_axisymmetric,
        fine_count=fine_count,
        fine_surface=fine_surface,
        beside=beside,
    )


def _coarse_cells(columns: CoarseColumns) -> tuple[dict[str, NDArray[Any]], NDArray[np.int64]]:
    """Particles of the coarse columns, and which of those at the surface is over each."""
    position, count = columns.positions(), columns.count
    at_surface = columns.number[0][columns.number[0] != NONE].size
    cells = _block(position, columns.widths(), columns.cells[-1], columns.first + np.arange(count))
    return cells, np.arange(count) % at_surface


def _coarse_dummies(
    columns: CoarseColumns, kinds: dict[str, str]
) -> tuple[dict[str, NDArray[Any]], NDArray[np.int64], NDArray[np.int64]]:
    """Dummies beyond the faces of coarse cells, one for each, the cells and the axes."""
    position, width, layer = columns.positions(), columns.widths(), columns.cells[-1]
    dimension, total = position.shape[0], columns.layers.thickness.size
    blocks, owners, axes = [], [], []
    for face, (axis, end) in ENDS.items():
        axis %= dimension
        # faces of the block that it has, and beyond which something lies
        if face not in faces_of(dimension) or kinds[face] == FREE:
            continue
        # the array of cells has the layer first, the surface its upper end
        along = columns.array_axis(axis, dimension)
        place_along = -end if axis < dimension - 1 else end - 1
        cells = np.asarray(columns.number.take(place_along, axis=along))
        cells = cells[cells != NONE] - columns.first
        # mirrored
        place = position[:, cells].copy()
        place[axis] += (1.0 if end else -1.0) * width[axis, cells]
        number = layer[cells] if axis < dimension - 1 else np.full(cells.size, -1)
        if axis == dimension - 1 and not end:
            number = np.full(cells.size, total)
        is_given = kinds[face] == DIRICHLET
        blocks.append(
            _block(
                place,
                width[:, cells],
                number,
                columns.first + cells,
                FACES.index(face) if is_given else 0,
            )
        )
        owners.append(columns.first + cells)
        axes.append(np.full(cells.size, axis))
    merged = {key: np.concatenate([block[key] for block in blocks], axis=-1) for key in blocks[0]}
    return merged, np.concatenate(owners), np.concatenate(axes)


def _block(
    position: Array,
    width: Array,
    layer: NDArray[np.int64],
    source: NDArray[np.int64],
    dirichlet: int = 0,
) -> dict[str, NDArray[Any]]:
    """Cells of coarse columns, or their dummies, with what `fine_cells` has of others."""
    count = layer.size
    return {
        "position": position,
        "width": width,
        "layer": layer,
        "source": source,
        "dirichlet": np.full(count, dirichlet),
        "real": np.ones(count, bool),
        "joined": np.zeros(count, bool),
        "place": position,
    }


def _above(layers: Layers, lateral: Array) -> NDArray[np.int64]:
    """Surface particle over each particle: the cell of the first layer that holds its x (and y)."""
    found = np.zeros(lateral.shape[1], np.int64)
    for axis, (lower, _upper) in enumerate(layers.fine_bounds):
        columns = int(layers.columns[axis, 0])
        width = float(layers.column_width()[axis, 0])
        # number of the cell of the first layer, the last axis fastest
        place = np.clip(np.floor((lateral[axis] - lower) / width), 0, columns - 1)
        found = found * columns + place.astype(np.int64)
    return found
