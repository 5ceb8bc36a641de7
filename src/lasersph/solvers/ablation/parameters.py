"""Constants of a run whose matter moves."""

from __future__ import annotations

from dataclasses import dataclass

from lasersph.boundaries.settings import Surroundings


@dataclass(frozen=True)
class Parameters:
    """Constants of a run.

    Attributes:
        smoothing: h [m]. sound_speed: c_0 [m/s]. gravity: [m/s^2]. courant: CFL number.
        alpha_solid, alpha_liquid: artificial viscosity [1].
        viscous_rate, diffusive_rate: of what stops and cools fastest on the lattice [1/s].
        weight_factor: of the conduction weights [1].
        surroundings: to which the surface loses heat.
        low, high: corners of the box in which ejecta are followed [m].
    """

    smoothing: float
    sound_speed: float
    gravity: float
    courant: float
    alpha_solid: float
    alpha_liquid: float
    viscous_rate: float
    diffusive_rate: float
    weight_factor: float
    surroundings: Surroundings
    low: tuple[float, ...]
    high: tuple[float, ...]
