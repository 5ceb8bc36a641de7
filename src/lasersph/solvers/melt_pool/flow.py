"""Flow of the melt in a step: the parts of the projection scheme [Demuth2020, eqs. (67)-(71)].

Velocities and pressures are fields of all particles, 0 where nothing flows. Each method is one line
of the algorithm; `solver` puts them in order. Gradient and divergence are corrected by the same
matrix C, so that the divergence is exact on linear fields and both are skew-adjoint to each other;
for that ghosts carry the mirrored pressure and, in the divergence, the mirrored velocity, so that
nothing crosses a face, whatever its motion, which viscosity alone sees.

Deviations from the paper: where particles are too dense the projection is asked for a divergence
that parts them again (`sph.density_drift`), 0 on a lattice. And the constant of the pressure, which
nothing fixes, is such that its gradient sees none below 0: where p < 0 the symmetric gradient
contracts the particles [Monaghan2000].

Below a surface that moves the pressure is given there, and the gradient is that of its differences,
exact on linear fields: the symmetric one pushes where the kernel sums of neighbors differ. It is
not adjoint to the divergence. Viscosity acts on the velocity in the middle of the step.
"""

from __future__ import annotations

from functools import cached_property
from math import exp, isfinite

import numpy as np

from lasersph.boundaries.surface import Surface, upward
from lasersph.compute.array_types import Array, Rows
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
    corrected_difference_term,
    corrected_divergence_term,
    corrected_symmetric_term,
    moment_term,
)
from lasersph.sph.lattice_sums import kernel_sum

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
        surface: Surface | None,
        settings: MeltPoolSettings,
        spacing: float,
    ) -> None:
        backend, count = particles.backend, particles.count
        particles.add("velocity", "pressure", "settled_jump")
        self.spacing, self.particles = spacing, particles
        self.backend, self.liquid, self.surface, self.settings = backend, liquid, surface, settings
        self.velocity, self.pressure = particles["velocity"], particles["pressure"]
        self.before, self.body_force = backend.zeros((2, count)), backend.zeros((2, count))
        self._nothing = backend.zeros(count)
        self.largest_speed = self.largest_acceleration = 0.0
        self.iterations = {"pressure": 0, "viscosity": 0}
        self.divergence = (0.0, 0.0)
        self.pressure_seen: tuple[dict[str, Array], float] | None = None
        self.viscous = ViscousStep(
            backend, particles["volume"], liquid.viscosity, settings.viscosity
        )
        T, m = (backend.asarray(values) for values in liquid.relative_viscosity)
        self._viscosity_nodes = {"T_nodes": T, "m_nodes": m}
        self.relative_viscosity = backend.asarray(np.ones(count))
        self.wall_pressure = WallPressure(
            backend, liquid.density, liquid.viscosity, self.relative_viscosity
        )
        self.current_block: Block | None = None

    def begin(self, velocity: np.ndarray) -> None:
        """Start from velocities, host array (2, n) [m/s]."""
        self.backend.copy(self.backend.asarray(velocity), self.velocity)
        self.largest_speed = float(np.sqrt(np.max(np.sum(velocity * velocity, axis=0))))

    def enter(self, block: Block, periods: tuple[float, float]) -> None:
        """Work on a new block; periods: width along each axis that repeats, else 0 [m]."""
        self.current_block, backend, count = block, self.backend, block.count
        self._C = backend.zeros((2, 2, count))
        self._rhs, self._p = backend.zeros(count), backend.zeros(count)
        self._V = block.volume
        weighing = block.lattice.weighing
        self._lattice_sum = kernel_sum(weighing.kernel, weighing.ratio)
        tolerance = self.settings.pressure_tolerance
        self.equation = PressureEquation(
            backend, count, block.moving_support, tolerance=tolerance, period=periods
        )
        self.published = None
        if self.settings.pressure == "published":
            self.published = PublishedPressure(backend, count, tolerance=tolerance)
        self._correct_kernel = backend.phase(Flow._run_kernel)
        self._find_forces = backend.phase(Flow._run_forces)
        self._find_load = backend.phase(Flow._run_load)
        self._take_pressure = backend.phase(Flow._run_dummies)
        self._find_lowest = backend.phase(Flow._run_lowest)
        self._accelerate = backend.phase(Flow._run_acceleration)

    @property
    def correction(self) -> Array:
        """(2, 2, count) correction matrices of the block."""
        return self._C

    @property
    def block(self) -> Block:
        """The block of particles that may move."""
        assert self.current_block is not None
        return self.current_block

    def ghost_velocity_jump(self) -> Array:
        """By how much the surface makes ghosts faster than their sources [m/s].

        (n,) along a plane, (2, n) across the tangents of a surface that is none.
        """
        if self.surface is None:
            return self._nothing
        beyond = self.surface.ghosts
        return self.surface.ghost_velocity_jump if beyond is None else beyond.jump

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
        block = self.block
        fields = {"v": extended, "m": block.gather(self.relative_viscosity), "C": self._C}
        fields |= {"G_ij": block.gradient, "b": self.body_force}
        how = {"finish": viscosity.transposed_force, "rows": kinds.fluid_rows}
        terms_of, nu = viscosity.transposed_terms, self.liquid.viscosity
        self.backend.pair_sum(terms_of, block.pairs, fields, self.body_force, **how, nu=nu)

    def correct_kernel(self, rows: Rows) -> None:
        """Correction matrices of some rows at the present positions."""
        self._correct_kernel(self, rows, reads=self.block.arrays, rows=(rows,))

    def _run_kernel(self, rows: Rows) -> None:
        pairs, fields, finish = self.block.pairs, {"G_ij": self.block.gradient}, bounded_inverse
        self.backend.pair_sum(moment_term, pairs, fields, self._C, finish=finish, rows=rows)

    def predict(self, T: Array, kinds: ParticleKinds, step: float) -> None:
        """Velocity after viscous and body forces (68)."""
        backend, block = self.backend, self.block
        ahead, rows = self.viscous_step(step), (kinds.fluid_rows,)
        self.wall_pressure.find(block, self.pressure, self._C)
        reads = self.stress_jump, *block.arrays
        self._find_forces(self, T, kinds, reads=reads, rows=rows, step=ahead)
        self.iterations["viscosity"] = self.viscous.advance(
            block, self.velocity, self.body_force, self._extended, kinds, ahead
        )
        if self.has_tangents:
            fields = {"v": self.velocity, "v_old": self.before}
            backend.pointwise(terms.continue_from_middle, fields, self.velocity)
        self.stop(kinds)

    def _run_forces(self, T: Array, kinds: ParticleKinds, step: float) -> None:
        """Keep the velocity; find the body force, and the velocity of the ghosts."""
        backend, liquid = self.backend, self.liquid
        backend.copy(self.velocity, self.before)
        backend.pointwise(
            buoyancy,
            {"T": T},
            self.body_force,
            beta=liquid.expansion,
            T_l=liquid.reference_temperature,
            g=liquid.gravity,
            up=upward(2),
        )
        self._extended = self.extend_velocity(self.velocity, step)
        self._add_transposed_stress(self._extended, kinds)

    @property
    def stress_jump(self) -> Array:
        """`ghost_velocity_jump`, as the viscosity of a step sees it [m/s]."""
        beyond = None if self.surface is None else self.surface.ghosts
        return self.ghost_velocity_jump() if beyond is None else beyond.stress_jump

    def viscous_step(self, step: float) -> float:
        """From v^n to what viscosity sees [s]: the end of a step; its middle below a surface that
        moves, of second order."""
        return 0.5 * step if self.has_tangents else step

    def extend_velocity(self, v: Array, step: float) -> Array:
        """v (2, n) on the block with ghosts (2, M), as the viscosity of a step sees it [m/s]."""
        extended = self.block.extend_velocity(v, self.stress_jump)
        return self.wall_pressure.add_to(extended, self.block, step)

    def project(self, kinds: ParticleKinds, step: float) -> None:
        """Pressure that makes the velocity free of divergence (69).

        Raises:
            NotConverged: the pressure equation is not solved.
        """
        backend, block = self.backend, self.block
        speed = max(self.largest_speed, block.conditions.largest_wall_speed())
        time = block.moving_support**2 / self.liquid.viscosity
        self._find_load(
            self,
            kinds,
            reads=(self.ghost_velocity_jump(), *block.arrays),
            rows=(kinds.unknown_rows,),
            rest=exp(-step / time),
            fraction=self.liquid.density / step,
            rate=DRIFT_RATE * speed / self.spacing,
        )
        head, count = backend.head, block.count
        mask = head(kinds.unknown, count)
        if self.published is not None:
            self.published.set_operator(
                block.pairs, block.source, block.weights, head(kinds.kind, count), self._V
            )
            outcome = self.published.solve(self._rhs, self._p)
        else:
            given = None if self.surface is None else self.surface.pressure
            coefficient, value, flux = given or (None, None, None)
            pairs, weights = block.without_ghosts(), block.weights_within()
            self.equation.set_operator(pairs, weights, mask, self._V, coefficient)
            outcome = self.equation.solve(self._rhs, self._p, value=value, flux=flux)
        if not outcome.residual <= ACCEPTED * self.settings.pressure_tolerance:
            raise NotConverged(
                f"the pressure equation is left with a residual of {outcome.residual:.1e} of its "
                f"right-hand side after {outcome.iterations} iterations"
            )
        self.iterations["pressure"] = outcome.iterations
        self._set_dummy_pressure(kinds)

    def _run_load(self, kinds: ParticleKinds, rest: float, fraction: float, rate: float) -> None:
        """Right-hand side of the pressure equation, and the pressure to begin with."""
        backend, block = self.backend, self.block
        if not self.has_tangents:
            settled = self.particles["settled_jump"]
            fields = {"settled": settled, "jump": self.ghost_velocity_jump()}
            fields["m"] = self.relative_viscosity
            backend.pointwise(terms.settle, fields, settled, rest=rest)
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
        backend.copy(backend.head(self.pressure, block.count), self._p)

    def correct(self, kinds: ParticleKinds, step: float) -> None:
        """Velocity after the pressure (70).

        Raises:
            NotConverged: the velocity is not finite.
        """
        arrays = self.block.arrays
        found = self._find_lowest(self, kinds, reads=arrays, rows=(kinds.unknown_rows,))
        lowest, reads = found[0] if found else 0.0, (self._extended_C, *arrays)
        square, speed_square = self._accelerate(
            self, kinds, reads=reads, rows=(kinds.fluid_rows,), lowest=lowest, step=step
        )
        self.pressure_seen = (self._pressure_fields, lowest) if found else None
        self.largest_acceleration = max(square, 0.0) ** 0.5
        self.largest_speed = max(speed_square, 0.0) ** 0.5
        if not isfinite(self.largest_speed):
            raise NotConverged("the velocity is not finite")

    def _run_lowest(self, kinds: ParticleKinds) -> None:
        """Corrections of the gradient with those of ghosts; reduces the lowest pressure, where the
        gradient sees the pressure over that."""
        self._extended_C = self.block.extend_tensor(self._C)
        if not self.has_tangents:
            fields, rows = {"p": self.pressure}, kinds.unknown_rows
            self.backend.pointwise(terms.pressure_of, fields, (None,), rows=rows, reduce=("min",))

    def _run_acceleration(self, kinds: ParticleKinds, lowest: float, step: float) -> None:
        """Apply the gradient of the pressure; reduces |dv/dt|^2 and |v|^2."""
        backend, block = self.backend, self.block
        gradient, p = corrected_difference_term, block.pressure_across(self.pressure)
        if p is None:
            gradient, p = corrected_symmetric_term, backend.zeros(block.total)
            tables, ghosts = {"p": self.pressure}, {"source": block.source}
            backend.pointwise(terms.pressure_over_lowest, ghosts, p, **tables, lowest=lowest)
        self._pressure_fields = {"p": p, "G_ij": block.gradient, "C": self._extended_C}
        backend.pair_sum(
            gradient,
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
        settled = self.particles["settled_jump"]
        jump = self.ghost_velocity_jump() if self.has_tangents else settled
        v = block.mirror_velocity(self.velocity, jump)
        return {"v": v, "C": self._C, "G_ij": block.gradient}

    @property
    def has_tangents(self) -> bool:
        """Whether the surface is no plane."""
        return self.surface is not None and self.surface.ghosts is not None

    def _set_dummy_pressure(self, kinds: ParticleKinds) -> None:
        """Take the pressure of the block; dummies have that of the edge."""
        self._take_pressure(self, kinds, reads=self.block.arrays, rows=(kinds.dummy_rows,))

    def _run_dummies(self, kinds: ParticleKinds) -> None:
        backend, block, rows = self.backend, self.block, kinds.dummy_rows
        pressure = backend.head(self.pressure, block.count)
        backend.copy(self._p, pressure)
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
