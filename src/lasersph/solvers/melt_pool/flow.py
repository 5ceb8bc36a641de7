"""Flow of the melt in a step: the parts of the projection scheme [Demuth2020, eqs. (67)-(71)].

Velocities and pressures are fields of all particles, 0 where nothing flows. Each method is one line
of the algorithm; `solver` puts them in order. Gradient and divergence are corrected by the same
matrix C, so that the divergence is exact on linear fields and both are skew-adjoint to each other;
for that ghosts carry the mirrored pressure and, in the divergence, the mirrored velocity, so that
nothing crosses a face, whatever its motion, which viscosity alone sees.

Deviations from the paper: where particles are too dense the projection is asked for a divergence
that parts them again (`sph.density_drift`), 0 on a lattice. Pressure and gradient are those that
the surface brings (`surface.pressure_gradient`), and so is the time at which viscosity acts.
"""

from __future__ import annotations

from functools import cached_property
from math import exp, isfinite

import numpy as np

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.graph import graph
from lasersph.particles.particles import Particles
from lasersph.physics import viscosity
from lasersph.physics.buoyancy import buoyancy
from lasersph.solvers.melt_pool import flow_terms as terms
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.liquid import Liquid
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds
from lasersph.solvers.melt_pool.pressure_equation import PressureEquation
from lasersph.solvers.melt_pool.published.pressure_equation import PublishedPressure
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.melt_pool.viscous_step import ViscousStep
from lasersph.solvers.melt_pool.wall_pressure import WallPressure
from lasersph.solvers.step_control import NotConverged
from lasersph.sph.correction import (
    bounded_inverse,
    corrected_divergence_term,
    moment_term,
)
from lasersph.sph.lattice_sums import kernel_sum
from lasersph.surface.surface import Surface, upward

ACCEPTED = 10.0
"""Residual of the pressure equation over its tolerance with which a step is still taken. Guard: a
worse one halves the step; tests that end iterations early see it."""
DRIFT_RATE = 0.1
"""Rate at which particles that are too dense part, over the largest speed per spacing. Study:
[Asai2012] leaves it open; without it the pressure under a pool differs by 0.3 %."""


class Flow:
    """Velocity and pressure of the particles, and the equations that advance them.

    Attributes:
        spacing: of the particles that move [m].
        velocity: (2, n) [m/s]. pressure: (n,) [Pa]. largest_speed [m/s].
            largest_acceleration by all forces [m/s^2]. iterations: of the last step. divergence:
            rms and largest D after the projection [1/s]. relative_viscosity: (n,) of the particles
            over that at the liquidus. current_block: None before anything flows.
        pressure_seen: fields of the symmetric gradient of the last step, p [Pa] over the lowest
            one, and that one [Pa]; None below a surface that moves.
    """

    def __init__(
        self,
        particles: Particles,
        liquid: Liquid,
        surface: Surface,
        settings: MeltPoolSettings,
        spacing: float,
    ) -> None:
        backend, count = particles.backend, particles.count
        particles.add("velocity", "pressure", "settled_jump")
        self.spacing, self.particles = spacing, particles
        self.backend, self.liquid, self.surface, self.settings = backend, liquid, surface, settings
        # v and p of all particles, v^n beside them, and the acceleration of buoyancy
        self.velocity, self.pressure = particles["velocity"], particles["pressure"]
        self.before, self.body_force = backend.zeros((2, count)), backend.zeros((2, count))
        self.largest_speed = self.largest_acceleration = 0.0
        self.iterations = {"pressure": 0, "viscosity": 0}
        self.divergence = (0.0, 0.0)
        self.pressure_seen: tuple[dict[str, Array], float] | None = None
        # viscosity: the equation of (68), and the table of nu(T)/nu_l that its pairs are weighed by
        self.viscous = ViscousStep(
            backend, particles["volume"], liquid.viscosity, settings.viscosity
        )
        T, m = (backend.asarray(values) for values in liquid.relative_viscosity)
        self._viscosity_nodes = {"T_nodes": T, "m_nodes": m}
        self.relative_viscosity = backend.asarray(np.ones(count))
        # pressure along walls that ghosts have to know of, a deviation of `wall_pressure`
        self.wall_pressure = WallPressure(
            backend, liquid.density, liquid.viscosity, self.relative_viscosity
        )
        self.current_block: Block | None = None

    def begin(self, velocity: np.ndarray) -> None:
        """Start from velocities, host array (2, n) [m/s]."""
        self.backend.copy(self.backend.asarray(velocity), self.velocity)
        self.largest_speed = float(np.sqrt(np.max(np.sum(velocity * velocity, axis=0))))

    def enter(self, block: Block, periods: tuple[float, ...]) -> None:
        """Work on a new block; periods: width along each axis that repeats, else 0 [m]."""
        self.current_block, backend, count = block, self.backend, block.count
        # work vectors of the size of the block: C, right-hand side and pressure of (69)
        self._C = backend.zeros((2, 2, count))
        self._rhs, self._p = backend.zeros(count), backend.zeros(count)
        self._V = block.volume
        # kernel sum of a perfect lattice, the density from which drift is counted
        weighing = block.lattice.weighing
        self._lattice_sum = kernel_sum(weighing.kernel, weighing.ratio)
        # the equation for p: conjugate gradients, or the paper's matrix for comparison
        tolerance = self.settings.pressure_tolerance
        self.equation = PressureEquation(
            backend, count, block.layers.moving_support, tolerance=tolerance, period=periods
        )
        self.published = None
        if self.settings.pressure == "published":
            self.published = PublishedPressure(backend, count, tolerance=tolerance)

    @property
    def correction(self) -> Array:
        """(2, 2, count) correction matrices of the block."""
        return self._C

    @property
    def block(self) -> Block:
        """The block of particles that may move."""
        assert self.current_block is not None
        return self.current_block

    @cached_property
    def _viscosity_varies(self) -> bool:
        """Whether the viscosity of the melt depends on its temperature."""
        return bool(np.ptp(self.liquid.relative_viscosity[1]) > 0.0)

    def update_viscosity(self, T: Array) -> None:
        """Viscosity of the particles at their temperatures (n,) [K], and of their pairs."""
        if self._viscosity_varies:
            relative, nodes = self.relative_viscosity, self._viscosity_nodes
            self.backend.pointwise(viscosity.relative_viscosity, {"T": T}, relative, **nodes)
            self.block.weigh_viscosity(relative)

    def _add_transposed_stress(self, extended: Array, kinds: ParticleKinds) -> None:
        """Add div(nu (grad v)^T) to the body force, 0 where the viscosity is the same everywhere.

        Args:
            extended: (2, M) velocities with those of ghosts [m/s].
        """
        if not self._viscosity_varies:
            return
        # (grad v)^T grad nu, both gradients corrected by C, beside the force of buoyancy
        block = self.block
        fields = {"v": extended, "m": block.gather(self.relative_viscosity), "C": self._C}
        fields |= {"G_ij": block.gradient, "b": self.body_force}
        how = {"finish": viscosity.transposed_force, "rows": kinds.fluid_rows}
        terms_of, nu = viscosity.transposed_terms, self.liquid.viscosity
        self.backend.pair_sum(terms_of, block.pairs, fields, self.body_force, **how, nu=nu)

    @graph
    def correct_kernel(self, rows: Rows) -> None:
        """Correction matrices of some rows at the present positions."""
        pairs, fields, finish = self.block.pairs, {"G_ij": self.block.gradient}, bounded_inverse
        self.backend.pair_sum(moment_term, pairs, fields, self._C, finish=finish, rows=rows)

    def predict(self, T: Array, kinds: ParticleKinds, step: float) -> None:
        """Velocity after viscous and body forces (68)."""
        # grad p/rho of the last step along walls, then buoyancy and the ghosts' velocity
        block, ahead = self.block, self.viscous_step(step)
        self.wall_pressure.find(block, self.pressure, self._C)
        self.find_forces(T, kinds, ahead)
        # v* after viscosity and body forces, over the share of the step after which they act
        self.iterations["viscosity"] = self.viscous.advance(
            block, self.velocity, self.body_force, self._extended, kinds, ahead
        )
        # from there to the end of the step, where viscosity was found in its middle
        self.surface.time_rule.finish(self.backend, self.velocity, self.before)
        self.stop(kinds)

    @graph
    def find_forces(self, T: Array, kinds: ParticleKinds, step: float) -> None:
        """Keep the velocity; find the body force, and the velocity of the ghosts.

        Args:
            T: (n,) temperature [K]. step: from v^n to what viscosity sees [s].
        """
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
            up=upward(2),
        )
        # ghosts with the stress of the surface, and what a varying viscosity adds
        self._extended = self.extend_velocity(self.velocity, step)
        self._add_transposed_stress(self._extended, kinds)

    def viscous_step(self, step: float) -> float:
        """From v^n to what viscosity sees [s], as the surface has it."""
        return self.surface.time_rule.share * step

    def extend_velocity(self, v: Array, step: float) -> Array:
        """v (2, n) on the block with ghosts (2, M), as the viscosity of a step sees it [m/s]."""
        extended = self.block.ghosts.extend_velocity(v, self.surface.stress_jump)
        return self.wall_pressure.add_to(extended, self.block, step)

    def project(self, kinds: ParticleKinds, step: float) -> None:
        """Pressure that makes the velocity free of divergence (69).

        Raises:
            NotConverged: the pressure equation is not solved.
        """
        backend, block = self.backend, self.block
        # speed that scales the drift of density, and the time in which viscosity crosses a support
        speed = max(self.largest_speed, block.conditions.largest_wall_speed())
        time = block.layers.moving_support**2 / self.liquid.viscosity
        # right-hand side of (69), with the jump of ghosts decayed over the step
        self.find_load(
            kinds,
            remaining=exp(-step / time),
            fraction=self.liquid.density / step,
            rate=DRIFT_RATE * speed / self.spacing,
        )
        head, count = backend.head, block.count
        mask = head(kinds.unknown, count)
        # matrix (77) of the present pairs, solved from the last pressure
        if self.published is not None:
            self.published.set_operator(
                block.pairs, block.ghosts.source, block.weights, head(kinds.kind, count), self._V
            )
            outcome = self.published.solve(self._rhs, self._p)
        else:
            # pairs across the surface weigh nothing: its pressure is a boundary of each particle
            coefficient, value, flux = self.surface.pressure
            pairs, weights = block.without_ghosts(), block.weights_within()
            self.equation.set_operator(pairs, weights, mask, self._V, coefficient)
            outcome = self.equation.solve(self._rhs, self._p, value=value, flux=flux)
        # a pressure that is far off would leave a divergence: halve the step instead
        if not outcome.residual <= ACCEPTED * self.settings.pressure_tolerance:
            raise NotConverged(
                f"the pressure equation is left with a residual of {outcome.residual:.1e} of its "
                f"right-hand side after {outcome.iterations} iterations"
            )
        self.iterations["pressure"] = outcome.iterations
        self.take_pressure(kinds)

    @graph
    def find_load(
        self, kinds: ParticleKinds, remaining: float, fraction: float, rate: float
    ) -> None:
        """Right-hand side of the pressure equation, and the pressure to begin with.

        Args:
            remaining: share that the jump of ghosts keeps of what it was. fraction: rho / dt
                [kg/(m^3 s)]. rate: at which particles that are too dense part [1/s].
        """
        backend, block = self.backend, self.block
        # the jump of ghosts that the divergence sees, then rho / dt V (D - d)
        self.surface.settle(self.particles["settled_jump"], self.relative_viscosity, remaining)
        backend.pair_sum(
            terms.divergence_terms,
            block.pairs,
            self._divergence_fields() | {"VW_ij": block.kernel, "V": self._V},
            self._rhs,
            finish=terms.divergence_load,
            rows=kinds.unknown_rows,
            fraction=fraction,
            lattice_sum=self._lattice_sum,
            rate=rate,
        )
        # first guess: the pressure of the last step
        backend.copy(backend.head(self.pressure, block.count), self._p)

    def correct(self, kinds: ParticleKinds, step: float) -> None:
        """Velocity after the pressure (70).

        Raises:
            NotConverged: the velocity is not finite.
        """
        # p_0: under the symmetric gradient p < 0 would contract the particles [Monaghan2000]
        found = self.find_lowest_pressure(kinds)
        lowest = found[0] if found else 0.0
        # (70), and the largest values that limit the next step
        square, speed_square = self.accelerate(kinds, lowest, step)
        is_over_lowest = self.surface.pressure_gradient.is_over_lowest
        self.pressure_seen = (self._pressure_fields, lowest) if is_over_lowest else None
        self.largest_acceleration = max(square, 0.0) ** 0.5
        self.largest_speed = max(speed_square, 0.0) ** 0.5
        if not isfinite(self.largest_speed):
            raise NotConverged("the velocity is not finite")

    @graph
    def find_lowest_pressure(self, kinds: ParticleKinds) -> None:
        """Corrections of the gradient with those of ghosts; reduces the lowest pressure, where the
        gradient sees the pressure over that."""
        self._extended_C = self.block.ghosts.extend_tensor(self._C)
        self.surface.pressure_gradient.find_lowest(self.backend, self.pressure, kinds.unknown_rows)

    @graph
    def accelerate(self, kinds: ParticleKinds, lowest: float, step: float) -> None:
        """Apply the gradient of the pressure over the lowest one [Pa]; reduces |dv/dt|^2, |v|^2."""
        backend, block = self.backend, self.block
        gradient = self.surface.pressure_gradient
        # p of particles and ghosts in the form of the gradient that the surface brings
        p = gradient.extend(backend, block.ghosts, self.pressure, lowest)
        self._pressure_fields = {"p": p, "G_ij": block.gradient, "C": self._extended_C}

        # v - dt / rho G{p}, and what the solid keeps at rest
        backend.pair_sum(
            gradient.term,
            block.pairs,
            self._pressure_fields | {"v": self.velocity, "v_old": self.before},
            (self.velocity, None),
            rows=kinds.fluid_rows,
            finish=terms.correct,
            reduce=(None, "max"),
            step=step,
            density=self.liquid.density,
        )
        self._stop(kinds)

    def measure(self, kinds: ParticleKinds) -> None:
        """Reduce the sum of squares of the divergence that the projection left and the largest one,
        then the kinetic energy of all that flows [J per meter], for observers."""
        fields = self.particles.by_symbol("velocity", "volume")
        # divergence that is left, by the same operator that the projection used
        self.backend.pair_sum(
            corrected_divergence_term,
            self.block.pairs,
            self._divergence_fields(),
            (None, None),
            finish=terms.divergence_sizes,
            rows=kinds.fluid_rows,
            reduce=("sum", "max"),
        )
        self.backend.pointwise(
            terms.kinetic_energy, fields, (None,), reduce=("sum",), density=self.liquid.density
        )

    def rest(self) -> None:
        """Nothing flows any more."""
        if self.largest_speed > 0.0:
            self.backend.fill(self.velocity, 0.0)
            self.backend.fill(self.pressure, 0.0)
            self.backend.fill(self.particles["settled_jump"], 0.0)
        self.largest_speed = self.largest_acceleration = 0.0
        self.divergence = (0.0, 0.0)
        self.iterations = {"pressure": 0, "viscosity": 0}

    def _divergence_fields(self) -> dict[str, Array]:
        block = self.block
        # walls mirror the velocity, so that nothing crosses them; a stressed surface continues it
        jump = self.surface.settled_jump(self.particles["settled_jump"])
        v = block.ghosts.mirror_velocity(self.velocity, jump)
        return {"v": v, "C": self._C, "G_ij": block.gradient}

    @graph
    def take_pressure(self, kinds: ParticleKinds) -> None:
        """Take the pressure of the block; dummies have that of the edge."""
        backend, block, rows = self.backend, self.block, kinds.dummy_rows
        pressure = backend.head(self.pressure, block.count)
        backend.copy(self._p, pressure)
        # dummies: mean of the edge within the support, dp/dn = 0 at the melt's wall
        if not kinds.is_box:
            fields = {"p": block.gather(self.pressure), "unknown": block.gather(kinds.unknown)}
            fields["dummy"], finish = kinds.dummy, terms.dummy_pressure
            mean = terms.edge_pressure_terms
            backend.pair_sum(mean, block.pairs, fields, self._p, finish=finish, rows=rows)
            backend.copy(self._p, pressure)

    def stop(self, kinds: ParticleKinds) -> None:
        """Stop everything but the fluid; find the largest speed."""
        (square,) = self._stop(kinds)
        self.largest_speed = max(square, 0.0) ** 0.5

    def _stop(self, kinds: ParticleKinds) -> tuple[float, ...]:
        fields, out = {"v": self.velocity, "fluid": kinds.fluid}, (self.velocity, None)
        return self.backend.pointwise(terms.stop_solid, fields, out, reduce=(None, "max"))
