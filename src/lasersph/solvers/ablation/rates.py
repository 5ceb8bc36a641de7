"""`Rates`: rates of change of the particles, and the half and whole steps that they lead to.

Mostly little can change, and only that is computed:

    NOTHING    moves: dh/dt alone, between pairs that are weighed once, with the conductivity where
               that is one number
    VAPOR      moves, what leaves the surface, at constant velocity, while no force acts on the
               rest: dh/dt and its position, between pairs that are weighed anew. Of the published
               rule, most steps under light are of this kind.
    ALL        may move: d rho/dt, dv/dt and dh/dt
"""

from __future__ import annotations

from enum import Enum
from math import isfinite, sqrt

from lasersph.compute.array_types import Array, Rows
from lasersph.input import format_quantity
from lasersph.particles.particles import Particles
from lasersph.particles.verlet_list import VerletList
from lasersph.solvers.ablation.equations import (
    advance,
    advance_enthalpy,
    advance_vapor,
    energy_gain,
    even_pair_heat,
    even_pair_rates,
    heat_rates,
    pair_heat,
    pair_rates,
    pair_weight,
    particle_rates,
    trial_step,
)
from lasersph.solvers.ablation.parameters import Parameters
from lasersph.solvers.ablation.particle_state import ParticleState
from lasersph.solvers.ablation.state import AblationState
from lasersph.solvers.step_control import NotConverged
from lasersph.sph.laplacian import flow, harmonic_flow
from lasersph.surface.surface import upward

LEAST_DENSITY = 0.01
"""Share of the density at rest below which a step has failed. Guard: a density that fell a
hundredfold in one step is no solution, matter would be torn apart; the step is halved."""


class Moving(Enum):
    """Particles that move in a step, see above."""

    NOTHING = 0
    VAPOR = 1
    ALL = 2


class Rates:
    """d rho/dt, dv/dt and dh/dt of the particles.

    Args:
        area: (N,) open area of each particle [m^(dim-1)], kept up to date.

    Attributes:
        moving: what may change. weights: (pairs,) of pairs at rest [m^(d-2)], with a conductivity
            that is one number [W/K]; None where unknown.
    """

    weights: Array | None

    def __init__(
        self,
        particles: ParticleState,
        pairs: VerletList,
        area: Array,
        parameters: Parameters,
        state: AblationState,
    ) -> None:
        self.particles, self.pairs, self.area = particles, pairs, area
        self.parameters, self.state = parameters, state
        backend, dimension = particles.backend, particles.geometry.dimension
        self._a = backend.zeros((dimension, particles.now.capacity))
        self._drho, self._dh = (backend.zeros(particles.now.capacity) for _ in range(2))
        self._constants = {
            "h_s": parameters.smoothing,
            "c_0": parameters.sound_speed,
            "g": parameters.gravity,
            "alpha_solid": parameters.alpha_solid,
            "alpha_liquid": parameters.alpha_liquid,
            "factor": parameters.weight_factor,
            "up": upward(dimension),
            "surroundings": backend.asarray(parameters.surroundings.table),
        }
        self.moving, self.weights = Moving.ALL, None

    def prepare(self, moving: Moving, rows: Rows | None) -> None:
        """Say what moves in the step; where nothing does, weigh all pairs unless that is done."""
        self.moving = moving
        if moving is not Moving.NOTHING:
            self.weights = None
        elif self.weights is None:
            # g_ij of pairs at rest, which stay the same while nothing moves
            particles, pairs, factor = self.particles, self.pairs.now, self.parameters.weight_factor
            backend, fields = particles.backend, particles.fields()
            self.weights = backend.zeros(pairs.neighbor.shape[0])
            if particles.conducts_alike:
                fields["V"] = fields["V_k"]
            backend.pair_values(pair_weight, pairs, fields, self.weights, rows=rows, factor=factor)

    def evaluate(self, level: Particles, step: float, rows: Rows | None) -> float:
        """Find the rates at a level, and what limits the next step; returns the heat lost [W]."""
        particles, state, backend = self.particles, self.state, self.particles.backend
        pairs = self.pairs.now if level is particles.now else self.pairs.half
        is_even = particles.conducts_alike
        fields = particles.fields(level) | {"A": self.area}

        # all three equations in one pass over the pairs
        if self.moving is Moving.ALL:
            lost, square, fourth = backend.pair_sum(
                even_pair_rates if is_even else pair_rates,
                pairs,
                fields,
                (self._drho, self._a, self._dh, None, None, None),
                rows=rows,
                finish=particle_rates,
                reduce=(None, None, None, "sum", "max", "max"),
                step=step,
                **self._constants,
            )
            # bound of |mu_ij| by the fourth root of the sum of its fourth powers
            state.approach_speed, state.acceleration = fourth**0.25, sqrt(square)
            state.is_balanced = square == 0.0
            return lost

        # heat alone, between particles that part or by weights of pairs at rest
        term = even_pair_heat if is_even else pair_heat
        constants = {"factor": self.parameters.weight_factor}
        if self.moving is Moving.NOTHING:
            assert self.weights is not None
            term, constants = flow if is_even else harmonic_flow, {}
            pairs, fields["g_ij"] = self.pairs.now, self.weights
            fields["P"] = fields["T"]  # with the conductivity in the weights that of heat, too
        (lost,) = backend.pair_sum(
            term,
            pairs,
            fields,
            (self._dh, None),
            rows=rows,
            finish=heat_rates,
            reduce=(None, "sum"),
            step=step,
            surroundings=self._constants["surroundings"],
            **constants,
        )
        return lost

    def check_stability(self, step: float, rows: Rows | None) -> None:
        """Look ahead at what the step brings.

        Raises:
            NotConverged: its heat or its force is not finite, or matter would be torn apart.
        """
        particles, pointwise = self.particles, self.particles.backend.pointwise
        # heat alone: the energy that is gained must be finite
        fields = {"m": particles.now["mass"], "dh": self._dh}
        if self.moving is not Moving.ALL:
            (gain,) = pointwise(energy_gain, fields, (None,), rows=rows, reduce=("sum",), dt=step)
            is_stable = isfinite(gain)
        else:
            # all equations: forces as well, and no particle may become too thin
            fields |= {"rho": particles.now["density"], "a": self._a, "drho": self._drho}
            reduce = ("sum", "min", "sum")
            gain, thinnest, force = pointwise(
                trial_step, fields, (None, None, None), rows=rows, reduce=reduce, dt=step
            )
            least = LEAST_DENSITY * particles.material.density_reference
            is_stable = isfinite(gain) and isfinite(force) and thinnest > least
        if not is_stable:
            raise NotConverged(
                f"a step of {format_quantity(step, 's')} is unstable; take shorter ones"
            )

    def advance(self, target: Particles, source: Particles, step: float, rows: Rows | None) -> None:
        """Write the start of the step advanced by `step` [s] into a level.

        Args:
            source: level that the rates were found at; positions move with its velocity.
        """
        particles, pointwise = self.particles, self.particles.backend.pointwise
        # y_0 + dt f(y'), of what may change in the step
        fields = particles.now.by_symbol() | {"v_rate": source["velocity"]}
        fields |= {"a": self._a, "drho": self._drho, "dh": self._dh}
        x, v, rho, h = (target[name] for name in ("position", "velocity", "density", "enthalpy"))
        if self.moving is Moving.NOTHING:
            pointwise(advance_enthalpy, fields, h, rows=rows, dt=step)
        elif self.moving is Moving.VAPOR:
            pointwise(advance_vapor, fields, (x, h), rows=rows, dt=step)
        else:
            pointwise(advance, fields, (x, v, rho, h), rows=rows, dt=step)
