"""Temperature of the surface: largest, smallest, and at the maximum of the light (x = 0)."""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.observers.peak import Peak
from lasersph.observers.view import View

SHORTEST = 1e-9
"""Steps shorter than this part of the time are left out of the rates: they hold rounding only."""


class SurfaceTemperature:
    """Observes the temperature of the whole body and of its surface layer.

    `temperature_at_maximum_K` is that of the surface cell closest to x = 0 (and y = 0), at the
    depth of its particle; nothing is extrapolated to the surface itself.
    """

    columns = (
        "temperature_max_K",
        "temperature_surface_max_K",
        "temperature_surface_min_K",
        "temperature_at_maximum_K",
    )

    def __init__(self) -> None:
        self.peak = Peak()
        self.peak_at_maximum = Peak()
        self.heating_rate = 0.0
        self.cooling_rate = 0.0
        self.previous: tuple[float, float] | None = None
        self.depth = 0.0
        self.symmetry = 1
        self.corners: dict[str, float | None] = {}

    def observe(self, view: View) -> dict[str, float]:
        """Temperatures at this step [K]."""
        surface = view.temperature[view.surface]
        cell = view.surface[cell_at_maximum(view)]
        at_maximum = float(view.temperature[cell])
        largest = float(np.max(view.temperature))
        self.peak.update(largest, view.time)
        self.peak_at_maximum.update(at_maximum, view.time)
        if self.previous is not None and view.time - self.previous[0] > SHORTEST * view.time:
            rate = (at_maximum - self.previous[1]) / (view.time - self.previous[0])
            self.heating_rate = max(self.heating_rate, rate)
            self.cooling_rate = max(self.cooling_rate, -rate)
        self.previous = (view.time, at_maximum)
        self.symmetry = view.symmetry_factor
        self.depth = float(-view.position[-1, cell])
        self.corners = {
            "solidus_K": view.solidus,
            "liquidus_K": view.liquidus,
            "vaporization_K": view.vaporization,
        }
        values = (largest, float(np.max(surface)), float(np.min(surface)), at_maximum)
        return dict(zip(self.columns, values, strict=True))

    def summary(self) -> dict[str, Any]:
        """Largest temperatures and when they were first reached, rates, corner temperatures."""
        return {
            "temperature_max_K": self.peak.value,
            "temperature_max_at_s": self.peak.first,
            "surface": {
                "temperature_at_maximum_max_K": self.peak_at_maximum.value,
                "temperature_at_maximum_max_at_s": self.peak_at_maximum.first,
                "temperature_at_maximum_end_K": self.previous[1] if self.previous else None,
                "depth_of_particle_m": self.depth,
                "symmetry_factor": self.symmetry,
                "heating_rate_max_K_s": self.heating_rate,
                "cooling_rate_max_K_s": self.cooling_rate,
            },
            "material": self.corners,
        }

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        return {
            "peak": self.peak.state(),
            "peak_at_maximum": self.peak_at_maximum.state(),
            "heating_rate": self.heating_rate,
            "cooling_rate": self.cooling_rate,
            "previous": self.previous,
            "depth": self.depth,
            "symmetry": self.symmetry,
            "corners": self.corners,
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        self.peak = Peak(**state["peak"])
        self.peak_at_maximum = Peak(**state["peak_at_maximum"])
        self.heating_rate = state["heating_rate"]
        self.cooling_rate = state["cooling_rate"]
        previous = state["previous"]
        self.previous = None if previous is None else (previous[0], previous[1])
        self.depth = state["depth"]
        self.symmetry = state["symmetry"]
        self.corners = dict(state["corners"])


def cell_at_maximum(view: View) -> int:
    """Place in `view.surface` of the cell closest to x = 0 (and y = 0)."""
    lateral = view.position[:-1, view.surface]
    return int(np.argmin(np.sum(lateral * lateral, axis=0)))
