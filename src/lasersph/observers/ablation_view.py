"""Ablation of a run after a step, for observers: host arrays, SI, never changed by it.

Amounts of a 1-D run are per unit area, of a 2-D run per unit length; those of a half or a quarter
are of the whole (`View.mirror_images`), numbers of particles are of those that are computed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

CONDENSED, LEAVING, EJECTED, GONE = 0, 1, 2, 3
"""Stages of a particle: in the body; with the velocity of the vapor, but still part of the surface;
flying; beyond the edge of the box."""


@dataclass(frozen=True)
class AblationView:
    """Crater and ejecta of a run after a step; n particles, m columns, e particles in flight.

    Attributes:
        stage: (n,) of each particle, see above.
        velocity: (dim, n) [m/s].
        density, pressure: (n,) [kg/m^3], [Pa]; of ejecta as they left.
        vapor_pressure: (n,) of ejecta at the temperature at which they left [Pa]; else 0.
        normal: (dim, n) outward unit normal of the particles at the surface; else 0.
        column_center: (dim - 1, m) lateral places of the columns that the beam goes down [m].
        column_width: of each of them along each lateral axis [m].
        column_top: (m,) upper face of the uppermost condensed particle [m]; NaN where none is left.
        ejecta_position, ejecta_velocity: (dim, e) of the particles in flight in the box.
        ejecta_temperature, ejecta_mass, ejecta_time: (e,) [K], mass, time at which they left [s].
        ejected_count, ejected_mass, ejected_energy, ejected_kinetic: of all that ever left; energy
            is the enthalpy above the initial temperature that they carried away.
        gone_count: of these, those that have left the box.
        pressure_max, speed_max_condensed: in the body [Pa], [m/s].
        particle_mass, density_reference: [kg/m^(3 - dim)], [kg/m^3].
        gas_constant: of the vapor R_s [J/(kg K)]; None where the material has no data of it.
    """

    stage: np.ndarray
    velocity: np.ndarray
    density: np.ndarray
    pressure: np.ndarray
    vapor_pressure: np.ndarray
    normal: np.ndarray
    column_center: np.ndarray
    column_width: float
    column_top: np.ndarray
    ejecta_position: np.ndarray
    ejecta_velocity: np.ndarray
    ejecta_temperature: np.ndarray
    ejecta_mass: np.ndarray
    ejecta_time: np.ndarray
    ejected_count: int
    ejected_mass: float
    ejected_energy: float
    ejected_kinetic: float
    gone_count: int
    pressure_max: float
    speed_max_condensed: float
    particle_mass: float
    density_reference: float
    gas_constant: float | None = None

    def of_whole(self, images: int) -> Self:
        """The same with the amounts of a computed part and its mirror images."""
        names = ("ejecta_mass", "ejected_mass", "ejected_energy", "ejected_kinetic")
        amounts = {name: images * getattr(self, name) for name in (*names, "particle_mass")}
        return replace(self, **amounts)
