"""Loops over the particles of columns: how thick they are, and what flows through their sides.

Columns and ends are those of `loops`. Particles of columns beyond an end are seen where the end
shows them: mirrored, or a period further.
"""

from __future__ import annotations

from math import ceil, floor

from lasersph.compute.vectors import vector
from lasersph.surface.loops import MIRROR, PERIODIC, number_of


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
    """Sign of a velocity along the axis that is seen there."""
    if c < 0:
        return -1.0 if low_end == MIRROR else 1.0
    if c >= columns:
        return -1.0 if high_end == MIRROR else 1.0
    return 1.0


def source_columns(c, columns, low_end, high_end):
    """`source_column` along each axis."""
    return vector(
        *(source_column(c[k], columns[k], low_end[k], high_end[k]) for k in range(len(c)))
    )


def seen_places(x, c, start, inverse_width, columns, low_end, high_end):
    """`seen_place` of a particle along each axis."""
    return vector(
        *(
            seen_place(
                (x[k] - start[k]) * inverse_width[k], c[k], columns[k], low_end[k], high_end[k]
            )
            for k in range(len(c))
        )
    )


def seen_signs(c, columns, low_end, high_end):
    """`seen_sign` along each axis, 1 along z."""
    return vector(
        *(seen_sign(c[k], columns[k], low_end[k], high_end[k]) for k in range(len(c))), 1.0
    )


def b_spline(distance):
    """Quadratic B-spline of a distance in columns, which has the integral 1."""
    if distance < 0.5:
        return 0.75 - distance * distance
    if distance < 1.5:
        return 0.5 * (1.5 - distance) * (1.5 - distance)
    return 0.0


def b_spline_around(place, center):
    """Product over the axes of the B-splines of a place around a center."""
    if len(center) == 1:
        return b_spline(abs(place[0] - center[0]))
    return b_spline(abs(place[0] - center[0])) * b_spline(abs(place[1] - center[1]))


def first_near(center):
    """First column that a B-spline around a place reaches."""
    return int(floor(center - 1.5))  # noqa: RUF046 (in a loop floor is a real number)


def beyond_near(center):
    """Column after the last one that it reaches."""
    return int(ceil(center + 1.5))  # noqa: RUF046


def side_center(k, along, columns):
    """Middle of the k-th side of the columns, counted in columns from the lower ends.

    Args:
        along: unit vector normal to the sides. columns: numbers along each axis.
    """
    if len(columns) == 1:
        return vector(1.0 * k)
    # one side more along the axis that they are normal to
    rows = columns[1] + along[1]
    number = floor((k + 0.5) / rows)
    return vector(number + 0.5 * along[1], k - number * rows + 0.5 * along[0])


def add_flow(
    c, center, flow, volume, solid, row_start, member, x, v, V, flows, along, start, inverse_width,
    columns, low_end, high_end,
):  # fmt: skip
    """Sums of v V, V of what flows, and V of what does not, with the particles seen in column c."""
    source = source_columns(c, columns, low_end, high_end)
    if min(source[0], source[-1]) < 0.0:
        return flow, volume, solid
    number = number_of(source, columns)
    signs = seen_signs(c, columns, low_end, high_end)
    for p in range(row_start[number], row_start[number + 1]):
        j = member[p]
        v_j = v[j]
        place = seen_places(x[j], c, start, inverse_width, columns, low_end, high_end)
        # each with its volume and a B-spline of its distance
        share = b_spline_around(place, center) * V[j]
        velocity = signs[0] * v_j[0]
        if len(along) == 2:
            velocity = along[0] * signs[0] * v_j[0] + along[1] * signs[1] * v_j[1]
        flow += flows[j] * share * velocity
        volume += flows[j] * share
        solid += (1.0 - flows[j]) * share
    return flow, volume, solid


def mean_velocity(
    k, row_start, member, x, v, V, flows, along, start, inverse_width, columns, low_end, high_end
):
    """Mean velocity, normal to it, of what flows around the k-th side of the columns [m/s]; how
    thick the solid is [m].

    Args:
        row_start, member: particles of each column. x, v: [m], [m/s]. V: volume [m^d]. flows: 1 or
            0. along: unit vector normal to the sides.
    """
    center = side_center(k, along, columns)
    flow, volume, solid = 0.0, 0.0, 0.0
    # particles of the columns around the side, with images beyond the ends
    for a in range(first_near(center[0]), beyond_near(center[0])):
        if len(columns) == 1:
            flow, volume, solid = add_flow(
                vector(1.0 * a), center, flow, volume, solid, row_start, member, x, v, V, flows,
                along, start, inverse_width, columns, low_end, high_end,
            )  # fmt: skip
        else:
            for b in range(first_near(center[1]), beyond_near(center[1])):
                flow, volume, solid = add_flow(
                    vector(1.0 * a, 1.0 * b), center, flow, volume, solid, row_start, member, x, v,
                    V, flows, along, start, inverse_width, columns, low_end, high_end,
                )  # fmt: skip
    area = inverse_width[0]
    if len(columns) == 2:
        area = inverse_width[0] * inverse_width[1]
    return flow / max(volume, 1.0e-300), solid * area


def thickness_of(k, row_start, member, V, inverse_area):
    """Sum of V over the particles of a column, over its area: how thick they are [m]."""
    total = 0.0
    for p in range(row_start[k], row_start[k + 1]):
        total += V[member[p]]
    return total * inverse_area
