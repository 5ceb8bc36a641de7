"""Faces that hold a temperature: their pull on each particle, from the pairs with dummies.

    q_i = A_i (P_w - P_i),    A_i = sum over the dummies j beyond the face of g_ij c_ij

with c_ij = 1 for a wall of particles of that temperature (dynamic boundary particles), and
c_ij = n_ij / n_i for a face of that temperature, n_ij being the distance of i and j and n_i the
distance of i and the face, both normal to it: the linear extrapolation through particle and face
[Morris1997]. Walls of several temperatures add up.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.filling import FACES, Filling

Array = NDArray[np.float64]


@dataclass(frozen=True)
class HeldFace:
    """A face whose temperature is held [K]; is_wall: by particles beyond it."""

    name: str
    temperature: float
    is_wall: bool


def face_pulls(
    faces: list[HeldFace],
    filling: Filling,
    weights: Array,
    row: NDArray[np.int64],
    neighbor: NDArray[np.uint32],
    bounds: tuple[tuple[float, float], ...],
    depth: float,
) -> dict[str, Array]:
    """A_i of each face, shape (count,) [m^(d-2)]; weights of the used pairs are set to zero.

    Args:
        weights: (pairs,) g_ij, changed in place. row, neighbor: (pairs,) i and j.
        bounds, depth: of the domain [m].
    """
    pulls = {}
    held = filling.held[neighbor]
    for face in faces:
        pairs = np.flatnonzero(held == FACES.index(face.name))
        i, j = row[pairs], neighbor[pairs]
        factor = np.ones(pairs.size)
        if not face.is_wall:
            factor = _extrapolation(face.name, filling.position, i, j, bounds, depth)
        pulls[face.name] = np.bincount(i, weights[pairs] * factor, minlength=filling.count)
        weights[pairs] = 0.0
    return pulls


def _extrapolation(
    name: str,
    position: Array,
    i: NDArray[np.int64],
    j: NDArray[np.uint32],
    bounds: tuple[tuple[float, float], ...],
    depth: float,
) -> Array:
    """n_ij / n_i of pairs across a face."""
    if name != "sides":
        z, plane = position[-1], 0.0 if name == "surface" else -depth
        return np.abs(z[i] - z[j]) / np.abs(z[i] - plane)
    factor = np.zeros(i.size)
    for axis, (lower, upper) in enumerate(bounds):
        x = position[axis]
        for plane, is_beyond in ((lower, x[j] < lower), (upper, x[j] > upper)):
            share = np.abs(x[i] - x[j]) / np.abs(x[i] - plane)
            factor = np.where(is_beyond & (factor == 0.0), share, factor)
    return factor
