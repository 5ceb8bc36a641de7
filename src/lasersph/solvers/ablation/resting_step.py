"""Half and whole steps of matter at rest: enthalpy alone, between pairs that are weighed once."""

from __future__ import annotations

from math import isfinite
from typing import Any

from lasersph.boundaries.free_surface import FreeSurface
from lasersph.solvers.ablation.pairs import Pairs
from lasersph.solvers.ablation.parameters import Parameters
from lasersph.solvers.ablation.particle_state import ParticleState, TimeLevel
from lasersph.solvers.ablation.rates import heat_rates, pair_weight, taken_up, warmed
from lasersph.solvers.step_control import NotConverged
from lasersph.sph.laplacian import harmonic_flow


class RestingStep:
    """As `moving_step.MovingStep`, where nothing moves and nothing pushes.

    Attributes:
        weights: (pairs,) [m^(d-2)]; None where they must be found anew.
    """

    def __init__(
        self, particles: ParticleState, pairs: Pairs, exposure: FreeSurface, numbers: Parameters
    ) -> None:
        self.particles, self.pairs, self.surface, self.parameters = (
            particles,
            pairs,
            exposure,
            numbers,
        )
        self.weights: Any = None
        self._dh = particles.backend.zeros(particles.total)

    def weigh(self, rows: Any) -> None:
        """Find the weights of all pairs, where they are not known."""
        if self.weights is not None:
            return
        particles, list_ = self.particles, self.pairs.now
        self.weights = particles.backend.zeros(list_.neighbor.shape[0])
        particles.backend.pair_values(
            pair_weight, list_, {"V": particles.now.V}, self.weights, rows=rows,
            factor=self.parameters.weight_factor,
        )  # fmt: skip

    def evaluate(self, level: TimeLevel, step: float, rows: Any) -> float:
        """Find the rates at a level; returns the heat lost [W]."""
        particles = self.particles
        fields = particles.fields(level) | {"A": self.surface.area, "g_ij": self.weights}
        (lost,) = particles.backend.pair_sum(
            harmonic_flow, self.pairs.now, fields, (self._dh, None), rows=rows, finish=heat_rates,
            reduce=(None, "sum"), step=step, **self.parameters.ambient,
        )  # fmt: skip
        return lost

    def foresee(self, step: float, rows: Any) -> float:
        """Energy that the step brings [J].

        Raises:
            NotConverged: it is not finite.
        """
        fields = {"m": self.particles.m, "dh": self._dh}
        (stored,) = self.particles.backend.pointwise(
            taken_up, fields, (None,), rows=rows, reduce=("sum",), dt=step
        )
        if not isfinite(stored):
            raise NotConverged(f"a step of {step:.4g} s is unstable; take shorter ones")
        return stored

    def move(self, target: TimeLevel, rate: TimeLevel, step: float, rows: Any) -> None:
        """Write the enthalpy after `step` [s] into a level; all else stays as it is."""
        fields = {"h": self.particles.now.h, "dh": self._dh}
        self.particles.backend.pointwise(warmed, fields, target.h, rows=rows, dt=step)
