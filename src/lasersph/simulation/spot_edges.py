"""How much of the whole is computed: half a period, half or a quarter of a spot on an edge."""

from __future__ import annotations

from math import isclose

from lasersph.case import Case

EDGE_TOLERANCE = 1e-9
"""Share of the width by which an axis may miss the edge. Rounding: of lengths."""


def halves_spot(case: Case) -> tuple[bool, bool]:
    """Whether the axis of a resting spot lies on the lower and on the upper end of x."""
    return _lies_on_ends(case, 0) if case.solver.dimensions > 1 else (False, False)


def mirror_images(case: Case) -> int:
    """How many times the computed part makes up the whole: 2 of half a period or half a spot, 4 of
    a quarter; 1 of a section (r, z), whose rings are whole."""
    if case.geometry.is_axisymmetric:
        return 1
    lateral = range(case.solver.dimensions - 1)
    # x > 0 alone, or an edge through the axis of the spot: each doubles what is computed
    is_half = [any(_lies_on_ends(case, axis)) for axis in lateral]
    for axis, _ in enumerate(case.domain.planes_of_symmetry):
        is_half[axis] = True
    return 2 ** sum(is_half)


def _lies_on_ends(case: Case, axis: int) -> tuple[bool, bool]:
    """Whether a resting spot lies on the lower and on the upper end of the lateral axis 0 or 1."""
    laser = case.laser
    if laser is None or laser.path is not None or not laser.is_bounded:
        return False, False

    # The resting axis against both ends, up to rounding.
    low, high = case.domain.lateral(case.geometry)[axis]
    near = EDGE_TOLERANCE * (high - low)
    place = laser.position[axis]
    return isclose(place, low, abs_tol=near), isclose(place, high, abs_tol=near)
