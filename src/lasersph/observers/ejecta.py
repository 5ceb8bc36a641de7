"""Ejecta: number, mass, energy, speed, temperature, direction.

Every particle counts once, with what it has when it leaves: from then on its velocity stays.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lasersph.input.key_units import suffix, unit_in
from lasersph.observers.ablation_view import AblationView
from lasersph.observers.crater import ablation_of
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View

RANGES = {"speed": "m/s", "temperature": "K", "angle": "deg"}
"""Quantities of each particle when it leaves, with units; the angle is that from the vertical."""


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

    def entries(self, stem: str, unit: str) -> dict[str, float | None]:
        """Mean, smallest and largest as entries of a summary; None before any value."""
        values = {"mean": self.mean, "min": self.smallest, "max": self.largest}
        return {
            f"{stem}_{word}{suffix(unit)}": value if self.count else None
            for word, value in values.items()
        }


class Ejecta(Observer):
    """Observes what leaves the surface."""

    title = "ejecta"
    note = "Each particle counts once, with what it had when it left."
    columns = (
        Quantity("ejected_count", "", "ejected particles"),
        Quantity("ejected_mass_kg", "kg", "ejected mass", end="ejecta.mass_kg", is_main=True),
        Quantity("ejected_energy_J", "J", "energy carried away by ejecta", end="ejecta.energy_J"),
        Quantity(
            "ejected_kinetic_energy_J",
            "J",
            "kinetic energy of the ejecta",
            end="ejecta.kinetic_energy_J",
        ),
        Quantity("ejecta_speed_mean_m_s", "m/s", "mean speed of all ejecta"),
        Quantity("ejecta_temperature_mean_K", "K", "mean temperature of all ejecta"),
    )
    results = (
        Quantity("ejecta.count", "", "ejected particles", is_main=True),
        Quantity("ejecta.gone_count", "", "of these beyond the box"),
        Quantity("ejecta.mass_unit", "", "unit of the mass"),
        Quantity("ejecta.energy_unit", "", "unit of the energies"),
        Quantity("ejecta.start_s", "s", "first ejecta"),
        Quantity("ejecta.end_s", "s", "last ejecta"),
        *(
            Quantity(
                f"ejecta.{name}_{word}{suffix(unit)}",
                unit,
                f"{text} {name} when it left",
                is_main=(name, word) == ("speed", "mean"),
            )
            for name, unit in RANGES.items()
            for word, text in (("mean", "mean"), ("min", "smallest"), ("max", "largest"))
        ),
        Quantity("ejecta.vapor_pressure_max_Pa", "Pa", "largest vapor pressure at leaving"),
    )
    kept = ("ranges", "vapor_pressure", "times", "seen_until", "counts")

    def __init__(self, dimension: int) -> None:
        super().__init__()
        self.dimension = dimension
        self.ranges = {name: Range() for name in RANGES}
        self.vapor_pressure = 0.0
        self.times: list[float] = []
        self.seen_until = -np.inf
        self.counts = [0, 0]

    def observe(self, view: View) -> Row:
        """Totals since the start, and means over all that left so far; 0 before any did."""
        seen = ablation_of(view)
        # those that left since the last view
        new = seen.ejecta_time > self.seen_until
        if np.any(new):
            self._add(seen, new)
        self.seen_until = view.time
        self.counts = [int(seen.ejected_count), int(seen.gone_count)]
        values = (
            float(seen.ejected_count),
            seen.ejected_mass,
            seen.ejected_energy,
            seen.ejected_kinetic,
            self.ranges["speed"].mean,
            self.ranges["temperature"].mean,
        )
        return self.record(view.time, values)

    def _add(self, seen: AblationView, new: np.ndarray) -> None:
        """Take the particles that just left into account."""
        velocity = seen.ejecta_velocity[:, new]
        speed = np.sqrt(np.sum(velocity * velocity, axis=0))
        # cosine of the angle from the vertical
        upward = velocity[-1] / np.maximum(speed, 1e-300)
        self.ranges["speed"].add(speed)
        self.ranges["temperature"].add(seen.ejecta_temperature[new])
        self.ranges["angle"].add(np.degrees(np.arccos(np.clip(upward, -1.0, 1.0))))
        self.vapor_pressure = max(self.vapor_pressure, float(np.max(seen.vapor_pressure)))
        # first and last time of leaving
        times = seen.ejecta_time[new]
        first = self.times[0] if self.times else float(np.min(times))
        self.times = [first, float(np.max(times))]

    def values(self) -> dict[str, object]:
        """Numbers and units, and what the particles had when they left."""
        # nothing has left: no times, no vapor pressure
        first, last = self.times or (None, None)
        found: dict[str, object] = {
            "ejecta.count": self.counts[0],
            "ejecta.gone_count": self.counts[1],
            "ejecta.mass_unit": unit_in("kg", self.dimension),
            "ejecta.energy_unit": unit_in("J", self.dimension),
            "ejecta.start_s": first,
            "ejecta.end_s": last,
            "ejecta.vapor_pressure_max_Pa": (
                self.vapor_pressure if self.ranges["speed"].count else None
            ),
        }
        for name, unit in RANGES.items():
            found |= self.ranges[name].entries(f"ejecta.{name}", unit)
        return found
