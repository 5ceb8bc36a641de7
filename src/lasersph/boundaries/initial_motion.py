"""`InitialMotion`: how matter that may move starts: at rest, as a whole, or as a sound wave.

A plane wave along z, of small amplitude V, running upward at c_0:

    v_z = V cos(k z),   rho = rho_0 (1 + V/c_0 cos(k z)),   z = z_0 - V/(k c_0) sin(k z_0)
"""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from lasersph.input import Model, Velocity

Array = NDArray[np.float64]


class Rest(Model):
    """Nothing moves at the start."""

    kind: Literal["rest"] = "rest"
    hydrostatic: bool = Field(
        default=False, description="whether pressure starts as the weight of what lies above"
    )


class Uniform(Model):
    """The block moves as a whole."""

    kind: Literal["uniform"] = "uniform"
    x: Velocity = Field(default=0.0, description="velocity along x")
    y: Velocity = Field(default=0.0, description="velocity along y")
    z: Velocity = Field(default=0.0, description="velocity along z, upward")

    def velocity(self, dimension: int) -> Array:
        """(dim,) [m/s], z last."""
        return np.array({1: (self.z,), 2: (self.x, self.z), 3: (self.x, self.y, self.z)}[dimension])


class SoundWave(Model):
    """A plane wave that runs upward through a block that is periodic in z."""

    kind: Literal["sound-wave"] = "sound-wave"
    amplitude: Annotated[Velocity, Field(gt=0)] = Field(description="of the velocity")
    waves: Annotated[int, Field(ge=1, le=1000)] = Field(
        default=1, description="wavelengths in the depth of the block"
    )

    def wave_number(self, depth: float) -> float:
        """k [1/m] in a block of given depth [m]."""
        return 2.0 * np.pi * self.waves / depth

    def strain(self, z: Array, depth: float, sound_speed: float) -> Array:
        """(rho - rho_0) / rho_0 at heights z of the undisturbed lattice [m], any shape."""
        return self.amplitude / sound_speed * np.cos(self.wave_number(depth) * z)

    def displacement(self, z: Array, depth: float, sound_speed: float) -> Array:
        """Displacement along z [m] of particles at heights z of the undisturbed lattice [m]."""
        # z = z_0 - V/(k c_0) sin(k z_0), from the integral of the strain
        k = self.wave_number(depth)
        return -self.amplitude / (k * sound_speed) * np.sin(k * z)


InitialMotion = Annotated[Rest | Uniform | SoundWave, Field(discriminator="kind")]
