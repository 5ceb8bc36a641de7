"""`Geometry`: where particles and walls stand at the start, as host arrays.

Material particles come first, in layers from the surface down, then those of the walls.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries import Boundaries
from lasersph.boundaries.initial_motion import Rest, SoundWave, Uniform
from lasersph.boundaries.staggered_walls import wall_particles
from lasersph.boundaries.vessel import Vessel
from lasersph.particles.extended_lattice import FREE
from lasersph.particles.faces import SURFACE, face_pairs, faces_of
from lasersph.particles.filling import fill
from lasersph.particles.layers import Layers
from lasersph.physics.equation_of_state import density_under

Array = NDArray[np.float64]
Motion = Rest | Uniform | SoundWave


@dataclass(frozen=True)
class Geometry:
    """Numbers and sizes that stay.

    Attributes:
        count: material particles. surface_count: of them in the first layer. total: with walls.
        spacing: [m]. cell: size of a particle's cell along each axis [m]. period: length per axis,
            0.0 where there is none [m].
        bounds: of the block. box: of the vessel around it [m].
    """

    count: int
    surface_count: int
    total: int
    spacing: float
    cell: tuple[float, ...]
    period: tuple[float, ...]
    bounds: tuple[tuple[float, float], ...]
    box: tuple[tuple[float, float], ...]

    @property
    def volume(self) -> float:
        """Of a cell [m^dim]."""
        return float(np.prod(self.cell))

    @property
    def dimension(self) -> int:
        """Number of space dimensions."""
        return len(self.bounds)


@dataclass(frozen=True)
class InitialState:
    """All particles at the start, host arrays.

    Attributes:
        position, velocity: (dim, N) [m], [m/s]. density: (N,) [kg/m^dim]. temperature: (N,) [K].
        conducts: (N,) 1, or 0 of walls without heat.
    """

    position: Array
    velocity: Array
    density: Array
    temperature: Array
    conducts: Array


def walled_faces(boundaries: Boundaries, dimension: int) -> tuple[str, ...]:
    """Faces with wall particles: "wall" and, but for the surface, "adiabatic"."""
    return tuple(
        face
        for face in faces_of(dimension)
        if boundaries.kind_of(face) == "wall"
        or (boundaries.kind_of(face) == "adiabatic" and face != SURFACE)
    )


def lay_out(
    layers: Layers,
    boundaries: Boundaries,
    vessel: Vessel,
    motion: Motion,
    *,
    density: float,
    temperature: float,
    sound_speed: float,
    gravity: float,
) -> tuple[Geometry, InitialState]:
    """Particles of uniform layers, their walls, and how they initial.

    Args:
        density, temperature: of the material at the start [kg/m^3], [K]. sound_speed: [m/s].
        gravity: [m/s^2].
    """
    bounds, spacing = layers.extents, layers.spacing
    dimension = layers.dimension

    # material on its lattice, walls around the vessel
    filling = fill(layers, surface=FREE, bottom=FREE, sides=FREE)
    periodic = [f for f in faces_of(dimension) if boundaries.kind_of(f) == "periodic"]
    box = vessel.box(bounds)
    walls = wall_particles(box, spacing, walled_faces(boundaries, dimension), periodic)

    # particles of each wall, at its temperature, which conduct where that is given
    places, temperatures, conducts = [filling.position], [], []
    for face, place in walls.items():
        places.append(place)
        temperatures.append(np.full(place.shape[1], boundaries.temperature_of(face, temperature)))
        conducts.append(np.full(place.shape[1], float(boundaries.kind_of(face) == "wall")))
    position = np.concatenate(places, axis=1)
    count, total = filling.count, position.shape[1]

    # motion of the whole, or a wave: v_z = c_0 s(z), rho = rho_0 (1 + s)
    velocity, strain = np.zeros((dimension, total)), np.zeros(total)
    if isinstance(motion, Uniform):
        velocity[:, :count] = motion.velocity(dimension)[:, None]
    elif isinstance(motion, SoundWave):
        depth, z = bounds[-1][1] - bounds[-1][0], filling.position[-1]
        strain[:count] = motion.strain(z, depth, sound_speed)
        velocity[-1, :count] = sound_speed * strain[:count]
        position[-1, :count] += motion.displacement(z, depth, sound_speed)
    elif motion.hydrostatic:
        # at rest under gravity: rho from p = rho_0 g depth
        pressure = density * gravity * np.maximum(-position[-1], 0.0)
        strain = density_under(pressure, density, sound_speed) / density - 1.0

    # what stays of it, and the state at the start
    period = [
        high - low if faces[0] in periodic else 0.0
        for (low, high), faces in zip(bounds, face_pairs(dimension), strict=True)
    ]
    geometry = Geometry(
        count=count,
        surface_count=filling.surface.size,
        total=total,
        spacing=spacing,
        cell=tuple(float(width) for width in filling.width[:, 0]),
        period=tuple(period),
        bounds=bounds,
        box=box,
    )
    initial = InitialState(
        position=position,
        velocity=velocity,
        density=density * (1.0 + strain),
        temperature=np.concatenate([np.full(count, temperature), *temperatures]),
        conducts=np.concatenate([np.ones(count), *conducts]),
    )
    return geometry, initial
