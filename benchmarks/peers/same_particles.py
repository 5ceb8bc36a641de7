"""The particles that all programs are given: lattices of spacing 1 m, each particle displaced.

The order is that of the lattice, x fastest; a program that sorts its particles does so itself.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree  # pyright: ignore[reportAttributeAccessIssue]

Array = NDArray[np.float64]

SUPPORT = 2.9
"""Support radius in 3-D [m]: 93 neighbors."""
SOUND_SPEED = 10.0
"""[m/s]; the fastest particles move at a tenth of it."""
VISCOSITY = 0.1
"""alpha of the artificial viscosity [1]."""
CONDUCTIVITY = 0.1
"""[W/(m K)], at unit density and heat capacity."""
STEP = 0.02
"""[s]: 0.14 of half a support at the speed of sound."""
STIFFNESS = 5.0
"""D dt / dx^2 of an implicit step; where cells are 1 m wide and D is 1 m^2/s, the step [s]."""
JITTER = 0.1
"""Largest displacement along each axis [m]."""


def displaced_lattice(edge: int, dimension: int) -> Array:
    """Positions (dimension, edge^dimension) [m] between 0 and `edge`, displaced from a lattice."""
    axis = np.arange(edge) + 0.5
    place = np.array([x.ravel() for x in np.meshgrid(*[axis] * dimension, indexing="ij")])[::-1]
    return place + np.random.default_rng(1).uniform(-JITTER, JITTER, place.shape)


def vortices(position: Array, edge: int) -> Array:
    """Velocities (3, n) [m/s] of Taylor and Green's flow, so that lists age as in a run."""
    kx, ky = 2.0 * np.pi / edge * position[:2]
    return np.array([np.sin(kx) * np.cos(ky), -np.cos(kx) * np.sin(ky), np.zeros_like(kx)])


def warmth(position: Array, edge: int) -> Array:
    """Temperature or energy (n,) [K], [J/kg]: a wave along z, between 0.5 and 1.5."""
    return 1.0 + 0.5 * np.cos(2.0 * np.pi * position[2] / edge)


@cache
def directed_pairs(edge: int, *, is_periodic: bool) -> float:
    """How many ordered pairs (i, j) of the 3-D lattice lie within the support, j != i."""
    position = displaced_lattice(edge, 3)
    box = float(edge) if is_periodic else None
    tree = cKDTree(np.mod(position, edge).T if is_periodic else position.T, boxsize=box)
    return float(tree.count_neighbors(tree, SUPPORT)) - position.shape[1]


def write_lammps(path: Path, position: Array, velocity: Array, edge: int) -> None:
    """Data file of LAMMPS for `atom_style sph`: unit mass, density and heat capacity."""
    count = position.shape[1]
    energy, number = warmth(position, edge), np.arange(1, count + 1)
    ones = np.ones(count)
    lines = [f"displaced lattice\n\n{count} atoms\n1 atom types\n"]
    lines += [f"0 {edge} {axis}lo {axis}hi" for axis in "xyz"]
    with path.open("w", encoding="utf-8") as file:
        file.write("\n".join([*lines, "\nMasses\n\n1 1.0\n\nAtoms # sph\n\n"]))
        table = np.column_stack([number, ones, ones, energy, ones, *position])
        np.savetxt(file, table, "%d %d %g %.9g %g %.17g %.17g %.17g")
        file.write("\nVelocities\n\n")
        np.savetxt(file, np.column_stack([number, *velocity]), "%d %.9g %.9g %.9g")
