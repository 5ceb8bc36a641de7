"""Half and whole steps of matter at rest: enthalpy alone, between pairs that are weighed once."""

from __future__ import annotations

from math import isfinite
from typing import Any

from lasersph.solvers.ablation.exposure import Exposure
from lasersph.solvers.ablation.matter import Level, Matter
from lasersph.solvers.ablation.numbers import Numbers
from lasersph.solvers.ablation.pairs import Pairs
from lasersph.solvers.ablation.rates import heat_rates, pair_weight, taken_up, warmed
from lasersph.solvers.conduction.state import NotConverged
from lasersph.sph.laplacian import harmonic_flow


class RestingStep:
    """As `moving_step.MovingStep`, where nothing moves and nothing pushes.

    Attributes:
        weights: (pairs,) [m^(d-2)]; None where they must be found anew.
    """

    def __init__(self, matter: Matter, pairs: Pairs, exposure: Exposure, numbers: Numbers) -> None:
        self.matter, self.pairs, self.exposure, self.numbers = matter, pairs, exposure, numbers
        self.weights: Any = None
        self._dh = matter.backend.zeros(matter.total)

    def weigh(self, rows: Any) -> None:
        """Find the weights of all pairs, where they are not known."""
        if self.weights is not None:
            return
        matter, list_ = self.matter, self.pairs.now
        self.weights = matter.backend.zeros(list_.neighbor.shape[0])
        matter.backend.pair_values(
            pair_weight, list_, {"V": matter.now.V}, self.weights, rows=rows,
            factor=self.numbers.weight_factor,
        )  # fmt: skip

    def evaluate(self, level: Level, step: float, rows: Any) -> float:
        """Find the rates at a level; returns the heat lost [W]."""
        matter = self.matter
        fields = matter.fields(level) | {"A": self.exposure.area, "g_ij": self.weights}
        (lost,) = matter.backend.pair_sum(
            harmonic_flow, self.pairs.now, fields, (self._dh, None), rows=rows, finish=heat_rates,
            reduce=(None, "sum"), step=step, **self.numbers.ambient,
        )  # fmt: skip
        return lost

    def foresee(self, step: float, rows: Any) -> float:
        """Energy that the step brings [J].

        Raises:
            NotConverged: it is not finite.
        """
        fields = {"m": self.matter.m, "dh": self._dh}
        (stored,) = self.matter.backend.pointwise(
            taken_up, fields, (None,), rows=rows, reduce=("sum",), dt=step
        )
        if not isfinite(stored):
            raise NotConverged(f"a step of {step:.4g} s is unstable; take shorter ones")
        return stored

    def move(self, target: Level, rate: Level, step: float, rows: Any) -> None:
        """Write the enthalpy after `step` [s] into a level; all else stays as it is."""
        fields = {"h": self.matter.now.h, "dh": self._dh}
        self.matter.backend.pointwise(warmed, fields, target.h, rows=rows, dt=step)
