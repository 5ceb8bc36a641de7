"""Between particles and the nodes of a grid: the other loops of `grid_correction`.

A particle at (u, w), in units of the spacing from the grid's corner, has the bilinear weights
(1 - |u - c|) (1 - |w - m|) toward the four nodes (c, m) of its cell. Sums over the particles of a
cell run in the order of their numbers.
"""

from __future__ import annotations

from lasersph.linear_solvers.grid_nodes import before, inside, node, started
from lasersph.particles.cell_grid import cell_along


def corner_sums(k, c, m, values, order, start, u, w):
    """Sums of a cell's values with their weights toward its four nodes; u and w in its order."""
    all_four = 0.0
    right = 0.0
    above = 0.0
    both = 0.0
    for p in range(start[k], start[k + 1]):
        value = values[order[p]]
        s = u[p] - c
        t = w[p] - m
        all_four += value
        right += s * value
        above += t * value
        both += s * t * value
    return all_four - right - above + both, above - both, right - both, both


def from_cells(c, m, v, s, sum_00, sum_01, sum_10, sum_11, cells, cell_lines, x_wraps, z_wraps):
    """P^T r, the sums of the cells around a node, as `started`."""
    left = before(c, cells, x_wraps)
    below = before(m, cell_lines, z_wraps)
    c = inside(c, cells, x_wraps)
    m = inside(m, cell_lines, z_wraps)
    total = sum_00[node(c, m, cells, cell_lines)] + sum_01[node(c, below, cells, cell_lines)]
    total += sum_10[node(left, m, cells, cell_lines)]
    total += sum_11[node(left, below, cells, cell_lines)]
    return started(total, v, s)


def at_particle(u, w, nodes, columns, lines, cells, cell_lines, x_wraps, z_wraps):
    """Bilinear interpolation of the nodes' values at a particle."""
    c = cell_along(u, cells)
    m = cell_along(w, cell_lines)
    s = u - c
    t = w - m
    c0 = c * lines
    c1 = inside(c + 1, columns, x_wraps) * lines
    m1 = inside(m + 1, lines, z_wraps)
    first = (1.0 - t) * nodes[c0 + m] + t * nodes[c0 + m1]
    second = (1.0 - t) * nodes[c1 + m] + t * nodes[c1 + m1]
    return (1.0 - s) * first + s * second


def corrected(r, d, mask, u, w, nodes, columns, lines, cells, cell_lines, x_wraps, z_wraps):
    """z = r / d + P e on particles with mask 1; and r z."""
    if mask <= 0.0:
        return 0.0, 0.0
    e = at_particle(u, w, nodes, columns, lines, cells, cell_lines, x_wraps, z_wraps)
    z = r / d + e
    return z, r * z
