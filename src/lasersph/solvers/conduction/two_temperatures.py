"""`TwoTemperatures`: conduction whose electrons are hotter than the lattice under short pulses.

Without light a run has one temperature, and is that of `Conduction`. Light splits it in two; when
|T_e - T_l| / T_l is below a stated share everywhere, and no light comes, it has one again. Both
share the enthalpy of electrons and lattice together, so that the hand-over keeps the energy to the
last bit.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from lasersph.compute.graph import graph
from lasersph.physics.two_temperature import relative_difference
from lasersph.solvers.conduction.electron_body import ElectronBody, ElectronState
from lasersph.solvers.conduction.electron_step import ElectronStep
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.conduction.solver import Conduction, next_light, temperature_change
from lasersph.solvers.step_control import common_limits, name_of_longest

FIRST_SHARE = 1e-4
"""First step in the light over the pulse. Accuracy: none there; its error says how long the next
ones may be."""
LIGHT_SHARE = 0.1
"""Longest step in the light over the pulse. Guard: errors bound the step, but none is told of light
that a step has jumped over."""
AHEAD = 4.0
"""Steps ahead of the last one in which no light may come for a hand-over. Cost: a run that comes
back to two at once has gained nothing."""

FEMTOSECOND_PAUSE = 1e12
"""Longest step without light over that in the light. Guard: milliseconds after a femtosecond;
other limits bind before."""


class TwoTemperatures(Conduction):
    """Solver of a run with electrons and lattice."""

    longest_pause = FEMTOSECOND_PAUSE
    body: ElectronBody
    state: ElectronState

    def __init__(
        self, body: ElectronBody, settings: ConductionSettings, *others: Any, **named: Any
    ) -> None:
        """As `Conduction`, of a body with electrons."""
        super().__init__(body, settings, *others, **named)
        self.state = body.state
        self.one = self.scheme
        self.two = ElectronStep(body, self.exchange, settings.step_error)
        self.share = settings.equal_within

    @property
    def holds_melt(self) -> bool:
        """Whether what is molten stays at rest: it flows from the hand-over on."""
        return bool(self.state.has_two)

    def restore(self, arrays: Mapping[str, np.ndarray], numbers: Mapping[str, float]) -> None:
        """Continue from the arrays of `fields` and the numbers of `checkpoint_scalars`."""
        # temperatures follow from the energies, by how many there are
        self.state.restore(numbers)
        super().restore(arrays, numbers)

    def time_step_limits(self) -> dict[str, float]:
        """Named limits of the next step [s]."""
        state, time, laser = self.state, self.time_settings, self.laser
        if time.fixed_step is not None or laser is None:
            return super().time_step_limits()
        first = FIRST_SHARE * 100.0 * laser.pulse.resolution
        is_lit = laser.pulse.active(state.time, state.time + first)
        if not state.has_two and not is_lit:
            return super().time_step_limits()

        # two temperatures: light is not jumped over, and the error of the last step bounds the next
        limits = common_limits(time, state.time, laser.pulse)
        longest = LIGHT_SHARE * 100.0 * laser.pulse.resolution
        if time.step is not None:
            longest = min(longest, time.step)
        limits[name_of_longest(True)] = next_light(laser.pulse, state.time, longest)
        if not state.has_two:
            return limits | {"first step": first}
        limits["growth"] = time.growth * state.unclipped_step
        if state.allowed_step > 0.0:
            limits["error"] = state.allowed_step
        return limits

    def attempt(self, step: float, unclipped_step: float | None = None) -> None:
        """As `Conduction.attempt`; with two temperatures each part of the step has its own light.

        Raises:
            NotConverged: the step is too large; the state is as before.
        """
        if self._splits(step):
            self.conduct(step, unclipped_step)
        else:
            super().attempt(step, unclipped_step)

    def _splits(self, step: float) -> bool:
        """Whether a step [s] has two temperatures: the last one had, or light comes."""
        state, pulse = self.state, None if self.laser is None else self.laser.pulse
        is_lit = pulse is not None and pulse.active(state.time, state.time + step)
        return bool(state.has_two) or is_lit

    def conduct(self, step: float, unclipped_step: float | None = None) -> None:
        """Advance by `step` [s]: with two temperatures from the first light on until both are one.

        Raises:
            NotConverged: the step is too large; the state is as before.
        """
        state, pulse = self.state, None if self.laser is None else self.laser.pulse
        had_two, state.has_two = state.has_two, float(self._splits(step))
        scheme: Any = self.two if state.has_two else self.one
        self.scheme = scheme
        try:
            super().conduct(step, unclipped_step)
        except Exception:
            state.has_two = had_two
            raise
        if not state.has_two:
            return
        state.allowed_step = self.two.next_step(step)
        # hand-over: equal within the share, and no light in the next steps
        ahead = state.time + AHEAD * state.unclipped_step
        dark = pulse is None or not pulse.active(state.time, ahead)
        if dark and state.difference <= self.share:
            self._become_one()

    def update_temperature(self) -> tuple[float]:
        """Temperatures and fractions; returns the largest change of the lattice's [K]."""
        if self.state.has_two:
            change, self.state.difference = self.update_both()
        else:
            (change,), self.state.difference = super().update_temperature(), 0.0
        return (change,)

    @graph
    def update_both(self) -> None:
        """Both temperatures; reduces the largest change of the lattice's [K] and the largest
        |T_e - T_l| / T_l."""
        self.body.update_both()
        particles, backend = self.particles, self.backend
        fields = {"T": particles["temperature"], "T_old": self._before}
        backend.pointwise(temperature_change, fields, (None,), reduce=("max",))
        fields = {"T_e": particles["electron_temperature"], "T_l": particles["temperature"]}
        backend.pointwise(relative_difference, fields, (None,), reduce=("max",))

    def _become_one(self) -> None:
        """Go on with one temperature, from the enthalpy of electrons and lattice together."""
        state, particles, backend = self.state, self.particles, self.backend
        state.has_two = state.allowed_step = 0.0
        # one temperature is predicted from steps of its own
        backend.fill(particles["enthalpy_excess"], 0.0)
        for name in ("enthalpy_before", "enthalpy_two_before"):
            backend.copy(particles["enthalpy"], particles[name])
        self.body.update_temperature()
        state.difference = 0.0
