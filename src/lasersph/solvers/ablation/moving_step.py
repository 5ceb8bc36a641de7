"""Half and whole steps of matter that moves: density, velocity, position and enthalpy.

y' = y + dt/2 f(y),    y + dt f(y')              [Alshaer2017, eqs. (29), (30)]
"""

from __future__ import annotations

from math import isfinite, sqrt
from typing import Any

from lasersph.boundaries.free_surface import FreeSurface
from lasersph.solvers.ablation.pairs import Pairs
from lasersph.solvers.ablation.parameters import Parameters
from lasersph.solvers.ablation.particle_state import ParticleState, TimeLevel
from lasersph.solvers.ablation.rates import foreseen, moved, pair_rates, rates
from lasersph.solvers.ablation.state import AblationState
from lasersph.solvers.step_control import NotConverged

THINNEST = 0.01
"""Share of the density at rest below which a step has failed."""


class MovingStep:
    """Rates of all that changes, and the steps that they lead to."""

    def __init__(
        self, particles: ParticleState, pairs: Pairs, exposure: FreeSurface, numbers: Parameters,
        state: AblationState,
    ) -> None:  # fmt: skip
        backend, dimension = particles.backend, particles.geometry.dimension
        self.particles, self.pairs, self.surface, self.state = particles, pairs, exposure, state
        self._a = backend.zeros((dimension, particles.total))
        self._drho, self._dh = (backend.zeros(particles.total) for _ in range(2))
        self._constants = {
            "h_s": numbers.smoothing, "c_0": numbers.sound_speed, "g": numbers.gravity,
            "alpha_solid": numbers.alpha_solid, "alpha_liquid": numbers.alpha_liquid,
            "factor": numbers.weight_factor, "up": (0.0,) * (dimension - 1) + (1.0,),
            **numbers.ambient,
        }  # fmt: skip

    def evaluate(self, level: TimeLevel, step: float, rows: Any) -> float:
        """Find the rates at a level, and what limits the next step; returns the heat lost [W]."""
        particles, state = self.particles, self.state
        pairs = self.pairs.now if level is particles.now else self.pairs.half
        lost, square, fourth = particles.backend.pair_sum(
            pair_rates, pairs, particles.fields(level) | {"A": self.surface.area},
            (self._drho, self._a, self._dh, None, None, None), rows=rows, finish=rates,
            reduce=(None, None, None, "sum", "max", "max"), step=step, **self._constants,
        )  # fmt: skip
        state.closing = fourth**0.25
        state.acceleration = sqrt(square)
        state.is_balanced = square == 0.0
        return lost

    def foresee(self, step: float, rows: Any) -> float:
        """Energy that the step brings [J].

        Raises:
            NotConverged: it is not finite, or matter would thin out.
        """
        particles = self.particles
        fields = {
            "m": particles.m,
            "rho": particles.now.rho,
            "a": self._a,
            "drho": self._drho,
            "dh": self._dh,
        }
        stored, thinnest, force = particles.backend.pointwise(
            foreseen, fields, (None, None, None), rows=rows, reduce=("sum", "min", "sum"), dt=step
        )
        least = THINNEST * particles.material.density_reference
        if not (isfinite(stored) and isfinite(force) and thinnest > least):
            raise NotConverged(f"a step of {step:.4g} s is unstable; take shorter ones")
        return stored

    def move(self, target: TimeLevel, rate: TimeLevel, step: float, rows: Any) -> None:
        """Write the start of the step advanced by `step` [s] into a level.

        Args:
            rate: level that the rates were found at; positions move with its velocity.
        """
        now = self.particles.now
        fields = {
            "x": now.x, "v": now.v, "rho": now.rho, "h": now.h, "kind": self.particles.kind,
            "v_then": rate.v, "a": self._a, "drho": self._drho, "dh": self._dh,
        }  # fmt: skip
        out = (target.x, target.v, target.rho, target.h)
        self.particles.backend.pointwise(moved, fields, out, rows=rows, dt=step)
