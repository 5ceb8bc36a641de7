"""Loops of a moving surface: from its line to the particles, and back.

The line is given at nodes in the middle of its columns, two more at either end: tables, with the
place of the first column `start`, 1/width `inverse` and the number of columns. Places are counted
in columns from the left end of the line. Beyond an end the line goes on as its kind says: PINNED
(not at all), MIRROR, PERIODIC; what particles give to columns comes from there in the same way.
"""

from __future__ import annotations

from math import floor, sqrt

from lasersph.compute.vectors import vector

PINNED, MIRROR, PERIODIC = 0.0, 1.0, 2.0
"""Kinds of ends in loops. Format: names as numbers."""
TEMPERATURE_DEPTH = 1.5
"""Particles whose temperature is that of the surface lie within as many spacings of it. Geometry:
two rows; with one a column is empty where particles part."""
VELOCITY_DEPTH = 2.5
"""The same for velocities, which are carried on with their curvature. Geometry: a parabola of the
depth takes two rows."""
LEAST_SHARE = 0.05
"""Least weight of such a particle, which falls with its distance from the surface. Derived: the
first row, 0.5 spacings deep, has the weight 0.67, the second at 1.5 would have none and a gap in
the first no value; with 0.05 it has 7 %, and the temperature is that of 0.57 spacings instead of
0.5."""
LEAST_DEPTH = 0.2
"""Least variance of the squares of depths, of all, with which a parabola is fitted. Guard: two rows
have a half, one whose particles lie a tenth of a spacing off 0.13."""
WINDOW = 2.5
"""Columns at either side from which a column takes values of particles. Accuracy: five columns hold
at least ten particles, and smoothing over 0.3 um comes after."""


def node_place(x, start, inverse):
    """Place among the nodes, of which two lie before the first column."""
    return (x - start) * inverse + 1.5


def node_before(place, nodes):
    """Number of the node before a place; the first and the last segment go on beyond the ends."""
    return int(min(max(floor(place), 0.0), nodes - 2.0))


def linear(place, low, values):
    """Value between the nodes `low` and the next."""
    share = place - low
    return (1.0 - share) * values[low] + share * values[low + 1]


def line_height(place, low, width, height, slope):
    """Height of the line [m]: cubic with the heights and slopes of two nodes."""
    s, a, b = place - low, height[low], height[low + 1]
    m, n = width * slope[low], width * slope[low + 1]
    return a + s * (m + s * (3.0 * (b - a) - 2.0 * m - n + s * (2.0 * (a - b) + m + n)))


def line_slope(place, low, width, height, slope):
    """Slope of `line_height`."""
    s, a, b = place - low, height[low], height[low + 1]
    m, n = width * slope[low], width * slope[low + 1]
    return (m + s * (2.0 * (3.0 * (b - a) - 2.0 * m - n) + 3.0 * s * (2.0 * (a - b) + m + n))) / (
        width
    )


def below_line(x, start, inverse, nodes, height, slope):
    """Depth of a particle below the line, along z [m]."""
    place = node_place(x[0], start, inverse)
    low = node_before(place, nodes)
    return line_height(place, low, 1.0 / inverse, height, slope) - x[1]


def surface_geometry(x, start, inverse, nodes, height, slope, near, far, min_distance):
    """Marks, depth along z, normal, distance from the tangent, and the way to the ghost across it.

    Args:
        near, far: depths that are at and near the surface [m]. min_distance: least distance from
            it [m], for particles that have just come out.
    """
    # place among the nodes, and the cubic of the line there
    place = node_place(x[0], start, inverse)
    low = node_before(place, nodes)
    inclination = line_slope(place, low, 1.0 / inverse, height, slope)
    depth = line_height(place, low, 1.0 / inverse, height, slope) - x[1]

    # unit normal, and the distance from the tangent: both turn with the slope
    S = sqrt(1.0 + inclination * inclination)
    distance = max(depth / S, min_distance)
    n = vector(-inclination / S, 1.0 / S)
    return (
        (1.0 if depth < near else 0.0),
        (1.0 if depth < far else 0.0),
        depth,
        n,
        distance,
        2.0 * distance * n,
    )


def surface_values(
    x, n, distance, start, inverse, nodes, shear, strain_rate, p_b, T_line, gradient
):
    """Velocity of a ghost over its source, its tangential part, pressure, temperature, gradient.

    2 d (du_t/dn t + du_n/dn n) [m/s] with du_n/dn = -du_t/ds, since nothing is compressed.
    """
    # du_t/dn and du_n/dn there, then 2 d times their vector sum
    place = node_place(x[0], start, inverse)
    low = node_before(place, nodes)
    a, b = linear(place, low, shear), linear(place, low, strain_rate)
    jump = 2.0 * distance * vector(a * n[1] - b * n[0], -a * n[0] - b * n[1])
    return (
        jump,
        2.0 * distance * a,
        linear(place, low, p_b),
        linear(place, low, T_line),
        linear(place, low, gradient),
    )


def column_of(x, flows, start, inverse, columns):
    """Column of a particle that flows; `columns` for others."""
    if flows <= 0.0:
        return int(columns)
    return int(min(max(floor((x[0] - start) * inverse), 0.0), columns - 1.0))


def source_column(c, columns, low_end, high_end):
    """Column whose particles are seen in column c, which may lie beyond an end; -1 for none."""
    if c < 0:
        if low_end == PERIODIC:
            return c + columns
        return -1 - c if low_end == MIRROR else -1
    if c >= columns:
        if high_end == PERIODIC:
            return c - columns
        return 2 * columns - 1 - c if high_end == MIRROR else -1
    return c


def seen_place(place, c, columns, low_end, high_end):
    """Place at which a particle of `source_column` is seen."""
    if c < 0:
        return place - columns if low_end == PERIODIC else -place
    if c >= columns:
        return place + columns if high_end == PERIODIC else 2.0 * columns - place
    return place


def seen_sign(c, columns, low_end, high_end):
    """Sign of a velocity along x that is seen there."""
    if c < 0:
        return -1.0 if low_end == MIRROR else 1.0
    if c >= columns:
        return -1.0 if high_end == MIRROR else 1.0
    return 1.0


def seen_velocity(v, sign):
    """Velocity that is seen there: its part along x times that sign [m/s]."""
    return vector(sign * v[0], v[1])


def b_spline(distance):
    """Quadratic B-spline of a distance in columns, which has the integral 1."""
    if distance < 0.5:
        return 0.75 - distance * distance
    if distance < 1.5:
        return 0.5 * (1.5 - distance) * (1.5 - distance)
    return 0.0


def mean_velocity(k, row_start, member, x, v, V, flows, start, inverse, columns, low_end, high_end):
    """Mean velocity along the line of what flows around the k-th side of the columns [m/s]; how
    thick the solid is [m].

    Args:
        k: 0 for the left end. row_start, member: particles of each column. x, v: [m], [m/s].
        V: volume [m^2]. flows: 1 or 0.
    """
    side = int(k)
    flow, volume, solid = 0.0, 0.0, 0.0
    # particles of the columns around the side, with images beyond the ends
    for c in range(side - 2, side + 2):
        column = source_column(c, columns, low_end, high_end)
        if column >= 0:
            sign = seen_sign(c, columns, low_end, high_end)
            for p in range(row_start[column], row_start[column + 1]):
                j = member[p]
                x_j, v_j = x[j], v[j]
                place = seen_place((x_j[0] - start) * inverse, c, columns, low_end, high_end)
                # each with its volume and a B-spline of its distance
                share = b_spline(abs(place - side)) * V[j]
                flow += flows[j] * sign * share * v_j[0]
                volume += flows[j] * share
                solid += (1.0 - flows[j]) * share
    return flow / max(volume, 1.0e-300), solid * inverse


def thickness_of(k, row_start, member, V, inverse):
    """Sum of V over the particles of a column, over its width: how thick they are [m]."""
    total = 0.0
    for p in range(row_start[k], row_start[k + 1]):
        total += V[member[p]]
    return total * inverse


def at_column(x, depth, flows, start, inverse, columns, reach):
    """Column of a particle that flows less than its `reach` below the surface; `columns` for
    others."""
    column = column_of(x, flows, start, inverse, columns)
    if column < columns and depth >= reach[column]:
        return int(columns)
    return column


def hold_column(x, flows, start, inverse, columns, is_molten):
    """1 where a particle flows in a column that moves."""
    return flows * is_molten[int(min(max(floor((x[0] - start) * inverse), 0.0), columns - 1.0))]


def column_above(x, start, inverse, columns, bottom):
    """Column of a particle above a height; `columns` for others."""
    if x[1] <= bottom:
        return int(columns)
    return int(min(max(floor((x[0] - start) * inverse), 0.0), columns - 1.0))


def surface_velocity(
    k,
    row_start,
    member,
    x,
    depth,
    v,
    jump,
    T,
    start,
    inverse,
    columns,
    low_end,
    high_end,
    spacing,
):
    """Velocity [m/s] and temperature [K] of the surface in the middle of a column, and a weight.

    Fits to what the particles near the surface have, linear along it. Velocities are carried on to
    it by half their ghosts' jump, which leaves a parabola of the depth: that is fitted too. 0 and
    the weight 0 where there are no particles.
    """
    # moments of the place r along the surface and of the squared depth d
    center, middle = int(k), k + 0.5
    s_0, s_1, s_2 = 0.0, 0.0, 0.0
    s_d, s_1d, s_dd = 0.0, 0.0, 0.0
    # of the velocity, and of the temperature with the places that it is fitted to
    v_0, v_1, v_d = vector(0.0, 0.0), vector(0.0, 0.0), vector(0.0, 0.0)
    n_0, n_1, n_2 = 0.0, 0.0, 0.0
    T_0, T_1 = 0.0, 0.0

    # particles of five columns, with images beyond the ends
    for c in range(center - 2, center + 3):
        column = source_column(c, columns, low_end, high_end)
        if column >= 0:
            sign = seen_sign(c, columns, low_end, high_end)
            for p in range(row_start[column], row_start[column + 1]):
                j = member[p]
                layers = depth[j] / spacing
                if layers < VELOCITY_DEPTH:
                    x_j = x[j]
                    place = seen_place((x_j[0] - start) * inverse, c, columns, low_end, high_end)
                    # weights fall along the surface and with the depth
                    r, d = place - middle, layers * layers
                    near = max(1.0 - r * r / (WINDOW * WINDOW), 0.0)
                    share = max(1.0 - layers / VELOCITY_DEPTH, LEAST_SHARE) * near * near
                    # velocity carried on to the surface by half of the ghost's jump
                    v_j = seen_velocity(v[j] + 0.5 * jump[j], sign)
                    s_0 += share
                    s_1 += share * r
                    s_2 += share * r * r
                    s_d += share * d
                    s_1d += share * r * d
                    s_dd += share * d * d
                    v_0 += share * v_j
                    v_1 += share * r * v_j
                    v_d += share * d * v_j
                    # moments for the temperature, of the uppermost two layers alone
                    if layers < TEMPERATURE_DEPTH:
                        share = max(1.0 - layers / TEMPERATURE_DEPTH, LEAST_SHARE) * near * near
                        n_0 += share
                        n_1 += share * r
                        n_2 += share * r * r
                        T_0 += share * T[j]
                        T_1 += share * r * T[j]

    # linear fit of the temperature, the mean where the particles lie on one spot
    T_s, det = T_0 / max(n_0, 1.0e-300), n_0 * n_2 - n_1 * n_1
    if det > 1.0e-9 * n_0 * n_0:
        T_s = (n_2 * T_0 - n_1 * T_1) / det
    # cofactors of 1, r, d; without the parabola where all are as deep, a mean where all are in line
    c_0 = s_2 * s_dd - s_1d * s_1d
    c_1 = s_1d * s_d - s_1 * s_dd
    c_d = s_1 * s_1d - s_2 * s_d
    det = s_0 * c_0 + s_1 * c_1 + s_d * c_d
    if det <= LEAST_DEPTH * s_0 * s_2 * s_dd:
        c_0, c_1, c_d, det = s_2, -s_1, 0.0, s_0 * s_2 - s_1 * s_1
    if det <= 1.0e-9 * s_0 * c_0:
        c_0, c_1, c_d, det = 1.0, 0.0, 0.0, max(s_0, 1.0e-300)
    v_s = c_0 * v_0 + c_1 * v_1 + c_d * v_d
    return (
        vector(v_s[0] / det, v_s[1] / det),
        T_s,
        n_0,
    )


def below_surface(x, flows, start, inverse, nodes, height, slope, min_depth):
    """Place of a particle [m] that flows, at least `min_depth` below the line."""
    if flows <= 0.0:
        return 1.0 * x
    place = node_place(x[0], start, inverse)
    low = node_before(place, nodes)
    top = line_height(place, low, 1.0 / inverse, height, slope) - min_depth
    return vector(x[0], min(x[1], top))


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


def passed_on(x, jump, start, inverse, nodes, share):
    """Jump with which pairs that see a share of the surface pass on the whole stress [m/s]."""
    place = node_place(x[0], start, inverse)
    return jump / linear(place, node_before(place, nodes), share)
