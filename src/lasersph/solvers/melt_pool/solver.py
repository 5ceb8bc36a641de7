"""`MeltPool`: heat, melting and the incompressible flow of what is molten.

`step()` is the algorithm of [Demuth2020, Section 4.3.1]. Predictor, pressure and correction use the
advected positions (67), enthalpy, shift and adjustment the updated ones (71). At rest it conducts.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.graph import graph
from lasersph.physics.flow_limits import flow_limits
from lasersph.solvers.conduction.implicit import ImplicitStep
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.conduction.state import HeatState
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.block_terms import either
from lasersph.solvers.melt_pool.domain import PoolDomain
from lasersph.solvers.melt_pool.face_exchange import FaceExchange
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.solvers.melt_pool.flow_terms import advect, move
from lasersph.solvers.melt_pool.heat_pairs import HeatPairs
from lasersph.solvers.melt_pool.instability import refuse_unstable
from lasersph.solvers.melt_pool.layout_renewal import LayoutRenewal
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds
from lasersph.solvers.melt_pool.particle_shifting import ParticleShifting
from lasersph.solvers.melt_pool.pauses import Pauses
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.melt_pool.steadiness import Steadiness
from lasersph.solvers.step_control import PAUSE, StepFailed, retry_step
from lasersph.surface.columns import SurfaceColumns, lies_at_surface
from lasersph.surface.surface import SurfaceStep


class InvalidSurface(StepFailed):
    """A surface that moves cannot be computed any further."""


class MeltPool:
    """Solver of a run whose melt flows.

    Attributes:
        heat: the solver of enthalpies. flow: velocity and pressure. domain: faces, surface, blocks.
        position: (d, n) of all particles [m]. kinds: of the particles. fluid_count: how many do.
        has_moved: whether anything flowed in the last step.
        is_passing: whether particles keep their columns and the melt passes between them.
        spacing_min: smallest distance of two particles of the block [m].
        exchange: of a box with its faces.
    """

    is_passing = False

    def __init__(
        self,
        heat: Conduction,
        flow: Flow,
        domain: PoolDomain,
        settings: MeltPoolSettings,
        pause: Literal["compute", "spread", "remove"] = "compute",
    ) -> None:
        backend, count = heat.body.backend, heat.body.count
        self.heat, self.flow, self.domain, self.settings = heat, flow, domain, settings
        self.body, self.backend = heat.body, backend
        self.particles = heat.particles
        self.particles.add("position", "has_moving_pairs")
        self.position = self.particles["position"]
        self.particles.set("position", heat.body.filling.position[:, :count])
        # what a step moves, and how: x*, kinds, shifts, and pairs that conduct
        self._advected, self._depth = backend.zeros(self.position.shape), backend.zeros(count)
        self.kinds = ParticleKinds(self.particles, domain.spacing, is_box=domain.is_box)
        self.shifting = ParticleShifting(backend, count, settings.shifting, domain)
        self.pairs = HeatPairs(heat.body)
        # faces book heat at the potential that the implicit step ends with
        scheme = heat.scheme
        potential = scheme.P if domain.is_box and isinstance(scheme, ImplicitStep) else None
        books = domain.surface.pressure_gradient.is_symmetric
        self.exchange = FaceExchange(
            *(backend, count, potential, domain.conditions), books_pressing=books
        )
        # between pulses: new lattice, time jump; and the test of a steady flow
        self.layout_renewal = LayoutRenewal(heat.body, domain, self.kinds, self.pairs)
        self.pauses: Pauses | None = None
        if pause != "compute" and heat.laser is not None:
            pulse = heat.laser.pulse
            self.pauses = Pauses(heat.body, heat.state, pulse, pause, self.lay_out)
        self.steadiness = Steadiness(settings.steady, domain.width)
        self.surface_columns = SurfaceColumns(backend, count, *domain.surface_grid)
        beside = heat.body.filling.surface[heat.body.filling.fine_surface :]
        self.surface_columns.keep(beside, heat.body.area)
        self.spacing_min = domain.spacing
        self.fluid_count = 0.0
        self.has_moved = False
        # what has numbers of its own that survive a step
        self._parts_with_numbers = (
            *(flow, domain.surface, self.exchange),
            *(self.layout_renewal, self.steadiness),
        )
        self._numbers: dict[str, float] = {}
        domain.surface.find(self.position)

    @property
    def state(self) -> HeatState:
        """Time and energies."""
        return self.heat.state

    @property
    def particle_count(self) -> int:
        """Particles of the body."""
        return self.body.count

    @property
    def fields(self) -> dict[str, Array]:
        """Arrays of a checkpoint by name."""
        return self.particles.kept | self.domain.surface.state.kept

    @property
    def iterations(self) -> dict[str, int]:
        """Iterations of the last step."""
        return self.heat.iterations | self.flow.iterations

    @property
    def is_steady(self) -> bool:
        """Whether the flow no longer changes, where the case asks to stop then."""
        return self.steadiness.reached

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers beside the fields that survive a step."""
        numbers = {
            "block_layers": self.domain.block_layers,
            "has_moved": float(self.has_moved),
            "spacing_min": self.spacing_min,
        }
        for part in (self.heat, *self._parts_with_numbers):
            numbers |= part.checkpoint_scalars()
        return numbers

    def restore(self, arrays: Mapping[str, np.ndarray], numbers: Mapping[str, float]) -> None:
        """Continue from the arrays of `fields` and the numbers of `checkpoint_scalars`."""
        backend = self.backend
        self.heat.restore(arrays, numbers)
        self.domain.surface.state.restore(arrays)
        self.domain.surface.take_state()
        self._restore_numbers(numbers)
        # pairs are no part of a checkpoint: find those of rows that have moved again
        if backend.rows_where(self.particles["has_moving_pairs"], 1.0).shape[0]:
            block, has_row = self.domain.block_for(self.position, self.kinds), None
            if not self.kinds.is_box:
                has_row = backend.head(self.particles["has_moving_pairs"], block.count)
            block.find_pairs(self.position, has_row)
            self.pairs.update(block)

    def time_step_limits(self) -> dict[str, float]:
        """Named limits of the next step [s]."""
        limits = self.heat.time_step_limits()
        if not self._melt():
            start = self._end_of_pause()
            return limits if start is None else {PAUSE: start - self.state.time}
        # limits of convection, forces, viscosity and capillary waves, where anything flows
        flow, liquid = self.flow, self.flow.liquid
        found = flow_limits(
            self.settings.step_limits,
            support=self.domain.support,
            speed=max(flow.largest_speed, self.domain.conditions.largest_wall_speed()),
            acceleration=flow.largest_acceleration,
            viscosity=liquid.largest_viscosity,
            diffusivity=liquid.diffusivity,
            density=liquid.density,
            surface_tension=liquid.surface_tension,
            is_implicit=self.settings.viscosity == "implicit",
            is_passing=self.is_passing,
        )
        found |= self.domain.surface.time_step_limits()
        return limits | {name: limit for name, limit in found.items() if limit < np.inf}

    def step(self, step: float, unclipped_step: float | None = None) -> float:
        """Advance by `step` [s], or by less where that fails; returns the step taken.

        Raises:
            NotConverged: not even a 256th of the step succeeds, or the flow has become unstable;
                the state is as before.
            PoolTooDeep: the melt reaches the graded layers. SupercriticalSurface: the surface is
                above the critical temperature. InvalidSurface: it cannot be computed any further.
        """
        # a pause that is left out is a step by itself
        if (start := self._end_of_pause()) is not None:
            assert self.pauses is not None
            self._update_resting_pairs()
            self.pauses.jump_to(start)
            return step
        # states that no shorter step mends end the run
        self.heat.refuse_supercritical(lambda: self.backend.to_host(self.position))
        if error := self.domain.surface.validity_error():
            raise InvalidSurface(error)
        refuse_unstable(self.flow, self.domain, self.position, self.heat.end_of_pulse)
        # layers worn by evaporation are laid out anew, then the step, halved until it succeeds
        self.layout_renewal.follow_recession()
        self._keep()
        return retry_step(self._advance, step, unclipped_step, undo=self._return)

    def _advance(self, step: float, unclipped_step: float | None) -> None:
        self.domain.conditions.interval = (self.state.time, self.state.time + step)
        if not self._melt():
            self._update_resting_pairs()
            self.illuminate(step)
            self.heat.conduct(step, unclipped_step)
            return
        self.has_moved = True
        self.flow.stop_solid(self.kinds)  # what has frozen since the last step
        # x* and the operators there (67)
        self.advect(step)
        # v* (68), p (69) and v^(n+1) (70); faces book the forces that these have used
        self.flow.predict(self.particles["temperature"], self.kinds, step)
        self.exchange.book_viscous_forces(self.flow.block, self.flow, step)
        self.flow.project(self.kinds, step)
        self.flow.correct(self.kinds, step)
        self.exchange.book_pressure(self.flow.block, self.flow, step)
        # x^(n+1) and the enthalpy there (71)
        self.update_positions(step)
        self.illuminate(step)
        self.heat.conduct(step, unclipped_step)
        self.exchange.book_heat(self.flow.block, step)
        # even density again, (73)-(75)
        self.rearrange(step)
        self._measure()
        self.kinds.remember()

    def advect(self, step: float) -> None:
        """Advected positions with their pairs, walls and surface (67).

        Below a surface that moves they are those of the middle of the step, where (71) has half of
        its way left: particles and line are then of second order in time.
        """
        domain, flow = self.domain, self.flow
        fields = {"x": self.position, "v": flow.velocity}
        ahead = domain.surface.time_rule.share * step
        self.backend.pointwise(advect, fields, self._advected, step=ahead)
        block = domain.block_for(self.position, self.kinds)
        flow.set_block(block)
        domain.surface.advance_first_half(self._surface_step(self.position, step))
        domain.surface.find(self._advected)
        block.find_pairs(self._advected, self._rows_to_find(block, self._advected), has_kernel=True)
        self.kinds.find_walls(block)
        flow.update_viscosity(self.particles["temperature"], self.kinds)
        now = self._surface_step(self._advected, step)
        domain.surface.update_stress(now, block, self.kinds.active)
        block.correct_kernel(self.kinds.active_rows)

    def update_positions(self, step: float) -> None:
        """Positions at the end of the step, and the weights of heat there (71)."""
        block = self.flow.block
        fields = {"x": self.position, "v_old": self.flow.before, "v": self.flow.velocity}
        self.backend.pointwise(move, fields, self.position, step=step)
        left = self.domain.surface.advance_second_half(self._surface_step(self.position, step))
        self.state.energy["removed"] += left
        block.move(self.position)
        block.correct_kernel(self.kinds.fluid_rows)
        block.normalize_surface_flux()
        self.exchange.find_walls(block)
        self.pairs.update(block)

    def illuminate(self, step: float) -> None:
        """Light and losses of the step on the particles where they are now."""
        light, exchange, backend = self.body.light, self.heat.exchange, self.backend
        light.shine(self.state.time, self.state.time + step)
        if light.incident == 0.0 and exchange.is_idle:
            return
        if not self.domain.block_layers:  # nothing has moved
            light.reset()
            exchange.use_lattice()
            return
        # the uppermost particle of each column meets light and losses
        self.domain.find_depth(self.position, self._depth)
        mark, columns = backend.zeros(self.body.count), self.surface_columns
        fields = {"depth": self._depth, "V": self.particles["volume"]}
        spacing, d = self.domain.spacing, self.position.shape[0]
        backend.pointwise(lies_at_surface, fields, mark, spacing=spacing, area=spacing ** (d - 1))
        surface = self.domain.surface
        fine = backend.head(mark, self.body.filling.fine_count)
        columns.find(self.position, backend.rows_where(fine, 1.0), surface.length_ratio())
        exchange.use_columns(columns, backend.rows_where(mark, 1.0))
        volume = fields["V"] if surface.moves else None
        light.distribute(self.position, self._depth, columns, volume)

    def _surface_step(self, position: Array, step: float) -> SurfaceStep:
        """Fields of the particles that the surface reads in a step [s]."""
        names = ("temperature", "volume", "mass", "enthalpy", "evaporated_mass")
        T, volume, mass, h, evaporated = (self.particles[name] for name in names)
        interval = self.state.time, self.state.time + step
        v, flows = self.flow.velocity, self.kinds.fluid
        return SurfaceStep(T, volume, mass, h, evaporated, position, v, flows, interval)

    def rearrange(self, step: float) -> None:
        """Displacements that keep the density of particles even (73), and velocity and enthalpy at
        the shifted positions (74), (75)."""
        surface, flow, kinds = self.domain.surface, self.flow, self.kinds
        # particles at a surface move along it alone; the shift scales with speed times step
        at_surface = surface.shifted_along(kinds.dummy)
        speed = max(flow.largest_speed, self.domain.conditions.largest_wall_speed())
        scale = self.shifting.factor * speed * step
        found = self.shifting.rearrange(flow, kinds, self.particles, at_surface, scale)
        (added,) = found or (0.0,)
        self.state.energy["shifting"] += added
        # no shift leaves the melt, and T follows the adjusted h
        surface.confine(self.position, kinds.fluid)
        self.body.update_temperature()

    def lay_out(self) -> None:
        """Lay the particles out evenly below the surface as it is.

        Raises:
            UnevenRelief: the relief is too deep for the finest layers.
        """
        self.layout_renewal.lay_out()

    def _melt(self) -> bool:
        """Whether anything flows. Melt that rests under hot electrons keeps its velocity."""
        self._find_fluid()
        if self.fluid_count == 0.0:
            self.flow.stop_all()
        elif self.heat.holds_melt:
            self.flow.solve_nothing()
        return self.fluid_count > 0.0 and not self.heat.holds_melt

    def _end_of_pause(self) -> float | None:
        """Start of the next pulse [s] where the pause before it is to be left out now."""
        return None if self.pauses is None or self.fluid_count else self.pauses.end()

    def _update_resting_pairs(self) -> None:
        """Where the flow has ended, conduct between the final positions from now on."""
        if not self.has_moved:
            return
        block = self.domain.block_for(self.position, self.kinds)
        block.find_pairs(self.position, self._rows_to_find(block, self.position))
        self.pairs.update(block)
        self.kinds.remember()
        self.has_moved = False

    def _rows_to_find(self, block: Block, position: Array) -> Array | None:
        """(count,) 1 for rows whose neighbors move now, or have just come to rest; None for all."""
        if self.kinds.is_box:
            return None
        now = block.near_melt.find(position, self.kinds.fluid)
        fields = {"a": now, "b": block.near_melt.find(self.position, self.kinds.before)}
        self.backend.pointwise(either, fields, now)
        return self.domain.keep_resting(now)

    def _measure(self) -> None:
        """Measures of the step, for observers."""
        flow = self.flow
        square, largest, energy, distance = self.find_sizes()
        flow.divergence = ((square / max(self.fluid_count, 1.0)) ** 0.5, largest)
        self.spacing_min = distance**0.5
        self.steadiness.record(self.state.time, flow.largest_speed, energy)
        self.domain.surface.find(self.position)

    @graph
    def find_sizes(self) -> None:
        """Reduce what `Flow.measure` does, and the square of the smallest distance [m^2]."""
        self.flow.measure(self.kinds)
        self.flow.block.smallest_distance(self.position, self.kinds.fluid_rows)

    def _keep(self) -> None:
        """Remember the state, for a step that fails."""
        self.particles.save()
        self.domain.surface.state.save()
        self._numbers = self.checkpoint_scalars()

    def _return(self) -> None:
        """Go back to the state that was kept."""
        self.particles.go_back()
        self.domain.surface.state.go_back()
        self.domain.surface.take_state()
        self.body.update_temperature()
        self.state.restore(self._numbers)
        self._restore_numbers(self._numbers)

    def _restore_numbers(self, numbers: Mapping[str, float]) -> None:
        self.domain.block_layers = int(numbers["block_layers"])
        self.has_moved = bool(numbers["has_moved"])
        self.spacing_min = numbers["spacing_min"]
        for part in self._parts_with_numbers:
            part.restore(numbers)
        self.domain.surface.find(self.position)
        self._find_fluid()

    def _find_fluid(self) -> None:
        """Particles that flow: all molten ones but those too thin under a surface that moves."""
        kinds, surface = self.kinds, self.domain.surface
        self.fluid_count = kinds.find_fluid(self.particles["melt_fraction"])
        if not kinds.is_box:
            volume = self.particles["volume"]
            self.fluid_count = surface.hold_thin_melt(self.position, volume, kinds.fluid)
