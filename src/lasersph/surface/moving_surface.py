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

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.particles.fields import Field
from lasersph.particles.ghosts import TANGENT
from lasersph.particles.neighbor_lists import NeighborList, members_of
from lasersph.particles.particles import Particles
from lasersph.surface import loops
from lasersph.surface.capillary_waves import fastest_wave, surface_limits
from lasersph.surface.column_flux import flux_through, volume_flux
from lasersph.surface.forcing import SurfaceForcing
from lasersph.surface.height_field import HeightField, length_ratio
from lasersph.surface.pressure_condition import SurfaceLiquid, find_conditions
from lasersph.surface.pressure_gradient import DifferenceGradient
from lasersph.surface.recession import MassLoss, take_mass
from lasersph.surface.segments import SurfaceSegments
from lasersph.surface.smoothing import ODD_PARITY
from lasersph.surface.surface import Surface, SurfaceNeighbors, SurfaceStep
from lasersph.surface.surface_stress import PARITIES, StressAlong, SurfaceStress
from lasersph.surface.time_rule import Midpoint
from lasersph.surface.validity import validity_error

HostArray = NDArray[np.float64]
MIN_DISTANCE = 0.2
"""Least distance from the surface over the spacing, for pressures, heat and ghosts. Guard: a
particle that has come out would have its ghost in its own place."""
MIN_DEPTH = 0.3
"""Particles stay as far below the surface, over the spacing. Guard: as at faces."""
MIN_MELT_THICKNESS = 0.5
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
MAX_SPEED = 1000.0
"""Speed of metal below a surface that moves [m/s]. Guard: a quarter of the speed of sound in liquid
steel and aluminum, some 4 km/s; what flows faster is not incompressible, and no texture flows at
200 m/s."""


class MovingSurface(Surface):
    """The surface over a box of liquid, see `Surface`.

    Args:
        count: particles of the whole body. line: columns, at their heights at the start. bottom: z
            of the wall [m]. spacing, support: of the particles [m]. has_stress: gamma drives it.

    Attributes:
        line: the heights. values: along it. segments: what of it moves. loss: mass that leaves.
    """

    crossing = TANGENT
    moves = True
    largest_speed = MAX_SPEED
    pressure_gradient = DifferenceGradient()
    time_rule = Midpoint()
    loss_shares = (0.5, 0.5)
    """Shares of what leaves in a step that the line loses in its halves."""

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
        # no particle comes to lie higher above the plane z = 0 than the wall lies below it
        dimension, min_distance = 1 + len(line.shape), MIN_DISTANCE * spacing
        super().__init__(backend, count, -bottom, dimension, min_distance)
        self.line, self.bottom, self.spacing = line, bottom, spacing
        self.liquid, self.forcing = liquid, forcing
        self.stress_law = SurfaceStress(liquid, forcing, has_stress=has_stress)
        # a ghost's jump is a vector, and so is that which passes on the whole stress
        self.ghost_velocity_jump, self.gradient = backend.zeros(count), backend.zeros(count)
        self.velocity_jump = backend.zeros((dimension, count))
        self.stress_jump = backend.zeros((dimension, count))

        # the line as loops know it
        low, high = (END_KINDS[kind] for kind in line.ends[0])
        self._grid: Constants = {"start": line.start[0], "inverse": 1.0 / line.widths[0]}
        self._ends = self._grid | {"columns": line.count, "low_end": low, "high_end": high}
        self._nodes: Constants = self._grid | {"nodes": float(line.count + 4)}
        self._marks: Constants = {"near": spacing, "far": support, "min_distance": min_distance}
        self._columns = {"k": backend.asarray(np.arange(line.count), "index")}

        # columns: what survives a step, what moves, what leaves, values along the line
        self._state = Particles(backend, line.count, 1, STATE)
        self._is_overrun = np.zeros(line.count, bool)
        self.segments = SurfaceSegments(line)
        self.loss = MassLoss(line.count, liquid.particle_density, forcing)
        self.values = self._no_values()
        metal = liquid.material
        self._initial_tension = float(metal.surface_tension_at(metal.flow_temperature))
        self._tension = self._initial_tension
        # tables of both, for loops
        self._tables: Constants = {}
        self._fields: Constants = {}
        self._update_tables()

    def _no_values(self) -> StressAlong:
        """Zero stresses, strain rates and temperatures along the line."""
        return StressAlong(*(np.zeros(self.line.count) for _ in StressAlong._fields))

    @property
    def state(self) -> Particles:
        """Table of the columns, with their present values."""
        own = self.values
        values = self.line.height, own.shear, own.strain_rate, self.loss.followed
        for field, value in zip(STATE, values, strict=True):
            self._state.set(field.name, value)
        return self._state

    def take_state(self) -> None:
        """Go on from the values of the table."""
        found = [np.array(self.backend.to_host(self._state[field.name])) for field in STATE]
        self.line.height, shear, strain_rate, self.loss.followed = found
        self.values = self.values._replace(shear=shear, strain_rate=strain_rate)
        self._update_tables()

    def settle(self, settled: Array, relative_viscosity: Array, remaining: float) -> None:
        """Nothing is to be undone under a given pressure."""

    def settled_jump(self, settled: Array) -> Array:
        """The jump is seen at once."""
        return self.velocity_jump

    def heights(self, columns: int) -> HostArray:
        """Heights of the columns."""
        return self.line.height

    def reset(self) -> None:
        """Forget strain rates, stresses and temperatures along the line."""
        self.values = self._no_values()
        self._tension = self._initial_tension
        self._update_tables()

    def find(self, position: Array) -> None:
        """Set marks, depths and ghosts of the particles at `position`, shape (d, n) [m]."""
        ghosts = self.ghosts
        out = (self.at_surface, self.near_surface, self.depth)
        out += (ghosts.normal, ghosts.distance, ghosts.shift)
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
        backend, line = self.backend, self.line
        self._set_values(now.position)

        # velocity and temperature along the line, fitted to the particles of five columns
        members = self._members(now.position, now.flows)
        found = backend.zeros((2, line.count)), backend.zeros(line.count), backend.zeros(line.count)
        tables: Constants = {"row_start": members.row_start, "member": members.neighbor}
        tables |= {"x": now.position, "v": now.velocity, "jump": self.velocity_jump}
        tables |= {"T": now.T, "depth": self.depth, "spacing": self.spacing}
        backend.pointwise(loops.surface_velocity, self._columns, found, **tables, **self._ends)
        velocity, T, weight = (backend.to_host(values) for values in found)

        # columns without melt near the surface, or just reached: what those beside them have
        full, places = (weight > 0.0) & ~self._is_overrun, line.centers()
        if full.any() and not full.all():
            velocity = np.array([np.interp(places, places[full], u[full]) for u in velocity])
            T = np.interp(places, places[full], T[full])

        # du_t/dn, du_t/ds and p_b along each part that moves
        values, largest = self._no_values()._replace(T_line=np.array(T)), 0.0
        self.segments.update_heights()
        for columns, own in self.segments.parts:
            x, u = places[columns], velocity[:, columns]
            along, tension = self.stress_law.along(own, x, now.interval, u, T[columns])
            largest = max(largest, tension)
            for whole, part in zip(values, along, strict=True):
                whole[columns] = part
        self._tension = largest or self._tension

        # beside a pool the pressure that holds at its edge
        molten = self.segments.is_molten
        if molten.any() and not molten.all():
            p_b = np.interp(places, places[molten], values.p_b[molten])
            values = values._replace(p_b=p_b)
        self.values = values
        self._update_values()
        self._set_values(now.position)

        # boundary coefficients of the pressure equation, and the jump that passes on all stress
        relative = self.liquid.relative_viscosity_at(values.T_line)
        self.pressure, share = find_conditions(
            backend, line, molten, members, self.ghosts, neighbors, relative
        )
        shares = backend.asarray(np.pad(share, 2, mode="edge"))
        fields = {"x": now.position, "jump": self.velocity_jump}
        backend.pointwise(loops.passed_on, fields, self.stress_jump, **self._nodes, share=shares)

    def hold_thin_melt(self, position: Array, volume: Array, flows: Array) -> float:
        """Let what is molten under too thin columns rest; returns how many particles flow."""
        backend, line = self.backend, self.line
        # columns over which the melt runs move, however little of it has arrived there
        thick = self._is_thick(self._melt_height(position, volume, flows))
        self._is_overrun = self._overrun(thick)
        self.segments.choose(thick | self._is_overrun)
        # particles of the columns that do not move rest
        is_molten = backend.asarray(self.segments.is_molten.astype(float))
        grid = self._grid | {"columns": float(line.count), "is_molten": is_molten}
        fields = {"x": position, "flows": flows}
        return backend.pointwise(loops.hold_column, fields, (flows,), reduce=("sum",), **grid)[0]

    def _melt_height(self, position: Array, volume: Array, flows: Array) -> HostArray:
        """(columns,) height of what flows [m]."""
        found, members = self.backend.zeros(self.line.count), self._members(position, flows)
        tables: Constants = {"row_start": members.row_start, "member": members.neighbor}
        tables |= {"V": volume, "inverse": self._grid["inverse"]}
        self.backend.pointwise(loops.thickness_of, self._columns, found, **tables)
        return self.backend.to_host(found)

    def _is_thick(self, height: HostArray) -> NDArray[np.bool_]:
        """(columns,) whether the melt, of a height (columns,) [m], is thick, as a mean of five."""
        thickness = self.line.mean_of_neighbors(height, np.ones(height.size, bool))
        return thickness >= MIN_MELT_THICKNESS * self.spacing

    def _overrun(self, thick: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """(columns,) over which melt runs from the thick ones (columns,)."""
        return self.segments.overrun(thick) & ~thick

    def advance_first_half(self, now: SurfaceStep) -> None:
        """Move the line through the first half of a step, with the velocity at its begin."""
        self.segments.update_heights()
        self.loss.begin_step(self.backend, now, self.segments)
        self._go_halfway(now, self.loss_shares[0])

    def advance_second_half(self, now: SurfaceStep) -> float:
        """Move the line through the second half of a step, with the velocity at its end, and damp
        short waves; find the particles again, and take from them what has left in the step."""
        self._go_halfway(now, self.loss_shares[1])
        # short waves are damped within the time of the fastest wave that the line shows
        line, moved, step = self.line, self.line.height.copy(), now.interval[1] - now.interval[0]
        rate = fastest_wave(self._tension, self.liquid.density, line.cutoff)
        self.segments.update_heights()
        for part, own in self.segments.parts:
            own.damp_short_waves(step * rate)
            moved[part] = own.height
        line.height = moved
        self._update_tables()
        self.find(now.position)
        return self._take_mass(now)

    def _take_mass(self, now: SurfaceStep) -> float:
        """Take from the particles what has left through the surface; returns its heat [J/m]."""
        if not self.loss.lost.any():
            return 0.0
        density, spacing = self.liquid.particle_density, self.spacing
        lost, gone = self.loss.lost, self.loss.followed / density
        return take_mass(self.backend, now, self.depth, self.line, lost, gone, spacing, density)

    def _go_halfway(self, now: SurfaceStep, loss_share: float) -> None:
        """Move the line by what flows in half of a step, and by a share of what leaves in it."""
        self.segments.update_heights()
        flux = volume_flux(self.backend, self.line, self.bottom, now, self._ends)
        half, height = 0.5 * (now.interval[1] - now.interval[0]), self.line.height.copy()
        for part, own in self.segments.parts:
            flow = flux_through(own, part, flux)
            height[part] = own.heights_after(half, flow) - loss_share * self.loss.lost[part]
        self.line.height = height
        self._update_tables()

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
        ghosts = self.ghosts
        fields = {"x": position, "n": ghosts.normal, "distance": ghosts.distance}
        out = (self.velocity_jump, self.ghost_velocity_jump, ghosts.pressure)
        out += (self.temperature, self.gradient)
        self.backend.pointwise(loops.surface_values, fields, out, **self._nodes, **self._fields)

    def _update_tables(self) -> None:
        """Tables of the line for loops: place and slope of the surface, and values along it."""
        line, asarray = self.line, self.backend.asarray
        slope = line.derivative(line.height)
        self._tables = self._nodes | {
            "height": asarray(line.extend(line.height)),
            "slope": asarray(line.extend(slope, ODD_PARITY)),
        }
        self._update_values()

    def _update_values(self) -> None:
        """Values along the line for loops."""
        self._fields = {
            name: self.backend.asarray(self.line.extend(values, PARITIES[name]))
            for name, values in self.values._asdict().items()
        }
