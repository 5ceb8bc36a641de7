"""How fast the liquid moves, when it does, and how sound the computed flow is.

    speed_max = max |v_i|,    kinetic energy = 1/2 rho sum_i V_i |v_i|^2

over flowing particles, per unit length of a plane run; of half a period where half is computed,
like the other energies of a run. The divergence that the projection leaves is given in 1/s and as
a share of |v|max over the spacing, the largest that one particle could have.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.observers.flow_view import FlowView
from lasersph.observers.peak import Peak, Span
from lasersph.observers.view import ENERGY_UNITS, View


class FlowSpeed:
    """Observes the largest speed, the kinetic energy, the divergence and the smallest spacing."""

    columns: tuple[str, ...] = (
        "flow_speed_max_m_s",
        "flow_kinetic_energy_J",
        "flow_divergence_rms_1_s",
        "flow_divergence_max_1_s",
        "flow_divergence_relative",
        "flow_spacing_min_m",
    )

    def __init__(self, dimension: int) -> None:
        self.unit = ENERGY_UNITS[dimension]
        self.span = Span()
        self.peak = {name: Peak() for name in self.columns[:-1]}
        self.spacing_min: float | None = None
        self.particles_max = 0

    def observe(self, view: View) -> dict[str, float]:
        """Largest speed [m/s], kinetic energy, divergence [1/s], smallest distance [m]."""
        flow = flow_of(view)
        square = np.sum(flow.velocity * flow.velocity, axis=0)
        fastest = float(np.sqrt(np.max(square)))
        count = int(np.count_nonzero(flow.flows))
        spacing = float(np.min(view.width))
        largest = fastest / spacing
        values = (
            fastest,
            0.5 * flow.density * float(np.sum(view.volume * square)),
            float(flow.divergence_rms),
            float(flow.divergence_max),
            float(flow.divergence_rms) / largest if largest > 0.0 else 0.0,
            float(flow.spacing_min),
        )
        row = dict(zip(self.columns, values, strict=True))
        for name, peak in self.peak.items():
            peak.update(row[name], view.time)
        self.span.update(count > 0, view.time)
        self.particles_max = max(self.particles_max, count)
        if count > 0:
            least = self.spacing_min
            self.spacing_min = values[-1] if least is None else min(least, values[-1])
        return row

    def summary(self) -> dict[str, Any]:
        """`flow`: largest values and when, first and last time at which anything flowed."""
        peak = self.peak
        return {
            "flow": {
                "start_s": self.span.first,
                "end_s": self.span.last,
                "particles_max": self.particles_max,
                "speed_max_m_s": peak["flow_speed_max_m_s"].value,
                "speed_max_at_s": time_of(peak["flow_speed_max_m_s"]),
                "kinetic_energy_unit": self.unit,
                "kinetic_energy_max_J": peak["flow_kinetic_energy_J"].value,
                "kinetic_energy_max_at_s": time_of(peak["flow_kinetic_energy_J"]),
                "divergence_rms_max_1_s": peak["flow_divergence_rms_1_s"].value,
                "divergence_max_1_s": peak["flow_divergence_max_1_s"].value,
                "divergence_relative_max": peak["flow_divergence_relative"].value,
                "spacing_min_m": self.spacing_min,
            }
        }

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        return {
            "span": self.span.state(),
            "peak": {name: peak.state() for name, peak in self.peak.items()},
            "spacing_min": self.spacing_min,
            "particles_max": self.particles_max,
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        self.span = Span(**state["span"])
        self.peak = {name: Peak(**values) for name, values in state["peak"].items()}
        self.spacing_min = state["spacing_min"]
        self.particles_max = state["particles_max"]


def flow_of(view: View) -> FlowView:
    """The flow of a view. Raises ValueError where the run has none."""
    if view.flow is None:
        raise ValueError("the view of a run without flow was given to an observer of flow")
    return view.flow


def time_of(peak: Peak) -> float | None:
    """When a size peaked [s]; None where it never was above zero."""
    return peak.time if peak.value > 0.0 else None
