"""Whether a spot lies on an edge of the block, so that half of it or a quarter is computed."""

from __future__ import annotations

from math import isclose

from lasersph.case import Case

EDGE_TOLERANCE = 1e-9
"""Share of the width by which an axis may miss the edge. Rounding: of lengths."""


def halves_spot(case: Case) -> tuple[bool, bool]:
    """Whether the axis of a resting spot lies on the lower and on the upper end of x."""
    laser, dimensions = case.laser, case.solver.dimensions
    if laser is None or laser.path is not None or not laser.is_bounded or dimensions == 1:
        return False, False

    # The resting axis against both ends of x, up to rounding.
    (low, high), *_ = case.domain.lateral(case.geometry)
    near = EDGE_TOLERANCE * (high - low)
    x = laser.position[0]
    return isclose(x, low, abs_tol=near), isclose(x, high, abs_tol=near)
