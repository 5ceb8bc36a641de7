"""Dirichlet faces: boundary coefficients of a given temperature, from the pairs with dummies.

    q_i = sum over the dummies j beyond the face of g_ij c_ij (P_w(x_c) - P_i)

with c_ij = 1 and x_c = x_j for a wall of particles of that temperature (dynamic boundary
particles), and c_ij = n_ij / n_i for a face of that temperature, n_ij being the distance of i and j
and n_i the distance of i and the face, both normal to it, and x_c the place where the line from i
to j crosses the face: the linear extrapolation through particle and face [Morris1997]. Coefficients
of several faces add up.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.extended_lattice import FACES
from lasersph.particles.faces import ENDS
from lasersph.particles.filling import Filling

Array = NDArray[np.float64]
Extents = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class DirichletFace:
    """A face of given temperature; is_wall: of particles beyond it."""

    name: str
    is_wall: bool


@dataclass(frozen=True)
class BoundaryCoefficients:
    """Pairs with a face: row i, weight g_ij c_ij [m^(d-2)], x_c [m]."""

    row: NDArray[np.int64]
    weight: Array
    place: Array

    def total(self, count: int, value: Array | float = 1.0) -> Array:
        """(count,) sums of the weights of each row, times the pairs' values."""
        return np.asarray(np.bincount(self.row, self.weight * value, minlength=count), float)


def plane_of(face: str, extents: Extents) -> tuple[int, float]:
    """Axis normal to a face, and where it lies [m]."""
    axis, end = ENDS[face]
    return axis, extents[axis][end]


def boundary_coefficients(
    faces: list[DirichletFace],
    filling: Filling,
    weights: Array,
    row: NDArray[np.int64],
    neighbor: NDArray[np.uint32],
    extents: Extents,
) -> dict[str, BoundaryCoefficients]:
    """Coefficients of each face; weights of the used pairs are set to zero.

    Args:
        weights: (pairs,) g_ij, changed in place. row, neighbor: (pairs,) i and j.
        extents: bounds of the block along each axis [m].
    """
    found = {}
    beyond = filling.dirichlet[neighbor]
    for face in faces:
        pairs = np.flatnonzero(beyond == FACES.index(face.name))
        i, j = row[pairs], neighbor[pairs]
        place, weight = filling.position[:, j], weights[pairs]
        if not face.is_wall:
            # c_ij = n_ij / n_i, and the place where the line from i to j crosses the face
            axis, plane = plane_of(face.name, extents)
            start = filling.position[:, i]
            factor = (place[axis] - start[axis]) / (plane - start[axis])
            place, weight = start + (place - start) / factor, weight * factor
        found[face.name] = BoundaryCoefficients(i, weight, place)
        # these pairs count by their coefficients alone
        weights[pairs] = 0.0
    return found
