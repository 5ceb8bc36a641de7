"""`MovingSurface`: a free surface z = eta(x, t), as what it gives a step of the flow.

    heights               `surface_line`, moved by the mean velocity of the particles in each column
    tangential stress     t . (2 mu D) . n = d gamma/ds                   [Demuth2020, eq. (15)]
    normal stress         p = p_e + gamma kappa + 2 mu n . D . n
    velocities beyond     v + 2 d (du_t/dn t - du_t/ds n), no component turned around

n points out of the melt, t along +x, d is the distance from the local tangent. With D and
div v = 0 the stresses become

    du_t/dn = tau/mu - n . dv/ds,        p_b = p_e + gamma kappa - 2 mu t . dv/ds

where dv/ds is that of the velocity along the line: of particles near it, carried on to it, smoothed
as slope and curvature are. Without those terms the surface of a film of steel 280 nm thick is 8 %
off after a pulse. A ghost across the surface has p = 2 p_b - p_i; in the pressure equation the
surface is a boundary of given pressure.

Explicit: the line moves with the velocity at the end of the step, which keeps its waves stable
while omega dt < 2 for the fastest of those that the smoothed line shows; half of one is taken.
Waves shorter than the smoothing length are damped within the time of that wave.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries import surface_loops as loops
from lasersph.boundaries.flat_surface import ImposedTemperature, surface_tension_table
from lasersph.boundaries.settings import SurfaceWave
from lasersph.boundaries.surface import (
    PressureCondition,
    SurfaceGhosts,
    SurfaceNeighbors,
    SurfaceStep,
    upward,
)
from lasersph.boundaries.surface_line import EVEN, ODD, ORDER, SurfaceLine
from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.input import format_quantity
from lasersph.materials import Material
from lasersph.particles.neighbor_lists import NeighborList, members_of

HostArray = NDArray[np.float64]
CLOSEST = 0.2
"""Least distance from the surface over the spacing, for pressures and ghosts."""
GAP = 0.3
"""Particles stay as far below the surface, over the spacing."""
STEEPEST = 1.0
"""Slope up to which the surface is computed."""
FEWEST_ROWS = 3.0
"""Thickness of the liquid over the spacing, down to which it is."""
CAPILLARY = 0.5
"""omega dt of the fastest wave; below 2 waves are stable, below 1 tests with films are as well."""
VISCOUS = 0.5
"""Rate at which the normal stress slows the shortest wave, 4 nu k^2, times dt."""
END_KINDS = {"pinned": loops.PINNED, "mirror": loops.MIRROR, "periodic": loops.PERIODIC}
LINE = ("height", "shear", "stretch")
"""What of the line survives a step: eta [m], du_t/dn and du_t/ds [1/s]."""


def shear_rate(tau: HostArray | float, viscosity: float, across: HostArray) -> HostArray:
    """du_t/dn [1/s] under a stress tau [Pa], where v changes along the surface by n . dv/ds."""
    return tau / viscosity - across


def normal_stress(viscosity: float, along: HostArray) -> HostArray:
    """2 mu n . D . n [Pa], from t . dv/ds [1/s]."""
    return -2.0 * viscosity * along


def fastest_wave(tension: float, density: float, cutoff: float) -> float:
    """omega of the fastest wave that a smoothed line shows [1/s].

    omega^2 = gamma k^3 F(k)/rho, F = 1/(1 + (k/k_c)^(2n)): largest at (k/k_c)^(2n) = 3/(2n - 3).
    """
    share = 3.0 / (2.0 * ORDER - 3.0)
    k = 2.0 * pi / cutoff * share ** (1.0 / (2.0 * ORDER))
    return sqrt(tension * k**3 / (1.0 + share) / density)


def surface_limits(
    tension: float, density: float, viscosity: float, cutoff: float
) -> dict[str, float]:
    """Limits of the step by capillary waves and by the viscous stress on the shortest [s].

    Args:
        tension: gamma [N/m]. density: [kg/m^3]. viscosity: kinematic [m^2/s]. cutoff: lambda_c [m].
    """
    k = 2.0 * pi / cutoff
    return {
        "capillary": CAPILLARY / fastest_wave(tension, density, cutoff),
        "surface-stress": VISCOUS / (4.0 * viscosity * k**2),
    }


class SurfaceLiquid(NamedTuple):
    """The melt below: rho [kg/m^3], eta [Pa s], and the metal, for gamma(T)."""

    density: float
    viscosity: float
    material: Material


@dataclass(frozen=True)
class Drives:
    """What a case imposes on the surface: temperature [K], pressure [Pa], mass flux [kg/(m^2 s)]
    that leaves; the last two as waves."""

    temperature: ImposedTemperature | None = None
    pressure: SurfaceWave | None = None
    mass_flux: SurfaceWave | None = None


class MovingSurface:
    """The surface over a box of liquid, see `Surface`.

    Args:
        count: particles of the whole body. line: columns, at their heights at the start. bottom: z
            of the wall below [m]. spacing, support: of the particles at the surface [m].
        has_stress: whether gamma drives the flow.

    Attributes:
        line: the heights. ghosts: what lies beyond.
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        *,
        line: SurfaceLine,
        bottom: float,
        spacing: float,
        support: float,
        liquid: SurfaceLiquid,
        has_stress: bool,
        drives: Drives,
    ) -> None:
        self.backend, self.line, self.bottom, self.spacing = backend, line, bottom, spacing
        self.liquid, self.has_stress, self.drives = liquid, has_stress, drives
        self.normal, self.tangent = upward(2), (1.0, 0.0)
        self.normal_velocity = self.heat_flux = 0.0
        names = ("at_surface", "near_surface", "depth", "temperature", "gradient", "stress")
        for name in (*names, "ghost_velocity_jump", "_distance", "_p_b"):
            setattr(self, name, backend.zeros(count))
        self._n, self._shift, self._jump = (backend.zeros((2, count)) for _ in range(3))
        self.ghosts = SurfaceGhosts(self._n, self._distance, self._shift, self._jump, self._p_b)
        self.pressure: PressureCondition | None = None
        self._shear, self._stretch = np.zeros(line.count), np.zeros(line.count)
        self._line_pressure, self._line_temperature = np.zeros(line.count), np.zeros(line.count)
        self._gradient = np.zeros(line.count)
        T = liquid.material.flow_temperature
        self._tension = float(liquid.material.surface_tension_at(T))
        low, high = (END_KINDS[kind] for kind in line.ends)
        self._grid = {"start": line.start, "inverse": 1.0 / line.width}
        self._ends = self._grid | {"columns": line.count, "low_end": low, "high_end": high}
        self._nodes = float(line.count + 4)
        self._marks = {"near": spacing, "far": support, "closest": CLOSEST * spacing}
        self._columns = {"k": backend.asarray(np.arange(line.count + 1), "index")}
        if has_stress:
            self._gamma_table = surface_tension_table(liquid.material)
        self.flux_loss = 0.0
        self._kept: dict[str, HostArray] = {}
        self._renew()

    @property
    def arrays(self) -> dict[str, Array]:
        """Arrays of a checkpoint by name."""
        host = {"height": self.line.height, "shear": self._shear, "stretch": self._stretch}
        return {f"surface_{name}": self.backend.asarray(host[name]) for name in LINE}

    def find(self, position: Array) -> None:
        """Set marks, depths and ghosts of the particles at `position`, shape (2, n) [m]."""
        out = (self.at_surface, self.near_surface, self.depth, self._n, self._distance, self._shift)
        self.backend.pointwise(
            loops.surface_geometry, {"x": position}, out, **self._tables, **self._marks
        )

    def find_depth(self, position: Array, out: Array) -> None:
        """Depth below the local surface along z [m] of particles at `position` [m]."""
        self.backend.pointwise(loops.below_line, {"x": position}, out, **self._tables)

    def update_stress(self, now: SurfaceStep, neighbors: SurfaceNeighbors, active: Array) -> None:
        """Set what the line gives the particles and their ghosts; see `Surface`."""
        backend, line, liquid = self.backend, self.line, self.liquid
        self._set_values(now.position)
        # velocity and temperature along the line
        members = self._members(now.position, now.flows)
        x, _ = (backend.component(now.position, k) for k in (0, 1))
        u, w = (backend.component(now.velocity, k) for k in (0, 1))
        jump_x, jump_z = (backend.component(self._jump, k) for k in (0, 1))
        found = tuple(backend.zeros(line.count) for _ in range(4))
        tables = {"row_start": members.row_start, "member": members.neighbor, "x": x, "T": now.T}
        tables |= {"depth": self.depth, "u": u, "w": w, "jump_x": jump_x, "jump_z": jump_z}
        places = {"k": backend.head(self._columns["k"], line.count)}
        backend.pointwise(
            loops.surface_velocity, places, found, **tables, **self._ends, spacing=self.spacing
        )
        u_s, w_s, T_s, weight = (backend.to_host(values) for values in found)
        if weight.min() <= 0.0:  # columns without a particle near the surface
            full = weight > 0.0
            u_s, w_s, T_s = (np.interp(line.x, line.x[full], f[full]) for f in (u_s, w_s, T_s))
        u_s, w_s = line.smooth(u_s, ODD, 0.0), line.smooth(w_s, EVEN, 0.0)
        # stress: derivatives along s of velocity and surface tension
        slope = line.slope
        S = np.sqrt(1.0 + slope**2)
        u_x, w_x = line.derivative(u_s, ODD), line.derivative(w_s)
        along = (u_x + slope * w_x) / S**2
        across = (-slope * u_x + w_x) / S**2
        self._line_temperature = self._temperature_at(now, T_s)
        self._gradient = line.derivative(self._line_temperature) / S
        tau = 0.0
        if self.has_stress:
            gamma = np.interp(self._line_temperature, *self._gamma_table)
            tau = line.derivative(gamma) / S
        self._shear = shear_rate(tau, liquid.viscosity, across)
        self._stretch = along
        tension = liquid.material.surface_tension_at(self._line_temperature)
        self._tension = float(np.max(tension))
        self._line_pressure = tension * line.curvature
        self._line_pressure = self._line_pressure + normal_stress(liquid.viscosity, along)
        if self.drives.pressure is not None:
            wave = self.drives.pressure
            self._line_pressure = self._line_pressure + wave.mean_over(line.x, *now.interval)
        self._renew()
        self._set_values(now.position)
        self.pressure = self._pressure_condition(neighbors)

    def move(self, now: SurfaceStep) -> None:
        """Move the line for a step with the velocity at its end, and find the particles again."""
        backend, line = self.backend, self.line
        begin, end = now.interval
        members = self._members(now.position, now.flows)
        x, u = backend.component(now.position, 0), backend.component(now.velocity, 0)
        found = backend.zeros(line.count + 1), backend.zeros(line.count + 1)
        tables = {"row_start": members.row_start, "member": members.neighbor, "V": now.volume}
        backend.pointwise(
            loops.mean_velocity, self._columns, found, x=x, u=u, **tables, **self._ends
        )
        mean = backend.to_host(found[0])
        height = line.extend(line.height)[1:-1]
        flux = mean * (0.5 * (height[1:] + height[:-1]) - self.bottom)
        if line.ends[0] != "periodic":
            flux[[0, -1]] = 0.0
        loss: HostArray | float = 0.0
        if self.drives.mass_flux is not None:
            S = np.sqrt(1.0 + line.slope**2)
            wave = self.drives.mass_flux
            loss = wave.mean_over(line.x, begin, end) * S / self.liquid.density
            self.flux_loss += (end - begin) * float(np.sum(loss)) * line.width
        line.move(end - begin, flux, loss)
        rate = fastest_wave(self._tension, self.liquid.density, line.cutoff)
        line.damp_short_waves((end - begin) * rate)
        self._renew()
        self.find(now.position)

    def confine(self, position: Array, flows: Array) -> None:
        """Keep particles that flow below the surface."""
        self.backend.pointwise(
            loops.below_surface,
            {"x": position, "flows": flows},
            position,
            **self._tables,
            gap=GAP * self.spacing,
        )

    def trouble(self) -> str:
        """Slope above 1, or too little liquid below; see `Surface`."""
        line = self.line
        slope, thickness = np.abs(line.slope), line.height - self.bottom
        steep, thin = int(np.argmax(slope)), int(np.argmin(thickness))
        if slope[steep] > STEEPEST:
            return (
                f"the surface has the slope {slope[steep]:.3g} at x = "
                f"{format_quantity(line.x[steep], 'm', 3)}, and none above {STEEPEST:.0f} is "
                "computed; take a weaker drive or an earlier end"
            )
        if thickness[thin] < FEWEST_ROWS * self.spacing:
            return (
                f"the liquid is {format_quantity(thickness[thin], 'm', 3)} thick at x = "
                f"{format_quantity(line.x[thin], 'm', 3)}, less than {FEWEST_ROWS:.0f} spacings of "
                "particles; take a finer spacing, a weaker drive or an earlier end"
            )
        return ""

    def time_step_limits(self) -> dict[str, float]:
        """Capillary waves, and the viscous stress on the shortest of them [s]."""
        rho, eta, _ = self.liquid
        return surface_limits(self._tension, rho, eta / rho, self.line.cutoff)

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        return {"surface.flux_loss": self.flux_loss, "surface.tension": self._tension}

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from `checkpoint_scalars`."""
        self.flux_loss, self._tension = numbers["surface.flux_loss"], numbers["surface.tension"]

    def restore_arrays(self, arrays: Mapping[str, np.ndarray]) -> None:
        """Continue from the arrays of a checkpoint."""
        height, self._shear, self._stretch = (np.array(arrays[f"surface_{n}"]) for n in LINE)
        self.line.height = height
        self._renew()

    def save(self) -> None:
        """Remember the line, for `go_back`."""
        self._kept = {
            "surface_height": self.line.height,
            "surface_shear": self._shear,
            "surface_stretch": self._stretch,
        }

    def go_back(self) -> None:
        """Take the line that `save` remembered."""
        self.restore_arrays(self._kept)

    def _temperature_at(self, now: SurfaceStep, found: HostArray) -> HostArray:
        """Temperature along the line: imposed, or of the particles there [K]."""
        given = self.drives.temperature
        if given is None:
            return self.line.smooth(found)
        mean = np.full(self.line.count, given.mean)
        return (
            mean if given.wave is None else mean + given.wave.mean_over(self.line.x, *now.interval)
        )

    def _members(self, position: Array, flows: Array) -> NeighborList:
        """The particles of each column."""
        columns = self.line.count
        key = self.backend.zeros(flows.shape[0], "index")
        fields = {"x": position, "flows": flows}
        self.backend.pointwise(loops.column_of, fields, key, **self._grid, columns=float(columns))
        return members_of(self.backend, key, columns)

    def _set_values(self, position: Array) -> None:
        """What the line gives particles and their ghosts."""
        fields = {"x": position, "n": self._n, "distance": self._distance}
        out = (self._jump, self.ghost_velocity_jump, self._p_b, self.temperature, self.gradient)
        tables = {name: self._tables[name] for name in ("start", "inverse", "nodes")}
        self.backend.pointwise(loops.surface_values, fields, out, **tables, **self._fields)

    def _renew(self) -> None:
        """Tables of the line for loops."""
        line, table = (
            self.line,
            lambda values, parity=EVEN: self.backend.asarray(line.extend(values, parity)),
        )
        self._tables = self._grid | {"nodes": self._nodes, "height": table(line.height)}
        self._tables["slope"] = table(line.derivative(line.height), ODD)
        self._fields = {
            "shear": table(self._shear, ODD),
            "stretch": table(self._stretch),
            "p_b": table(self._line_pressure),
            "T_line": table(self._line_temperature),
            "gradient": table(self._gradient, ODD),
        }

    def _pressure_condition(self, neighbors: SurfaceNeighbors) -> PressureCondition:
        """Boundary coefficients and pressures of the pressure equation."""
        backend, count = self.backend, neighbors.pairs.row_start.shape[0] - 1
        a, p_b = backend.zeros(count), backend.zeros(count)
        fields = {"g_ij": neighbors.weights, "across": neighbors.across}
        fields |= {"distance": neighbors.gather(self._distance), "p_b": neighbors.gather(self._p_b)}
        terms, finish = loops.given_pressure, loops.given_pressure_of_row
        backend.pair_sum(terms, neighbors.pairs, fields, (a, p_b), finish=finish)
        return PressureCondition(coefficient=a, value=p_b)
