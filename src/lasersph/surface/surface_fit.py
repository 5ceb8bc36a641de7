"""Velocity and temperature of a surface in the middle of its columns, from the particles near it.

Fits to what the particles near the surface have, linear along it. Velocities are carried on to it
by half their ghosts' jump, which leaves a parabola of the depth: that is fitted too. Light is
absorbed within the first row, so that its temperature is that of the surface; the second row, which
fills gaps of the first, has a part that is linear in the depth.
"""

from __future__ import annotations

from math import floor

from lasersph.compute.vectors import determinant, dot, inverse, matvec, outer, transpose, vector
from lasersph.surface.column_loops import (
    seen_places,
    seen_signs,
    source_columns,
)
from lasersph.surface.loops import number_of

TEMPERATURE_DEPTH = 1.5
"""Particles whose temperature is that of the surface lie within as many spacings of it. Geometry:
two rows; with one a column is empty where particles part."""
FIRST_ROW = 0.5
"""Depth of the first row, in spacings. Geometry: half of it lies above its middle."""
VELOCITY_DEPTH = 2.5
"""The same for velocities, which are carried on with their curvature. Geometry: a parabola of the
depth takes two rows."""
LEAST_SHARE = 0.05
"""Least weight of such a particle, which falls with its distance from the surface. Derived: the
first row, 0.5 spacings deep, has the weight 0.67, the second at 1.5 would have none and a gap in
the first no value; with 0.05 it has 7 %."""
LEAST_DEPTH = 0.2
"""Least share of what the depth adds to a fit, of all, with which it is fitted. Guard: the squares
of depths of two rows have a half, of one whose particles lie a tenth of a spacing off 0.13."""
WINDOW = 2.5
"""Columns at either side from which a column takes values of particles. Accuracy: five columns hold
at least ten particles, and smoothing over 0.3 um comes after."""


def fall_off(r):
    """Weight by the distance along an axis, in columns."""
    return max(1.0 - r * r / (WINDOW * WINDOW), 0.0)


def share_of(layers, reach, near):
    """Weight in a fit by the depth, in spacings, of those that count, and along the surface."""
    return max(1.0 - layers / reach, LEAST_SHARE) * near * near


def line_weights(m_0, m_1, m_2, m_d, m_1d, m_dd):
    """Weights of the moments 1, r and d of a field in its value at r = d = 0, and their divisor,
    by a fit to 1, r and d, whose moments with each other are given."""
    # cofactors of 1, r, d
    c_0 = m_2 * m_dd - m_1d * m_1d
    c_1 = m_1d * m_d - m_1 * m_dd
    c_d = m_1 * m_1d - m_2 * m_d
    det = m_0 * c_0 + m_1 * c_1 + m_d * c_d
    # without the depth where all are as deep, and the mean where all are on one spot
    if det <= LEAST_DEPTH * m_0 * m_2 * m_dd:
        c_0, c_1, c_d, det = m_2, -m_1, 0.0, m_0 * m_2 - m_1 * m_1
    if det <= 1.0e-9 * m_0 * c_0:
        c_0, c_1, c_d, det = 1.0, 0.0, 0.0, max(m_0, 1.0e-300)
    return c_0, c_1, c_d, det


def grid_weights(M, m_d, m_dd):
    """Weights of the moments b = (1, r_x, r_y) and d, as `line_weights` has them, divided.

    Args:
        M: moments of b with b, 3 x 3. m_d: of b with d. m_dd: of d with d.
    """
    # the depth is eliminated first
    first, above = vector(1.0, 0.0, 0.0), max(m_dd, 1.0e-300)
    R, share = M - outer(m_d, m_d) / above, 1.0
    # without it where all are as deep, and the mean where the particles lie in a line
    all_of = M[0, 0] * M[1, 1] * M[2, 2]
    if determinant(R) <= LEAST_DEPTH * all_of:
        R, share = 1.0 * M, 0.0
    w = first / max(M[0, 0], 1.0e-300)
    if determinant(R) > 1.0e-9 * all_of:
        w = matvec(inverse(R), first)
    else:
        share = 0.0
    return w, -share * dot(m_d, w) / above


def surface_velocity_of_line(
    k, row_start, member, x, depth, v, jump, T, start, inverse_width, columns, low_end, high_end,
    spacing,
):  # fmt: skip
    """Velocity [m/s] and temperature [K] of the surface in the middle of a column, and a weight.

    0 and the weight 0 where there are no particles.
    """
    # moments of the place r along the surface and of the squared depth d
    center, middle = int(k), k + 0.5
    s_0, s_1, s_2 = 0.0, 0.0, 0.0
    s_d, s_1d, s_dd = 0.0, 0.0, 0.0
    # of the velocity, and of the temperature with the places that it is fitted to
    v_0, v_1, v_d = vector(0.0, 0.0), vector(0.0, 0.0), vector(0.0, 0.0)
    n_0, n_1, n_2 = 0.0, 0.0, 0.0
    n_d, n_1d, n_dd = 0.0, 0.0, 0.0
    T_0, T_1, T_d = 0.0, 0.0, 0.0

    # particles of five columns, with images beyond the ends
    for a in range(center - 2, center + 3):
        c = vector(1.0 * a)
        source = source_columns(c, columns, low_end, high_end)
        if source[0] >= 0.0:
            number, signs = number_of(source, columns), seen_signs(c, columns, low_end, high_end)
            for p in range(row_start[number], row_start[number + 1]):
                j = member[p]
                layers = depth[j] / spacing
                if layers < VELOCITY_DEPTH:
                    place = seen_places(x[j], c, start, inverse_width, columns, low_end, high_end)
                    # weights fall along the surface and with the depth
                    r, d = place[0] - middle, layers * layers
                    near = fall_off(r)
                    share = share_of(layers, VELOCITY_DEPTH, near)
                    # velocity carried on to the surface by half of the ghost's jump
                    v_j = signs * (v[j] + 0.5 * jump[j])
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
                        share, d = share_of(layers, TEMPERATURE_DEPTH, near), layers - FIRST_ROW
                        n_0 += share
                        n_1 += share * r
                        n_2 += share * r * r
                        n_d += share * d
                        n_1d += share * r * d
                        n_dd += share * d * d
                        T_0 += share * T[j]
                        T_1 += share * r * T[j]
                        T_d += share * d * T[j]

    # temperature of the first row, linear along the surface and with the depth
    c_0, c_1, c_d, det = line_weights(n_0, n_1, n_2, n_d, n_1d, n_dd)
    T_s = (c_0 * T_0 + c_1 * T_1 + c_d * T_d) / det
    # velocity of the surface, with a parabola of the depth
    c_0, c_1, c_d, det = line_weights(s_0, s_1, s_2, s_d, s_1d, s_dd)
    v_s = c_0 * v_0 + c_1 * v_1 + c_d * v_d
    return (
        vector(v_s[0] / det, v_s[1] / det),
        T_s,
        n_0,
    )


def surface_velocity_of_grid(
    k, row_start, member, x, depth, v, jump, T, start, inverse_width, columns, low_end, high_end,
    spacing,
):  # fmt: skip
    """`surface_velocity_of_line` of a grid of columns, linear along both axes."""
    row = floor((k + 0.5) / columns[1])
    line = k - row * columns[1]
    # moments of b = (1, r_x, r_y), of these with the squared depth d, and of d
    zero = vector(0.0, 0.0, 0.0)
    M, N, b_d, s_dd = outer(zero, zero), outer(zero, zero), 1.0 * zero, 0.0
    # of the velocity times b and d, and of the temperature with its own b
    v_b, v_d, T_b = outer(zero, zero), 1.0 * zero, 1.0 * zero
    N_d, n_dd, T_d = 1.0 * zero, 0.0, 0.0

    # particles of five by five columns, with images beyond the ends
    for q in range(25):
        step = q // 5
        c = vector(row + step - 2.0, line + (q - 5 * step) - 2.0)
        source = source_columns(c, columns, low_end, high_end)
        if min(source[0], source[1]) >= 0.0:
            number, signs = number_of(source, columns), seen_signs(c, columns, low_end, high_end)
            for p in range(row_start[number], row_start[number + 1]):
                j = member[p]
                layers = depth[j] / spacing
                if layers < VELOCITY_DEPTH:
                    place = seen_places(x[j], c, start, inverse_width, columns, low_end, high_end)
                    # weights fall along the surface and with the depth
                    r_x, r_y, d = place[0] - row - 0.5, place[1] - line - 0.5, layers * layers
                    near = fall_off(r_x) * fall_off(r_y)
                    share = share_of(layers, VELOCITY_DEPTH, near)
                    b = vector(1.0, r_x, r_y)
                    # velocity carried on to the surface by half of the ghost's jump
                    v_j = signs * (v[j] + 0.5 * jump[j])
                    M += share * outer(b, b)
                    b_d += share * d * b
                    s_dd += share * d * d
                    v_b += share * outer(b, v_j)
                    v_d += share * d * v_j
                    # moments for the temperature, of the uppermost two layers alone
                    if layers < TEMPERATURE_DEPTH:
                        share, d = share_of(layers, TEMPERATURE_DEPTH, near), layers - FIRST_ROW
                        N += share * outer(b, b)
                        N_d += share * d * b
                        n_dd += share * d * d
                        T_b += share * T[j] * b
                        T_d += share * d * T[j]

    # temperature of the first row, linear along the surface and with the depth
    w, w_d = grid_weights(N, N_d, n_dd)
    T_s = dot(w, T_b) + w_d * T_d
    # velocity of the surface, with a parabola of the depth
    w, w_d = grid_weights(M, b_d, s_dd)
    return matvec(transpose(v_b), w) + w_d * v_d, T_s, N[0, 0]
