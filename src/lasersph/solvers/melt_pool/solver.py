"""`MeltPool`: heat, melting and the incompressible flow of what is molten.

`step()` is the algorithm of [Demuth2020, Section 4.3.1]. Predictor, pressure and correction use the
advected positions (67), enthalpy, shift and adjustment the updated ones (71). Where nothing flows a
step is that of `Conduction`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.physics.flow_limits import flow_limits
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.domain import PoolDomain
from lasersph.solvers.melt_pool.flow import Flow, advected, updated
from lasersph.solvers.melt_pool.heat_pairs import HeatPairs
from lasersph.solvers.melt_pool.rearrange import Rearrangement
from lasersph.solvers.melt_pool.roles import Roles
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.melt_pool.steadiness import Steadiness
from lasersph.solvers.step_control import NotConverged, retry_step

SHORTEST = 1e-9
"""Time in which the fastest particle crosses its support, over the time to compute: in a flow that
takes less its speeds have grown without bound."""


def either(a, b):
    """1 where one of two marks is 1."""
    return max(a, b)


class MeltPool:
    """Solver of a run whose melt flows.

    Attributes:
        heat: the solver of enthalpies. flow: velocity and pressure. domain: lid, sides, blocks.
        position: (2, n) of all particles [m]. roles: which flow. fluid_count: how many do.
        spacing_min: smallest distance of two particles of the block [m].
    """

    def __init__(
        self, heat: Conduction, flow: Flow, domain: PoolDomain, settings: MeltPoolSettings
    ) -> None:
        backend, count = heat.body.backend, heat.body.count
        self.heat, self.flow, self.domain, self.settings = heat, flow, domain, settings
        self.body, self.backend = heat.body, backend
        self.particles = heat.particles
        self.particles.add("position", "was_fluid", "has_moving_pairs")
        self.position = self.particles["position"]
        self.particles.set("position", heat.body.filling.position[:, :count])
        self._advected = backend.zeros((2, count))
        self.roles = Roles(self.particles, domain.spacing, is_box=domain.is_box)
        self.rearrangement = Rearrangement(
            backend, count, settings.shifting, domain.spacing, domain.box, domain.periods
        )
        self.pairs = HeatPairs(heat.body)
        self.steadiness = Steadiness(heat.time_settings.steady, domain.width)
        self.spacing_min = domain.spacing
        self.fluid_count = 0.0
        self._has_moved = False

    @property
    def state(self) -> Any:
        """State of heat: time, energies, enthalpies."""
        return self.heat.state

    @property
    def particle_count(self) -> int:
        """Particles of the body."""
        return self.body.count

    @property
    def fields(self) -> dict[str, Any]:
        """Arrays of a checkpoint by name."""
        return self.particles.kept

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
        return self.heat.checkpoint_scalars() | self.steadiness.checkpoint_scalars() | {
            "fastest_flow": self.flow.fastest,
            "push": self.flow.push,
            "block_layers": self.domain.block_layers,
            "has_moved": float(self._has_moved),
            "spacing_min": self.spacing_min,
            "divergence_rms": self.flow.divergence[0],
            "divergence_max": self.flow.divergence[1],
        }  # fmt: skip

    def restore(self, arrays: dict[str, np.ndarray], numbers: dict[str, float]) -> None:
        """Continue from the arrays of `fields` and the numbers of `checkpoint_scalars`."""
        backend = self.backend
        self.heat.restore(arrays, numbers)
        self._restore_numbers(numbers)
        if backend.rows_where(self.particles["has_moving_pairs"], 1.0).shape[0]:
            block = self.domain.block_for(self.position, self.roles)
            block.find_pairs(
                self.position, backend.head(self.particles["has_moving_pairs"], block.count)
            )
            self.pairs.renew(block)

    def time_step_limits(self) -> dict[str, float]:
        """Named limits of the next step [s]."""
        limits = self.heat.time_step_limits()
        if not self._melt():
            return limits
        flow, liquid, lid = self.flow, self.flow.liquid, self.domain.lid
        found = flow_limits(
            self.settings.step_limits,
            support=self.domain.support,
            speed=max(flow.fastest, self.domain.sides.fastest_wall()),
            acceleration=flow.push,
            viscosity=liquid.viscosity,
            diffusivity=liquid.diffusivity,
            density=liquid.density,
            surface_tension=liquid.surface_tension,
            is_implicit=self.settings.viscosity == "implicit",
            capillary=np.inf if lid is None else lid.capillary_limit,
            recoil=np.inf if lid is None else lid.recoil_limit,
        )
        return limits | {name: limit for name, limit in found.items() if limit < np.inf}

    def step(self, step: float, unclipped_step: float | None = None) -> float:
        """Advance by `step` [s], or by less where that fails; returns the step taken.

        Raises:
            NotConverged: not even a 256th of the step succeeds, or the flow has become unstable;
                the state is as before.
            PoolTooDeep: the melt reaches the graded layers.
        """
        if self.flow.fastest * SHORTEST * self.heat.time_settings.end > self.domain.support:
            raise NotConverged(f"the flow has become unstable: {self.flow.fastest:.3g} m/s")
        self._keep()
        return retry_step(self._advance, step, unclipped_step, undo=self._return)

    def _advance(self, step: float, unclipped_step: float | None) -> None:
        if not self._melt():
            self._settle_pairs()
            if self.domain.block_layers:
                self.illuminate(step)
            self.heat.attempt(step, unclipped_step)
            return
        self._has_moved = True
        self.flow.stop(self.roles)  # what has frozen since the last step
        self.advect(step)
        self.flow.predict(self.particles["temperature"], self.roles, step)
        self.flow.project(self.roles, step)
        self.flow.correct(self.roles, step)
        self.update_positions(step)
        self.illuminate(step)
        self.heat.attempt(step, unclipped_step)
        self.shift(step)
        self.adjust()
        self._measure()
        self.roles.remember()

    def advect(self, step: float) -> None:
        """Advected positions with their pairs, walls and surface (67)."""
        domain, flow = self.domain, self.flow
        fields = {"x": self.position, "v": flow.velocity}
        self.backend.pointwise(advected, fields, self._advected, step=step)
        block = domain.block_for(self.position, self.roles)
        if block is not flow.current_block:
            flow.enter(block, domain.periods)
        block.find_pairs(self._advected, self._touched(block, self._advected))
        self.roles.find_walls(block.pairs, block.gather, block.count, block.wanted)
        if domain.lid is not None:
            domain.lid.find_surface(self._advected)
            domain.lid.drive(
                self.particles["temperature"], self._advected, block.pairs, block.V, block.gather,
                self.roles.active,
            )  # fmt: skip
        flow.correct_kernel(self.roles.active_rows)

    def update_positions(self, step: float) -> None:
        """Positions at the end of the step, and the weights of heat there (71)."""
        block = self.flow.block
        fields = {"x": self.position, "v_old": self.flow.before, "v": self.flow.velocity}
        self.backend.pointwise(updated, fields, self.position, step=step)
        block.move(self.position)
        self.flow.correct_kernel(self.roles.fluid_rows)
        self.pairs.renew(block)

    def illuminate(self, step: float) -> None:
        """Light of the step on the particles where they are now."""
        irradiation, state = self.body.irradiation, self.state
        irradiation.shine(state.time, state.time + step)
        irradiation.follow(
            self.position, self.particles["has_moving_pairs"], self.particles["temperature"]
        )

    def shift(self, step: float) -> None:
        """Displacements that keep the particles evenly spread (73)."""
        lid = self.domain.lid
        at_face = self.roles.dummy if lid is None else lid.at_surface
        speed = max(self.flow.fastest, self.domain.sides.fastest_wall())
        self.rearrangement.shift(self.flow.block, self.roles, at_face, speed, step)

    def adjust(self) -> None:
        """Velocity and enthalpy at the shifted positions (74), (75)."""
        flow, particles, block = self.flow, self.particles, self.flow.block
        C = flow.correction
        self.rearrangement.adjust_velocity(block, self.roles, flow.velocity, flow.reach(), C)
        self.rearrangement.adjust_enthalpy(
            block, self.roles, particles["enthalpy"], particles["vapor_fraction"],
            particles["mass"], C,
        )  # fmt: skip
        self.rearrangement.settle(self.position, self.roles)
        self.body.update_temperature()

    def _melt(self) -> bool:
        """Whether anything flows."""
        self.fluid_count = self.roles.find_fluid(self.particles["melt_fraction"])
        if self.fluid_count == 0.0:
            self.flow.rest()
        return self.fluid_count > 0.0

    def _settle_pairs(self) -> None:
        """Where the flow has ended, conduct between the final positions from now on."""
        if not self._has_moved:
            return
        block = self.domain.block_for(self.position, self.roles)
        block.find_pairs(self.position, self._touched(block, self.position))
        self.pairs.renew(block)
        self.roles.remember()
        self._has_moved = False

    def _touched(self, block: Block, position: Any) -> Any:
        """(count,) 1 for rows whose neighbors move now, or have just come to rest."""
        now = block.touched(position, self.roles.fluid)
        fields = {"a": now, "b": block.touched(self.position, self.roles.before)}
        self.backend.pointwise(either, fields, now)
        return now

    def _measure(self) -> None:
        """What observers want to know of the step."""
        flow, block = self.flow, self.flow.block
        flow.measure_divergence(self.roles, self.fluid_count)
        self.spacing_min = block.smallest_distance(self.position, self.roles.fluid_rows)
        energy = flow.kinetic_energy()
        self.steadiness.look(self.state.time, flow.fastest, energy)

    def _keep(self) -> None:
        """Remember the state, for a step that fails."""
        self.particles.save()
        self._numbers = self.checkpoint_scalars()

    def _return(self) -> None:
        """Go back to the state that was kept."""
        self.particles.go_back()
        self.body.update_temperature()
        self.state.restore(self._numbers)
        self._restore_numbers(self._numbers)

    def _restore_numbers(self, numbers: dict[str, float]) -> None:
        flow = self.flow
        flow.fastest, flow.push = numbers["fastest_flow"], numbers["push"]
        flow.divergence = (numbers["divergence_rms"], numbers["divergence_max"])
        self.domain.block_layers = int(numbers["block_layers"])
        self._has_moved = bool(numbers["has_moved"])
        self.spacing_min = numbers["spacing_min"]
        self.steadiness.restore(numbers)
        self.fluid_count = self.roles.find_fluid(self.particles["melt_fraction"])
