"""How matter moves as a whole: kinetic energy, speed, pressure, and how far it reaches.

For runs without light: waves, columns at rest, liquids that run out.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.observers.crater import ablation_of
from lasersph.observers.view import ENERGY_UNITS, View

COLUMNS: tuple[str, ...] = (
    "kinetic_energy_J", "speed_max_m_s", "pressure_max_Pa", "front_m", "height_m",
)  # fmt: skip


class MatterMotion:
    """Observes all particles of a run of a given dimension.

    The front is the far end of the particle at the largest x, the height the top of the highest.
    """

    columns: tuple[str, ...] = COLUMNS

    def __init__(self, dimension: int) -> None:
        self.dimension = dimension
        self.last = dict.fromkeys(COLUMNS, 0.0)
        self.largest = dict.fromkeys(COLUMNS[1:3], 0.0)

    def observe(self, view: View) -> dict[str, float]:
        """Values of the columns at this step."""
        seen = ablation_of(view)
        square = float(np.sum(seen.velocity * seen.velocity))
        ends = 0.5 * np.max(2.0 * view.position + view.width, axis=1)
        values = (
            0.5 * seen.particle_mass * square,
            seen.speed_max_condensed,
            seen.pressure_max,
            float(ends[0]) if self.dimension > 1 else 0.0,
            float(ends[-1]),
        )
        self.last = dict(zip(COLUMNS, values, strict=True))
        self.largest = {name: max(self.last[name], old) for name, old in self.largest.items()}
        return dict(self.last)

    def summary(self) -> dict[str, Any]:
        """`motion`: values at the end, and the largest speed and pressure."""
        unit = ENERGY_UNITS[self.dimension]
        largest = {f"{name}_ever": value for name, value in self.largest.items()}
        return {"motion": {"energy_unit": unit, **self.last, **largest}}

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        return {"last": dict(self.last), "largest": dict(self.largest)}

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        self.last, self.largest = dict(state["last"]), dict(state["largest"])
