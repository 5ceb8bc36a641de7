"""Light that falls down columns onto the particles that it meets first, as pure functions.

The beam is cut into columns of one spacing. A particle stands in each column that its square of
one spacing covers; of a column's light it takes

    s_pc = a_pc / sum_q a_qc        over the uppermost particles q of the column,

a_pc the share of the column's area that it covers. Uppermost are those less than half a spacing
below the highest one; one that covers less than an eighth of the column is not the highest, unless
nothing else stands there. So each column's light is absorbed completely, whatever the surface
looks like, where "q / (rho dx) on every flagged particle" deposits more on slopes and walls.

Left out: light reflected from one wall of a crater to another, and shadows narrower than a column.
"""

from __future__ import annotations

from math import floor

from lasersph.compute.vectors import dot, interpolate
from lasersph.particles.kinds import LEAVING

ROUNDING = 1e-6
"""Shares of a column below which a particle does not stand in it. Rounding: of positions."""
LEAST_COVER = 0.125
"""Share of a column that its highest particle covers at least. Study: craters of turned lattices
agree within a layer with it (`tests/laws/test_crater.py`)."""
NOWHERE = -1e30
"""Height where nothing stands [m]. Format: lower than anything."""


def column_along(x, axis, low, inverse):
    """Column in which the lower edge of a particle's square lies, and the share beyond it.

    Args:
        x: position [m]. axis: unit vector. low: lower bound of the columns [m]. inverse: 1 / width
            [1/m].
    """
    place = (dot(x, axis) - low) * inverse - 0.5
    # a particle that stands in one column but for rounding covers no part of the next
    column = floor(place + ROUNDING)
    beyond = place - column
    return column, (beyond if beyond > ROUNDING else 0.0)


def wrap_column(column, count, wraps):
    """Number of a column, -1 outside; around the end where the columns are periodic."""
    if wraps > 0.0:
        return column - count * floor(column / count)
    if column < 0.0 or column >= count:
        return -1.0
    return column


def column_at_corner(
    column_x,
    beyond_x,
    column_y,
    beyond_y,
    kind,
    right,
    back,
    count_x,
    count_y,
    wraps_x,
    wraps_y,
):
    """Number of the column at a corner of a particle's square, and the share that it covers.

    The number behind the last one stands for no column.

    Args:
        column_x, column_y, beyond_x, beyond_y: from `column_along`; 0 for an axis that is missing.
            kind: only interior and leaving particles stand anywhere. right, back: 1 for the
            upper corner along x and y.
    """
    x = wrap_column(column_x + right, count_x, wraps_x)
    y = wrap_column(column_y + back, count_y, wraps_y)
    # part of the column's area under the square: a product of the parts along both axes
    cover = (beyond_x if right > 0.0 else 1.0 - beyond_x) * (
        beyond_y if back > 0.0 else 1.0 - beyond_y
    )
    # what has left, and what lies outside, stands in no column
    if kind > LEAVING or x < 0.0 or y < 0.0 or cover <= ROUNDING:
        return int(count_x * count_y), 0.0
    return int(x * count_y + y), cover


def heights(x_j, cover_j, up):
    """Height of a particle of a column [m]: where it covers enough, and in any case."""
    z = dot(x_j, up)
    return (z if cover_j >= LEAST_COVER else NOWHERE), z


def larger(a, b):
    """The larger of two heights [m]."""
    return max(a, b)


def top_of(covering, any_height):
    """Height of the highest particle of a column [m]."""
    return covering if covering > NOWHERE else any_height


def cover_of_uppermost(x_j, cover_j, top_i, up, band):
    """Share of a column that a particle covers if it is one of its uppermost ones, else 0."""
    return cover_j if dot(x_j, up) > top_i - band else 0.0


def add(a, b):
    """Sum of two covers."""
    return a + b


def share_of(x, column, cover, tops, covers, up, band):
    """Share of a column's light that a particle takes.

    Args:
        column: its number. cover: share that the particle covers. tops, covers: tables of columns:
            height of the highest [m], sum of the covers of the uppermost.
    """
    # shadowed: more than half a spacing below the highest of the column
    if cover <= 0.0 or dot(x, up) <= tops[column] - band:
        return 0.0
    return cover / covers[column]


def add_light(light, column, share, energy):
    """Light on a particle [J], with that of one more column; energy: table of the columns [J]."""
    return light + share * energy[column]


def mark_hit(hit, share):
    """1 for a particle that takes a share of any column."""
    return 1.0 if share > 0.0 else hit


def absorbed_light(light, T, R_T, R_R):
    """Energy of the light on a particle that it absorbs and that it reflects [J], the shares
    1 - R(T) and R(T); R_T, R_R: table of R(T)."""
    # the reflectivity of the particle's own temperature
    R = interpolate(T, R_T, R_R)
    return (1.0 - R) * light, R * light


def excess_for_column(excess_j, cover_j, whole_j):
    """Energy that a particle that has left hands to one of its columns [J].

    Args:
        excess: energy beyond what it took along [J]. cover: share of the column that it covered.
            whole: sum of its covers.
    """
    return excess_j * cover_j / whole_j if cover_j > 0.0 else 0.0 * excess_j


def add_heat(h, m, given):
    """Enthalpy with the energy that others have handed down [J/kg], and that energy [J].

    Args:
        m: mass [kg].
    """
    return h + given / m, given
