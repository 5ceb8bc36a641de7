"""Weights between coarse columns, and between those and the fine ones beside them.

    coarse, coarse    g = (A - A')/dx      face A between two cells, dx from middle to middle
    fine, coarse      g_im = sum_k g_ik c_km

A linear temperature flows exactly through a face of a grid [m^(d-2)], so that g needs no kernel.
A dummy k beside the fine columns has the mean temperature over its width of straight lines between
the coarse cells there, sum_m c_km T_m: what it gives to a fine particle is shared among these
cells by the same c_km. So g_im is symmetric, and heat is conserved to rounding.

Pairs of fine and coarse particles carry heat through faces of the grid, too, as wide as a support
beside the fine columns. A' is what these conduct at unit gradient, g_im |x_m - x_i| of each pair
that crosses the face on the line of m: all of it beyond the fine columns, and half of it along
them, where the other half is that of the fine particle's line.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.coarse_columns import NONE, CoarseColumns, linear_means
from lasersph.particles.filling import Beside, Filling

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]


class PairRows(NamedTuple):
    """Pairs on the host: row i and neighbor j of each, and its weight g [m^(d-2)]; rows rise."""

    row: Numbers
    neighbor: NDArray[Any]
    weight: Array


def pairs_beside(filling: Filling, fine: PairRows) -> tuple[PairRows, PairRows]:
    """All pairs of a body with its dummies, and those of fine and coarse particles, each once.

    Args:
        fine: pairs of the fine particles with what they see, dummies included.
    """
    beside = filling.beside
    assert beside is not None
    crossing = _crossing(filling, beside, fine)
    coarse = _coarse_pairs(filling, beside, crossing)
    # rows of the fine particles come first
    return _together(fine, coarse), crossing


def without_joined(filling: Filling, whole: PairRows, crossing: PairRows) -> PairRows:
    """All pairs of a body, with coarse particles in the place of dummies beside the fine ones."""
    assert filling.beside is not None
    is_joined = np.zeros(filling.position.shape[1], bool)
    is_joined[filling.beside.joined] = True
    stays = ~is_joined[whole.neighbor]
    old = PairRows(whole.row[stays], whole.neighbor[stays], whole.weight[stays])
    i, m, g = crossing
    return _sorted(_together(old, crossing, PairRows(m, i, g)))


def _crossing(filling: Filling, beside: Beside, fine: PairRows) -> PairRows:
    """Pairs of fine and coarse particles, each once."""
    # pairs with dummies beside the fine columns, and which of these they are
    place = np.full(filling.position.shape[1], NONE)
    place[beside.joined] = np.arange(beside.joined.size)
    pair = np.flatnonzero((place[fine.neighbor] != NONE) & (fine.weight > 0.0))
    used, which = np.unique(place[fine.neighbor[pair]], return_inverse=True)
    dummy, cell, share = _cells_of_dummies(filling, beside, used)

    # a term for each cell of each pair's dummy
    terms = np.bincount(dummy, minlength=used.size)
    start = np.cumsum(terms) - terms
    repeated = np.repeat(np.arange(pair.size), terms[which])
    first = np.cumsum(terms[which]) - terms[which]
    term = start[which[repeated]] + np.arange(repeated.size) - first[repeated]
    chosen = pair[repeated]
    i, m, g = fine.row[chosen], cell[term], fine.weight[chosen] * share[term]

    # pairs that meet in several dummies are one
    key, where = np.unique(i * filling.count + m, return_inverse=True)
    total = np.bincount(where, g).astype(np.float64)
    return PairRows(key // filling.count, key % filling.count, total)


def _cells_of_dummies(
    filling: Filling, beside: Beside, used: Numbers
) -> tuple[Numbers, Numbers, Array]:
    """Dummy, coarse particle and share c of each term of the dummies `used`, in their order."""
    columns, place = beside.columns, beside.place[:, used]
    width = filling.width[:, beside.joined[used]]
    layer = np.searchsorted(columns.edges[-1], -place[-1]) - 1
    dummy, share = np.arange(used.size), np.ones(used.size)
    index: tuple[Numbers, ...] = (layer,)
    # along each axis the cells beside the fine columns on the dummy's side, or all
    for axis, center in enumerate(columns.centers[:-1]):
        x, half = place[axis], 0.5 * width[axis]
        low, high = columns.layers.fine_bounds[axis]
        side = np.where(x < low, -1, np.where(x > high, 1, 0))
        found = []
        fine = columns.fine[axis]
        for which, part in (
            (-1, slice(0, fine.start)),
            (0, slice(None)),
            (1, slice(fine.stop, None)),
        ):
            chosen = np.flatnonzero(side == which)
            if chosen.size:
                k, node, c = linear_means(center[part], (x - half)[chosen], (x + half)[chosen])
                found.append((chosen[k], node + (part.start or 0), c))
        k, node, c = (np.concatenate(parts) for parts in zip(*found, strict=True))
        order = np.argsort(k, kind="stable")
        k, node, c = k[order], node[order], c[order]
        # every term so far with every one along this axis
        count = np.bincount(k, minlength=used.size)
        start = np.cumsum(count) - count
        repeated = np.repeat(np.arange(dummy.size), count[dummy])
        first = np.cumsum(count[dummy]) - count[dummy]
        term = start[dummy[repeated]] + np.arange(repeated.size) - first[repeated]
        dummy, share = dummy[repeated], share[repeated] * c[term]
        index = (*(one[repeated] for one in index), node[term])
    is_there = share != 0.0
    cell = columns.number[index]
    return dummy[is_there], cell[is_there], share[is_there]


def _coarse_pairs(filling: Filling, beside: Beside, crossing: PairRows) -> PairRows:
    """Pairs of coarse cells with the next ones, and with dummies beyond the faces of the block."""
    columns, dimension = beside.columns, filling.position.shape[0]
    found: list[PairRows] = []
    outer = filling.position.shape[1] - beside.owner.size + np.arange(beside.owner.size)
    for axis in range(dimension):
        along = columns.array_axis(axis, dimension)
        area, size = columns.area(axis), columns.sizes[axis]

        # g = (A - A')/dx between neighbors along the axis
        number = np.moveaxis(columns.number, along, -1)
        left, right = number[..., :-1], number[..., 1:]
        there = (left != NONE) & (right != NONE)
        free = np.maximum(area - _taken(filling, columns, crossing, axis), 0.0)
        distance = 0.5 * (size[:-1] + size[1:])
        g = (np.moveaxis(free, along, -1)[..., 1:-1] / distance)[there]
        one, other = left[there], right[there]
        found += [PairRows(one, other, g), PairRows(other, one, g)]

        # dummies beyond the faces normal to the axis; areas of their cells' outer faces
        faces = np.flatnonzero(beside.axis == axis)
        owner, dummy = beside.owner[faces], outer[faces]
        cell = tuple(place[owner - columns.first] for place in columns.cells)
        x, own = filling.position[axis, dummy], filling.position[axis, owner]
        above = (x > own) if axis < dimension - 1 else (x < own)
        plane = [one + (above if k == axis else 0) for k, one in enumerate(cell)]
        outside = area[plane[-1], *plane[:-1]]
        found.append(PairRows(owner, dummy, outside / np.abs(x - own)))
    return _sorted(_together(*found))


def _taken(filling: Filling, columns: CoarseColumns, crossing: PairRows, axis: int) -> Array:
    """Heat that pairs of fine and coarse particles conduct through the faces normal to an axis at
    unit gradient, A' [m^(d-1)], in the shape of `CoarseColumns.area`."""
    dimension = filling.position.shape[0]
    is_depth = axis == dimension - 1
    cell = [place[crossing.neighbor - columns.first] for place in columns.cells]
    edges = columns.edges[axis]
    x = (-1.0 if is_depth else 1.0) * filling.position[axis, crossing.row]
    # faces between the fine particle and its cell
    c = cell[axis]
    first, last = np.searchsorted(edges, x, side="right"), np.searchsorted(edges, x, side="left")
    is_up = columns.centers[axis][c] > x
    low, high = np.where(is_up, first, c + 1), np.where(is_up, c, last - 1)
    flux = 0.5 * crossing.weight * np.abs(columns.centers[axis][c] - x)

    # half of it on the line of the cell, and the rest where its faces lie beyond the fine columns
    shape = [size.size for size in columns.sizes]
    shape[axis] += 2
    total = np.zeros(int(np.prod(shape)))
    spans = [(low, high)]
    if not is_depth:
        fine = columns.fine[axis]
        spans.append(
            (
                np.where(is_up, np.maximum(low, fine.stop + 1), low),
                np.where(is_up, high, np.minimum(high, fine.start - 1)),
            )
        )
    for begin, end in spans:
        crossed = end >= begin
        for plane, sign in ((begin, 1.0), (end + 1, -1.0)):
            place = [one[crossed] for one in cell]
            place[axis] = plane[crossed]
            flat = np.ravel_multi_index((place[-1], *place[:-1]), (shape[-1], *shape[:-1]))
            total += np.bincount(flat, sign * flux[crossed], minlength=total.size)
    summed = np.cumsum(
        total.reshape(shape[-1], *shape[:-1]), axis=columns.array_axis(axis, dimension)
    )
    return summed.take(np.arange(shape[axis] - 1), axis=columns.array_axis(axis, dimension))


def _together(*parts: PairRows) -> PairRows:
    """All pairs of several lists, one list after the other."""
    return PairRows(
        np.concatenate([one.row for one in parts]),
        np.concatenate([one.neighbor for one in parts]),
        np.concatenate([one.weight for one in parts]),
    )


def _sorted(pairs: PairRows) -> PairRows:
    """Pairs in the order of their rows, those of a row as they come."""
    order = np.argsort(pairs.row, kind="stable")
    return PairRows(pairs.row[order], pairs.neighbor[order], pairs.weight[order])
