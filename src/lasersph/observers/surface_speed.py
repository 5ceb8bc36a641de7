"""Speed of the liquid at and below the surface, and the layer that the surface drags along.

At the place x_m of the largest |u| at the surface the horizontal velocity is followed downward, in
3-D its part along the velocity at x_m: u one spacing below the surface, and the depth at which it
changes sign, which is the thickness delta_m of the layer that flows outward. From it and from the
mean gradient of the temperature along the fluid surface on that side follow the estimates

    u_tc = delta_m / eta |d gamma/dT <dT/dx>|,    t_tc = (period / 2) / u_tc

[Demuth2020, eqs. (79), (80)]. The return flow is the largest speed against u(x_m) on the side of x
= 0 on which x_m lies, in 3-D of the plane through the axis normal to x_m. Where the pool is one
cell deep or flows one way down to its bottom, the layer reaches down to the lowest flowing particle
below x_m.
"""

from __future__ import annotations

from functools import reduce

import numpy as np

from lasersph.observers.flow_speed import flow_of
from lasersph.observers.flow_view import FlowView
from lasersph.observers.interpolation import interpolate
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View

COLUMN_WIDTH = 5.0
"""Half width, in spacings, of the column of particles from which u(z) is interpolated."""
FASTEST_Y = Quantity("flow_surface_speed_max_y_m", "m", "y of the fastest place of the surface")
FASTEST_Y_AT = "flow.surface_speed_max_y_m"
AT_PEAK = {
    "flow_surface_speed_max_x_m": "flow.surface_speed_max_x_m",
    "flow_layer_thickness_m": "flow.layer_thickness_m",
    "flow_gradient_mean_K_m": "flow.estimate.gradient_mean_K_m",
    "flow_estimate_m_s": "flow.estimate.speed_m_s",
}
"""Columns whose values at the time of the largest surface speed go to these keys."""


class SurfaceSpeed(Observer):
    """Observes the velocity at the surface and the layer below its largest value."""

    title = "flow at the surface"
    note = (
        "The speed at the surface is that of the first row, extrapolated by its depth times the"
        " stress over the viscosity. The layer is taken where and when the surface was fastest;"
        " the estimates from it are eqs. (79) and (80) of Demuth and Lasagni (2020)."
    )
    columns = (
        Quantity(
            "flow_surface_speed_max_m_s",
            "m/s",
            "speed at the surface (extrapolated)",
            largest="flow.surface_speed_max_m_s",
            at=("flow.surface_speed_max_x_m",),
            is_main=True,
        ),
        Quantity(
            "flow_surface_speed_mean_m_s",
            "m/s",
            "mean speed of the liquid surface",
            largest="flow.surface_speed_mean_max_m_s",
        ),
        Quantity(
            "flow_row_speed_max_m_s",
            "m/s",
            "horizontal speed of the first row of particles",
            largest="flow.row_speed_max_m_s",
        ),
        Quantity("flow_surface_speed_max_x_m", "m", "fastest place of the surface"),
        Quantity(
            "flow_below_speed_m_s",
            "m/s",
            "horizontal speed one spacing below the fastest place of the surface",
            largest="flow.below_speed_max_m_s",
        ),
        Quantity(
            "flow_return_speed_m_s",
            "m/s",
            "horizontal speed against the surface's, on its side of x = 0",
            largest="flow.return_speed_max_m_s",
        ),
        Quantity("flow_layer_thickness_m", "m", "thickness of the layer that flows outward"),
        Quantity("flow_gradient_mean_K_m", "K/m", "mean of |dT/dx| along the liquid surface"),
        Quantity("flow_estimate_m_s", "m/s", "speed estimated from that layer"),
        FASTEST_Y,
    )
    results = (
        Quantity(FASTEST_Y_AT, "m", "y of the fastest place of the surface"),
        Quantity("flow.row_depth_m", "m", "depth of the first row of particles"),
        Quantity("flow.below_depth_m", "m", "depth one spacing below"),
        Quantity(
            "flow.layer_thickness_m",
            "m",
            "depth at which u changes sign below the fastest place of the surface",
        ),
        Quantity(
            "flow.estimate.gradient_mean_K_m",
            "K/m",
            "mean of |dT/dx| along the liquid surface on that side",
        ),
        Quantity("flow.estimate.speed_m_s", "m/s", "estimated speed, eq. (79)"),
        Quantity("flow.estimate.time_s", "s", "estimated time to cross half the width, eq. (80)"),
        Quantity(
            "flow.estimate.surface_speed_over_estimate", "", "surface speed over the estimate"
        ),
    )
    kept = ("at_peak",)

    def __init__(self, dimension: int = 2) -> None:
        """
        Args:
            dimension: 2 or 3.
        """
        if dimension < 3:
            self.columns = self.columns[:-1]
        super().__init__()
        self.at_peak: dict[str, float] = {}

    def observe(self, view: View) -> Row:
        """Speeds [m/s], place and thickness [m], mean gradient [K/m]; 0 where nothing flows."""
        flow = flow_of(view)
        is_wet = flow.flows[flow.surface]
        values = (0.0,) * len(self.columns)
        # the row of particles and the surface over it
        if np.any(is_wet):
            speed = np.where(is_wet, flow.surface_speed, 0.0)
            row = flow.velocity[:-1, flow.surface]
            of_row = float(np.max(np.sqrt(np.sum(row * row, axis=0))))
            fastest = int(np.argmax(speed))
            mean = mean_along(view.position[:-1, flow.surface], speed, is_wet)
            values = (float(np.max(speed)), mean, of_row, *below_the_peak(view, flow, fastest))
            values += tuple(view.position[1:-1, flow.surface[fastest]].tolist())
        row = self.record(view.time, values)
        # at the time of the fastest surface: the layer below it and its estimates
        surface = self.peak["flow_surface_speed_max_m_s"]
        if surface.last == view.time and surface.value > 0.0:
            self.at_peak = {key: float(row[column]) for column, key in AT_PEAK.items()}
            self.at_peak |= {
                **({} if view.dimension < 3 else {FASTEST_Y_AT: float(row[FASTEST_Y.key])}),
                "flow.row_depth_m": float(-view.position[-1, flow.surface].mean()),
                "flow.below_depth_m": spacing_at(view, flow),
                "period": period(view),
            }
        return row

    def values(self) -> dict[str, object]:
        """The layer below the surface when that was fastest, and the estimates from it."""
        found: dict[str, object] = {k: v for k, v in self.at_peak.items() if k != "period"}
        estimate = self.at_peak["flow.estimate.speed_m_s"]
        surface = self.peak["flow_surface_speed_max_m_s"].value
        found["flow.estimate.time_s"] = found["flow.estimate.surface_speed_over_estimate"] = None
        # eqs. (79) and (80): speed of the layer, and time to cross half of the width
        if estimate > 0.0:
            found["flow.estimate.time_s"] = 0.5 * self.at_peak["period"] / estimate
            found["flow.estimate.surface_speed_over_estimate"] = surface / estimate
        return found

    def summary(self) -> dict[str, object]:
        """Nothing where no surface moved."""
        return super().summary() if self.at_peak else {}


def mean_along(places: np.ndarray, values: np.ndarray, chosen: np.ndarray) -> float:
    """Mean over length of values (m,) at places (m,) or (2, m) of the surface [m], of those chosen.

    Each counts as long as it lies from its neighbors, so that none which joins or leaves the row
    moves the mean as one of many; in 3-D, where there are many, as much as any other.
    """
    x, *y = np.atleast_2d(places)
    if x.size < 2 or y:
        # one particle has no length to average over
        return float(np.mean(values[chosen]))
    # length that each particle stands for, of neighbors along x
    order = np.argsort(x, kind="stable")
    length = np.empty(x.size)
    length[order] = np.gradient(x[order])
    return float(np.average(values[chosen], weights=length[chosen]))


def below_the_peak(view: View, flow: FlowView, place: int) -> tuple[float, ...]:
    """The columns from the fastest place on, for surface particle number `place`."""
    at = view.position[:-1, flow.surface[place]]

    # largest speed against the surface's, on its side
    u = np.atleast_2d(flow.surface_velocity)[:, place]
    direction = u / np.sqrt(u @ u) if np.any(u) else np.eye(u.size)[0]
    side = is_beside(view.position, at)
    opposed = -part_along(direction, flow.velocity)
    against = np.max(opposed, where=flow.flows & side, initial=0.0)

    # the layer below, its thickness, and the speed one spacing down
    depth, along = velocity_below(view, flow, place, direction)
    thickness = zero_of(depth, along)
    gradient = mean_gradient(view, flow, at)
    stress = abs(flow.surface_tension_slope * gradient)
    below = abs(float(np.interp(spacing_at(view, flow), depth, along)))
    estimate = thickness * stress / flow.viscosity
    return float(at[0]), below, float(against), thickness, gradient, estimate


def is_beside(places: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Which of some places (d, m) lie on the side of the axis on which `at` (d - 1,) lies."""
    return part_along(at, places) >= 0.0


def part_along(direction: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Horizontal part (m,) of vectors (d, m) along a direction (d - 1,), component by component: so
    it is computed where the vectors are, on a graphics card, too."""
    return reduce(np.add, (direction[k] * vectors[k] for k in range(direction.size)))


def velocity_below(
    view: View, flow: FlowView, place: int, direction: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Horizontal velocity against depth below a place of the surface.

    Args:
        place: number in `flow.surface`. direction: (d - 1,) unit vector that it is taken along.

    Returns:
        Depths (m,) [m] from 0 down to half a spacing below the lowest flowing particle there, and
        velocities (m,) [m/s], the first one extrapolated to the surface.
    """
    step = spacing_at(view, flow)
    at = view.position[:-1, flow.surface[place]]
    # a column of particles around the place, as deep as the liquid there
    apart = (np.abs(view.position[k] - at[k]) for k in range(at.size))
    beside = reduce(np.maximum, apart)
    near = np.flatnonzero(beside < COLUMN_WIDTH * step)
    wet = near[flow.flows[near]]
    over = wet[beside[wet] < step]
    bottom = float(-np.min(view.position[-1, over])) + 0.5 * step
    depth = np.arange(0.5, max(bottom / step, 1.0) + 0.5, 0.5) * step
    fine = near[view.position[-1, near] > -bottom - COLUMN_WIDTH * step]
    # values at each half spacing, the surface itself first
    places = np.vstack([np.repeat(at[:, None], depth.size, axis=1), -depth])
    along = interpolate(view.position[:, fine], direction @ flow.velocity[:-1, fine], places)
    first = float(direction @ np.atleast_2d(flow.surface_velocity)[:, place])
    return np.concatenate([[0.0], depth]), np.concatenate([[first], along])


def zero_of(depth: np.ndarray, values: np.ndarray) -> float:
    """Smallest depth at which values (m,) that begin above zero reach it; else the last depth."""
    below = np.flatnonzero(values <= 0.0)
    if below.size == 0 or below[0] == 0:
        # no change of sign: the whole depth, or none of it
        return float(depth[-1]) if below.size == 0 else 0.0
    k = int(below[0])
    share = values[k - 1] / (values[k - 1] - values[k])
    return float(depth[k - 1] + share * (depth[k] - depth[k - 1]))


def mean_gradient(view: View, flow: FlowView, at: np.ndarray) -> float:
    """Mean of |dT/dx| over the fluid surface on the side of the axis on which `at` (d - 1,) lies
    [K/m]."""
    chosen = flow.flows[flow.surface] & is_beside(view.position[:, flow.surface], at)
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
