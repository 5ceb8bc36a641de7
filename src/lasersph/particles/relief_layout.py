"""Particles laid out evenly below a relief.

The layers as fine as the finest are columns of equal cells. Below a relief of heights eta_c the
number of cells in each column follows its thickness, their sum stays what it is:

    n_c ~ (d + eta_c)/dz,    dz = mean (d + eta_c) / mean n,    z = -d + (k + 1/2) (d + eta_c)/n_c

with the depth d of these layers, rounded by largest remainders; where particles keep their columns,
each column has as many as before. So all cells are alike within
half of one in a column, how deep a relief ever is, and their volume is what lies below it.

What particles carry goes along in three steps, each of which keeps the sum of V f: those of a
column, one on the other from the top, become as many even levels as there are fine layers; columns
that hold more than lies below the relief pass the excess on to their neighbors, of every level as
much; the levels become the cells. Within an old part f is linear, with van Leer's slope of those
beside it [vanLeer1974]: no new extremes.
"""

from __future__ import annotations

from math import prod
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.layers import Layers

Array = NDArray[np.float64]


class ReliefLayout(NamedTuple):
    """Particles of the finest layers, which come first: position (d, n) [m], volume (n,) [m^d],
    smallest and largest height of their cells [m], column (n,) of each and its row from the top,
    numbers of the columns along each axis."""

    position: Array
    volume: Array
    heights: tuple[float, float]
    column: NDArray[np.intp]
    row: NDArray[np.intp]
    shape: tuple[int, ...]


def lay_below(layers: Layers, height: Array, *, keep_columns: bool = False) -> ReliefLayout:
    """Particles of the finest layers of a domain below a relief.

    Args:
        height: of the surface over each column of the first layer [m], in the shape of their grid;
            its lowest point lies above the lower end of these layers. keep_columns: whether no
            particle changes its column.

    Raises:
        ValueError: a column would hold no particle.
    """
    fine = int(np.count_nonzero(layers.thickness <= layers.spacing * (1.0 + 1e-9)))
    columns, depth, shape = height.size, layers.fine_depth, height.shape
    thickness = depth + height.ravel()
    # largest remainders: whole cells, the last ones where most of a cell was cut off
    wanted = (
        np.full(columns, float(fine)) if keep_columns else thickness / np.mean(thickness) * fine
    )
    count = np.floor(wanted).astype(np.int64)
    remainder = np.argsort(count - wanted, kind="stable")[: fine * columns - int(count.sum())]
    count[remainder] += 1
    if count.min() < 1:
        raise ValueError("the relief reaches the lower end of the finest layers")
    column = np.repeat(np.arange(columns), count)
    row = np.concatenate([np.arange(n) for n in count])
    # numbers rise from the uppermost row down, as those of the lattice do
    order = np.lexsort((column, -row))
    column, row = column[order], row[order]
    size, area, lateral = thickness / count, 1.0, []
    for (low, high), n, place in zip(
        layers.bounds, shape, np.unravel_index(column, shape), strict=True
    ):
        width = (high - low) / n
        lateral.append(low + (place + 0.5) * width)
        area = area * width
    position = np.array([*lateral, (row + 0.5) * size[column] - depth], dtype=np.float64)
    heights, row = (float(size.min()), float(size.max())), count[column] - 1 - row
    return ReliefLayout(position, area * size[column], heights, column, row, shape)


def carry_over(
    layers: Layers, layout: ReliefLayout, position: Array, volume: Array, fields: Array
) -> tuple[Array, Array]:
    """Volume (n,) of the particles of a layout, whose sum stays what it is, and the means (k, n) of
    fields over what each holds.

    Args:
        layout: where they lie, with volumes of the same kind: of cells [m^d], or of the rings that
            they stand for [m^3]. position, volume, fields: (d, n), (n,), (k, n) of the particles of
            the finest layers before.

    Raises:
        ValueError: a column holds no particle.
    """
    shape, columns, places = layout.shape, prod(layout.shape), []
    for x, (low, high), n in zip(position[:-1], layers.bounds, shape, strict=True):
        places.append(np.clip(np.floor((x - low) * n / (high - low)).astype(np.intp), 0, n - 1))
    place = np.asarray(np.ravel_multi_index(tuple(places), shape), np.intp)
    members = columns_alike(place, columns, np.lexsort((-position[-1], place)))
    if members[0][1].shape[1] < 1:
        raise ValueError("a column holds no particle")
    # columns become even levels, from the top
    count = volume.size // columns
    levels = np.linspace(0.0, 1.0, count + 1)
    held = np.bincount(place, volume, columns)
    means = np.empty((fields.shape[0], count, columns))
    for alike, rows in members:
        edges = np.pad(np.cumsum(volume[rows], axis=1), ((0, 0), (1, 0))) / held[alike, None]
        edges[:, -1] = 1.0
        means[:, :, alike] = resample(edges, fields[:, rows], levels).swapaxes(1, 2)
    # what a column holds too much goes to the next
    new_volume = layout.volume * (volume.sum() / layout.volume.sum())

    # volume that passes each side, with the means upwind of it
    wanted = np.bincount(layout.column, new_volume, columns)
    grid = means.reshape(*means.shape[:2], *shape)
    content = held.reshape(shape) * grid
    excess = np.asarray((held - wanted).reshape(shape), np.float64)
    for axis, passed in enumerate(passed_on(excess)):
        values, change = (np.moveaxis(one, axis + 2, -1) for one in (grid, content))
        passed = np.moveaxis(passed, axis, -1)
        carried = passed * np.where(passed > 0.0, values[..., :-1], values[..., 1:])
        change[..., :-1] -= carried
        change[..., 1:] += carried
    means = content.reshape(means.shape) / wanted
    # levels become cells
    found = np.empty_like(fields)
    for alike, rows in columns_alike(
        layout.column, columns, np.argsort(layout.column, kind="stable")
    ):
        cells = np.linspace(0.0, 1.0, rows.shape[1] + 1)
        values = resample(levels[None], means[:, :, alike].swapaxes(1, 2), cells)
        found[:, rows] = np.take_along_axis(values, layout.row[rows][None], 2)
    return new_volume, found


def passed_on(excess: Array) -> list[Array]:
    """Volumes that pass the sides of columns along each axis, toward larger places where positive,
    so that nothing of their excess is left; none through the ends.

    Along a line that is the sum of the excess so far. On a grid it is the gradient of a potential,
    the least that does it, by cosine transforms.
    """
    if excess.ndim == 1:
        return [np.cumsum(excess)[:-1]]
    from scipy.fft import dctn, idctn  # few runs have a grid of columns

    waves = [2.0 * np.cos(np.pi * np.arange(n) / n) - 2.0 for n in excess.shape]
    eigenvalue = np.add.outer(*waves)
    eigenvalue[0, 0] = 1.0
    potential = np.asarray(idctn(np.asarray(dctn(excess)) / eigenvalue), np.float64)
    return [np.diff(potential, axis=axis) for axis in range(excess.ndim)]


def columns_alike(
    column: NDArray[np.intp], columns: int, order: NDArray[np.intp]
) -> list[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Columns (c,) of equally many particles, the fewest first, and the numbers (c, n) of those.

    Args:
        column: (N,) of each particle. order: (N,) of the numbers, column after column.
    """
    held = np.bincount(column, minlength=columns)
    start, groups = np.cumsum(held) - held, []
    for count in np.unique(held):
        alike = np.flatnonzero(held == count)
        groups.append((alike, order[start[alike, None] + np.arange(count)]))
    return groups


def resample(edges: Array, values: Array, new_edges: Array) -> Array:
    """Means (k, c, m) between new edges (m + 1,) of what has the means (k, c, n) between edges.

    Args:
        edges: (c, n + 1) of each of c columns, or (1, n + 1) of all. Old and new ones begin and end
            at the same places.
    """

    # van Leer's slope: the harmonic mean of both rises, none at an extreme
    size = np.diff(edges)
    rise = np.diff(values) / (0.5 * (size[:, 1:] + size[:, :-1]))
    up, down = rise[..., :-1], rise[..., 1:]
    slope, product = np.zeros_like(values), up * down
    both = np.where(product > 0.0, up + down, 1.0)
    slope[..., 1:-1] = np.where(product > 0.0, 2.0 * product / both, 0.0)
    # integrals up to the new edges
    content = values * size
    total = np.cumsum(content, axis=2) - content
    after = np.array([np.searchsorted(one, new_edges, side="right") for one in edges])
    # old part that each new edge lies in, and how far the edge is from both of its ends
    part = np.clip(after - 1, 0, size.shape[1] - 1)
    entered = new_edges - np.take_along_axis(edges, part, 1)
    remaining = entered - np.take_along_axis(size, part, 1)
    # tables of all columns in a row, so that one index serves for column and part
    fields, columns, old = values.shape
    place = part + old * np.arange(columns)[:, None]
    v, s, t = (one.reshape(fields, -1).take(place, axis=1) for one in (values, slope, total))
    # total before each new edge and integral of the linear piece up to it; means are differences
    return np.diff(t + entered * (v + 0.5 * s * remaining)) / np.diff(new_edges)
