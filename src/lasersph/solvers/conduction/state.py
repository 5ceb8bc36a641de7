"""What changes during a run: the state of the particles and the energies exchanged so far."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from lasersph.compute.backend import Backend
from lasersph.physics.phase_change import state as state_of
from lasersph.solvers.conduction.body import Body

ENERGIES = (
    "incident", "absorbed", "reflected", "transmitted", "stored", "lost", "removed", "discarded",
)  # fmt: skip


@dataclass
class HeatState:
    """Fields (n,) on the backend, and what survives a step beside them.

    Attributes:
        enthalpy [J/kg], temperature [K], potential [W/m], melt_fraction, vapor_fraction [1].
        excess: what the last step has added to each enthalpy beside the iteration's result, to
            close its balance [J/kg]. previous, older: enthalpy without it one and two steps ago,
            from which the next is foreseen.
        evaporated: mass per area that has left, (n,), 0 below the surface [kg/m^2].
        energy: exchanged since the start [J], by ENERGIES.
        time, time_step, time_step_before: [s]; the last steps, 0 before the first and second.
    """

    enthalpy: Any
    temperature: Any
    potential: Any
    melt_fraction: Any
    vapor_fraction: Any
    excess: Any
    previous: Any
    older: Any
    evaporated: Any
    energy: dict[str, float] = field(default_factory=lambda: dict.fromkeys(ENERGIES, 0.0))
    time: float = 0.0
    time_step: float = 0.0
    time_step_before: float = 0.0
    fastest: float = 0.0
    """Largest change of temperature in the last step [K]."""
    lit_until: float = 0.0
    """End of the last step with light [s]."""
    unclipped_step: float = 0.0
    """The last step, had no time been to be hit [s]."""

    @classmethod
    def at_rest(cls, backend: Backend, body: Body) -> HeatState:
        """The body at its initial temperature: h = 0."""
        count = body.count
        state = cls(*(backend.zeros(count) for _ in range(9)))
        state.refresh(body)
        return state

    def refresh(self, body: Body) -> None:
        """Set temperature, potential and fractions from the enthalpy."""
        out = (self.temperature, self.potential, self.melt_fraction, self.vapor_fraction)
        body.backend.pointwise(state_of, {"h": self.enthalpy}, out, **body.tables)

    def fields(self) -> dict[str, Any]:
        """Arrays by symbol."""
        return {
            "h": self.enthalpy, "T": self.temperature, "P": self.potential,
            "f_m": self.melt_fraction, "f_v": self.vapor_fraction,
        }  # fmt: skip
