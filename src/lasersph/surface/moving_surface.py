"""`MovingSurface`: a free surface z = eta(x, t), as what it gives a step of the flow.

    heights               `height_field`, moved by the mean velocity of the particles in each column
    tangential stress     t . (2 mu D) . n = d gamma/ds                   [Demuth2020, eq. (15)]
    normal stress         p = p_e + gamma kappa + 2 mu n . D . n, see `surface_stress`
    velocities beyond     v + 2 d (du_t/dn t - du_t/ds n), no component turned around

n points out of the melt, t along +x, d is the distance from the local tangent. With D and
div v = 0 the stresses become

    du_t/dn = tau/mu - n . dv/ds,        p_b = p_e + gamma kappa - 2 mu t . dv/ds

where dv/ds is that of the velocity along the line: of particles near it, carried on to it, smoothed
as slope and curvature are, and mu that at the temperature of the line. A ghost across the surface
has p = 2 p_b - p_i; in the pressure equation the surface is a boundary of given pressure.

The line goes half of its way through a step with the velocity at its begin, the flow of the step is
found with particles and line there, and it goes the other half with the velocity at the end: a
leapfrog, of second order as the particles' own way (71). Curvature and stress are those of the
middle, with half of the mass gone that leaves in the step. Waves neither grow nor decay by it while
omega dt < 2 for the fastest that the smoothed line shows; half of one is taken. Waves shorter than
the smoothing length are damped within the time of that wave.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.particles.fields import Field
from lasersph.particles.neighbor_lists import NeighborList, members_of
from lasersph.particles.particles import Particles
from lasersph.surface import loops
from lasersph.surface.capillary_waves import fastest_wave, surface_limits
from lasersph.surface.column_flux import flux_through, volume_flux
from lasersph.surface.forcing import SurfaceForcing
from lasersph.surface.height_field import HeightField, length_ratio
from lasersph.surface.pressure_condition import SurfaceLiquid, find_conditions
from lasersph.surface.pressure_gradient import DifferenceGradient, PressureGradient
from lasersph.surface.recession import MassLoss, take_mass
from lasersph.surface.segments import Segment, SurfaceSegments
from lasersph.surface.smoothing import EVEN, ODD
from lasersph.surface.surface import (
    PressureCondition,
    SurfaceGhosts,
    SurfaceNeighbors,
    SurfaceStep,
    upward,
)
from lasersph.surface.surface_stress import SurfaceStress
from lasersph.surface.time_rule import Midpoint, TimeRule
from lasersph.surface.validity import validity_error

HostArray = NDArray[np.float64]
MIN_DISTANCE = 0.2
"""Least distance from the surface over the spacing, for pressures, heat and ghosts. Guard: a
particle that has come out would have its ghost in its own place."""
MIN_DEPTH = 0.3
"""Particles stay as far below the surface, over the spacing. Guard: as at faces."""
THINNEST = 0.5
"""Thickness of melt over the spacing from which its column moves, as a mean of five columns.
Accuracy: less is no row; with 3 a quarter of the relief of `texture-steel` was lost at 32 nm."""
END_KINDS = {"pinned": loops.PINNED, "mirror": loops.MIRROR, "periodic": loops.PERIODIC}
STATE = (
    Field("surface_height", "eta", "m", "height of a column", is_kept=True),
    Field("surface_shear_rate", "shear", "1/s", "du_t/dn", is_kept=True),
    Field("surface_strain_rate", "strain_rate", "1/s", "du_t/ds", is_kept=True),
    Field("surface_followed", "followed", "kg/m^2", "evaporated mass that has left", is_kept=True),
)
"""Fields of the columns that survive a step."""
FASTEST = 1000.0
"""Speed of metal below a surface that moves [m/s]. Guard: a quarter of the speed of sound in liquid
steel and aluminum, some 4 km/s; what flows faster is not incompressible, and no texture flows at
200 m/s."""


class MovingSurface:
    """The surface over a box of liquid, see `Surface`.

    Args:
        count: particles of the whole body. line: columns, at their heights at the start. bottom: z
            of the wall [m]. spacing, support: of the particles [m]. has_stress: gamma drives it.

    Attributes:
        line: the heights. ghosts: what lies beyond. loss: mass that leaves.
    """

    normal = upward(2)
    tangent = (1.0, 0.0)
    normal_velocity = heat_flux = 0.0
    top = inf
    moves = True
    largest_speed = FASTEST
    pressure_gradient: PressureGradient = DifferenceGradient()
    time_rule: TimeRule = Midpoint()

    def __init__(
        self,
        backend: Backend,
        count: int,
        *,
        line: HeightField,
        bottom: float,
        spacing: float,
        support: float,
        liquid: SurfaceLiquid,
        has_stress: bool,
        forcing: SurfaceForcing,
    ) -> None:
        self.backend, self.line, self.bottom, self.spacing = backend, line, bottom, spacing
        self.liquid, self.forcing = liquid, forcing
        self.stress_law = SurfaceStress(liquid, forcing, has_stress=has_stress)
        # fields of the particles below it
        self.at_surface, self.near_surface, self.depth = (backend.zeros(count) for _ in range(3))
        self.temperature, self.gradient, self.stress = (backend.zeros(count) for _ in range(3))
        self.ghost_velocity_jump = backend.zeros(count)
        # ghosts across its tangents, by their sources
        self._distance, self._p_b = backend.zeros(count), backend.zeros(count)
        vectors = tuple(backend.zeros((2, count)) for _ in range(4))
        self._n, self._shift, self._jump, self._stress_jump = vectors
        self.ghosts = SurfaceGhosts(self._distance, self._p_b, MIN_DISTANCE * spacing, *vectors)
        self.pressure = PressureCondition()
        self._state = Particles(backend, line.count, 1, STATE)
        self._is_overrun = np.zeros(line.count, bool)
        # the line as loops know it
        low, high = (END_KINDS[kind] for kind in line.ends[0])
        self._grid: Constants = {"start": line.start[0], "inverse": 1.0 / line.widths[0]}
        self._ends = self._grid | {"columns": line.count, "low_end": low, "high_end": high}
        self._nodes = float(line.count + 4)
        self._marks: Constants = {"near": spacing, "far": support}
        self._marks["min_distance"] = MIN_DISTANCE * spacing
        self._columns = {"k": backend.asarray(np.arange(line.count), "index")}
        self.segments = SurfaceSegments(line)
        self.loss = MassLoss(line.count, liquid.particle_density, forcing)
        self.reset()

    @property
    def state(self) -> Particles:
        """Table of the columns, with their present values."""
        values = self.line.height, self._shear, self._strain_rate, self.loss.followed
        for field, value in zip(STATE, values, strict=True):
            self._state.set(field.name, value)
        return self._state

    def take_state(self) -> None:
        """Go on from the values of the table."""
        found = [np.array(self.backend.to_host(self._state[field.name])) for field in STATE]
        self.line.height, self._shear, self._strain_rate, self.loss.followed = found
        self._renew()

    @property
    def velocity_jump(self) -> Array:
        """(2, n) across the tangents."""
        return self._jump

    @property
    def stress_jump(self) -> Array:
        """That with which pairs across pass on the whole stress."""
        return self._stress_jump

    def settle(self, settled: Array, relative_viscosity: Array, remaining: float) -> None:
        """Nothing is to be undone under a given pressure."""

    def settled_jump(self, settled: Array) -> Array:
        """The jump is seen at once."""
        return self._jump

    def kept_at_face(self, dummy: Array) -> Array:
        """Dummies alone: particles at the surface are kept below it by `confine`."""
        return dummy

    def heights(self, columns: int) -> HostArray:
        """Heights of the columns."""
        return self.line.height

    def reset(self) -> None:
        """Forget strain rates, stresses and temperatures along the line."""
        metal, zero = self.liquid.material, np.zeros(self.line.count)
        self._shear = self._strain_rate = self._gradient = zero
        self._line_pressure = self._line_temperature = zero
        self._tension = float(metal.surface_tension_at(metal.flow_temperature))
        self._renew()

    def find(self, position: Array) -> None:
        """Set marks, depths and ghosts of the particles at `position`, shape (2, n) [m]."""
        out = (self.at_surface, self.near_surface, self.depth, self._n, self._distance, self._shift)
        tables: Constants = self._tables | self._marks
        self.backend.pointwise(loops.surface_geometry, {"x": position}, out, **tables)

    def length_ratio(self) -> Array:
        """(columns,) sqrt(1 + eta_x^2), with the slope at which the particles see the surface."""
        return self.backend.asarray(length_ratio(self.line.gradient(self.line.height)))

    def find_depth(self, position: Array, out: Array) -> None:
        """Depth below the local surface along z [m] of particles at `position` [m]."""
        self.backend.pointwise(loops.below_line, {"x": position}, out, **self._tables)

    def update_stress(self, now: SurfaceStep, neighbors: SurfaceNeighbors, active: Array) -> None:
        """Set what the line gives the particles and their ghosts; see `Surface`."""
        backend, line, places = self.backend, self.line, self.line.centers()
        self._set_values(now.position)

        # velocity and temperature along the line, fitted to the particles of five columns
        members = self._members(now.position, now.flows)
        x = backend.component(now.position, 0)
        u, w = (backend.component(now.velocity, k) for k in (0, 1))
        jump_x, jump_z = (backend.component(self._jump, k) for k in (0, 1))
        found = tuple(backend.zeros(line.count) for _ in range(4))
        tables: Constants = {"row_start": members.row_start, "member": members.neighbor}
        tables |= {"x": x, "T": now.T, "depth": self.depth, "u": u, "w": w}
        tables |= self._ends | {"spacing": self.spacing, "jump_x": jump_x, "jump_z": jump_z}
        backend.pointwise(loops.surface_velocity, self._columns, found, **tables)
        u_s, w_s, T_s, weight = (backend.to_host(values) for values in found)

        # columns without melt near the surface, or just reached: what those beside them have
        full = (weight > 0.0) & ~self._is_overrun
        if full.any() and not full.all():
            u_s, w_s, T_s = (np.interp(places, places[full], f[full]) for f in (u_s, w_s, T_s))
        self._line_temperature = T_s

        # du_t/dn, du_t/ds and p_b along each part that moves
        self._shear, self._strain_rate, self._gradient = (np.zeros(line.count) for _ in range(3))
        self._line_pressure, largest = np.zeros(line.count), 0.0
        self.segments.follow()
        for part in self.segments.parts:
            largest = max(largest, self._set_part(part, now.interval, (u_s, w_s), T_s))
        self._tension = largest or self._tension
        # beside a pool the pressure that holds at its edge
        molten = self.segments.is_molten
        if molten.any() and not molten.all():
            known = self._line_pressure[molten]
            self._line_pressure = np.interp(places, places[molten], known)
        self._renew_values()
        self._set_values(now.position)

        # boundary coefficients of the pressure equation, and the jump that passes on all stress
        relative = self.liquid.relative_viscosity_at(self._line_temperature)
        self.pressure, share = find_conditions(
            backend, line, molten, members, self.ghosts, neighbors, relative
        )
        tables = {name: self._tables[name] for name in ("start", "inverse", "nodes")}
        tables["share"] = backend.asarray(np.pad(share, 2, mode="edge"))
        fields = {"x": now.position, "jump": self._jump}
        backend.pointwise(loops.passed_on, fields, self._stress_jump, **tables)

    def _set_part(
        self,
        part: Segment,
        interval: tuple[float, float],
        velocity: tuple[HostArray, HostArray],
        T: HostArray,
    ) -> float:
        """Stress, strain rates and pressure along a part that moves; largest gamma there [N/m].

        Args:
            velocity, T: of the whole line [m/s], [K].
        """
        columns, line = part
        u, w = velocity
        own = u[columns], w[columns]
        found = self.stress_law.along(line, self.line.centers()[columns], interval, own, T[columns])
        self._line_temperature[columns] = found.temperature
        self._gradient[columns] = found.temperature_slope
        self._shear[columns] = found.shear_rate
        self._strain_rate[columns] = found.strain_rate
        self._line_pressure[columns] = found.pressure
        return found.largest_tension

    def hold_thin_melt(self, position: Array, volume: Array, flows: Array) -> float:
        """Let what is molten under too thin columns rest; returns how many particles flow."""
        backend, line, everywhere = self.backend, self.line, np.ones(self.line.count, bool)
        # thickness of the melt in each column, as a mean of five
        members = self._members(position, flows)
        found = backend.zeros(line.count)
        tables: Constants = {"row_start": members.row_start, "member": members.neighbor}
        tables |= {"V": volume, "inverse": self._grid["inverse"]}
        backend.pointwise(loops.thickness_of, self._columns, found, **tables)
        thickness = line.mean_of_neighbors(backend.to_host(found), everywhere)
        # columns over which the melt runs move, however little of it has arrived there
        thick = thickness >= THINNEST * self.spacing
        self._is_overrun = self.segments.overrun(thick) & ~thick
        self.segments.choose(thick | self._is_overrun)
        # particles of the columns that do not move rest
        is_molten = backend.asarray(self.segments.is_molten.astype(float))
        grid = self._grid | {"columns": float(line.count), "is_molten": is_molten}
        fields = {"x": position, "flows": flows}
        (count,) = backend.pointwise(loops.hold_column, fields, (flows,), reduce=("sum",), **grid)
        return count

    def advance_first_half(self, now: SurfaceStep) -> None:
        """Move the line through the first half of a step, with the velocity at its begin."""
        self.segments.follow()
        self.loss.begin_step(self.backend, now, self.segments)
        self._go_halfway(now)

    def advance_second_half(self, now: SurfaceStep) -> float:
        """Move the line through the second half of a step, with the velocity at its end, and damp
        short waves; find the particles again, and take from them what has left in the step."""
        self._go_halfway(now)
        # short waves are damped within the time of the fastest wave that the line shows
        line, moved, step = self.line, self.line.height.copy(), now.interval[1] - now.interval[0]
        rate = fastest_wave(self._tension, self.liquid.density, line.cutoff)
        self.segments.follow()
        for part, own in self.segments.parts:
            own.damp_short_waves(step * rate)
            moved[part] = own.height
        line.height = moved
        self._renew()
        self.find(now.position)
        # the particles lose what has left through the surface
        if not self.loss.lost.any():
            return 0.0
        density, spacing = self.liquid.particle_density, self.spacing
        lost, gone = self.loss.lost, self.loss.followed / density
        return take_mass(self.backend, now, self.depth, line, lost, gone, spacing, density)

    def _go_halfway(self, now: SurfaceStep) -> None:
        """Move the line by what flows in half of a step, and by half of what leaves in it."""
        self.segments.follow()
        flux = volume_flux(self.backend, self.line, self.bottom, now, self._ends)
        half, height = 0.5 * (now.interval[1] - now.interval[0]), self.line.height.copy()
        for part, own in self.segments.parts:
            flow = flux_through(own, part, flux)
            height[part] = own.heights_after(half, flow) - 0.5 * self.loss.lost[part]
        self.line.height = height
        self._renew()

    def confine(self, position: Array, flows: Array) -> None:
        """Keep particles that flow below the surface."""
        fields = {"x": position, "flows": flows}
        tables: Constants = self._tables | {"min_depth": MIN_DEPTH * self.spacing}
        self.backend.pointwise(loops.below_surface, fields, position, **tables)

    def validity_error(self) -> str:
        """Slope above 1, or too little liquid below; see `Surface`."""
        return validity_error(self.segments, self.bottom, self.spacing)

    def time_step_limits(self) -> dict[str, float]:
        """Capillary waves, and the viscous stress on the shortest of them [s]."""
        liquid = self.liquid
        nu = liquid.viscosity / liquid.density * float(np.max(liquid.relative_viscosity[1]))
        return surface_limits(self._tension, liquid.density, nu, self.line.cutoff)

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        numbers = {
            "flux_loss": self.loss.volume,
            "tension": self._tension,
            "delay": self.loss.delay,
        }
        return {f"surface.{name}": number for name, number in numbers.items()}

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from `checkpoint_scalars`."""
        self.loss.volume, self._tension = numbers["surface.flux_loss"], numbers["surface.tension"]
        self.loss.delay = numbers["surface.delay"]

    def _members(self, position: Array, flows: Array) -> NeighborList:
        """The particles of each column."""
        columns = self.line.count
        key = self.backend.zeros(flows.shape[0], "index")
        fields = {"x": position, "flows": flows}
        self.backend.pointwise(loops.column_of, fields, key, **self._grid, columns=float(columns))
        return members_of(self.backend, key, columns)

    def _set_values(self, position: Array) -> None:
        """Interpolate the values of the line to particles and their ghosts."""
        fields = {"x": position, "n": self._n, "distance": self._distance}
        out = (self._jump, self.ghost_velocity_jump, self._p_b, self.temperature, self.gradient)
        tables = {name: self._tables[name] for name in ("start", "inverse", "nodes")}
        self.backend.pointwise(loops.surface_values, fields, out, **tables, **self._fields)

    def _renew(self) -> None:
        """Tables of the line for loops."""
        self._set_tables(self.line.height)
        self._renew_values()

    def _set_tables(self, height: HostArray) -> None:
        """Place and slope of the surface for loops, for heights [m]."""
        line, backend = self.line, self.backend
        self._tables: Constants = self._grid | {"nodes": self._nodes}
        self._tables["height"] = backend.asarray(line.extend(height))
        self._tables["slope"] = backend.asarray(line.extend(line.derivative(height), ODD))

    def _renew_values(self) -> None:
        """Values along the line for loops."""
        odd = {"shear": self._shear, "gradient": self._gradient}
        even = {"strain_rate": self._strain_rate, "p_b": self._line_pressure}
        even["T_line"] = self._line_temperature
        self._fields = {
            name: self.backend.asarray(self.line.extend(values, parity))
            for fields, parity in ((even, EVEN), (odd, ODD))
            for name, values in fields.items()
        }
