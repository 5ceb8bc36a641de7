"""Flow of the melt in a step: the parts of the projection scheme [Demuth2020, eqs. (67)-(71)].

Velocities and pressures are fields of all particles, 0 where nothing flows. Each method is one line
of the algorithm; `solver` puts them in order. Deviations from the paper: gradient and pressure are
those that the surface brings, and so is the time at which viscosity acts; see also `projection`.

In pools, below a surface that moves, and where particles rest, the pressure of the step before acts
with viscosity, and is taken back before the projection, which finds all of it again [Guermond2006].
Without it melt slips along solid and walls by dt grad p/rho, as the projection moves it after
viscosity. So

    nu d2u/dn2 = -b on a wall, where nothing accelerates under the force b, grad p/rho in it,

and a ghost at the distance d has -u_s - d^2/nu b: u is not odd about the wall. Without that a film
of five rows errs by 1.9 % under a pressure, with it by 0.7 % at most. Other boxes are as published:
where buoyancy is held by a pressure, rows along their walls begin to swing in steps over h^2/nu.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.graph import graph
from lasersph.particles.particles import Particles
from lasersph.physics import viscosity
from lasersph.physics.buoyancy import buoyancy
from lasersph.solvers.melt_pool import flow_terms as terms
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.flow_terms import FlowTerms
from lasersph.solvers.melt_pool.liquid import Liquid
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds
from lasersph.solvers.melt_pool.projection import Projection
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.melt_pool.viscous_step import ViscousStep
from lasersph.solvers.step_control import NotConverged
from lasersph.surface.surface import Surface, upward


class Flow:
    """Velocity and pressure of the particles, and the equations that advance them.

    Args:
        volume: (n,) of the body that the particles stand for [m^2], rings [m^3]. geometry_terms: of
            a plane or of rings. is_box: whether nothing is solid, and all flows.

    Attributes:
        spacing: of the particles that move [m].
        velocity: (d, n) [m/s]. pressure: (n,) [Pa]. largest_speed [m/s].
            largest_acceleration by all forces [m/s^2]. iterations: of the last step. divergence:
            rms and largest D after the projection [1/s]. relative_viscosity: (n,) of the particles
            over that at the liquidus.
    """

    def __init__(
        self,
        particles: Particles,
        liquid: Liquid,
        surface: Surface,
        settings: MeltPoolSettings,
        spacing: float,
        volume: Array,
        geometry_terms: FlowTerms,
        *,
        is_box: bool,
    ) -> None:
        backend, count = particles.backend, particles.count
        particles.add("velocity", "pressure", "pressure_force", "settled_jump")
        self.spacing, self.particles, self.volume = spacing, particles, volume
        self.geometry_terms = geometry_terms
        self.backend, self.settings = backend, settings
        self.liquid, self.surface = liquid, surface

        # v, p and -grad p/rho of all particles, v^n beside them, and what accelerates the melt but
        # for viscosity, without and with the transposed stress
        self.velocity, self.pressure = particles["velocity"], particles["pressure"]
        self.pressure_force = particles["pressure_force"]
        vectors = self.velocity.shape
        self.before, self.body_force = backend.zeros(vectors), backend.zeros(vectors)
        self.largest_speed = self.largest_acceleration = 0.0
        self.iterations = {"pressure": 0, "viscosity": 0}
        self.divergence = (0.0, 0.0)

        # viscosity: the equation of (68), and the table of nu(T)/nu_l that its pairs are weighed by
        self.viscous = ViscousStep(
            *(backend, volume, liquid.viscosity, settings.viscosity, geometry_terms),
            dimension=vectors[0],
        )
        T, m = (backend.asarray(values) for values in liquid.relative_viscosity)
        self._viscosity_nodes = {"T_nodes": T, "m_nodes": m}
        self._viscosity_varies = bool(np.ptp(liquid.relative_viscosity[1]) > 0.0)
        self.force = backend.zeros(vectors) if self._viscosity_varies else self.body_force
        self.relative_viscosity = backend.asarray(np.ones(count))
        # the explicit scheme is the published one, in which solid is as viscous as melt, and the
        # pressure acts after viscosity
        is_implicit = settings.viscosity == "implicit"
        self._has_rigid_walls = is_implicit and not is_box
        is_swinging = is_box and not surface.moves and not settings.rests
        self._has_pressure_force = is_implicit and not is_swinging
        self._stiffness = backend.zeros(count)

        # of the block of particles that may move, from when anything flows
        self._projection: Projection | None = None
        self._extended = backend.zeros((vectors[0], 0))

    def set_initial_velocity(self, velocity: np.ndarray) -> None:
        """Start from velocities, host array (d, n) [m/s]."""
        self.backend.copy(self.backend.asarray(velocity), self.velocity)
        self.largest_speed = float(np.sqrt(np.max(np.sum(velocity * velocity, axis=0))))

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        return {
            "largest_speed": self.largest_speed,
            "largest_acceleration": self.largest_acceleration,
            "divergence_rms": self.divergence[0],
            "divergence_max": self.divergence[1],
        }

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from the numbers of `checkpoint_scalars`."""
        self.largest_speed = numbers["largest_speed"]
        self.largest_acceleration = numbers["largest_acceleration"]
        self.divergence = (numbers["divergence_rms"], numbers["divergence_max"])

    def set_block(self, block: Block) -> None:
        """Work on a block from now on."""
        if not self.has_block or block is not self.block:
            self._projection = Projection(
                *(self.particles, self.liquid, self.surface, self.settings, block),
                *(self.spacing, self.volume, self.geometry_terms),
            )

    @property
    def has_block(self) -> bool:
        """Whether anything has flowed."""
        return self._projection is not None

    @property
    def projection(self) -> Projection:
        """Pressure of the block."""
        assert self._projection is not None
        return self._projection

    @property
    def block(self) -> Block:
        """The block of particles that may move."""
        return self.projection.block

    def update_viscosity(self, T: Array, kinds: ParticleKinds) -> None:
        """Viscosity of the particles at their temperatures (n,) [K], and of their pairs, in which
        what rests is rigid."""
        backend, relative = self.backend, self.relative_viscosity
        if self._viscosity_varies:
            nodes = self._viscosity_nodes
            backend.pointwise(viscosity.relative_viscosity, {"T": T}, relative, **nodes)
        if self._has_rigid_walls:
            fields = {"m": relative, "fluid": kinds.fluid}
            backend.pointwise(viscosity.stiffness, fields, self._stiffness)
            self.block.weigh_viscosity(self._stiffness)
        elif self._viscosity_varies:
            self.block.weigh_viscosity(relative)

    def _add_transposed_stress(self, extended: Array, kinds: ParticleKinds) -> None:
        """Add div(nu (grad v)^T) to the body forces, 0 where the viscosity is the same everywhere.

        Args:
            extended: (d, M) velocities with those of ghosts [m/s].
        """
        if not self._viscosity_varies:
            return
        # (grad v)^T grad nu, both gradients corrected by C, beside what acts on the body
        self.backend.copy(self.body_force, self.force)
        block = self.block
        fields = {"v": extended, "m": block.gather(self.relative_viscosity), "b": self.force}
        fields |= {"G_ij": block.gradient, "C": block.correction}
        self.backend.pair_sum(
            viscosity.transposed_terms,
            block.pairs,
            fields,
            self.force,
            finish=viscosity.transposed_force,
            rows=kinds.fluid_rows,
            nu=self.liquid.viscosity,
        )

    def predict(self, T: Array, kinds: ParticleKinds, step: float) -> None:
        """Velocity after viscous and body forces (68)."""
        # buoyancy and the pressure of the step before, then the ghosts' velocity
        self.find_forces(T, kinds)
        # v* after viscosity and forces, over the share of the step after which they act
        self.iterations["viscosity"] = self.viscous.advance(
            *(self.block, self.velocity, self.force, self._extended, kinds),
            self.surface.time_rule.share * step,
        )
        # from there to the end of the step, where viscosity was found in its middle
        self.surface.time_rule.finish(self.backend, self.velocity, self.before)
        # without the pressure of the step before, which (69) finds anew
        if self._has_pressure_force:
            fields = {"v": self.velocity, "a": self.pressure_force}
            self.backend.pointwise(terms.take_back, fields, self.velocity, step=step)
        self.stop_solid(kinds)

    @graph
    def find_forces(self, T: Array, kinds: ParticleKinds) -> None:
        """Keep the velocity; find the forces at temperatures (n,) [K], and the velocity of the
        ghosts."""
        backend, liquid = self.backend, self.liquid
        # v^n, from which the correction finds the acceleration
        backend.copy(self.velocity, self.before)
        # Boussinesq buoyancy from the temperature at the start of the step
        backend.pointwise(
            buoyancy,
            {"T": T},
            self.body_force,
            beta=liquid.expansion,
            T_l=liquid.reference_temperature,
            g=liquid.gravity,
            up=upward(self.velocity.shape[0]),
        )

        # the force of the pressure of the step before, on what has flowed since
        if self._has_pressure_force:
            kinds.stop_solid(self.pressure_force)
            fields = {"b": self.body_force, "a": self.pressure_force}
            backend.pointwise(terms.add_force, fields, self.body_force)

        # ghosts with the stress of the surface, and what a varying viscosity adds
        self._extended = self.extend_velocity(self.velocity)
        self._add_transposed_stress(self._extended, kinds)

    def extend_velocity(self, v: Array) -> Array:
        """v (d, n) on the block with ghosts (d, M), as the viscosity of a step sees it [m/s]."""
        ghosts = self.block.ghosts
        extended = ghosts.extend_velocity(v, self.surface.stress_jump)
        if ghosts.has_still_walls and self._has_pressure_force:
            b, m, nu = self.body_force, self.relative_viscosity, self.liquid.viscosity
            ghosts.bend_at_walls(extended, b, m, nu)
        return extended

    def project(self, kinds: ParticleKinds, step: float) -> None:
        """Pressure that makes the velocity free of divergence (69).

        Raises:
            NotConverged: the pressure equation is not solved.
        """
        self.iterations["pressure"] = self.projection.project(
            kinds, self.relative_viscosity, self.largest_speed, step
        )

    def correct(self, kinds: ParticleKinds, step: float) -> None:
        """Velocity after the pressure (70).

        Raises:
            NotConverged: the velocity is not finite.
        """
        # the largest values limit the next step
        square, speed_square = self.projection.correct(kinds, self.before, step)
        self.largest_acceleration = max(square, 0.0) ** 0.5
        self.largest_speed = max(speed_square, 0.0) ** 0.5
        if not isfinite(self.largest_speed):
            raise NotConverged("the velocity is not finite")

    def measure(self, kinds: ParticleKinds) -> None:
        """Reduce the sum of squares of the divergence that the projection left and the largest one,
        then the kinetic energy of all that flows [J per meter, of rings J], for observers."""
        self.projection.sum_divergence(kinds)
        fields = {"v": self.velocity, "V": self.volume}
        self.backend.pointwise(
            terms.kinetic_energy, fields, (None,), reduce=("sum",), density=self.liquid.density
        )

    def stop_all(self) -> None:
        """Nothing flows any more."""
        if self.largest_speed > 0.0:
            self.backend.fill(self.velocity, 0.0)
            self.backend.fill(self.pressure, 0.0)
            self.backend.fill(self.pressure_force, 0.0)
            self.backend.fill(self.particles["settled_jump"], 0.0)
        self.largest_speed = self.largest_acceleration = 0.0
        self.divergence = (0.0, 0.0)
        self.solve_nothing()

    def solve_nothing(self) -> None:
        """Leave velocities as they are: nothing is solved in this step."""
        self.iterations = {"pressure": 0, "viscosity": 0}

    def stop_solid(self, kinds: ParticleKinds) -> None:
        """Stop everything but the fluid; find the largest speed."""
        (square,) = kinds.stop_solid(self.velocity)
        self.largest_speed = max(square, 0.0) ** 0.5
