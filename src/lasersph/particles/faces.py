"""Faces of a block: their names, in pairs by the axis to which they are normal.

x  left, right        y  front, back        z  bottom, surface
"""

from __future__ import annotations

LEFT, RIGHT, FRONT, BACK, BOTTOM, SURFACE = "left", "right", "front", "back", "bottom", "surface"
LATERAL = ((LEFT, RIGHT), (FRONT, BACK))
"""Faces at the lower and the upper end of x and of y."""
VERTICAL = (BOTTOM, SURFACE)
AXES = "xyz"
PLANE = (LEFT, RIGHT, BOTTOM, SURFACE)
"""Faces of a box in two dimensions."""
ENDS = {
    face: (axis, end)
    for axis, pair in ((0, LATERAL[0]), (1, LATERAL[1]), (-1, VERTICAL))
    for end, face in enumerate(pair)
}
"""Axis and end (0 lower, 1 upper) of each face."""


def face_pairs(dimension: int) -> tuple[tuple[str, str], ...]:
    """Lower and upper face of each axis, z last."""
    return (*LATERAL[: dimension - 1], VERTICAL)


def faces_of(dimension: int) -> tuple[str, ...]:
    """Names of all faces, surface and bottom first."""
    return (SURFACE, BOTTOM, *(face for pair in LATERAL[: dimension - 1] for face in pair))
