"""Walls of particles beyond the faces of a box: three layers, every second one staggered.

Wall particles obey continuity and equation of state like all others but do not move [Alshaer2017,
Section 2; Crespo2007]: what comes near them raises their density and is
pushed back. Layers lie half, one and a half and two and a half spacings beyond a face; in the
second one particles stand in the gaps of the first, by half a spacing along every axis of the face.
Layers below and above reach beyond the sides, so that corners are closed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.faces import face_pairs

Array = NDArray[np.float64]
LAYERS = 3
"""Layers of a wall. Geometry: three fill a support of 3 spacings."""


def wall_particles(
    bounds: Sequence[tuple[float, float]],
    spacing: float,
    walled: Sequence[str],
    periodic: Sequence[str] = (),
) -> Mapping[str, Array]:
    """Places of the particles of each walled face, (dim, k) [m].

    Args:
        bounds: lower and upper end of the box along each axis, z last [m].
        walled, periodic: names of faces: surface, bottom, left, right, front, back.
    """
    dimension = len(bounds)
    faces: dict[str, Array] = {}
    # x last: faces of earlier axes close the corners
    for axis in reversed(range(dimension)):
        for is_upper, face in enumerate(face_pairs(dimension)[axis]):
            if face in walled:
                faces[face] = _face(bounds, spacing, axis, bool(is_upper), walled, periodic)
    return faces


def _face(
    bounds: Sequence[tuple[float, float]],
    spacing: float,
    axis: int,
    is_upper: bool,
    walled: Sequence[str],
    periodic: Sequence[str],
) -> Array:
    """All layers of one face. Axes before its own are covered beyond their walls, others within."""
    layers, pairs = [], face_pairs(len(bounds))
    # lattice of one layer: a place along the normal, places along all other axes
    for layer in range(LAYERS):
        away = (layer + 0.5) * spacing
        lower, upper = bounds[axis]
        coordinates = [np.array([upper + away if is_upper else lower - away])]
        others = [other for other in range(len(bounds)) if other != axis]
        for other in others:
            beyond = [LAYERS if face in walled and other < axis else 0 for face in pairs[other]]
            repeats = pairs[other][0] in periodic
            coordinates.append(_row(bounds[other], spacing, beyond, layer % 2 == 1, repeats))

        # all combinations, with the axes in their order
        points = np.array(list(product(*coordinates))).T
        ordered = np.empty_like(points)
        ordered[[axis, *others]] = points
        layers.append(ordered)
    return np.concatenate(layers, axis=1)


def _row(
    bounds: tuple[float, float],
    spacing: float,
    beyond: Sequence[int],
    is_staggered: bool,
    repeats: bool,
) -> Array:
    """Places along one axis of a face, `beyond` cells further at each end."""
    lower, upper = bounds
    count = max(1, round((upper - lower) / spacing))
    width = (upper - lower) / count
    number = np.arange(-beyond[0], count + beyond[1], dtype=np.float64)
    if not is_staggered:
        return lower + (number + 0.5) * width
    # staggered: in the gaps of the layer beside it, one fewer where that reaches beyond the end
    inner = number if repeats or beyond[0] == 0 else number[1:]
    return lower + inner * width
