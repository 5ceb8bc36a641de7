"""Filling a domain: a particle in the middle of each cell, and dummy particles beyond the faces.

Dummy layers and columns continue the lattice past each face that is not free. Each dummy knows
which inner particle it stands for (mirror image or periodic image) or which face gives its
temperature. Patterns that repeat within one support radius are unfolded as often as needed.
`sides` are the faces normal to x and y.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.faces import BACK, BOTTOM, FRONT, LATERAL, LEFT, RIGHT, SURFACE, faces_of
from lasersph.particles.layers import Layers

Array = NDArray[np.float64]
GHOSTS = 5
"""Dummy layers, and columns of uniform layers: enough for a support radius of 6 spacings."""
GRADED_GHOSTS = 12
"""Dummy columns of graded layers: a coarse particle reaches over many columns of a finer layer."""
FREE, MIRROR, PERIODIC, DIRICHLET = "free", "mirror", "periodic", "dirichlet"
FACES = ("none", *faces_of(3))
"""Faces by the number that dummies have of them."""


@dataclass(frozen=True)
class Filling:
    """Host arrays of the particles; the first `count` of N are real, the others dummies.

    Attributes:
        position, width: (dim, N) [m]. layer: (N,) number of the layer, negative above z = 0.
        source: (N,) the inner particle that a dummy stands for; the particle itself where real.
        dirichlet: (N,) index in FACES of the Dirichlet face that a dummy lies beyond, 0 if none.
        surface: the particles of the first layer. above: (count,) the surface particle over each.
        measure: (N,) what a cell stands for, the length of its ring [m] or 1 [1]; of a dummy that
            of its source, so that mirrored pairs weigh the same, but beyond a Dirichlet face.
        is_axisymmetric: whether the particles are rings.
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
) -> Filling:
    """Particles of the layers with dummies as the faces ask: FREE, MIRROR, PERIODIC or DIRICHLET.

    Left and right are as the sides where not given; opposite faces are periodic in pairs. Nothing
    lies beyond an axis of revolution.
    """
    kinds = {LEFT: left or sides, RIGHT: right or sides, FRONT: sides, BACK: sides}
    if layers.geometry.is_axisymmetric:
        kinds[LEFT] = FREE
    kinds[SURFACE] = surface
    total = layers.thickness.size
    starts = np.concatenate([[0], np.cumsum(np.prod(layers.columns, axis=0))])
    # layers of the extended lattice, from the uppermost dummies down to the lowest
    first = 0 if surface == FREE else -min(GHOSTS, total)
    last = total if bottom == FREE else total + min(GHOSTS, total)
    real, dummies = [], []
    for number in range(first, last):
        inside = _inside(number, total, is_periodic=surface == PERIODIC)
        # face that gives the temperature of these dummies
        face = 0
        if number < 0 and surface == DIRICHLET:
            face = FACES.index(SURFACE)
        if number >= total and bottom == DIRICHLET:
            face = FACES.index(BOTTOM)
        block = _layer(layers, number, inside, int(starts[inside]), face, kinds)
        # real particles come first, so cells are sorted after
        is_real = np.logical_and(block["real"], 0 <= number < total)
        real.append({key: value[..., is_real] for key, value in block.items()})
        dummies.append({key: value[..., ~is_real] for key, value in block.items()})
    merged = {
        key: np.concatenate([block[key] for block in real + dummies], axis=-1) for key in real[0]
    }
    count = layers.particle_count
    source = merged["source"].astype(np.uint32)
    surface_count = int(starts[1])
    measure = layers.geometry.measure(merged["position"])
    measure = np.where(merged["dirichlet"] > 0, measure, measure[source])
    return Filling(
        count=count,
        position=np.ascontiguousarray(merged["position"]),
        width=np.ascontiguousarray(merged["width"]),
        layer=merged["layer"],
        source=source,
        dirichlet=merged["dirichlet"].astype(np.uint8),
        surface=np.arange(surface_count),
        above=_above(layers, merged["position"][:-1, :count]),
        measure=measure,
        is_axisymmetric=layers.geometry.is_axisymmetric,
    )


def _inside(number: int, total: int, *, is_periodic: bool) -> int:
    """The layer of the block that layer `number` of the extended lattice repeats or mirrors."""
    # the pattern repeats
    if is_periodic:
        return number % total
    # mirrored at the surface, at the bottom
    if number < 0:
        return -1 - number
    return number if number < total else 2 * total - 1 - number


def _height(layers: Layers, number: int, inside: int, *, is_periodic: bool) -> float:
    """z of the middle of a layer of the extended lattice [m]."""
    depth, total = float(layers.thickness.sum()), layers.thickness.size
    z = float(layers.center()[inside])
    if is_periodic:
        return z - depth * (number // total)
    if number < 0:
        return -z
    return z if number < total else -2.0 * depth - z


def _layer(
    layers: Layers, number: int, inside: int, start: int, face: int, kinds: dict[str, str]
) -> dict[str, NDArray[Any]]:
    """One layer of the extended lattice, real and dummy columns; `inside` is its image."""
    z = _height(layers, number, inside, is_periodic=kinds[SURFACE] == PERIODIC)
    is_uniform = np.ptp(layers.thickness) <= 1e-9 * layers.thickness[0]
    beyond = GHOSTS if is_uniform else GRADED_GHOSTS
    axes, sources, reals, widths, holders = [], [], [], [], []
    # along each axis: places, widths, real or not, source, and the face that gives the temperature
    for axis, (lower, _upper) in enumerate(layers.bounds):
        low, high = LATERAL[axis]
        columns = int(layers.columns[axis, inside])
        width = float(layers.column_width()[axis, inside])
        ghosts = [0 if kinds[end] == FREE else beyond for end in (low, high)]
        index = np.arange(-ghosts[0], columns + ghosts[1])
        axes.append(lower + (index + 0.5) * width)
        reals.append((index >= 0) & (index < columns))
        is_periodic = kinds[low] == PERIODIC
        sources.append(index % columns if is_periodic else _reflected(index, columns))
        holder = np.zeros(index.size, int)
        if kinds[low] == DIRICHLET:
            holder[index < 0] = FACES.index(low)
        if kinds[high] == DIRICHLET:
            holder[index >= columns] = FACES.index(high)
        holders.append(holder)
        widths.append(width)

    # all combinations of x (and y) in this layer
    shape = tuple(axis.size for axis in axes)
    position = np.empty((layers.dimension, int(np.prod(shape))))
    is_real = np.ones(shape, bool)
    source = np.zeros(shape, np.int64)
    dirichlet = np.full(shape, face)
    for axis, values in enumerate(axes):
        view = [1] * len(shape)
        view[axis] = -1
        position[axis] = np.broadcast_to(values.reshape(view), shape).ravel()
        is_real &= reals[axis].reshape(view)
        # a dummy in a corner belongs to the face of the layer, then to that of x, then of y
        dirichlet = np.where(dirichlet == 0, holders[axis].reshape(view), dirichlet)
        source = source * int(layers.columns[axis, inside]) + sources[axis].reshape(view)
    position[-1] = z
    width = np.broadcast_to(
        np.array([*widths, layers.thickness[inside]])[:, None], position.shape
    ).copy()
    return {
        "position": position,
        "width": width,
        "real": is_real.ravel(),
        "layer": np.full(position.shape[1], number),
        "source": start + source.ravel(),
        "dirichlet": dirichlet.ravel(),
    }


def _reflected(index: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """Columns 0 ... count - 1 reflected at both ends as often as needed."""
    folded = index % (2 * count)
    return np.where(folded < count, folded, 2 * count - 1 - folded)


def _above(layers: Layers, lateral: Array) -> NDArray[np.int64]:
    """Surface particle over each particle: the cell of the first layer that holds its x (and y)."""
    found = np.zeros(lateral.shape[1], np.int64)
    for axis, (lower, _upper) in enumerate(layers.bounds):
        columns = int(layers.columns[axis, 0])
        width = float(layers.column_width()[axis, 0])
        # number of the cell of the first layer, the last axis fastest
        place = np.clip(np.floor((lateral[axis] - lower) / width), 0, columns - 1)
        found = found * columns + place.astype(np.int64)
    return found
