"""How fast the liquid moves, when it does, and how good the computed flow is.

    speed_max = max |v_i|,    kinetic energy = 1/2 rho sum_i V_i |v_i|^2

over flowing particles, per unit length of a plane run, of the whole where half of it is computed,
like the other energies of a run. The largest speed is that of a single particle, its largest value
in time that of one step; no single particle moves the root mean square speed. The divergence that
the projection leaves is given in 1/s and as a share of |v|max over the spacing, the largest that
one particle could have.
"""

from __future__ import annotations

import numpy as np

from lasersph.input.key_units import unit_in
from lasersph.observers.flow_view import FlowView
from lasersph.observers.observer import Observer, Row
from lasersph.observers.peak import Span
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View


class FlowSpeed(Observer):
    """Observes the largest speed, the kinetic energy, the divergence and the smallest spacing."""

    title = "flow"
    columns = (
        Quantity(
            "flow_speed_max_m_s",
            "m/s",
            "speed of any particle",
            largest="flow.speed_max_m_s",
            is_main=True,
        ),
        Quantity(
            "flow_speed_rms_m_s",
            "m/s",
            "root mean square speed of the liquid",
            largest="flow.speed_rms_max_m_s",
        ),
        Quantity(
            "flow_kinetic_energy_J", "J", "kinetic energy", largest="flow.kinetic_energy_max_J"
        ),
        Quantity(
            "flow_divergence_rms_1_s",
            "1/s",
            "root mean square of the divergence that the projection leaves",
            largest="flow.divergence_rms_max_1_s",
        ),
        Quantity(
            "flow_divergence_max_1_s",
            "1/s",
            "divergence that the projection leaves",
            largest="flow.divergence_max_1_s",
        ),
        Quantity(
            "flow_divergence_relative",
            "",
            "root mean square of the divergence times spacing over the largest speed",
            largest="flow.divergence_relative_max",
        ),
        Quantity("flow_spacing_min_m", "m", "smallest distance of two particles"),
    )
    results = (
        Quantity("flow.start_s", "s", "first flow"),
        Quantity("flow.end_s", "s", "last flow"),
        Quantity("flow.particles_max", "", "flowing particles at most"),
        Quantity("flow.spacing_min_m", "m", "smallest distance of two particles in a flow"),
        Quantity("flow.kinetic_energy_unit", "", "unit of the kinetic energy"),
    )
    kept = ("span", "spacing_min", "particles_max")

    def __init__(self, dimension: int) -> None:
        super().__init__()
        self.unit = unit_in("J", dimension)
        self.span = Span()
        self.spacing_min: float | None = None
        self.particles_max = 0

    def observe(self, view: View) -> Row:
        """Largest speed [m/s], kinetic energy, divergence [1/s], smallest distance [m]."""
        flow = flow_of(view)
        # largest |v_i|, and the rate 1/s by which it crosses a spacing
        fastest = float(np.sqrt(np.max(np.sum(flow.velocity * flow.velocity, axis=0))))
        count = int(np.count_nonzero(flow.flows))
        largest = fastest / float(np.min(view.width))
        self.span.update(count > 0, view.time)
        self.particles_max = max(self.particles_max, count)
        # smallest spacing while something flows: a lattice at rest has its own
        if count > 0:
            least = self.spacing_min
            now = float(flow.spacing_min)
            self.spacing_min = now if least is None else min(least, now)
        # sqrt(2 E / m) over what flows
        energy = kinetic_energy(view)
        mass = flow.density * float(np.sum(np.where(flow.flows, view.volume, 0.0)))
        values = (
            fastest,
            (2.0 * energy / mass) ** 0.5 if count else 0.0,
            energy,
            float(flow.divergence_rms),
            float(flow.divergence_max),
            float(flow.divergence_rms) / largest if largest > 0.0 else 0.0,
            float(flow.spacing_min),
        )
        return self.record(view.time, values)

    def values(self) -> dict[str, object]:
        """When something flowed, how many particles, how close they came."""
        return {
            "flow.start_s": self.span.first,
            "flow.end_s": self.span.last,
            "flow.particles_max": self.particles_max,
            "flow.spacing_min_m": self.spacing_min,
            "flow.kinetic_energy_unit": self.unit,
        }


def kinetic_energy(view: View) -> float:
    """1/2 rho sum_i V_i |v_i|^2 of a flow [J], as `View.energy`."""
    flow = flow_of(view)
    square = np.sum(flow.velocity * flow.velocity, axis=0)
    return 0.5 * flow.density * float(np.sum(view.volume * square))


def flow_of(view: View) -> FlowView:
    """The flow of a view. Raises ValueError where the run has none."""
    if view.flow is None:
        raise ValueError("the view of a run without flow was given to an observer of flow")
    return view.flow
