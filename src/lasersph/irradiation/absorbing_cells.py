"""Beer and Lambert through particles that have moved, as pure functions of a grid of cells.

Columns and levels of cells of one spacing lie below the surface. A particle is as wide as a cell
and as high as its volume says, that of a cell where nothing has evaporated; it covers up to two of
them along each axis, by parts c_ik of their volume, which sum up to its volume over that of a cell.
A cell is as opaque as what lies in it, and takes of the light that enters its column

    tau_k = alpha w sum_i c_ik,    s_k = exp(-sum of tau above) (1 - exp(-tau_k))

which its particles share by their c_ik. So a column takes 1 - exp(-sum tau) of its light wherever
its particles lie, and no sum is scaled. On the lattice each cell holds one particle, whose share is
the exact one of its depth [Demuth2020, eq. (8)].
"""

from __future__ import annotations

from math import exp, floor

from lasersph.surface.columns import column_at_corner
from lasersph.surface.loops import total_of

THIN = 1e-6
"""Optical thickness below which 1 - exp(-tau) is taken as tau - tau^2 / 2. Rounding: exact to
1e-12."""


def cell_at_corner(
    x, depth, size, low, inverse_width, inverse_height, upper, lower, columns, levels
):
    """Cell at a corner of a particle's cell, its column, and the part c of a cell that lies in it.

    What reaches beyond an end or the surface counts for the cells next to it. The number behind
    the last one stands for what lies below all levels.

    Args:
        x: position [m]. depth: below the surface [m]. size: volume over that of a cell, 1 for a
            cube. low: lower ends [m]. inverse_width, inverse_height: of a cell, along each axis of
            the surface and along z [1/m]. upper: 1 where the corner is the upper one of an axis.
            lower: 1 for the lower level. columns, levels: their numbers.
    """
    c, share = column_at_corner(x, low, inverse_width, columns, upper)
    down = depth * inverse_height - 0.5 * size
    level = floor(down)
    beyond_z = down - level
    # c_ik is a product: part of the column, part of the height in this level
    share_z = min(1.0 - beyond_z, size)
    if lower > 0.0:
        share_z = max(beyond_z + (size - 1.0), 0.0)
    # what reaches beyond an end counts for the cell next to it
    r = int(min(max(level + lower, 0.0), levels))
    if r >= levels:
        return int(total_of(columns) * levels), c, 0.0 * share_z
    return int(c * levels + r), c, share * share_z


def optical_thickness(cover_j, tau_one):
    """Part of a cell's tau [1]; tau_one: of a cell that one particle fills."""
    return tau_one * cover_j


def add(a, b):
    """Sum of two numbers."""
    return a + b


def running_sum(k, total, totals, distance, levels):
    """Sum with that of the cell `distance` levels above [1]; doubled distances give the sum of all.

    Args:
        k: number of the cell. total: sum so far. totals: that of all cells.
            distance: a number of levels. levels: those of a column.
    """
    # the first `distance` cells of a column have none that far above them
    if k % levels < distance:
        return 1.0 * total
    return total + totals[k - distance]


def light_per_cover(tau, total, tau_one):
    """Share s_k of a cell over the sum of the c_ik in it [1].

    Args:
        tau: of the cell. total: of it and all above [1].
    """
    # (1 - exp(-tau_k)) / tau_k, times the light that is left above the cell, exp(-(sum - tau_k))
    taken = 1.0 - 0.5 * tau if tau < THIN else (1.0 - exp(-tau)) / tau
    return exp(tau - total) * taken * tau_one


def column_share(upper, cover_upper, lower, cover_lower, area, light):
    """Share of a column's light that a particle takes, times the area of the column [m^(d-1)].

    Args:
        upper, lower: its two cells in the column. light: table of `light_per_cover`.
    """
    return area * (cover_upper * light[upper] + cover_lower * light[lower])
