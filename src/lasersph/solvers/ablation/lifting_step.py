"""Half and whole steps where only what leaves moves: enthalpy, and the way of the vapor.

As in `resting_step` no force acts on what is condensed, but the pairs of what leaves get longer, so
that all are weighed anew. Of the published rule, most steps under light are of this kind.
"""

from __future__ import annotations

from typing import Any

from lasersph.solvers.ablation.matter import Level
from lasersph.solvers.ablation.rates import conducted, heat_rates, lifting
from lasersph.solvers.ablation.resting_step import RestingStep


class LiftingStep(RestingStep):
    """Rates and steps of enthalpy, while leaving particles move at constant velocity."""

    def evaluate(self, level: Level, step: float, rows: Any) -> float:
        """Find the rates at a level; returns the heat lost [W]."""
        matter = self.matter
        pairs = self.pairs.now if level is matter.now else self.pairs.half
        (lost,) = matter.backend.pair_sum(
            conducted, pairs, matter.fields(level) | {"A": self.exposure.area}, (self._dh, None),
            rows=rows, finish=heat_rates, reduce=(None, "sum"), step=step,
            factor=self.numbers.weight_factor, **self.numbers.ambient,
        )  # fmt: skip
        return lost

    def move(self, target: Level, rate: Level, step: float, rows: Any) -> None:
        """Write enthalpy and position after `step` [s] into a level; all else stays as it is."""
        now = self.matter.now
        fields = {"x": now.x, "v": now.v, "h": now.h, "stage": self.matter.stage, "dh": self._dh}
        self.matter.backend.pointwise(lifting, fields, (target.x, target.h), rows=rows, dt=step)
