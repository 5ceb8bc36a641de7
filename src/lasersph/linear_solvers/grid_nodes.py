"""What happens at one node of a grid: loops of `grid_correction`, as plain functions.

A level has `columns` times `lines` nodes, numbered line after line within a column; node k lies in
column c and line m. Where an axis is periodic (`x_wraps`, `z_wraps`) its last node is a neighbor of
its first. Node I stands for the volume s_I^2, and bilinear elements couple the nodes by

    (K x)_I = sum_J k_IJ s_I s_J (x_I - x_J) + a_I x_I

where k_IJ [1/m^2] is `across` toward the next column, `along` toward the next line and `aslant`
toward the nodes of both [Strang1973]. Arrays called all_... are read at other nodes and have a 0
behind the last node, which stands for every place outside.
"""

from __future__ import annotations

from math import sqrt


def before(c, count, wraps):
    """Number along an axis before c; -1 outside."""
    if wraps > 0 and c == 0:
        return count - 1
    return c - 1


def after(c, count, wraps):
    """Number along an axis after c; -1 outside."""
    if c + 1 < count:
        return c + 1
    if wraps > 0:
        return 0
    return -1


def node(c, m, columns, lines):
    """Number of the node in column c and line m; that behind the last where either is outside."""
    return c * lines + m if c >= 0 and m >= 0 else columns * lines


def around(c, m, all_y, columns, lines, x_wraps, z_wraps, across, along, aslant):
    """sum_J k_IJ y_J over the eight nodes around that in column c and line m."""
    left = before(c, columns, x_wraps)
    right = after(c, columns, x_wraps)
    below = before(m, lines, z_wraps)
    above = after(m, lines, z_wraps)
    sides = all_y[node(left, m, columns, lines)] + all_y[node(right, m, columns, lines)]
    ends = all_y[node(c, below, columns, lines)] + all_y[node(c, above, columns, lines)]
    first = all_y[node(left, below, columns, lines)] + all_y[node(left, above, columns, lines)]
    second = all_y[node(right, below, columns, lines)] + all_y[node(right, above, columns, lines)]
    return across * sides + along * ends + aslant * (first + second)


def root(C):
    """Square root of a node's volume."""
    return sqrt(max(C, 0.0))


def diagonal(c, m, s, a, all_s, columns, lines, x_wraps, z_wraps, across, along, aslant, damping):
    """d without a over s, and the damped inverse of d = K_II; 0 where nothing is around."""
    total = around(c, m, all_s, columns, lines, x_wraps, z_wraps, across, along, aslant)
    d = s * total + a
    if d <= 0.0:
        return total, 0.0
    return total, damping / d


def rest(c, m, s, d, a, x, r, all_y, columns, lines, x_wraps, z_wraps, across, along, aslant):
    """r - K x, with y = s x."""
    total = around(c, m, all_y, columns, lines, x_wraps, z_wraps, across, along, aslant)
    return r - s * (d * x - total) - a * x


def sweep(c, m, s, d, a, x, r, v, all_y, columns, lines, x_wraps, z_wraps, across, along, aslant):
    """One damped Jacobi sweep, x + v (r - K x)."""
    total = around(c, m, all_y, columns, lines, x_wraps, z_wraps, across, along, aslant)
    return x + v * (r - s * (d * x - total) - a * x)


def started(total, v, s):
    """Right-hand side, first damped Jacobi sweep from 0, and s times it."""
    x = v * total
    return total, x, s * x


def lower_end(c, step):
    """First coarse node that the fine node c lies between: of axes halved, kept or dropped."""
    if step > 0:
        return c // step
    return 0


def upper_end(c, step, coarse, wraps):
    """Second coarse node; the first once more where c lies on it."""
    if step > 0:
        number = (c + step - 1) // step
        return number - coarse if wraps > 0 and number >= coarse else number
    return 0


def added(c, m, s, x, coarse_x, x_step, z_step, coarse_columns, coarse_lines, x_wraps, z_wraps):
    """x + P e, with e the mean of the coarse nodes that the node lies between; and s times it."""
    c0 = lower_end(c, x_step) * coarse_lines
    c1 = upper_end(c, x_step, coarse_columns, x_wraps) * coarse_lines
    m0 = lower_end(m, z_step)
    m1 = upper_end(m, z_step, coarse_lines, z_wraps)
    first = coarse_x[c0 + m0] + coarse_x[c0 + m1]
    second = coarse_x[c1 + m0] + coarse_x[c1 + m1]
    new = x + 0.25 * (first + second)
    return new, s * new


def first_of(c, step):
    """First fine node around the coarse node c."""
    if step > 0:
        return c * step - step + 1
    return 0


def number_of(step, count):
    """How many fine nodes lie around a coarse node."""
    if step > 0:
        return 2 * step - 1
    return count


def share(c, fine, step):
    """Weight of a fine node toward the coarse node c: 1 on it, half beside it."""
    return 1.0 if step == 0 or fine == c * step else 0.5


def inside(c, count, wraps):
    """Number c along an axis, wrapped where that is periodic; -1 outside."""
    if wraps > 0:
        if c < 0:
            return c + count
        return c - count if c >= count else c
    if c < count:
        return c
    return -1


def collected(c, m, v, s, all_r, columns, lines, x_step, z_step, x_wraps, z_wraps):
    """P^T r, the sum of the fine nodes' values with their shares, as `started`.

    columns, lines: numbers of the fine nodes; c, m, v and s belong to the coarse node.
    """
    c_first = first_of(c, x_step)
    m_first = first_of(m, z_step)
    total = 0.0
    for i in range(number_of(x_step, columns)):
        column = inside(c_first + i, columns, x_wraps)
        for k in range(number_of(z_step, lines)):
            line = inside(m_first + k, lines, z_wraps)
            w = share(c, c_first + i, x_step) * share(m, m_first + k, z_step)
            total += w * all_r[node(column, line, columns, lines)]
    return started(total, v, s)


def product(k, inverse, all_r, count):
    """Row of a dense matrix times r."""
    total = 0.0
    for j in range(count):
        total += inverse[k * count + j] * all_r[j]
    return total
