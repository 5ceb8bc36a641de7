"""Temperature of the surface: largest, smallest, and at the maximum of the light (x = 0)."""

from __future__ import annotations

import numpy as np

from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View

SHORTEST = 1e-9
"""Steps shorter than this part of the time are left out of the rates: they hold rounding only."""


class SurfaceTemperature(Observer):
    """Observes the temperature of the whole body and of its surface layer.

    `temperature_at_maximum_K` is that of the surface cell closest to x = 0 (and y = 0), at the
    depth of its particle; nothing is extrapolated to the surface itself.
    """

    title = "temperature"
    columns = (
        Quantity(
            "temperature_max_K", "K", "temperature", largest="temperature_max_K", is_main=True
        ),
        Quantity("temperature_surface_max_K", "K", "largest temperature of the surface"),
        Quantity("temperature_surface_min_K", "K", "smallest temperature of the surface"),
        Quantity(
            "temperature_at_maximum_K",
            "K",
            "temperature of the surface at x = 0",
            largest="surface.temperature_at_maximum_max_K",
            end="surface.temperature_at_maximum_end_K",
        ),
    )
    results = (
        Quantity("surface.depth_of_particle_m", "m", "depth of the particle there"),
        Quantity("surface.symmetry_factor", "", "2 where half a period was computed, else 1"),
        Quantity("surface.heating_rate_max_K_s", "K/s", "fastest heating there"),
        Quantity("surface.cooling_rate_max_K_s", "K/s", "fastest cooling there"),
        Quantity("material.solidus_K", "K", "solidus of the metal"),
        Quantity("material.liquidus_K", "K", "liquidus of the metal"),
        Quantity("material.vaporization_K", "K", "vaporization temperature of the metal"),
    )
    kept = ("heating_rate", "cooling_rate", "previous", "depth", "symmetry", "corners")

    def __init__(self) -> None:
        super().__init__()
        self.heating_rate = 0.0
        self.cooling_rate = 0.0
        self.previous: list[float] | None = None
        self.depth = 0.0
        self.symmetry = 1
        self.corners: dict[str, float | None] = {}

    def observe(self, view: View) -> Row:
        """Temperatures at this step [K]."""
        surface = view.temperature[view.surface]
        # where the light is strongest, at x = 0
        cell = view.surface[cell_at_light_maximum(view)]
        at_maximum = float(view.temperature[cell])
        # rates of that cell; steps of rounding say nothing
        if self.previous is not None and view.time - self.previous[0] > SHORTEST * view.time:
            rate = (at_maximum - self.previous[1]) / (view.time - self.previous[0])
            self.heating_rate = max(self.heating_rate, rate)
            self.cooling_rate = max(self.cooling_rate, -rate)
        # what the next step compares with
        self.previous = [view.time, at_maximum]
        self.symmetry = view.symmetry_factor
        self.depth = float(-view.position[-1, cell])
        self.corners = {
            "material.solidus_K": view.solidus,
            "material.liquidus_K": view.liquidus,
            "material.vaporization_K": view.vaporization,
        }
        hottest = float(np.max(view.temperature))
        return self.record(
            view.time, (hottest, float(np.max(surface)), float(np.min(surface)), at_maximum)
        )

    def values(self) -> dict[str, object]:
        """When the largest temperatures were first reached, rates, corner temperatures."""
        return {
            "temperature_max_at_s": self.peak["temperature_max_K"].first,
            "surface.temperature_at_maximum_max_at_s": self.peak["temperature_at_maximum_K"].first,
            "surface.depth_of_particle_m": self.depth,
            "surface.symmetry_factor": self.symmetry,
            "surface.heating_rate_max_K_s": self.heating_rate,
            "surface.cooling_rate_max_K_s": self.cooling_rate,
            **self.corners,
        }


def cell_at_light_maximum(view: View) -> int:
    """Place in `view.surface` of the cell closest to x = 0 (and y = 0)."""
    lateral = view.position[:-1, view.surface]
    return int(np.argmin(np.sum(lateral * lateral, axis=0)))
