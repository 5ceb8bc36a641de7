"""Heat that the faces of the body bring to each particle: given temperatures and given fluxes.

    q_i = B_i - A_i P_i,    B_i = sum g_ij c_ij P_w + b_i,    A_i = sum g_ij c_ij

with the coefficients A of `boundaries.dirichlet_faces` and the powers b of
`boundaries.neumann_faces`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries import Boundaries
from lasersph.boundaries.dirichlet_faces import DirichletFace, boundary_coefficients
from lasersph.boundaries.neumann_faces import face_power
from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.particles.filling import Filling
from lasersph.particles.layers import Layers

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Walls:
    """Host arrays (n,).

    Attributes:
        coefficient: A [m^(d-2)]. flow: sum of A P_w and b [W per (3 - d) lengths]. heat: sum of
            A T_w [K m^(d-2)]. power: b.
    """

    coefficient: Array
    flow: Array
    heat: Array
    power: Array


def walls_of(
    boundaries: Boundaries,
    curve: CaloricCurve,
    layers: Layers,
    filling: Filling,
    weights: Array,
    row: NDArray[np.int64],
    neighbor: NDArray[np.uint32],
) -> Walls:
    """Terms of the faces; weights of the pairs with Dirichlet faces are set to zero.

    Args:
        weights: (pairs,) g_ij, changed in place. row, neighbor: (pairs,) i and j.
    """
    kinds = {face: boundaries.kind_of(face) for face in layers.geometry.faces}
    faces = [
        DirichletFace(face, kind == "wall") for face, kind in kinds.items() if kind in DIRICHLET
    ]

    # Dirichlet faces: A, sum of A T_w and of A P(T_w)
    found = boundary_coefficients(faces, filling, weights, row, neighbor, layers.extents)
    count = filling.count
    coefficient, flow, heat, power = (np.zeros(count) for _ in range(4))
    for face, pairs in found.items():
        # a column of one dimension has no place along its surface
        places = tuple(pairs.place[: max(len(pairs.place) - 1, 1)])
        T = boundaries.temperature_along(face, places, curve.initial_temperature)
        coefficient += pairs.total(count)
        heat += pairs.total(count, T)
        flow += pairs.total(count, wall_potential(curve, T))

    # Neumann faces: b
    for face in (face for face, kind in kinds.items() if kind == NEUMANN):
        flux = boundaries.flux_of(face)
        power += face_power(face, flux, filling, weights, row, neighbor, layers)
    return Walls(coefficient, flow + power, heat, power)


def wall_potential(curve: CaloricCurve, temperature: Array) -> Array:
    """Heat potential of walls [W/m]; the end segments continue, flat where T is held."""
    rising = np.concatenate([[True], np.diff(curve.temperature) > 0.0])
    T, P = curve.temperature[rising], curve.potential[rising]
    # P(T) within the curve, its end segments beyond
    found = np.interp(temperature, T, P)
    below = P[0] + (P[1] - P[0]) / (T[1] - T[0]) * (temperature - T[0])
    found = np.where(temperature < T[0], below, found)
    if rising[-1]:
        above = P[-1] + (P[-1] - P[-2]) / (T[-1] - T[-2]) * (temperature - T[-1])
        found = np.where(temperature > T[-1], above, found)
    return found


def wall_enthalpy(curve: CaloricCurve, temperature: np.ndarray) -> np.ndarray:
    """Enthalpy of walls [J/kg]; the end segments continue."""
    rising = np.concatenate([[True], np.diff(curve.temperature) > 0.0])
    T, h = curve.temperature[rising], curve.enthalpy[rising]
    # h(T) within the curve, its end segments beyond
    found = np.interp(temperature, T, h)
    below = h[0] + (h[1] - h[0]) / (T[1] - T[0]) * (temperature - T[0])
    above = h[-1] + (h[-1] - h[-2]) / (T[-1] - T[-2]) * (temperature - T[-1])
    return np.where(temperature < T[0], below, np.where(temperature > T[-1], above, found))
