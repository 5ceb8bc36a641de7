"""`MovingSurface`: a free surface z = eta(x, y, t), as what it gives a step of the flow.

    heights               `height_field`, moved by the mean velocity of the particles in each column
    tangential stress     P (2 mu D n) = grad_s gamma                   [Demuth2020, eq. (15)]
    normal stress         p = p_e + gamma kappa + 2 mu n . D . n, see `surface_stress`
    velocities beyond     v + 2 d (s - div_s v n), no component turned around

n points out of the melt, d is the distance from the local tangent, s the tangential part of dv/dn.
With D and div v = 0 the stresses become

    s = grad_s gamma/mu - (grad_s v) n,      p_b = p_e + gamma kappa - 2 mu div_s v

where grad_s v is that of the velocity along the surface: of particles near it, carried on to it,
smoothed as slope and curvature are, and mu that at its temperature. A ghost across the surface
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
from lasersph.surface.column_flux import volume_flux
from lasersph.surface.column_loops import thickness_of
from lasersph.surface.forcing import SurfaceForcing
from lasersph.surface.height_field import HeightField, length_ratio
from lasersph.surface.pools import SurfacePools
from lasersph.surface.pressure_condition import PairsAcross, SurfaceLiquid
from lasersph.surface.pressure_gradient import DifferenceGradient
from lasersph.surface.recession import MassLoss, take_mass
from lasersph.surface.segments import SurfaceSegments, overrun
from lasersph.surface.surface import Surface, SurfaceNeighbors, SurfaceStep
from lasersph.surface.surface_fit import surface_velocity_of_grid, surface_velocity_of_line
from lasersph.surface.surface_stress import StressAlong, SurfaceStress
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
    Field("surface_shear_rate", "shear", "1/s", "du_t/dn", "vector", is_kept=True),
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
        self.gradient = backend.zeros(count)
        # its tangential part: along the tangent of a line, or a vector
        if dimension == 2:
            self.ghost_velocity_jump = backend.zeros(count)
        self.velocity_jump = backend.zeros((dimension, count))
        self.stress_jump = backend.zeros((dimension, count))

        # the columns as loops know them
        low, high = zip(*((END_KINDS[a], END_KINDS[b]) for a, b in line.ends), strict=True)
        self._grid: Constants = {"start": line.start, "inverse_width": line.inverse_widths}
        self._grid |= {"columns": tuple(map(float, line.shape))}
        self._ends: Constants = {"low_end": low, "high_end": high}
        self._nodes: Constants = {"start": line.start, "inverse_width": line.inverse_widths}
        self._nodes |= {"nodes": tuple(n + 4.0 for n in line.shape)}
        self._marks: Constants = {"near": spacing, "far": support, "min_distance": min_distance}
        self._columns = {"k": backend.asarray(np.arange(line.count), "index")}
        self._fit = surface_velocity_of_line if dimension == 2 else surface_velocity_of_grid

        # columns: what survives a step, what moves, what leaves, values along the line
        self._state = Particles(backend, line.count, len(line.shape), STATE)
        self._is_overrun = np.zeros(line.count, bool)
        self.segments = SurfaceSegments(line) if dimension == 2 else SurfacePools(line)
        self.loss = MassLoss(line.count, liquid.particle_density, forcing)
        self._pairs_across = PairsAcross(backend, line)
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
        columns = self.line.count
        found = StressAlong(*(np.zeros(columns) for _ in StressAlong._fields))
        return found._replace(shear=np.zeros((len(self.line.shape), columns)))

    @property
    def state(self) -> Particles:
        """Table of the columns, with their present values."""
        own = self.values
        values = self.line.height.ravel(), own.shear, own.strain_rate, self.loss.followed
        for field, value in zip(STATE, values, strict=True):
            self._state.set(field.name, value)
        return self._state

    def take_state(self) -> None:
        """Go on from the values of the table."""
        found = [np.array(self.backend.to_host(self._state[field.name])) for field in STATE]
        height, shear, strain_rate, self.loss.followed = found
        self.line.height = height.reshape(self.line.shape)
        self.values = self.values._replace(shear=shear, strain_rate=strain_rate)
        self._update_tables()

    def settle(self, settled: Array, relative_viscosity: Array, remaining: float) -> None:
        """Nothing is to be undone under a given pressure."""

    def settled_jump(self, settled: Array) -> Array:
        """The jump is seen at once."""
        return self.velocity_jump

    def heights(self, columns: int) -> HostArray:
        """Heights of the columns, in the shape of their grid."""
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
        """(columns,) sqrt(1 + |grad eta|^2), with the slope at which particles see the surface."""
        return self.backend.asarray(length_ratio(self.line.gradient(self.line.height)).ravel())

    def find_depth(self, position: Array, out: Array) -> None:
        """Depth below the local surface along z [m] of particles at `position` [m]."""
        self.backend.pointwise(loops.below_surface, {"x": position}, out, **self._tables)

    def update_stress(self, now: SurfaceStep, neighbors: SurfaceNeighbors, active: Array) -> None:
        """Set what the line gives the particles and their ghosts; see `Surface`."""
        backend, line = self.backend, self.line
        self._set_values(now.position)

        # velocity and temperature along the line, fitted to the particles of five columns
        members, count = self._members(now.position, now.flows), line.count
        found = backend.zeros((len(self.normal), count)), backend.zeros(count), backend.zeros(count)
        tables: Constants = {"row_start": members.row_start, "member": members.neighbor}
        tables |= {"x": now.position, "v": now.velocity, "jump": self.velocity_jump}
        tables |= {"T": now.T, "depth": self.depth, "spacing": self.spacing}
        backend.pointwise(self._fit, self._columns, found, **tables, **self._grid, **self._ends)
        velocity, T, weight = (backend.to_host(values) for values in found)

        # columns without melt near the surface, or just reached: what those beside them have
        full = (weight > 0.0) & ~self._is_overrun
        if full.any() and not full.all():
            velocity = np.array([line.fill_gaps(u, full) for u in velocity])
            T = line.fill_gaps(T, full)

        # s, div_s v and p_b along each part that moves
        values, largest = self._no_values()._replace(T_line=np.array(T)), 0.0
        self.segments.update_heights()
        for columns, own in self.segments.parts:
            along, tension = self.stress_law.along(
                own, now.interval, velocity[:, columns], T[columns]
            )
            largest = max(largest, tension)
            for whole, part in zip(values, along, strict=True):
                whole[..., columns] = part
        self._tension = largest or self._tension

        # beside a pool the pressure that holds at its edge
        molten = self.segments.is_molten
        if molten.any() and not molten.all():
            values = values._replace(p_b=line.fill_gaps(values.p_b, molten))
        self.values = values
        self._update_values()
        self._set_values(now.position)

        # boundary coefficients of the pressure equation, and the jump that passes on all stress
        relative = self.liquid.relative_viscosity_at(values.T_line)
        ratio = length_ratio(self.segments.slopes)
        share = self._pairs_across.find(molten, members, self.ghosts, neighbors, relative, ratio)
        self.pressure = self._pairs_across.condition
        shares = backend.asarray(np.pad(share.reshape(line.shape), 2, mode="edge").ravel())
        fields = {"x": now.position, "jump": self.velocity_jump}
        backend.pointwise(loops.passed_on, fields, self.stress_jump, **self._nodes, share=shares)

    def hold_thin_melt(self, position: Array, volume: Array, flows: Array) -> float:
        """Let what is molten under too thin columns rest; returns how many particles flow."""
        backend = self.backend
        # columns over which the melt runs move, however little of it has arrived there
        thick = self._is_thick(self._melt_height(position, volume, flows))
        self._is_overrun = self._overrun(thick)
        self.segments.choose(thick | self._is_overrun)
        # particles of the columns that do not move rest
        is_molten = backend.asarray(self.segments.is_molten.astype(float))
        grid = self._grid | {"is_molten": is_molten}
        fields = {"x": position, "flows": flows}
        return backend.pointwise(loops.hold_column, fields, (flows,), reduce=("sum",), **grid)[0]

    def _melt_height(self, position: Array, volume: Array, flows: Array) -> HostArray:
        """(columns,) height of what flows [m]."""
        found, members = self.backend.zeros(self.line.count), self._members(position, flows)
        tables: Constants = {"row_start": members.row_start, "member": members.neighbor}
        tables |= {"V": volume, "inverse_area": self.line.inverse_area}
        self.backend.pointwise(thickness_of, self._columns, found, **tables)
        return self.backend.to_host(found)

    def _is_thick(self, height: HostArray) -> NDArray[np.bool_]:
        """(columns,) whether the melt, of a height (columns,) [m], is thick, as a mean of five."""
        shape = self.line.shape
        thickness = self.line.mean_of_neighbors(height.reshape(shape), np.ones(shape, bool))
        return thickness.ravel() >= MIN_MELT_THICKNESS * self.spacing

    def _overrun(self, thick: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """(columns,) over which melt runs from the thick ones (columns,)."""
        return overrun(self.line, thick) & ~thick

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
        line, step = self.line, now.interval[1] - now.interval[0]
        moved = line.height.ravel().copy()
        rate = fastest_wave(self._tension, self.liquid.density, line.cutoff)
        self.segments.update_heights()
        for part, own in self.segments.parts:
            own.damp_short_waves(step * rate)
            moved[part] = own.height
        line.height = moved.reshape(line.shape)
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
        line, half = self.line, 0.5 * (now.interval[1] - now.interval[0])
        flux = volume_flux(self.backend, line, self.bottom, now, self._grid, self._ends)
        height = self.segments.heights_after(half, flux) - loss_share * self.loss.lost
        line.height = height.reshape(line.shape)
        self._update_tables()

    def confine(self, position: Array, flows: Array) -> None:
        """Keep particles that flow below the surface."""
        fields = {"x": position, "flows": flows}
        tables: Constants = self._tables | {"min_depth": MIN_DEPTH * self.spacing}
        self.backend.pointwise(loops.confined, fields, position, **tables)

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
        self.backend.pointwise(loops.column_of, fields, key, **self._grid)
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
        line, asarray, axes = self.line, self.backend.asarray, range(len(self.line.shape))
        slopes = line.gradient(line.height)
        height, slope = line.at_nodes(line.height), [line.at_nodes(slopes[a], a) for a in axes]
        # eta_xy of a grid, odd along both axes
        twist = line.at_nodes(line.derivative(slopes[1]), 0, 1) if len(slopes) > 1 else height
        self._tables = self._nodes | {
            "height": asarray(height),
            "slope": asarray(np.array(slope)),
            "twist": asarray(twist),
        }
        self._update_values()

    def _update_values(self) -> None:
        """Values along the line for loops, those of shear odd along their axes."""
        line, own, asarray = self.line, self.values, self.backend.asarray
        shape = line.shape
        fields = {
            name: line.at_nodes(values.reshape(shape))
            for name, values in own._asdict().items()
            if name != "shear"
        }
        # on a line the gradient of the temperature has a sign
        if len(shape) == 1:
            fields["gradient"] = line.at_nodes(own.gradient, 0)
        shear = [line.at_nodes(part.reshape(shape), a) for a, part in enumerate(own.shear)]
        fields["shear"] = np.array(shear)
        self._fields = {name: asarray(values) for name, values in fields.items()}
