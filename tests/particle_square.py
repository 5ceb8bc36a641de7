"""Square of particles with the weights between them, as sparse and dense matrices."""

from types import SimpleNamespace

import numpy as np

from lasersph.linear_solvers.conjugate_gradient import PairOperator

SUPPORT = 3.75


def square(side):
    """Positions of side x side particles at distance 1, pairs within the support, their weights."""
    axis = np.arange(side) + 0.5
    position = np.stack([c.ravel() for c in np.meshgrid(axis, axis, indexing="ij")])
    farthest = int(SUPPORT)
    index = np.arange(side * side).reshape(side, side)
    rows, columns, weights = [], [], []
    for i in range(-farthest, farthest + 1):
        for k in range(-farthest, farthest + 1):
            distance = np.hypot(i, k)
            if 0 < distance < SUPPORT:
                here = index[max(0, -i) : side - max(0, i), max(0, -k) : side - max(0, k)]
                there = index[max(0, i) : side - max(0, -i), max(0, k) : side - max(0, -k)]
                rows.append(here.ravel())
                columns.append(there.ravel())
                weights.append(np.full(here.size, 0.05 * (1 - distance / SUPPORT) ** 3))
    row, column, weight = (np.concatenate(v) for v in (rows, columns, weights))
    order = np.lexsort((column, row))
    return position, row[order], column[order], weight[order]


def system(backend, side, *, boundary_coefficient=0.0):
    """Pair operator of a square of particles, and its weights on the host as (row, column, g)."""
    position, row, column, weight = square(side)
    count = side * side
    start = np.concatenate([[0], np.cumsum(np.bincount(row, minlength=count))])
    neighbors = SimpleNamespace(
        row_end=None,
        row_start=backend.asarray(start, "offset"),
        neighbor=backend.asarray(column, "index"),
        position=backend.asarray(position),
        support=backend.asarray(np.full(count, SUPPORT)),
        kernel=None,
        mean=None,
        period=(0.0, 0.0),
    )
    total = np.bincount(row, weight, minlength=count)
    operator = PairOperator(
        neighbors=neighbors,
        weights=backend.asarray(weight),
        boundary_coefficient=backend.asarray(np.full(count, boundary_coefficient)),
        total=backend.asarray(total),
    )
    return operator, (row, column, weight)


def dense(pairs, C, mask, s, boundary_coefficient):
    """A on the free particles, as a matrix of all with ones on the held diagonal."""
    row, column, weight = pairs
    A = np.zeros((C.size, C.size))
    A[row, column] = -s * weight
    A[np.arange(C.size), np.arange(C.size)] = C + s * (
        np.bincount(row, weight) + boundary_coefficient
    )
    A *= mask[:, None] * mask[None, :]
    return A + np.diag(1.0 - mask)


def right_side(count, side):
    """Rough and smooth parts."""
    x, z = np.divmod(np.arange(count), side)
    return np.cos(3.0 * x / side) + np.sin(5.0 * z / side) + 0.3 * np.cos(2.5 * np.arange(count))


def held_front(side):
    """Mask with a crooked line of held particles across the square."""
    mask = np.ones((side, side))
    column = np.arange(side)
    mask[side // 2 + column % 3, column] = 0.0
    return mask.ravel()
