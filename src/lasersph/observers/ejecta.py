"""What was ejected: number, mass, energy, speed, temperature, direction.

Every particle counts once, with what it has when it leaves: from then on its velocity stays.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from lasersph.observers.ablation_view import AblationView
from lasersph.observers.crater import ablation_of
from lasersph.observers.view import ENERGY_UNITS, View

COLUMNS = (
    "ejected_count",
    "ejected_mass_kg",
    "ejected_energy_J",
    "ejected_kinetic_energy_J",
    "ejecta_speed_mean_m_s",
    "ejecta_temperature_mean_K",
)
MASS_UNITS = {1: "kg/m^2", 2: "kg/m", 3: "kg"}


@dataclass
class Range:
    """Number, sum, smallest and largest of values seen one group after another."""

    count: int = 0
    total: float = 0.0
    smallest: float = np.inf
    largest: float = -np.inf

    def add(self, values: np.ndarray) -> None:
        """Take a group of values (k,) into account."""
        if values.size:
            self.count += int(values.size)
            self.total += float(np.sum(values))
            self.smallest = min(self.smallest, float(np.min(values)))
            self.largest = max(self.largest, float(np.max(values)))

    @property
    def mean(self) -> float:
        """Mean of all values; 0 before any."""
        return self.total / self.count if self.count else 0.0

    def named(self, name: str, unit: str) -> dict[str, float | None]:
        """Mean, smallest and largest as entries of a summary; None before any value."""
        values = (self.mean, self.smallest, self.largest)
        words = ("mean", "min", "max")
        return {
            f"{name}_{word}_{unit}": value if self.count else None
            for word, value in zip(words, values, strict=True)
        }


class Ejecta:
    """Observes what leaves the surface."""

    columns = COLUMNS

    def __init__(self, dimension: int) -> None:
        self.dimension = dimension
        self.speed, self.temperature, self.angle = Range(), Range(), Range()
        self.vapor_pressure = 0.0
        self.first: float | None = None
        self.last: float | None = None
        self.seen_until = -np.inf
        self.totals = dict.fromkeys(("count", "gone", "mass", "energy", "kinetic"), 0.0)

    def observe(self, view: View) -> dict[str, float]:
        """Totals since the start, and means over all that left so far; 0 before any did."""
        seen = ablation_of(view)
        new = seen.ejecta_time > self.seen_until
        if np.any(new):
            self._take(seen, new)
        self.seen_until = view.time
        self.totals = {
            "count": float(seen.ejected_count),
            "gone": float(seen.gone_count),
            "mass": seen.ejected_mass,
            "energy": seen.ejected_energy,
            "kinetic": seen.ejected_kinetic,
        }
        values = [self.totals[name] for name in ("count", "mass", "energy", "kinetic")]
        return dict(zip(COLUMNS, [*values, self.speed.mean, self.temperature.mean], strict=True))

    def _take(self, seen: AblationView, new: np.ndarray) -> None:
        """Take the particles that just left into account."""
        velocity = seen.ejecta_velocity[:, new]
        speed = np.sqrt(np.sum(velocity * velocity, axis=0))
        self.speed.add(speed)
        self.temperature.add(seen.ejecta_temperature[new])
        upward = velocity[-1] / np.maximum(speed, 1e-300)
        self.angle.add(np.degrees(np.arccos(np.clip(upward, -1.0, 1.0))))
        self.vapor_pressure = max(self.vapor_pressure, float(np.max(seen.vapor_pressure)))
        times = seen.ejecta_time[new]
        self.first = float(np.min(times)) if self.first is None else self.first
        self.last = float(np.max(times))

    def summary(self) -> dict[str, Any]:
        """`ejecta`: totals with their units, and what the particles had when they left."""
        totals = self.totals
        return {
            "ejecta": {
                "count": int(totals["count"]),
                "gone_count": int(totals["gone"]),
                "mass_unit": MASS_UNITS[self.dimension],
                "mass_kg": totals["mass"],
                "energy_unit": ENERGY_UNITS[self.dimension],
                "energy_J": totals["energy"],
                "kinetic_energy_J": totals["kinetic"],
                "start_s": self.first,
                "end_s": self.last,
                **self.speed.named("speed", "m_s"),
                **self.temperature.named("temperature", "K"),
                **self.angle.named("angle", "deg"),
                "vapor_pressure_max_Pa": self.vapor_pressure if self.speed.count else None,
            }
        }

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        return {
            "ranges": [asdict(r) for r in (self.speed, self.temperature, self.angle)],
            "vapor_pressure": self.vapor_pressure,
            "times": [self.first, self.last, self.seen_until],
            "totals": dict(self.totals),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        self.speed, self.temperature, self.angle = (Range(**r) for r in state["ranges"])
        self.vapor_pressure = state["vapor_pressure"]
        self.first, self.last, self.seen_until = state["times"]
        self.totals = dict(state["totals"])
