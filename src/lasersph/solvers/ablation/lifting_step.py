"""Half and whole steps where only what leaves moves: enthalpy, and the way of the vapor.

As in `resting_step` no force acts on what is condensed, but the pairs of what leaves get longer, so
that all are weighed anew. Of the published rule, most steps under light are of this kind.
"""

from __future__ import annotations

from typing import Any

from lasersph.solvers.ablation.particle_state import TimeLevel
from lasersph.solvers.ablation.rates import conducted, heat_rates, lifting
from lasersph.solvers.ablation.resting_step import RestingStep


class LiftingStep(RestingStep):
    """Rates and steps of enthalpy, while leaving particles move at constant velocity."""

    def evaluate(self, level: TimeLevel, step: float, rows: Any) -> float:
        """Find the rates at a level; returns the heat lost [W]."""
        particles = self.particles
        pairs = self.pairs.now if level is particles.now else self.pairs.half
        (lost,) = particles.backend.pair_sum(
            conducted, pairs, particles.fields(level) | {"A": self.surface.area}, (self._dh, None),
            rows=rows, finish=heat_rates, reduce=(None, "sum"), step=step,
            factor=self.parameters.weight_factor, **self.parameters.ambient,
        )  # fmt: skip
        return lost

    def move(self, target: TimeLevel, rate: TimeLevel, step: float, rows: Any) -> None:
        """Write enthalpy and position after `step` [s] into a level; all else stays as it is."""
        now = self.particles.now
        fields = {"x": now.x, "v": now.v, "h": now.h, "kind": self.particles.kind, "dh": self._dh}
        self.particles.backend.pointwise(lifting, fields, (target.x, target.h), rows=rows, dt=step)
