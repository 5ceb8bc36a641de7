"""Particles laid out evenly below a relief.

The layers as fine as the finest are columns of equal cells. Below a relief of heights eta_c the
number of cells in each column follows its thickness, their sum stays what it is:

    n_c ~ (d + eta_c)/dz,    dz = mean (d + eta_c) / mean n,    z = -d + (k + 1/2) (d + eta_c)/n_c

with the depth d of these layers, rounded by largest remainders. So all cells are alike within
half of one in a column, how deep a relief ever is, and their volume is what lies below it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.layers import Layers

Array = NDArray[np.float64]


class ReliefLayout(NamedTuple):
    """Particles of the finest layers, which come first: position (2, n) [m], volume (n,) [m^2], and
    smallest and largest height of their cells [m]."""

    position: Array
    volume: Array
    heights: tuple[float, float]


def lay_below(layers: Layers, height: Array) -> ReliefLayout:
    """Particles of the finest layers of a 2-D domain below a relief.

    Args:
        height: (columns,) of the surface over each column of the first layer [m]; its lowest point
            lies above the lower end of these layers.

    Raises:
        ValueError: a column would hold no particle.
    """
    fine = int(np.count_nonzero(layers.thickness <= layers.spacing * (1.0 + 1e-9)))
    columns, depth = height.size, layers.fine_depth
    thickness = depth + height
    wanted = thickness / np.mean(thickness) * fine
    count = np.floor(wanted).astype(np.int64)
    rest = np.argsort(count - wanted, kind="stable")[: fine * columns - int(count.sum())]
    count[rest] += 1
    if count.min() < 1:
        raise ValueError("the relief reaches the lower end of the finest layers")
    column = np.repeat(np.arange(columns), count)
    row = np.concatenate([np.arange(n) for n in count])
    # numbers rise from the uppermost row down, as those of the lattice do
    order = np.lexsort((column, -row))
    column, row = column[order], row[order]
    size, (low, high) = thickness / count, layers.bounds[0]
    width = (high - low) / columns
    x, z = low + (column + 0.5) * width, (row + 0.5) * size[column] - depth
    position = np.array([x, z], dtype=np.float64)
    return ReliefLayout(position, width * size[column], (float(size.min()), float(size.max())))
