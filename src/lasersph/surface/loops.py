"""Loops of a moving surface: from its heights to the particles, and back.

Heights are given at nodes in the middle of their columns, two more at either end of each axis:
tables in which the last axis runs fastest, with the place of the first column `start`, 1/width
`inverse_width` and the number of columns along each of the d - 1 axes. Places are counted in
columns from the lower ends. Beyond an end the surface goes on as its kind says: PINNED (not at
all), MIRROR, PERIODIC; what particles give to columns comes from there in the same way, see
`column_loops`.
"""

from __future__ import annotations

from math import floor, sqrt

from lasersph.compute.vectors import dot, vector

PINNED, MIRROR, PERIODIC = 0.0, 1.0, 2.0
"""Kinds of ends in loops. Format: names as numbers."""


def node_place(x, start, inverse_width):
    """Place among the nodes along each axis, of which two lie before the first column."""
    return vector(*((x[k] - start[k]) * inverse_width[k] + 1.5 for k in range(len(start))))


def node_before(place, nodes):
    """Node before a place along each axis; the first and the last cell go on beyond the ends."""
    return vector(*(min(max(floor(place[k]), 0.0), nodes[k] - 2.0) for k in range(len(nodes))))


def number_of(place, counts):
    """Number of a node or column, from its place along each axis."""
    if len(counts) == 1:
        return int(place[0])
    return int(place[0] * counts[1] + place[1])


def total_of(counts):
    """Number of all columns, that of no column."""
    if len(counts) == 1:
        return int(counts[0])
    return int(counts[0] * counts[1])


def linear(place, low, nodes, values):
    """Value between the nodes around a place, of numbers or vectors."""
    number = number_of(low, nodes)
    s = place[0] - low[0]
    if len(nodes) == 1:
        return (1.0 - s) * values[number] + s * values[number + 1]
    # at the lower and the upper node of x, then between them
    t, beyond = place[1] - low[1], number + int(nodes[1])
    lower = (1.0 - t) * values[number] + t * values[number + 1]
    upper = (1.0 - t) * values[beyond] + t * values[beyond + 1]
    return (1.0 - s) * lower + s * upper


def cubic(s, a, b, m, n):
    """Cubic with the values a, b at s = 0 and 1, and the slopes m, n there."""
    return a + s * (m + s * (3.0 * (b - a) - 2.0 * m - n + s * (2.0 * (a - b) + m + n)))


def cubic_slope(s, a, b, m, n):
    """Slope of `cubic`."""
    return m + s * (2.0 * (3.0 * (b - a) - 2.0 * m - n) + 3.0 * s * (2.0 * (a - b) + m + n))


def surface_at(place, low, nodes, width, height, slope, twist):
    """Height of the surface [m] and its slopes: cubic along each axis.

    Args:
        width: of a column along each axis [m]. height, slope, twist: tables of eta [m], its slopes
            along each axis, and eta_xy [1/m], which a line has not.
    """
    number = number_of(low, nodes)
    s, w = place[0] - low[0], width[0]
    a, b = height[number], height[number + 1]
    if len(nodes) == 1:
        m, n = w * slope[number][0], w * slope[number + 1][0]
        return cubic(s, a, b, m, n), vector(cubic_slope(s, a, b, m, n) / w)

    # along x at the lower and the upper node of y: height and slope along y, and their slopes
    t, h, beyond = place[1] - low[1], width[1], number + int(nodes[1])
    c, d = height[beyond], height[beyond + 1]
    m, n = w * slope[number][0], w * slope[beyond][0]
    p, q = w * slope[number + 1][0], w * slope[beyond + 1][0]
    low_height, low_x = cubic(s, a, c, m, n), cubic_slope(s, a, c, m, n)
    high_height, high_x = cubic(s, b, d, p, q), cubic_slope(s, b, d, p, q)
    a, c = h * slope[number][1], h * slope[beyond][1]
    m, n = h * w * twist[number], h * w * twist[beyond]
    low_y, low_xy = cubic(s, a, c, m, n), cubic_slope(s, a, c, m, n)
    b, d = h * slope[number + 1][1], h * slope[beyond + 1][1]
    p, q = h * w * twist[number + 1], h * w * twist[beyond + 1]
    high_y, high_xy = cubic(s, b, d, p, q), cubic_slope(s, b, d, p, q)

    # then along y between them
    return (
        cubic(t, low_height, high_height, low_y, high_y),
        vector(
            cubic(t, low_x, high_x, low_xy, high_xy) / w,
            cubic_slope(t, low_height, high_height, low_y, high_y) / h,
        ),
    )


def surface_over(x, start, inverse_width, nodes, height, slope, twist):
    """Height [m] and slopes of the surface over a particle."""
    place = node_place(x, start, inverse_width)
    width = vector(*(1.0 / inverse_width[k] for k in range(len(inverse_width))))
    return surface_at(place, node_before(place, nodes), nodes, width, height, slope, twist)


def below_surface(x, start, inverse_width, nodes, height, slope, twist):
    """Depth of a particle below the surface, along z [m]."""
    top, _ = surface_over(x, start, inverse_width, nodes, height, slope, twist)
    return top - x[-1]


def surface_geometry(x, start, inverse_width, nodes, height, slope, twist, near, far, min_distance):
    """Marks, depth along z, normal, distance from the tangent, and the way to the ghost across it.

    Args:
        near, far: depths that are at and near the surface [m]. min_distance: least distance from
            it [m], for particles that have just come out.
    """
    # the cubic of the surface over the particle
    top, inclination = surface_over(x, start, inverse_width, nodes, height, slope, twist)
    depth = top - x[-1]

    # unit normal, and the distance from the tangent: both turn with the slope
    S = sqrt(1.0 + dot(inclination, inclination))
    distance = max(depth / S, min_distance)
    n = vector(*(-inclination[k] / S for k in range(len(inclination))), 1.0 / S)
    return (
        (1.0 if depth < near else 0.0),
        (1.0 if depth < far else 0.0),
        depth,
        n,
        distance,
        2.0 * distance * n,
    )


def surface_values(
    x, n, distance, start, inverse_width, nodes, shear, strain_rate, p_b, T_line, gradient
):
    """Velocity of a ghost over its source, its tangential part, pressure, temperature, gradient.

    2 d (s - n div_s v) [m/s], the last since nothing is compressed, with s the tangential part of
    dv/dn: du_t/dn along the tangent of a line; of a grid its parts along x and y are given.
    """
    place = node_place(x, start, inverse_width)
    low = node_before(place, nodes)
    s, b = linear(place, low, nodes, shear), linear(place, low, nodes, strain_rate)
    # vector of the tangent plane: s t of a line, s_z = -(s_x n_x + s_y n_y)/n_z of a grid
    p, T = linear(place, low, nodes, p_b), linear(place, low, nodes, T_line)
    slope = linear(place, low, nodes, gradient)
    if len(x) == 2:
        jump = 2.0 * distance * vector(s[0] * n[1] - b * n[0], -s[0] * n[0] - b * n[1])
        return jump, 2.0 * distance * s[0], p, T, slope
    along = 2.0 * distance * vector(s[0], s[1], -(s[0] * n[0] + s[1] * n[1]) / n[2])
    return along - 2.0 * distance * b * n, along, p, T, slope


def column_place(x, start, inverse_width, columns):
    """Column below which a particle lies, along each axis."""
    return vector(
        *(
            min(max(floor((x[k] - start[k]) * inverse_width[k]), 0.0), columns[k] - 1.0)
            for k in range(len(start))
        )
    )


def column_of(x, flows, start, inverse_width, columns):
    """Column of a particle that flows; the number of all for others."""
    if flows <= 0.0:
        return total_of(columns)
    return number_of(column_place(x, start, inverse_width, columns), columns)


def at_column(x, depth, flows, start, inverse_width, columns, reach):
    """Column of a particle that flows less than its `reach` below the surface; the number of all
    for others."""
    column = column_of(x, flows, start, inverse_width, columns)
    if column < total_of(columns) and depth >= reach[column]:
        return total_of(columns)
    return column


def hold_column(x, flows, start, inverse_width, columns, is_molten):
    """1 where a particle flows in a column that moves."""
    return flows * is_molten[number_of(column_place(x, start, inverse_width, columns), columns)]


def column_above(x, start, inverse_width, columns, bottom):
    """Column of a particle above a height; the number of all for others."""
    if x[-1] <= bottom:
        return total_of(columns)
    return number_of(column_place(x, start, inverse_width, columns), columns)


def confined(x, flows, start, inverse_width, nodes, height, slope, twist, min_depth):
    """Place of a particle [m] that flows, at least `min_depth` below the surface."""
    if flows <= 0.0:
        return 1.0 * x
    top, _ = surface_over(x, start, inverse_width, nodes, height, slope, twist)
    return vector(*(x[k] for k in range(len(x) - 1)), min(x[-1], top - min_depth))


def inner_weight(g_ij, across_j):
    """Weight of a pair for the pressure: 0 toward ghosts across the surface."""
    return g_ij * (1.0 - across_j)


def mean_weight(g_ij, swapped_ij, across_j):
    """Weight of a pair: toward a ghost across the surface the harmonic mean of both ways.

    It is symmetric, and 0 where one of both lies beyond the support: its row has no such pair.
    """
    if across_j > 0.0:
        return 2.0 * g_ij * swapped_ij / max(g_ij + swapped_ij, 1.0e-300)
    return 1.0 * g_ij


def given_pressure(g_ij, across_j, distance_i, distance_j, p_b_j):
    """Boundary coefficient of a pair toward a ghost across the surface, and that times p_b; and the
    length of surface over which the pair passes on a stress [m].

    The ghost's pressure continues the line from particle i through p_b at the surface.
    """
    length = across_j * g_ij * (distance_i + distance_j)
    a = length / distance_i
    return a, a * p_b_j, length


def given_pressure_of_row(total_0, total_1, total_2):
    """Boundary coefficient of a particle, the mean of p_b [Pa], and the length [m]."""
    return total_0, total_1 / max(total_0, 1.0e-300), total_2


def passed_on(x, jump, start, inverse_width, nodes, share):
    """Jump with which pairs that see a share of the surface pass on the whole stress [m/s]."""
    place = node_place(x, start, inverse_width)
    return jump / linear(place, node_before(place, nodes), nodes, share)
