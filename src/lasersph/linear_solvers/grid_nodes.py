"""Loops of `grid_correction` at one node of a grid of d axes, as plain functions.

Node I stands for the volume s_I^2, and multilinear elements couple the nodes by

    (K x)_I = sum_J k_IJ s_I s_J (x_I - x_J) + a_I x_I

over the 3^d - 1 nodes J around I, with the couplings k_IJ [1/m^2] of `grid_levels` [Strang1973].
Every sum over other nodes is `gathered` from a table: numbers of the nodes and their weights follow
from the grid alone. Arrays called all_... are read at other nodes and have a 0 behind the last
node, which stands for every place outside.
"""

from __future__ import annotations

from math import sqrt

from lasersph.compute.vectors import multilinear


def gathered(places, weights, values):
    """sum_n w_n values[place_n], of as many places as there are weights."""
    total = 0.0
    for n in range(len(places)):
        total += weights[n] * values[places[n]]
    return total


def root(C):
    """Square root of a node's volume."""
    return sqrt(max(C, 0.0))


def diagonal(around, s, a, all_s, couplings, damping):
    """d without a over s, and the damped inverse of d = K_II; 0 where nothing is around."""
    total = gathered(around, couplings, all_s)
    d = s * total + a
    if d <= 0.0:
        return total, 0.0
    return total, damping / d


def residual(around, s, d, a, x, r, all_y, couplings):
    """r - K x, with y = s x."""
    total = gathered(around, couplings, all_y)
    return r - s * (d * x - total) - a * x


def sweep(around, s, d, a, x, r, v, all_y, couplings):
    """One damped Jacobi sweep, x + v (r - K x)."""
    total = gathered(around, couplings, all_y)
    return x + v * (r - s * (d * x - total) - a * x)


def started(total, v, s):
    """Right-hand side, first damped Jacobi sweep from 0, and s times it."""
    x = v * total
    return total, x, s * x


def collected(finer, v, s, all_r, shares):
    """P^T r, the sum of the finer nodes' values with their shares, as `started`."""
    return started(gathered(finer, shares, all_r), v, s)


def added(coarser, s, x, coarse_x, shares):
    """x + P e, with e the mean of the coarser nodes that the node lies between; and s times it."""
    new = x + gathered(coarser, shares, coarse_x)
    return new, s * new


def product(k, inverse, all_r, count):
    """Row of a dense matrix times r."""
    total = 0.0
    for j in range(count):
        total += inverse[k * count + j] * all_r[j]
    return total


def corner_sums(k, values, order, start, place, nothing):
    """Sums of a cell's values with their multilinear weights toward its 2^d corners.

    Sums over the particles of a cell run in the order of their numbers.

    Args:
        place: table of the particles' places in their cells, in the order of the cells.
            nothing: 2^d zeros.
    """
    total = 1.0 * nothing
    for p in range(start[k], start[k + 1]):
        total = total + values[order[p]] * multilinear(place[p])
    return total


def from_cells(cells, v, s, sums):
    """P^T r, the sums of the 2^d cells around a node, as `started`."""
    total = 0.0
    for n in range(len(cells)):
        # of cell n the node is corner n
        total += sums[cells[n]][n]
    return started(total, v, s)


def at_particle(place, cell, nodes, corners):
    """Multilinear interpolation of the nodes' values at a particle."""
    weights = multilinear(place)
    total = 0.0
    for n in range(len(weights)):
        total += weights[n] * nodes[corners[cell][n]]
    return total


def corrected(r, d, mask, place, cell, nodes, corners):
    """z = r / d + P e on particles with mask 1; and r z."""
    if mask <= 0.0:
        return 0.0, 0.0
    e = at_particle(place, cell, nodes, corners)
    z = r / d + e
    return z, r * z
