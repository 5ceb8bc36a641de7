"""Neumann faces, through which a given heat flux enters: power from the mirrored pairs.

A dummy j beyond the face stands for its mirror image and is hotter by what the flux q asks for,
P_j = P_image + 2 q n_j, n_j being its distance from the face. So particle i takes up

    b_i = sum over the dummies j beyond the face of g_ij 2 q n_j

scaled so that all of them together take up q times the area of the face. A linear temperature
profile is then at rest to the last row.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries.dirichlet_faces import plane_of
from lasersph.particles.faces import ENDS
from lasersph.particles.filling import Filling
from lasersph.particles.layers import Layers

Array = NDArray[np.float64]


def face_power(
    face: str,
    flux: float,
    filling: Filling,
    weights: Array,
    row: NDArray[np.int64],
    neighbor: NDArray[np.uint32],
    layers: Layers,
) -> Array:
    """(count,) power that enters each particle through a face [W per (3 - d) lengths].

    Args:
        flux: into the body [W/m^2]. weights: (pairs,) g_ij, 0 where j is beyond a Dirichlet face.
        row, neighbor: (pairs,) i and j. layers: of the block.
    """
    axis, plane = plane_of(face, layers.extents)
    # n_j of the dummies beyond the face
    outward = 1.0 if ENDS[face][1] else -1.0
    distance = outward * (filling.position[axis, neighbor] - plane)
    beyond = np.flatnonzero((distance > 0.0) & (weights > 0.0))

    # b_i, scaled to q times the area of the face
    share = np.bincount(row[beyond], weights[beyond] * distance[beyond], minlength=filling.count)
    area = layers.geometry.face_area(axis, plane, layers.extents)
    return flux * area * share / share.sum()
