"""State of an ablation beside the fields of its particles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from lasersph.solvers.ablation.ejecta import Ejecta
from lasersph.solvers.conduction.state import ENERGIES

GROUPS = ("ejecta", "energy")
"""Numbers that are several; the others are one each."""


@dataclass
class AblationState:
    """Times, energies and what limits the next step.

    Attributes:
        time, time_step: [s]. energy: exchanged since the start [J], by ENERGIES.
        speed: largest of the interior at the start of the last step [m/s]. acceleration,
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
        # plain numbers, then energies and ejecta under names of their own
        own = {name: value for name, value in vars(self).items() if name not in GROUPS}
        own |= {f"energy.{name}": value for name, value in self.energy.items()}
        return own | {f"ejecta.{name}": value for name, value in self.ejecta._asdict().items()}

    def restore(self, scalars: Mapping[str, float]) -> None:
        """Set all numbers from `checkpoint_scalars`."""
        for name, value in vars(self).items():
            if name not in GROUPS:
                setattr(self, name, type(value)(scalars[name]))
        self.energy = {name: scalars[f"energy.{name}"] for name in ENERGIES}
        number, *others = (scalars[f"ejecta.{name}"] for name in Ejecta._fields)
        self.ejecta = Ejecta(int(number), *others)

    def add(self, exchanged: Mapping[str, float]) -> None:
        """Count the energies of a step [J], by ENERGIES; what is missing is 0."""
        for name, value in exchanged.items():
            self.energy[name] += value

    def count_ejecta(self, ejecta: Ejecta) -> None:
        """Count what left in a step."""
        # sums of what had left before and what leaves now; its energies are booked
        number, *others = (was + now for was, now in zip(self.ejecta, ejecta, strict=True))
        self.ejecta = Ejecta(int(number), *others)
        self.add({"removed": ejecta.energy, "discarded": ejecta.discarded})
        self.add({"ejection_work": ejecta.work})
