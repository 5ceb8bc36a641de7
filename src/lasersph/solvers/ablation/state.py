"""What survives a step of an ablation beside the fields of the particles."""

from __future__ import annotations

from dataclasses import dataclass, field

from lasersph.solvers.ablation.ejecta import Ejecta
from lasersph.solvers.conduction.state import ENERGIES


@dataclass
class AblationState:
    """Times, energies and what limits the next step.

    Attributes:
        time, time_step: [s]. energy: exchanged since the start [J], by ENERGIES.
        speed: largest of what was condensed at the start of the last step [m/s]. acceleration,
            approach_speed: largest |dv/dt| [m/s^2], and bound of |mu| [m/s], when last looked for.
        ejecta: all that ever left. gone: how many of them have passed the edge.
        is_balanced: no force was found when forces were last looked for.
    """

    time: float = 0.0
    time_step: float = 0.0
    speed: float = 0.0
    acceleration: float = 0.0
    approach_speed: float = 0.0
    is_balanced: bool = False
    gone: int = 0
    ejecta: Ejecta = field(default_factory=Ejecta)
    energy: dict[str, float] = field(default_factory=lambda: dict.fromkeys(ENERGIES, 0.0))

    def checkpoint_scalars(self) -> dict[str, float]:
        """All numbers by name."""
        numbers = {f"energy.{name}": value for name, value in self.energy.items()}
        return numbers | {f"ejecta.{name}": value for name, value in vars(self.ejecta).items()} | {
            "time": self.time, "time_step": self.time_step, "speed": self.speed,
            "acceleration": self.acceleration,
            "approach_speed": self.approach_speed,
            "is_balanced": float(self.is_balanced), "gone": self.gone,
        }  # fmt: skip

    def restore(self, numbers: dict[str, float]) -> None:
        """Set all numbers from `checkpoint_scalars`."""
        self.energy = {name: numbers[f"energy.{name}"] for name in ENERGIES}
        self.ejecta = Ejecta(
            int(numbers["ejecta.count"]), numbers["ejecta.mass"], numbers["ejecta.energy"],
            numbers["ejecta.kinetic"],
        )  # fmt: skip
        self.time, self.time_step = numbers["time"], numbers["time_step"]
        self.speed, self.approach_speed = numbers["speed"], numbers["approach_speed"]
        self.acceleration = numbers["acceleration"]
        self.is_balanced, self.gone = bool(numbers["is_balanced"]), int(numbers["gone"])

    def add(self, exchanged: dict[str, float]) -> None:
        """Count the energies of a step [J], by ENERGIES; what is missing is 0."""
        for name, value in exchanged.items():
            self.energy[name] += value

    def count_ejecta(self, ejecta: Ejecta) -> None:
        """Count what left in a step."""
        was = self.ejecta
        self.ejecta = Ejecta(
            was.count + ejecta.count, was.mass + ejecta.mass,
            was.energy + ejecta.energy, was.kinetic + ejecta.kinetic,
        )  # fmt: skip
        self.energy["removed"] += ejecta.energy
        self.energy["stored"] -= ejecta.energy
