"""Pauses between the pulses of a train, jumped over once all is solid.

What is left of the heat is spread evenly through the body or removed, and booked. The particles are
laid out anew below the relief, and the next pulse finds the body as the start of a run does.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np

from lasersph.compute.vectors import same
from lasersph.lasers.pulses import PulseTrain
from lasersph.solvers.conduction.body import HISTORY, Body
from lasersph.solvers.conduction.state import HeatState

PERIOD_TOLERANCE = 1e-9
"""Difference of two times over the period of a pulse train. Rounding: they are the same."""


class Pauses:
    """When a pause is left out, and what becomes of the heat that is left then.

    Args:
        heat: "spread" evenly through the body, or "remove". lay_out: lays the particles out below
            the relief.
    """

    def __init__(
        self,
        body: Body,
        state: HeatState,
        pulse: PulseTrain,
        heat: Literal["spread", "remove"],
        lay_out: Callable[[], None],
    ) -> None:
        self.body, self.state, self.pulse, self.heat = body, state, pulse, heat
        self.lay_out = lay_out

    def end(self) -> float | None:
        """Start of the next pulse [s], once nothing is molten and no light comes before it."""
        # number of the pulse that was last, and whether its light is over
        time, period = self.state.time, self.pulse.interval or np.inf
        number = int(np.floor(time / period + PERIOD_TOLERANCE))
        if number + 1 >= self.pulse.count or time - number * period < self.pulse.window[1]:
            return None

        # only once nothing is molten
        fields = {"value": self.body.particles["melt_fraction"]}
        (melt,) = self.body.backend.pointwise(same, fields, (None,), reduce=("max",))
        return None if melt > 0.0 else (number + 1) * period

    def jump_to(self, start: float) -> None:
        """Go on at `start` [s] as at the start of a run, on the relief that there is now.

        Raises:
            UnevenRelief: it is too deep to lay particles out below it.
        """
        body, particles, state = self.body, self.body.particles, self.state
        # heat that is left, and the layout below the relief
        heat = self._sum("mass", "enthalpy")
        self.lay_out()

        # h of all particles: that heat over their mass, or none of it
        mass = self._sum("mass")
        h = heat / mass if self.heat == "spread" else 0.0
        state.energy["pauses"] += heat - mass * h
        for name in HISTORY:
            body.backend.fill(particles[name], 0.0 if name == "enthalpy_excess" else h)
        body.backend.fill(particles["was_fluid"], 0.0)
        body.update_temperature()
        state.begin_again(start)

    def _sum(self, *names: str) -> float:
        """Sum over all particles of the product of fields."""
        host = self.body.backend.to_host
        product = np.prod([host(self.body.particles[name]) for name in names], axis=0)
        return float(np.sum(product))
