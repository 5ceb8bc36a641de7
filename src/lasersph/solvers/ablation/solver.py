"""`Ablation`: matter that is heated, moves, compresses and leaves. `step()` is the recipe.

    light -> rates -> half step -> rates -> whole step -> what leaves -> what flies

[Alshaer2017, Sections 2 and 4.4]. Rates are evaluated anew in the middle of the step, that is the
midpoint rule; the paper's eqs. (29), (30) do not show it. While nothing moves and no force acts,
only heat is computed, between pairs weighed once.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, sqrt
from typing import Any

import numpy as np

from lasersph.compute.search import EscapedParticle
from lasersph.physics.compressible_limits import compressible_limits
from lasersph.physics.ejection import EJECTED
from lasersph.solvers.ablation.active import ActiveRegion
from lasersph.solvers.ablation.columns import Columns
from lasersph.solvers.ablation.enthalpy_ejection import EnthalpyEjection
from lasersph.solvers.ablation.exposure import Exposure
from lasersph.solvers.ablation.flight import flown
from lasersph.solvers.ablation.matter import Level, Matter
from lasersph.solvers.ablation.pairs import Pairs
from lasersph.solvers.ablation.published_ejection import PublishedEjection
from lasersph.solvers.ablation.rates import (
    COMBINE,
    condensed_extremes,
    foreseen,
    heat_rates,
    moved,
    pair_rates,
    pair_weight,
    rates,
    speed_squares,
    warmed,
)
from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.ablation.state import AblationState
from lasersph.solvers.conduction.state import NotConverged
from lasersph.solvers.time_step import TimeSettings, next_edge
from lasersph.sph.laplacian import harmonic_flow

RETRIES = 8
THINNEST = 0.01
"""Share of the density at rest below which a step has failed."""
LEVEL_ARRAYS = {"position": "x", "velocity": "v", "density": "rho", "enthalpy": "h"}
MATTER_ARRAYS = ("stage", "left_at", "p_v")


@dataclass(frozen=True)
class Numbers:
    """Constants of a run.

    Attributes:
        smoothing: h [m]. alpha_solid, alpha_liquid: artificial viscosity [1]. viscous_rate,
            diffusive_rate: of alternating layers [1/s]. weight_factor: of the conduction weights
            [1]. ambient: T_a, h_c, eps of the surroundings. low, high: corners of the box in which
            ejecta are followed [m].
    """

    smoothing: float
    alpha_solid: float
    alpha_liquid: float
    viscous_rate: float
    diffusive_rate: float
    weight_factor: float
    ambient: dict[str, float]
    low: tuple[float, ...]
    high: tuple[float, ...]


class Ablation:
    """Solver of a run whose matter may move and leave.

    Attributes:
        body: the particles. pairs: who is near whom. exposure: the free surface. columns: the
            light. ejection: the rule of leaving. Both None without a laser.
        state: all numbers that survive a step.
    """

    def __init__(
        self,
        matter: Matter,
        pairs: Pairs,
        exposure: Exposure,
        numbers: Numbers,
        settings: AblationSettings,
        time: TimeSettings,
        columns: Columns | None = None,
        ejection: EnthalpyEjection | PublishedEjection | None = None,
        region: ActiveRegion | None = None,
    ) -> None:
        self.body, self.pairs, self.exposure = matter, pairs, exposure
        self.numbers, self.settings, self.time_settings = numbers, settings, time
        self.columns, self.ejection, self.region = columns, ejection, region
        self.backend = backend = matter.backend
        self.state = AblationState()
        dimension, total = matter.layout.dimension, matter.total
        self._a = backend.zeros((dimension, total))
        self._drho, self._dh = (backend.zeros(total) for _ in range(2))
        self._weights: Any = None
        self._surface_known = False
        self._flow = {
            "h_s": numbers.smoothing, "c_0": settings.sound_speed,
            "alpha_solid": numbers.alpha_solid, "alpha_liquid": numbers.alpha_liquid,
            "factor": numbers.weight_factor, "g": settings.gravity,
            "up": (0.0,) * (dimension - 1) + (1.0,),
        }  # fmt: skip
        self._everything = backend.asarray(np.arange(total), "index")
        self._enter()

    @property
    def rows(self) -> Any:
        """Particles that are computed, kind "index"; None for all."""
        return None if self.region is None else self.region.rows

    @property
    def fields(self) -> dict[str, Any]:
        """Arrays of the particles by name."""
        level, matter = self.body.now, self.body
        found = {name: getattr(level, symbol) for name, symbol in LEVEL_ARRAYS.items()}
        found |= {name: getattr(matter, name) for name in MATTER_ARRAYS}
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

    def carried(self) -> dict[str, float]:
        """Numbers beside the fields that survive a step."""
        numbers = self.state.carried() | {"margin": self.pairs.margin}
        return numbers | ({} if self.region is None else self.region.carried())

    def restore(self, arrays: dict[str, np.ndarray], numbers: dict[str, float]) -> None:
        """Continue from the arrays of `fields` and the numbers of `carried`."""
        for name, field in self.fields.items():
            self.backend.copy(self.backend.asarray(arrays[name]), field)
        self.state.restore(numbers)
        self.pairs.margin = numbers["margin"]
        if self.region is not None:
            self.region.restore(arrays, numbers)
        self.body.refresh(self.body.now)
        self._enter()
        self._surface_known, self._weights = False, None
        if self.pairs.margin > 0.0:
            self.pairs.find()

    def time_step_limits(self) -> dict[str, float]:
        """Named limits of the next step [s]; of flow only where something moves or is pushed."""
        state, time, numbers = self.state, self.time_settings, self.numbers
        limits = {"end": time.end - state.time}
        if time.is_fixed and time.step is not None:
            return limits | {"fixed step": time.step}
        if self.columns is not None:
            edge = next_edge(self.columns.laser.pulse, state.time, time.end)
            if edge is not None:
                limits["pulse edge"] = edge
        limits |= compressible_limits(
            is_still=state.is_balanced and state.speed == 0.0,
            courant=self.settings.courant_number,
            smoothing=numbers.smoothing,
            sound_speed=self.settings.sound_speed,
            closing_speed=state.closing,
            acceleration=state.acceleration,
            viscous_rate=numbers.viscous_rate,
            diffusive_rate=numbers.diffusive_rate,
        )
        if time.step is not None:
            limits["light"] = time.step
        if self.columns is not None and self.ejection is not None:
            flux = self.columns.largest_flux(state.time, state.time + min(limits.values()))
            if flux > 0.0:
                density = self.body.material.density_reference
                limits["vaporization"] = self.ejection.longest_step(flux, density)
        return limits

    def step(self, step: float, pace: float | None = None) -> float:
        """Advance by `step` [s], or by less where that is unstable; returns the step taken.

        Raises:
            NotConverged: not even a 256th of the step is stable; the state is as before.
        """
        for attempt in range(RETRIES + 1):
            try:
                self._advance(step)
                break
            except NotConverged:
                if attempt == RETRIES:
                    raise
                step *= 0.5
        return step

    def _advance(self, step: float) -> None:
        """One step of the midpoint rule [Alshaer2017, eqs. (29), (30)]."""
        matter, state = self.body, self.state
        is_resting = self._look(step)
        incident, absorbed = self._shine(step)
        self._evaluate(matter.now, step, is_resting)
        self._move(matter.half, matter.now, 0.5 * step, is_resting)
        matter.refresh(matter.half, self.rows)
        lost = self._evaluate(matter.half, step, is_resting)
        stored = self._foresee(step)
        self._move(matter.now, matter.half, step, is_resting)
        matter.refresh(matter.now, self.rows)
        energy = state.energy
        energy["incident"] += incident
        energy["absorbed"] += absorbed
        energy["reflected"] += incident - absorbed
        energy["stored"] += stored
        energy["lost"] += lost * step
        state.time, state.time_step = state.time + step, step
        self._leave(step)
        self._fly(step)
        self._surface_known = self._surface_known and is_resting

    def _enter(self) -> None:
        """Let the middle of the step know what is computed, and its neighbors."""
        self.body.enter(None if self.region is None else self.region.near)

    def _look(self, step: float) -> bool:
        """Renew pairs and surface where matter has moved; returns whether only heat changes."""
        matter, state, backend = self.body, self.state, self.backend
        has_grown = self.region is not None and self.region.wake(matter.fields())
        if has_grown:
            self._enter()
        fields = {"v": matter.now.v, "stage": matter.stage}
        square, leaving = backend.pointwise(
            speed_squares, fields, (None, None), rows=self.rows, reduce=("max", "max")
        )
        state.speed = sqrt(square)
        way = step * (state.speed + step * state.acceleration)
        if not 2.0 * way <= self.pairs.skin:
            raise NotConverged(f"matter moves {way:.3g} m in {step:.3g} s; take shorter steps")
        if has_grown or self.pairs.is_stale(way, self.rows):
            try:
                self.pairs.renew(way, self.rows)
            except EscapedParticle as error:
                raise NotConverged(str(error)) from error
            self._weights, self._surface_known = None, False
        is_still = square == 0.0 and leaving == 0.0 and self.settings.gravity == 0.0
        is_resting = state.is_balanced and is_still
        if not is_resting:
            self._weights = None
        elif self._weights is None:
            self._weights = backend.zeros(self.pairs.now.neighbor.shape[0])
            backend.pair_values(
                pair_weight, self.pairs.now, {"V": matter.now.V}, self._weights, rows=self.rows,
                factor=self.numbers.weight_factor,
            )  # fmt: skip
        if self.columns is not None:
            self.find_surface()
        return is_resting

    def extremes(self) -> tuple[float, float]:
        """Largest pressure [Pa] and speed [m/s] of what is condensed."""
        fields = {"P": self.body.now.P, "v": self.body.now.v, "stage": self.body.stage}
        pressure, square = self.backend.pointwise(
            condensed_extremes, fields, (None, None), rows=self.rows, reduce=("max", "max")
        )
        return pressure, sqrt(square)

    def find_surface(self) -> None:
        """Surface, normals and open areas of what has not been ejected, where not known."""
        if self._surface_known:
            return
        if self.pairs.margin == 0.0:
            self.pairs.renew(0.0, self.rows)
        matter = self.body
        self.exposure.find(self.pairs.now, matter.now.V, matter.opaque, self.rows)
        if self.columns is not None:
            rows = self._everything if self.rows is None else self.rows
            self.columns.sort(matter.now.x, matter.stage, rows)
        self._surface_known = True

    def _shine(self, step: float) -> tuple[float, float]:
        """Light of the step: what falls on the surface and what of it is absorbed [J]."""
        if self.columns is None:
            return 0.0, 0.0
        time = self.state.time
        self.columns.shine(time, time + step)
        self.columns.absorb(self.body.now.T)
        return self.columns.incident, self.columns.absorbed

    def _evaluate(self, level: Level, step: float, is_resting: bool) -> float:
        """Rates at a level; returns the heat lost per second [W]."""
        matter, backend, state = self.body, self.backend, self.state
        pairs = self.pairs.now if level is matter.now else self.pairs.half
        fields = matter.fields(level) | {"A": self.exposure.area}
        constants = {"step": step, **self.numbers.ambient}
        if is_resting:
            (lost,) = backend.pair_sum(
                harmonic_flow, pairs, fields | {"g_ij": self._weights}, (self._dh, None),
                rows=self.rows, finish=heat_rates, reduce=(None, "sum"), **constants,
            )  # fmt: skip
            return lost
        lost, square, state.closing = backend.pair_sum(
            pair_rates, pairs, fields, (self._drho, self._a, self._dh, None, None, None),
            rows=self.rows, finish=rates, combine=COMBINE,
            reduce=(None, None, None, "sum", "max", "max"), **self._flow, **constants,
        )  # fmt: skip
        state.acceleration = sqrt(square)
        state.is_balanced = square == 0.0
        return lost

    def _move(self, target: Level, rate: Level, step: float, is_resting: bool) -> None:
        """Write the start of the step advanced by `step` [s] into a level.

        Args:
            rate: level whose velocity goes with the rates.
        """
        now, backend = self.body.now, self.backend
        if is_resting:
            fields = {"h": now.h, "dh": self._dh}
            backend.pointwise(warmed, fields, target.h, rows=self.rows, dt=step)
            return
        fields = {
            "x": now.x, "v": now.v, "rho": now.rho, "h": now.h, "stage": self.body.stage,
            "v_then": rate.v, "a": self._a, "drho": self._drho, "dh": self._dh,
        }  # fmt: skip
        out = (target.x, target.v, target.rho, target.h)
        backend.pointwise(moved, fields, out, rows=self.rows, dt=step)

    def _foresee(self, step: float) -> float:
        """Energy that the step brings [J].

        Raises:
            NotConverged: it is not finite, or matter would thin out.
        """
        fields = {
            "m": self.body.m, "rho": self.body.now.rho, "a": self._a, "drho": self._drho,
            "dh": self._dh,
        }  # fmt: skip
        stored, thinnest, force = self.backend.pointwise(
            foreseen, fields, (None, None, None), rows=self.rows, reduce=("sum", "min", "sum"),
            dt=step,
        )  # fmt: skip
        least = THINNEST * self.body.material.density_reference
        if not (isfinite(stored) and isfinite(force) and thinnest > least):
            raise NotConverged(f"a step of {step:.4g} s is unstable; take shorter ones")
        return stored

    def _leave(self, step: float) -> None:
        """Let what has taken up enough heat leave the surface."""
        if self.ejection is None:
            return
        matter, surface = self.body, self.exposure
        fields = matter.fields() | {
            "exposed": surface.exposed, "normal": surface.normal,
        }  # fmt: skip
        departure = self.ejection.leave(fields, self.pairs.now, self.rows, self.state.time, step)
        matter.refresh(matter.now, self.rows)
        if departure.count:
            self.state.leave(departure)
            self._surface_known = False

    def _fly(self, step: float) -> None:
        """Move what has been ejected."""
        if not self.state.left.count:
            return
        matter = self.body
        fields = {"x": matter.now.x, "v": matter.now.v, "stage": matter.stage}
        (gone,) = self.backend.pointwise(
            flown, fields, (matter.now.x, matter.stage, None),
            rows=self.backend.rows_where(matter.stage, EJECTED), reduce=(None, None, "sum"),
            step=step, low=self.numbers.low, high=self.numbers.high,
        )  # fmt: skip
        self.state.gone += int(gone)
