"""Exact temperatures under pulses on a half-space, with the light of the case `pulsed-heating`."""

from __future__ import annotations

from typing import Any

from lasersph.analytic.half_space import pulse_train_temperature
from lasersph.case import load_case


class Light:
    """Exact temperatures for the material of the case `pulsed-heating`.

    Args:
        intensity: [W/m^2]. duration: of a pulse, and of what is dark between two [s].
        diffusivity: D [m^2/s]; None takes k / (rho c_p), as the particles do.
    """

    def __init__(self, intensity: float, duration: float, diffusivity: float | None = None) -> None:
        # The metal of the case, with constant properties.
        case = load_case("pulsed-heating")
        material = case.material
        self.intensity = intensity
        self.duration = duration
        self.initial = case.initial_temperature
        self.conductivity = float(material.conductivity_at(self.initial))
        heat_capacity = material.density_reference * float(material.heat_capacity_at(self.initial))
        self.diffusivity = diffusivity or self.conductivity / heat_capacity

    def pulses(self, reflectivity: float, count: int) -> dict[str, Any]:
        """Arguments of the exact solution."""
        return {
            "flux": (1.0 - reflectivity) * self.intensity,
            "pulse_duration": self.duration,
            "off_time": self.duration,
            "count": count,
            "conductivity": self.conductivity,
            "diffusivity": self.diffusivity,
        }

    def temperature(self, depth, time, *, reflectivity: float = 0.75, count: int = 3):
        """Exact T [K] at depths [m] and times [s]."""
        return pulse_train_temperature(
            depth, time, initial_temperature=self.initial, **self.pulses(reflectivity, count)
        )
