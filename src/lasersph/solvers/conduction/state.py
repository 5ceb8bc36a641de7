"""State of a run of heat beside the fields of its particles: time, steps, energies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

ENERGIES = (
    *("incident", "absorbed", "reflected", "transmitted", "unassigned"),
    *("lost", "removed", "discarded", "shifting", "ejection_work", "newton_residual", "pauses"),
)
"""Energies that steps exchange; the stored one is summed from fields by observers."""


@dataclass
class HeatState:
    """Numbers that survive a step.

    Attributes:
        energy: exchanged since the start [J], by ENERGIES.
        time, time_step, time_step_before: [s]; the last steps, 0 before the first and second.
        temperature_change: largest in the last step [K]. lit_until: end of the last step with
            light [s]. unclipped_step: the last step, had no time been to be hit [s].
        recession: largest speed of a surface that recedes, in the last step [m/s].
    """

    energy: dict[str, float] = field(default_factory=lambda: dict.fromkeys(ENERGIES, 0.0))
    time: float = 0.0
    time_step: float = 0.0
    time_step_before: float = 0.0
    temperature_change: float = 0.0
    lit_until: float = 0.0
    unclipped_step: float = 0.0
    recession: float = 0.0

    def begin_again(self, time: float) -> None:
        """Go on from `time` [s] as from the start of a run, without a step before."""
        self.time, self.time_step, self.time_step_before = time, 0.0, 0.0
        self.temperature_change = self.lit_until = self.unclipped_step = self.recession = 0.0

    def numbers(self) -> dict[str, float]:
        """All of them, for a checkpoint."""
        own = {name: value for name, value in vars(self).items() if name != "energy"}
        return {f"energy.{name}": self.energy[name] for name in ENERGIES} | own

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from what `numbers` gave."""
        self.energy = {name: numbers[f"energy.{name}"] for name in ENERGIES}
        for name in vars(self):
            if name != "energy":
                setattr(self, name, numbers[name])
