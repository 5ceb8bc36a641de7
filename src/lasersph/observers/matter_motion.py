"""How matter moves as a whole: kinetic energy, speed, pressure, and how far it reaches.

For runs without light: waves, columns at rest, liquids that run out.
"""

from __future__ import annotations

import numpy as np

from lasersph.input.key_units import unit_in
from lasersph.observers.crater import ablation_of
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View


class MatterMotion(Observer):
    """Observes all particles of a run of a given dimension.

    The front is the far end of the particle at the largest x, the height the top of the highest.
    """

    title = "motion"
    columns = (
        Quantity("kinetic_energy_J", "J", "kinetic energy", end="motion.kinetic_energy_J"),
        Quantity("speed_max_m_s", "m/s", "largest speed", end="motion.speed_max_m_s"),
        Quantity("pressure_max_Pa", "Pa", "largest pressure", end="motion.pressure_max_Pa"),
        Quantity("front_m", "m", "front along x", end="motion.front_m"),
        Quantity("height_m", "m", "height", end="motion.height_m"),
    )
    results = (
        Quantity("motion.energy_unit", "", "unit of the kinetic energy"),
        Quantity("motion.speed_max_m_s_ever", "m/s", "largest speed, ever"),
        Quantity("motion.pressure_max_Pa_ever", "Pa", "largest pressure, ever"),
    )
    kept = ("largest",)

    def __init__(self, dimension: int) -> None:
        super().__init__()
        self.dimension = dimension
        self.largest = {"speed_max_m_s": 0.0, "pressure_max_Pa": 0.0}

    def observe(self, view: View) -> Row:
        """Values of the columns at this step."""
        seen = ablation_of(view)
        # how far particles reach, by half of their width
        ends = 0.5 * np.max(2.0 * view.position + view.width, axis=1)
        values = (
            0.5 * seen.particle_mass * float(np.sum(seen.velocity * seen.velocity)),
            seen.speed_max_condensed,
            seen.pressure_max,
            float(ends[0]) if self.dimension > 1 else 0.0,
            float(ends[-1]),
        )
        row = self.record(view.time, values)
        self.largest = {name: max(float(row[name]), old) for name, old in self.largest.items()}
        return row

    def values(self) -> dict[str, object]:
        """The largest speed and pressure of the run."""
        ever = {f"motion.{name}_ever": value for name, value in self.largest.items()}
        return {"motion.energy_unit": unit_in("J", self.dimension), **ever}
