"""`Projection`: the pressure of a step, and what it does to the velocity [Demuth2020, (69), (70)].

    L p = rho/dt (D{v*} - d),    v = v* - dt/rho G{p}

Gradient and divergence are corrected by the same matrix C, so that the divergence is exact on
linear fields and both are skew-adjoint to each other; for that ghosts carry the mirrored pressure
and, in the divergence, the mirrored velocity, so that nothing crosses a face, whatever its motion,
which viscosity alone sees. d parts particles that are too dense (`sph.density_drift`); condition
and gradient of the pressure are those that the surface brings (`surface.pressure_gradient`).
"""

from __future__ import annotations

from math import exp

from lasersph.compute.array_types import Array
from lasersph.compute.graph import graph
from lasersph.linear_solvers.unknowns import Unknowns
from lasersph.particles.particles import Particles
from lasersph.solvers.melt_pool import flow_terms as terms
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.flow_terms import FlowTerms
from lasersph.solvers.melt_pool.liquid import Liquid
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds
from lasersph.solvers.melt_pool.pressure_equation import Outcome, PressureEquation
from lasersph.solvers.melt_pool.published.pressure_equation import PublishedPressure
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.sph.lattice_sums import kernel_sum
from lasersph.surface.surface import Surface

ACCEPTED = 10.0
"""Residual of the pressure equation over its tolerance with which a step is still taken. Guard: a
worse one halves the step; tests that end iterations early see it."""


class Projection:
    """Projection of the velocities of a block.

    Args:
        particles: with velocity, pressure and settled jump. spacing: of those that move [m].
            volume: (n,) of the body that they stand for [m^2], rings [m^3]. terms: of its
            geometry.

    Attributes:
        unknowns: whose pressure it is. equation: for the pressure. lowest: pressure above which the
            gradient counts [Pa]. gradient_fields: of its sum in the last step, p [Pa], G and C.
    """

    def __init__(
        self,
        particles: Particles,
        liquid: Liquid,
        surface: Surface,
        settings: MeltPoolSettings,
        block: Block,
        spacing: float,
        volume: Array,
        terms: FlowTerms,
    ) -> None:
        backend, count = particles.backend, block.count
        self.terms = terms
        self.backend, self.block = backend, block
        self.liquid, self.surface = liquid, surface
        self.spacing, self.tolerance = spacing, settings.pressure_tolerance
        self.volume = backend.head(volume, count)
        self.velocity, self.pressure = particles["velocity"], particles["pressure"]
        self._settled_jump, self._force = particles["settled_jump"], particles["pressure_force"]

        # right-hand side and pressure of (69); kernel sum of a perfect lattice, from which density
        # drift is counted
        self._load, self._p = backend.zeros(count), backend.zeros(count)
        weighing = block.lattice.weighing
        self._lattice_sum = kernel_sum(weighing.kernel, weighing.ratio)

        # the equation for p: conjugate gradients, or the paper's matrix for comparison
        self.unknowns = unknowns_of(block)
        self.equation: PressureEquation | PublishedPressure
        if settings.pressure == "published":
            self.equation = PublishedPressure(backend, count, tolerance=self.tolerance)
        else:
            self.equation = PressureEquation(
                backend,
                self.unknowns,
                tolerance=self.tolerance,
                is_even=not block.lattice.geometry.is_axisymmetric,
            )

        # what the gradient of the last step has seen
        self.lowest = 0.0
        self.gradient_fields: dict[str, Array] = {}
        self._extended_C = block.correction

    def project(
        self, kinds: ParticleKinds, relative_viscosity: Array, speed: float, step: float
    ) -> int:
        """Find the pressure that makes the velocity free of divergence (69); iterations.

        Args:
            relative_viscosity: (n,) over that at the liquidus. speed: largest [m/s].

        Raises:
            NotConverged: the pressure equation is not solved.
        """
        block = self.block
        # rho/dt V (D - d): d by the speed of the flow, the jump of ghosts decayed over the step
        speed = max(speed, block.conditions.largest_wall_speed())
        time = block.layers.moving_support**2 / self.liquid.viscosity
        self.find_load(
            kinds,
            relative_viscosity,
            remaining=exp(-step / time),
            fraction=self.liquid.density / step,
            rate=self.terms.drift_rate * speed / self.spacing,
        )

        # matrix (77) of the present pairs, solved from the last pressure
        outcome = self._solve(kinds)
        # a pressure that is far off would leave a divergence
        outcome.refuse_above(ACCEPTED * self.tolerance, "the pressure equation")
        self.set_pressure(kinds)
        return outcome.iterations

    @graph
    def find_load(
        self,
        kinds: ParticleKinds,
        relative_viscosity: Array,
        remaining: float,
        fraction: float,
        rate: float,
    ) -> None:
        """Right-hand side of the pressure equation, and the pressure to begin with.

        Args:
            remaining: share that the jump of ghosts keeps of what it was. fraction: rho / dt
                [kg/(m^3 s)]. rate: at which particles that are too dense part [1/s].
        """
        backend, block = self.backend, self.block
        # the jump of ghosts that the divergence sees, then rho / dt V (D - d)
        self.surface.settle(self._settled_jump, relative_viscosity, remaining)
        backend.pair_sum(
            self.terms.divergence_terms,
            block.pairs,
            self._divergence_fields() | {"VW_ij": block.kernel, "V": self.volume},
            self._load,
            finish=terms.divergence_load,
            rows=kinds.unknown_rows,
            fraction=fraction,
            lattice_sum=self._lattice_sum,
            rate=rate,
        )

        # first guess: the pressure of the last step
        backend.copy(backend.head(self.pressure, block.count), self._p)

    def _solve(self, kinds: ParticleKinds) -> Outcome:
        """Solve the pressure equation of the present pairs."""
        block, equation, head = self.block, self.equation, self.backend.head
        if isinstance(equation, PublishedPressure):
            equation.set_operator(
                block.pairs,
                block.ghosts.source,
                block.weights,
                head(kinds.kind, block.count),
                self.volume,
            )
            return equation.solve(self._load, self._p)
        # pairs across a surface weigh nothing: its pressure is a boundary of each particle
        coefficient, value = self.surface.pressure
        equation.set_operator(
            block.without_ghosts(),
            block.inner_weights(),
            head(kinds.unknown, block.count),
            self.volume,
            coefficient,
            version=(block.placings, kinds.changes),
        )
        return equation.solve(self._load, self._p, value=value)

    @graph
    def set_pressure(self, kinds: ParticleKinds) -> None:
        """Set the pressure from that of the block; dummies have that of the edge."""
        backend, block = self.backend, self.block
        pressure = backend.head(self.pressure, block.count)
        backend.copy(self._p, pressure)
        if kinds.is_box:
            return
        # dummies: mean of the edge within the support, dp/dn = 0 at the melt's wall
        backend.pair_sum(
            terms.edge_pressure_terms,
            block.pairs,
            {
                "p": block.gather(self.pressure),
                "unknown": block.gather(kinds.unknown),
                "dummy": kinds.dummy,
            },
            self._p,
            finish=terms.dummy_pressure,
            rows=kinds.dummy_rows,
        )
        backend.copy(self._p, pressure)

    def correct(self, kinds: ParticleKinds, v_old: Array, step: float) -> tuple[float, ...]:
        """Velocity after the pressure (70); the largest |dv/dt|^2 and |v|^2.

        Args:
            v_old: (d, n) at the begin of the step [m/s].
        """
        # p_0: under the symmetric gradient p < 0 would contract the particles [Monaghan2000]
        found = self.find_lowest_pressure(kinds)
        self.lowest = found[0] if found else 0.0
        return self.accelerate(kinds, v_old, self.lowest, step)

    @graph
    def find_lowest_pressure(self, kinds: ParticleKinds) -> None:
        """Corrections of the gradient with those of ghosts; reduces the lowest pressure, where the
        gradient sees the pressure over that."""
        self._extended_C = self.block.ghosts.extend_tensor(self.block.correction)
        self.surface.pressure_gradient.find_lowest(self.backend, self.pressure, kinds.unknown_rows)

    @graph
    def accelerate(self, kinds: ParticleKinds, v_old: Array, lowest: float, step: float) -> None:
        """Apply the gradient of the pressure over the lowest one [Pa]; reduces |dv/dt|^2, |v|^2."""
        backend, block = self.backend, self.block
        gradient = self.surface.pressure_gradient
        # p of particles and ghosts in the form of the gradient that the surface brings
        p = gradient.extend(backend, block.ghosts, self.pressure, lowest)
        self.gradient_fields = {"p": p, "G_ij": block.gradient, "C": self._extended_C}

        # v - dt / rho G{p}, and what the solid keeps at rest
        backend.pair_sum(
            gradient.term,
            block.pairs,
            self.gradient_fields | {"v": self.velocity, "v_old": v_old},
            (self.velocity, self._force, None),
            rows=kinds.fluid_rows,
            finish=terms.correct,
            reduce=(None, None, "max"),
            step=step,
            density=self.liquid.density,
        )
        kinds.stop_solid(self.velocity)

    def sum_divergence(self, kinds: ParticleKinds) -> None:
        """Reduce the sum of squares of the divergence that is left, and the largest one, by the
        operator of the projection."""
        self.backend.pair_sum(
            self.terms.divergence,
            self.block.pairs,
            self._divergence_fields(),
            (None, None),
            finish=terms.divergence_sizes,
            rows=kinds.fluid_rows,
            reduce=("sum", "max"),
        )

    def _divergence_fields(self) -> dict[str, Array]:
        """Velocities as the divergence sees them, C and G."""
        block = self.block
        # walls mirror the velocity, so that nothing crosses them; a stressed surface continues it
        jump = self.surface.settled_jump(self._settled_jump)
        v = block.ghosts.mirror_velocity(self.velocity, jump)
        return {"v": v, "C": block.correction, "G_ij": block.gradient, **block.ring_fields}


def unknowns_of(block: Block) -> Unknowns:
    """Unknowns among the particles of a block."""
    support, periods = block.layers.moving_support, block.conditions.periods
    return Unknowns(block.backend, block.count, support, block.spacing, periods)
