"""When a flow no longer changes.

The kinetic energy is looked at once in every turnover time width / max|v|; where its relative
change over one such time falls below the given number, the flow is steady. Single particles never
rest in a steady flow, and their speeds are noisier than the energy.
"""

from __future__ import annotations


class Steadiness:
    """Looks at the kinetic energy.

    Args:
        wanted: largest relative change per turnover time; None for never. width: of the box [m].

    Attributes:
        reached: whether the flow is steady.
    """

    def __init__(self, wanted: float | None, width: float) -> None:
        self.wanted, self.width = wanted, width
        self.time = self.energy = 0.0
        self.reached = False

    def look(self, time: float, speed: float, energy: float) -> None:
        """Take note of the time [s], the largest speed [m/s] and the kinetic energy [J]."""
        if self.wanted is None or (time - self.time) * speed < self.width:
            return
        if self.energy > 0.0:
            self.reached = abs(energy - self.energy) < self.wanted * energy
        self.time, self.energy = time, energy

    def carried(self) -> dict[str, float]:
        """Numbers that survive a step."""
        return {"steady.time": self.time, "steady.energy": self.energy,
                "steady.reached": float(self.reached)}  # fmt: skip

    def restore(self, numbers: dict[str, float]) -> None:
        """Continue from the numbers of `carried`."""
        self.time, self.energy = numbers["steady.time"], numbers["steady.energy"]
        self.reached = bool(numbers["steady.reached"])
