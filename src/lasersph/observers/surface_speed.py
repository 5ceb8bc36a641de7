"""Speed of the liquid at and below the surface, and the layer that the surface drags along.

At the place x_m of the largest |u| at the surface the horizontal velocity is followed downward:
u one spacing below the surface, and the depth at which it changes sign, which is the thickness
delta_m of the layer that flows outward. From it and from the mean gradient of the temperature
along the fluid surface on that side follow the estimates

    u_tc = delta_m / eta |d gamma/dT <dT/dx>|,    t_tc = (period / 2) / u_tc

[Demuth2020, eqs. (79), (80)]. The return flow is the largest speed against u(x_m) on the side of
x = 0 on which x_m lies. Where the pool is one cell deep or flows one way down to its bottom, the
layer reaches down to the lowest flowing particle below x_m.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.observers.flow_speed import flow_of, time_of
from lasersph.observers.flow_view import FlowView
from lasersph.observers.interpolation import interpolate
from lasersph.observers.peak import Peak
from lasersph.observers.view import View

COLUMN_WIDTH = 5.0
"""Half width, in spacings, of the column of particles from which u(z) is interpolated."""
AT_PEAK = (
    "flow_surface_speed_max_x_m",
    "flow_below_speed_m_s",
    "flow_return_speed_m_s",
    "flow_layer_thickness_m",
    "flow_gradient_mean_K_m",
    "flow_estimate_m_s",
)
"""Columns whose values at the time of the largest surface speed go to the summary."""


class SurfaceSpeed:
    """Observes the velocity at the surface and the layer below its largest value."""

    columns: tuple[str, ...] = ("flow_surface_speed_max_m_s", "flow_row_speed_max_m_s", *AT_PEAK)

    def __init__(self) -> None:
        self.peak = {name: Peak() for name in self.columns}
        self.at_peak: dict[str, float] = {}

    def observe(self, view: View) -> dict[str, float]:
        """Speeds [m/s], place and thickness [m], mean gradient [K/m]; 0 where nothing flows."""
        flow = flow_of(view)
        row = dict.fromkeys(self.columns, 0.0)
        is_wet = flow.flows[flow.surface]
        if np.any(is_wet):
            speed = np.where(is_wet, np.abs(flow.surface_velocity), 0.0)
            row["flow_surface_speed_max_m_s"] = float(np.max(speed))
            u = np.abs(flow.velocity[0, flow.surface])
            row["flow_row_speed_max_m_s"] = float(np.max(u))
            row |= below_the_peak(view, flow, int(np.argmax(speed)))
        for name, peak in self.peak.items():
            peak.update(row[name], view.time)
        surface = self.peak["flow_surface_speed_max_m_s"]
        if surface.last == view.time and surface.value > 0.0:
            self.at_peak = {name: row[name] for name in AT_PEAK}
            self.at_peak["period"] = period(view)
            row_depth = float(-view.position[-1, flow.surface].mean())
            self.at_peak["row_depth"] = row_depth
            self.at_peak["below_depth"] = spacing_at(view, flow)
        return row

    def summary(self) -> dict[str, Any]:
        """`flow`: the surface and the layer below it, when the surface was fastest.

        Nothing where no surface moved.
        """
        surface = self.peak["flow_surface_speed_max_m_s"]
        if surface.value == 0.0:
            return {}
        at, peak = self.at_peak, self.peak
        estimate = at["flow_estimate_m_s"]
        return {
            "flow": {
                "surface_speed_max_m_s": surface.value,
                "surface_speed_max_at_s": surface.time,
                "surface_speed_max_x_m": at["flow_surface_speed_max_x_m"],
                "row_depth_m": at["row_depth"],
                "row_speed_max_m_s": peak["flow_row_speed_max_m_s"].value,
                "row_speed_max_at_s": time_of(peak["flow_row_speed_max_m_s"]),
                "below_depth_m": at["below_depth"],
                "below_speed_max_m_s": peak["flow_below_speed_m_s"].value,
                "below_speed_max_at_s": time_of(peak["flow_below_speed_m_s"]),
                "return_speed_max_m_s": peak["flow_return_speed_m_s"].value,
                "return_speed_max_at_s": time_of(peak["flow_return_speed_m_s"]),
                "layer_thickness_m": at["flow_layer_thickness_m"],
                "estimate": {
                    "gradient_mean_K_m": at["flow_gradient_mean_K_m"],
                    "speed_m_s": estimate,
                    "time_s": 0.5 * at["period"] / estimate if estimate > 0.0 else None,
                    "surface_speed_over_estimate": surface.value / estimate if estimate else None,
                },
            }
        }

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        peaks = {name: peak.state() for name, peak in self.peak.items()}
        return {"peak": peaks, "at_peak": dict(self.at_peak)}

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        self.peak = {name: Peak(**values) for name, values in state["peak"].items()}
        self.at_peak = dict(state["at_peak"])


def below_the_peak(view: View, flow: FlowView, place: int) -> dict[str, float]:
    """The columns `AT_PEAK` for the surface particle number `place` of `flow.surface`."""
    x = float(view.position[0, flow.surface[place]])
    u = float(flow.surface_velocity[place])
    direction = 1.0 if u >= 0.0 else -1.0
    side = view.position[0] * np.sign(x) >= 0.0
    against = np.max(-direction * flow.velocity[0], where=flow.flows & side, initial=0.0)
    depth, along = velocity_below(view, flow, place)
    thickness = zero_of(depth, direction * along)
    gradient = mean_gradient(view, flow, x)
    stress = abs(flow.surface_tension_slope * gradient)
    step = spacing_at(view, flow)
    values = (
        x,
        abs(float(np.interp(step, depth, along))),
        float(against),
        thickness,
        gradient,
        thickness * stress / flow.viscosity,
    )
    return dict(zip(AT_PEAK, values, strict=True))


def velocity_below(view: View, flow: FlowView, place: int) -> tuple[np.ndarray, np.ndarray]:
    """Horizontal velocity against depth below a place of the surface.

    Args:
        place: number in `flow.surface`.

    Returns:
        Depths (m,) [m] from 0 down to half a spacing below the lowest flowing particle there, and
        velocities (m,) [m/s], the first one extrapolated to the surface.
    """
    step = spacing_at(view, flow)
    x = view.position[0, flow.surface[place]]
    near = np.flatnonzero(np.abs(view.position[0] - x) < COLUMN_WIDTH * step)
    wet = near[flow.flows[near]]
    over = wet[np.abs(view.position[0, wet] - x) < step]
    bottom = float(-np.min(view.position[-1, over])) + 0.5 * step
    depth = np.arange(0.5, max(bottom / step, 1.0) + 0.5, 0.5) * step
    fine = near[view.position[-1, near] > -bottom - COLUMN_WIDTH * step]
    places = np.stack([np.full(depth.size, x), -depth])
    along = interpolate(view.position[:, fine], flow.velocity[0, fine], places)
    first = float(flow.surface_velocity[place])
    return np.concatenate([[0.0], depth]), np.concatenate([[first], along])


def zero_of(depth: np.ndarray, values: np.ndarray) -> float:
    """Smallest depth at which values (m,) that begin above zero reach it; else the last depth."""
    below = np.flatnonzero(values <= 0.0)
    if below.size == 0 or below[0] == 0:
        return float(depth[-1]) if below.size == 0 else 0.0
    k = int(below[0])
    share = values[k - 1] / (values[k - 1] - values[k])
    return float(depth[k - 1] + share * (depth[k] - depth[k - 1]))


def mean_gradient(view: View, flow: FlowView, x: float) -> float:
    """Mean of |dT/dx| over the fluid surface on the side of x = 0 on which `x` lies [K/m]."""
    lateral = view.position[0, flow.surface]
    chosen = flow.flows[flow.surface] & (lateral * np.sign(x) >= 0.0)
    return float(np.mean(np.abs(flow.surface_gradient[chosen]))) if np.any(chosen) else 0.0


def spacing_at(view: View, flow: FlowView) -> float:
    """Spacing of the particles at the surface [m]."""
    return float(view.width[0, flow.surface[0]])


def period(view: View) -> float:
    """Full lateral width of the run [m], both halves of a period where one is computed.

    The edges are those of the lowest particles, which rest.
    """
    x, half = view.position[0], 0.5 * view.width[0]
    lowest = view.position[-1] <= np.min(view.position[-1]) + 0.5 * np.min(view.width[-1])
    right = float(np.max((x + half)[lowest]))
    if view.symmetry_factor == 2:
        return 2.0 * right
    return right - float(np.min((x - half)[lowest]))
