"""`Ablation`: matter that is heated, moves, compresses and leaves. `step()` is the recipe.

    light -> rates -> half step -> rates -> whole step -> what leaves -> what flies

[Alshaer2017, Sections 2 and 4.4]. Rates are evaluated anew in the middle of the step, that is the
midpoint rule; the paper's eqs. (29), (30) do not show it. While nothing moves and no force acts,
only heat is computed, between pairs weighed once.
"""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np

from lasersph.boundaries.free_surface import FreeSurface
from lasersph.physics.compressible_limits import compressible_limits
from lasersph.physics.ejection import EJECTED
from lasersph.solvers.ablation.active import ActiveRegion
from lasersph.solvers.ablation.ejecta_motion import flown
from lasersph.solvers.ablation.enthalpy_ejection import EnthalpyEjection
from lasersph.solvers.ablation.first_hit import FirstHitLight
from lasersph.solvers.ablation.lifting_step import LiftingStep
from lasersph.solvers.ablation.moving_step import MovingStep
from lasersph.solvers.ablation.pairs import REST, Pairs, Stride
from lasersph.solvers.ablation.parameters import Parameters
from lasersph.solvers.ablation.particle_state import ParticleState
from lasersph.solvers.ablation.published.ejection import PublishedEjection
from lasersph.solvers.ablation.rates import condensed_extremes, speed_squares
from lasersph.solvers.ablation.resting_step import RestingStep
from lasersph.solvers.ablation.state import AblationState
from lasersph.solvers.step_control import (
    NotConverged,
    common_limits,
    name_of_longest,
    retry_step,
)
from lasersph.solvers.time_settings import TimeSettings

LEVEL_ARRAYS = {"position": "x", "velocity": "v", "density": "rho", "enthalpy": "h"}
MATTER_ARRAYS = ("kind", "left_at", "p_v")


class Ablation:
    """Solver of a run whose matter may move and leave.

    Attributes:
        body: the particles. pairs: who is near whom. exposure: the free surface. columns: the
            light. ejection: the rule of leaving. Both None without a laser.
        state: all numbers that survive a step.
    """

    def __init__(
        self,
        particles: ParticleState,
        pairs: Pairs,
        exposure: FreeSurface,
        numbers: Parameters,
        time: TimeSettings,
        columns: FirstHitLight | None = None,
        ejection: EnthalpyEjection | PublishedEjection | None = None,
        region: ActiveRegion | None = None,
    ) -> None:
        self.body, self.pairs, self.surface = particles, pairs, exposure
        self.parameters, self.time_settings = numbers, time
        self.light, self.ejection, self.region = columns, ejection, region
        self.backend = particles.backend
        self.state = AblationState()
        self._moving = MovingStep(particles, pairs, exposure, numbers, self.state)
        self._resting = RestingStep(particles, pairs, exposure, numbers)
        self._lifting = LiftingStep(particles, pairs, exposure, numbers)
        self._surface_known = False
        self._everything = self.backend.asarray(np.arange(particles.total), "index")
        self._enter()

    @property
    def rows(self) -> Any:
        """Particles that are computed, kind "index"; None for all."""
        return None if self.region is None else self.region.rows

    @property
    def particle_count(self) -> int:
        """Particles of the body, without walls."""
        return self.body.count

    @property
    def fields(self) -> dict[str, Any]:
        """Arrays of the particles by name."""
        level, particles = self.body.now, self.body
        found = {name: getattr(level, symbol) for name, symbol in LEVEL_ARRAYS.items()}
        found |= {name: getattr(particles, name) for name in MATTER_ARRAYS}
        found["listed"] = self.pairs.listed
        for part in (self.ejection, self.region):
            found |= {} if part is None else part.fields
        return found

    @property
    def iterations(self) -> dict[str, int]:
        """An explicit step has none."""
        return {}

    @property
    def is_steady(self) -> bool:
        """A run goes on to its end."""
        return False

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers beside the fields that survive a step."""
        numbers = self.state.checkpoint_scalars() | self.pairs.checkpoint_scalars()
        return numbers | ({} if self.region is None else self.region.checkpoint_scalars())

    def restore(self, arrays: dict[str, np.ndarray], numbers: dict[str, float]) -> None:
        """Continue from the arrays of `fields` and the numbers of `checkpoint_scalars`."""
        for name, field in self.fields.items():
            self.backend.copy(self.backend.asarray(arrays[name]), field)
        self.state.restore(numbers)
        if self.region is not None:
            self.region.restore(arrays, numbers)
        self.body.refresh(self.body.now)
        self._enter()
        self._surface_known, self._resting.weights = False, None
        self.pairs.resume(numbers)

    def time_step_limits(self) -> dict[str, float]:
        """Named limits of the next step [s]; of flow only where something moves or is pushed."""
        state, time, numbers = self.state, self.time_settings, self.parameters
        pulse = None if self.light is None else self.light.laser.pulse
        limits = common_limits(time, state.time, pulse)
        if time.fixed_step is not None:
            return limits
        limits |= compressible_limits(
            is_still=state.is_balanced and state.speed == 0.0,
            courant=numbers.courant,
            smoothing=numbers.smoothing,
            sound_speed=numbers.sound_speed,
            closing_speed=state.closing,
            acceleration=state.acceleration,
            viscous_rate=numbers.viscous_rate,
            diffusive_rate=numbers.diffusive_rate,
        )
        if time.step is not None:
            limits[name_of_longest(self.light is not None)] = time.step
        if self.light is not None and self.ejection is not None:
            flux = self.light.largest_flux(state.time, state.time + min(limits.values()))
            if flux > 0.0:
                density = self.body.material.density_reference
                limits["vaporization"] = self.ejection.longest_step(flux, density)
        return limits

    def step(self, step: float, unclipped_step: float | None = None) -> float:
        """Advance by `step` [s], or by less where that is unstable; returns the step taken.

        Raises:
            NotConverged: not even a 256th of the step is stable; the state is as before.
        """
        return retry_step(self._advance, step)

    def _advance(self, step: float, _unclipped_step: float | None = None) -> None:
        """One step of the midpoint rule."""
        particles, state = self.body, self.state
        rule = self._prepare(step)
        rows = self.rows
        light = self._shine(step)
        rule.evaluate(particles.now, step, rows)
        rule.move(particles.half, particles.now, 0.5 * step, rows)
        particles.refresh(particles.half, rows)
        lost = rule.evaluate(particles.half, step, rows)
        stored = rule.foresee(step, rows)
        rule.move(particles.now, particles.half, step, rows)
        particles.refresh(particles.now, rows)
        state.add(light | {"stored": stored, "lost": lost * step})
        state.time, state.time_step = state.time + step, step
        self._leave(step)
        self._fly(step)
        self._surface_known = self._surface_known and rule is self._resting

    def _prepare(self, step: float) -> MovingStep | RestingStep:
        """Wake what heat comes near, renew pairs and surface where matter has moved.

        Returns the rule of the step: that of rest where only heat changes.
        """
        particles, state = self.body, self.state
        has_grown = self.region is not None and self.region.activate(particles.fields())
        if has_grown:
            self._enter()
        fields = {"v": particles.now.v, "kind": particles.kind}
        square, leaving = self.backend.pointwise(
            speed_squares, fields, (None, None), rows=self.rows, reduce=("max", "max")
        )
        state.speed = sqrt(square)
        stride = Stride(step, state.speed, state.acceleration)
        if not 2.0 * stride.way <= self.pairs.skin:
            raise NotConverged(
                f"matter moves {stride.way:.3g} m in {step:.3g} s; take shorter steps"
            )
        if has_grown or self.pairs.is_stale(stride, self.rows):
            self.pairs.renew(stride, self.rows)
            self._resting.weights, self._surface_known = None, False
        if self.light is not None:
            self.find_surface()
        is_still = square == 0.0 and self.parameters.gravity == 0.0
        if state.is_balanced and is_still and leaving == 0.0:
            self._resting.weigh(self.rows)
            return self._resting
        self._resting.weights = None
        return self._lifting if state.is_balanced and is_still else self._moving

    def extremes(self) -> tuple[float, float]:
        """Largest pressure [Pa] and speed [m/s] of what is condensed."""
        fields = {"P": self.body.now.P, "v": self.body.now.v, "kind": self.body.kind}
        pressure, square = self.backend.pointwise(
            condensed_extremes, fields, (None, None), rows=self.rows, reduce=("max", "max")
        )
        return pressure, sqrt(square)

    def find_surface(self) -> None:
        """Surface, normals and open areas of what has not been ejected, where not known."""
        if self._surface_known:
            return
        if self.pairs.margin == 0.0:
            self.pairs.renew(REST, self.rows)
        particles = self.body
        self.surface.find(self.pairs.now, particles.now.V, particles.opaque, self.rows)
        if self.light is not None:
            rows = self._everything if self.rows is None else self.rows
            self.light.sort(particles.now.x, particles.kind, rows)
        self._surface_known = True

    def _shine(self, step: float) -> dict[str, float]:
        """Light of the step: where what falls on the surface goes [J], by ENERGIES."""
        columns, time = self.light, self.state.time
        if columns is None:
            return {}
        columns.shine(time, time + step)
        columns.absorb(self.body.now.T)
        return {
            "incident": columns.incident,
            "absorbed": columns.absorbed,
            "transmitted": columns.transmitted,
            "reflected": columns.incident - columns.absorbed - columns.transmitted,
        }

    def _enter(self) -> None:
        """Let the middle of the step know what is computed, and its neighbors."""
        self.body.enter(None if self.region is None else self.region.near)

    def _leave(self, step: float) -> None:
        """Let what has taken up enough heat leave the surface."""
        if self.ejection is None:
            return
        particles, surface = self.body, self.surface
        fields = particles.fields() | {
            "exposed": surface.exposed, "normal": surface.normal,
        }  # fmt: skip
        departure = self.ejection.leave(fields, self.pairs.now, self.rows, self.state.time, step)
        particles.refresh(particles.now, self.rows)
        if departure.count:
            self.state.leave(departure)
            self._surface_known = False

    def _fly(self, step: float) -> None:
        """Move what has been ejected."""
        if not self.state.left.count:
            return
        particles = self.body
        fields = {"x": particles.now.x, "v": particles.now.v, "kind": particles.kind}
        (gone,) = self.backend.pointwise(
            flown, fields, (particles.now.x, particles.kind, None),
            rows=self.backend.rows_where(particles.kind, EJECTED), reduce=(None, None, "sum"),
            step=step, low=self.parameters.low, high=self.parameters.high,
        )  # fmt: skip
        self.state.gone += int(gone)
