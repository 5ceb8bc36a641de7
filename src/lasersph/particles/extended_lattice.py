"""Lattice of the fine columns, extended beyond their faces, layer after layer.

Dummy layers and columns continue the lattice past each face that is not free. Each dummy knows
which inner particle it stands for (mirror image or periodic image) or which face gives its
temperature. Patterns that repeat within one support radius are unfolded as often as needed.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.faces import BOTTOM, LATERAL, SURFACE, faces_of
from lasersph.particles.layers import Layers

GHOSTS = 5
"""Dummy layers, and columns of uniform layers: enough for a support radius of 6 spacings."""
GRADED_GHOSTS = 12
"""Dummy columns of graded layers: a coarse particle reaches over many columns of a finer layer."""
FREE, MIRROR, PERIODIC, DIRICHLET = "free", "mirror", "periodic", "dirichlet"
JOINED = "joined"
"""Kind of the end of the fine columns beside which coarse ones lie."""
FACES = ("none", *faces_of(3))
"""Faces by the number that dummies have of them."""


def fine_cells(
    layers: Layers, kinds: dict[str, str]
) -> tuple[list[dict[str, NDArray[Any]]], list[dict[str, NDArray[Any]]]]:
    """Particles of the fine columns and their dummies, layer after layer."""
    # the fine columns end where coarse ones begin
    kinds = dict(kinds)
    for ends, beside in zip(LATERAL, layers.beside, strict=False):
        kinds |= {end: JOINED for end, widths in zip(ends, beside, strict=True) if widths.size}
    surface, bottom = kinds[SURFACE], kinds[BOTTOM]
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
    return real, dummies


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


class _Axis(NamedTuple):
    """Columns of a layer along one axis, dummies beyond its ends among them, (m,) each.

    center [m]. is_real. source: column that it is an image of. holder: face whose temperature it
    has, or 0. is_joined: whether it stands for what lies beside. place: of what it stands for [m].
    width: of a column [m].
    """

    center: NDArray[Any]
    is_real: NDArray[Any]
    source: NDArray[Any]
    holder: NDArray[Any]
    is_joined: NDArray[Any]
    place: NDArray[Any]
    width: float


def _axis(layers: Layers, axis: int, inside: int, kinds: dict[str, str]) -> _Axis:
    """Columns along an axis of the layer `inside`."""
    low, high = LATERAL[axis]
    lower = layers.fine_bounds[axis][0]
    columns = int(layers.columns[axis, inside])
    width = float(layers.column_width()[axis, inside])

    # dummies beyond both ends: none of a free face, and as far as coarse columns reach
    is_uniform = np.ptp(layers.thickness) <= 1e-9 * layers.thickness[0]
    beyond = GHOSTS if is_uniform else GRADED_GHOSTS
    ghosts = [0 if kinds[end] == FREE else beyond for end in (low, high)]
    # a mirror sees the body once where nothing lies beyond the other end
    if (kinds[low], kinds[high]) == (FREE, MIRROR):
        ghosts[1] = min(beyond, columns)
    for end, kind in enumerate((kinds[low], kinds[high])):
        if kind == JOINED:
            ghosts[end] = min(beyond, int(layers.beside[axis][end].sum() / width))

    # what each of them is an image of, and the face that gives its temperature
    index = np.arange(-ghosts[0], columns + ghosts[1])
    before, after = index < 0, index >= columns
    source = index % columns if kinds[low] == PERIODIC else _reflected(index, columns)
    holder = np.zeros(index.size, np.int64)
    for end, outside in ((low, before), (high, after)):
        if kinds[end] == DIRICHLET:
            holder[outside] = FACES.index(end)

    # beside coarse columns a dummy stands for what lies where it lies
    center = lower + (index + 0.5) * width
    is_joined = before & (kinds[low] == JOINED) | after & (kinds[high] == JOINED)
    place = np.where(is_joined, center, lower + (source + 0.5) * width)
    return _Axis(center, ~before & ~after, source, holder, is_joined, place, width)


def _layer(
    layers: Layers, number: int, inside: int, start: int, face: int, kinds: dict[str, str]
) -> dict[str, NDArray[Any]]:
    """One layer of the extended lattice, real and dummy columns; `inside` is its image."""
    z = _height(layers, number, inside, is_periodic=kinds[SURFACE] == PERIODIC)
    axes = [_axis(layers, axis, inside, kinds) for axis in range(layers.dimension - 1)]

    # all combinations of x (and y) in this layer
    shape = tuple(axis.center.size for axis in axes)
    position = np.empty((layers.dimension, int(np.prod(shape))))
    is_real = np.ones(shape, bool)
    source = np.zeros(shape, np.int64)
    dirichlet = np.full(shape, face)
    joined = np.zeros(shape, bool)
    place = np.empty(position.shape)
    for number_of_axis, axis in enumerate(axes):
        view = [1] * len(shape)
        view[number_of_axis] = -1
        position[number_of_axis] = np.broadcast_to(axis.center.reshape(view), shape).ravel()
        place[number_of_axis] = np.broadcast_to(axis.place.reshape(view), shape).ravel()
        is_real &= axis.is_real.reshape(view)
        joined |= axis.is_joined.reshape(view)
        # a dummy in a corner belongs to the face of the layer, then to that of x, then of y
        dirichlet = np.where(dirichlet == 0, axis.holder.reshape(view), dirichlet)
        columns = int(layers.columns[number_of_axis, inside])
        source = source * columns + axis.source.reshape(view)
    position[-1], place[-1] = z, layers.center()[inside]
    widths = np.array([*(axis.width for axis in axes), layers.thickness[inside]])
    return {
        "position": position,
        "width": np.broadcast_to(widths[:, None], position.shape).copy(),
        "real": is_real.ravel(),
        "layer": np.full(position.shape[1], number),
        "source": start + source.ravel(),
        "dirichlet": dirichlet.ravel(),
        "joined": (joined & (dirichlet == 0)).ravel(),
        "place": place,
    }


def _reflected(index: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """Columns 0 ... count - 1 reflected at both ends as often as needed."""
    folded = index % (2 * count)
    return np.where(folded < count, folded, 2 * count - 1 - folded)
