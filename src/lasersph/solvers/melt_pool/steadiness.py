"""When a flow no longer changes.

The kinetic energy is looked at once in every turnover time width / max|v|; where it has stayed
within the given part of itself over the last `SAMPLES` of them, the flow is steady. Single
particles never rest in a steady flow, and their speeds are noisier than the energy; a single look
would take the turn of a slow oscillation for the end.
"""

from __future__ import annotations

from collections.abc import Mapping

SAMPLES = 5
"""Times that the fastest particle crosses the width between two looks. Accuracy: `solver.steady`
says by how much the energy may change meanwhile."""


class Steadiness:
    """Looks at the kinetic energy.

    Args:
        wanted: range of the energy over its mean; None for never. width: of the box [m].

    Attributes:
        reached: whether the flow is steady.
    """

    def __init__(self, wanted: float | None, width: float) -> None:
        self.wanted, self.width = wanted, width
        self.time = 0.0
        self.energies = [0.0] * SAMPLES
        self.reached = False

    def record(self, time: float, speed: float, energy: float) -> None:
        """Take note of the time [s], the largest speed [m/s] and the kinetic energy [J]."""
        if self.wanted is None or (time - self.time) * speed < self.width:
            return
        # (max E - min E) < wanted mean E over the samples
        self.time, self.energies = time, [*self.energies[1:], energy]
        if self.energies[0] > 0.0:
            width = max(self.energies) - min(self.energies)
            self.reached = width * SAMPLES < self.wanted * sum(self.energies)

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        return {"steady.time": self.time, "steady.reached": float(self.reached)} | {
            f"steady.energy_{k}": energy for k, energy in enumerate(self.energies)
        }

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from the numbers of `checkpoint_scalars`."""
        self.time, self.reached = numbers["steady.time"], bool(numbers["steady.reached"])
        self.energies = [numbers[f"steady.energy_{k}"] for k in range(SAMPLES)]
