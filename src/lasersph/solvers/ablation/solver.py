"""`Ablation`: matter that is heated, moves, compresses and leaves. `_advance` is the step.

Rates are evaluated anew in the middle of the step, that is the midpoint rule; eqs. (29), (30) of
[Alshaer2017, Sections 2 and 4.4] do not show it. While nothing moves and no force acts, only heat
is computed, between pairs weighed once.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt

import numpy as np

from lasersph.compute.array_types import Array, Rows
from lasersph.input import format_quantity
from lasersph.irradiation.first_hit import FirstHitLight
from lasersph.irradiation.light import energies
from lasersph.particles.kinds import EJECTED
from lasersph.particles.particles import Particles
from lasersph.particles.verlet_list import REST, LargestMotion, VerletList
from lasersph.physics.compressible_limits import compressible_limits
from lasersph.solvers.ablation.active_region import ActiveRegion
from lasersph.solvers.ablation.enthalpy_ejection import EnthalpyEjection
from lasersph.solvers.ablation.equations import fly, interior_extremes, speed_squares
from lasersph.solvers.ablation.parameters import Parameters
from lasersph.solvers.ablation.particle_state import ParticleState
from lasersph.solvers.ablation.published.ejection import PublishedEjection
from lasersph.solvers.ablation.rates import Moving, Rates
from lasersph.solvers.ablation.state import AblationState
from lasersph.solvers.step_control import (
    NotConverged,
    common_limits,
    name_of_longest,
    retry_step,
)
from lasersph.solvers.time_settings import TimeSettings
from lasersph.surface.free_surface import FreeSurface


class Ablation:
    """Solver of a run whose matter may move and leave.

    Attributes:
        body: the particles. pairs: who is near whom. light, ejection: what falls on the surface and
            the rule of leaving, both None without a laser. region: what is computed, None for all.
        state: all numbers that survive a step.
    """

    def __init__(
        self,
        particles: ParticleState,
        pairs: VerletList,
        surface: FreeSurface,
        parameters: Parameters,
        time: TimeSettings,
        light: FirstHitLight | None = None,
        ejection: EnthalpyEjection | PublishedEjection | None = None,
        region: ActiveRegion | None = None,
    ) -> None:
        # who is computed, what falls on the surface, what leaves it
        self.body, self.pairs, self._surface = particles, pairs, surface
        self.parameters, self.time_settings = parameters, time
        self.light, self.ejection, self.region = light, ejection, region
        self.backend = particles.backend
        self.state = AblationState()

        # rates of the three equations, and the surface where anything asks for it
        self._rates = Rates(particles, pairs, surface.area, parameters, self.state)
        self._needs_surface = light is not None or parameters.surroundings.take_heat
        self._is_surface_current = False
        self._all_rows = self.backend.asarray(np.arange(particles.now.capacity), "index")
        self._include_active()
        if self._needs_surface:
            self._update_surface()

    # --- what the time loop asks ----------------------------------------------------------------

    @property
    def rows(self) -> Rows | None:
        """Particles that are computed, kind "index"; None for all."""
        return None if self.region is None else self.region.rows

    @property
    def particles(self) -> Particles:
        """The particles where they are now."""
        return self.body.now

    @property
    def particle_count(self) -> int:
        """Particles of the body, without walls."""
        return self.body.count

    @property
    def fields(self) -> dict[str, Array]:
        """Arrays that a checkpoint keeps, by name."""
        return self.particles.kept | ({} if self.region is None else self.region.fields)

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
        # the active region has numbers where not all is computed
        scalars = self.state.checkpoint_scalars() | self.pairs.checkpoint_scalars()
        return scalars | ({} if self.region is None else self.region.checkpoint_scalars())

    def restore(self, arrays: Mapping[str, np.ndarray], scalars: Mapping[str, float]) -> None:
        """Continue from the arrays of `fields` and from `checkpoint_scalars`."""
        # fields and numbers first, then what follows from them
        self.particles.restore(arrays)
        self.state.restore(scalars)
        if self.region is not None:
            self.region.restore(arrays, scalars)
        self.body.refresh(self.particles)
        self._include_active()
        # surface, weights and pairs are found again
        self._is_surface_current, self._rates.weights = False, None
        self.pairs.restore(scalars)
        if self._needs_surface:
            self._update_surface()

    def time_step_limits(self) -> dict[str, float]:
        """Named limits of the next step [s]; of flow only where something moves or a force acts."""
        state, time, parameters = self.state, self.time_settings, self.parameters
        limits = common_limits(
            time, state.time, None if self.light is None else self.light.laser.pulse
        )
        if time.fixed_step is not None:
            return limits

        # sound, forces, viscosity and heat [Alshaer2017, eqs. (31), (32)]
        limits |= compressible_limits(
            is_still=state.is_balanced and state.speed == 0.0,
            courant=parameters.courant,
            smoothing=parameters.smoothing,
            sound_speed=parameters.sound_speed,
            closing_speed=state.approach_speed,
            acceleration=state.acceleration,
            viscous_rate=parameters.viscous_rate,
            diffusive_rate=parameters.diffusive_rate,
        )
        if time.step is not None:
            limits[name_of_longest(self.light is not None)] = time.step

        # no more than a part of a layer may vaporize in a step
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

    # --- the step -------------------------------------------------------------------------------

    def _advance(self, step: float, _unclipped_step: float | None = None) -> None:
        """One step of the midpoint rule,  y' = y + dt/2 f(y),  y + dt f(y'),  of three equations:

            d rho_i/dt = rho_i sum_j V_j v_ij . grad W_ij                     [Alshaer2017, (20)]
            dv_i/dt    = -sum_j m_j ((P_i + P_j) / (rho_i rho_j) + Pi_ij) grad W_ij - g up   (22)
            dh_i/dt    = (sum_j 4 k_i k_j / (k_i + k_j) V_i V_j (T_i - T_j) dW_ij / r_ij
                          + Q_i - A_i q(T_i)) / m_i                                          (27)

        and dx_i/dt = v_i; `equations` says how each is computed.
        """
        body, rates, state = self.body, self._rates, self.state
        now, half = body.now, body.half
        # who is computed, who is near whom, what moves
        self._prepare(step)
        rows = self.rows
        # light: Q_i = E_i / dt on what it meets first
        light = self._absorb_light(step)
        # half step: rates at the start of the step, y' = y + dt/2 f(y)                     (29)
        rates.evaluate(now, step, rows)
        rates.advance(half, now, 0.5 * step, rows)
        # equation of state and caloric curve: P(rho'), T(h'), k(T') in the middle
        body.refresh(half, rows)
        # whole step: rates in the middle, y + dt f(y'), unless that would be unstable       (30)
        lost = rates.evaluate(half, step, rows)
        rates.check_stability(step, rows)
        rates.advance(now, half, step, rows)
        body.refresh(now, rows)
        state.add(light | {"lost": lost * step})
        state.time, state.time_step = state.time + step, step
        self._is_surface_current &= rates.moving is Moving.NOTHING
        # ejection: what has taken up enough heat leaves the surface; what has left flies on
        self._eject(step)
        self._move_ejecta(step)
        if self._needs_surface:
            self._update_surface()

    def _prepare(self, step: float) -> None:
        """Activate what heat comes near, renew pairs and surface where particles have moved.

        Raises:
            NotConverged: particles would pass their neighbors.
        """
        # particles that heat or motion may get to in this step
        fields, state, pairs = self.particles.by_symbol(), self.state, self.pairs
        has_grown = self.region is not None and self.region.grow(fields)
        if has_grown:
            self._include_active()

        # displacement of the fastest in the step: below the thickest skin that lists have
        square, leaving = self.backend.pointwise(
            speed_squares, fields, (None, None), rows=self.rows, reduce=("max", "max")
        )
        state.speed = sqrt(square)
        motion = LargestMotion(step, state.speed, state.acceleration)
        if not 2.0 * motion.displacement <= pairs.largest_skin:
            raise NotConverged(
                f"matter moves {format_quantity(motion.displacement, 'm')} in "
                f"{format_quantity(step, 's')}; take shorter steps"
            )

        # pairs, and with them weights and surface, where they have come out of date
        if has_grown or pairs.is_stale(motion, self.rows):
            pairs.rebuild(motion, self.rows)
            self._rates.weights, self._is_surface_current = None, False
        if self._needs_surface:
            self._update_surface()
        self._rates.prepare(self._what_moves(square, leaving), self.rows)

    def _what_moves(self, interior: float, leaving: float) -> Moving:
        """Movers of a step, by the largest |v|^2 of the interior and of what leaves [m^2/s^2]."""
        if not self.state.is_balanced or interior > 0.0 or self.parameters.gravity > 0.0:
            return Moving.ALL
        return Moving.VAPOR if leaving > 0.0 else Moving.NOTHING

    def _include_active(self) -> None:
        """Let pairs and the middle of the step know what is computed, and its neighbors."""
        subset = None if self.region is None else self.region.subset
        self.pairs.subset = subset
        self.body.add_to_half(None if subset is None else subset.members)

    def _absorb_light(self, step: float) -> dict[str, float]:
        """Light of the step: where what falls on the surface goes [J], by ENERGIES."""
        light, time = self.light, self.state.time
        if light is None:
            return {}
        # energy of the step on the columns, then on what it meets first
        light.shine(time, time + step)
        return energies(light, light.absorb(self.particles["temperature"]))

    def _eject(self, step: float) -> None:
        """Let what has taken up enough heat leave the surface."""
        if self.ejection is None:
            return
        # exposed particles leave by the rule, along the normal of the surface
        surface = self._surface
        fields = self.particles.by_symbol() | {
            "exposed": surface.at_surface,
            "normal": surface.normal,
        }
        # count what they take along; the surface lies lower now, and they conduct no more
        ejecta = self.ejection.eject(fields, self.pairs.now, self.rows, self.state.time, step)
        self.body.refresh(self.particles, self.rows)
        if ejecta.number:
            self.state.count_ejecta(ejecta)
            self._rates.weights, self._is_surface_current = None, False

    def _move_ejecta(self, step: float) -> None:
        """Move what has been ejected, straight on until it passes the edge of what is followed."""
        if not self.state.ejecta.number:
            return
        # x + dt v of what has been ejected, GONE beyond the edges of the box
        x, kind = self.particles["position"], self.particles["kind"]
        rows = self.backend.rows_where(kind, EJECTED)
        flight = {"step": step, "low": self.parameters.low, "high": self.parameters.high}
        (gone,) = self.backend.pointwise(
            fly,
            self.particles.by_symbol(),
            (x, kind, None),
            rows=rows,
            reduce=(None, None, "sum"),
            **flight,
        )
        self.state.gone += int(gone)

    # --- what observers ask ---------------------------------------------------------------------

    @property
    def surface(self) -> FreeSurface:
        """The free surface of what has not been ejected, where particles are now."""
        self._update_surface()
        return self._surface

    def extremes(self) -> tuple[float, float]:
        """Largest pressure [Pa] and speed [m/s] of what has not left."""
        fields = self.particles.by_symbol()
        pressure, square = self.backend.pointwise(
            interior_extremes, fields, (None, None), rows=self.rows, reduce=("max", "max")
        )
        return pressure, sqrt(square)

    def _update_surface(self) -> None:
        """Find surface, normals, open areas and what light meets, unless they are current.

        Steps do it where light falls or heat is lost. Else they never read the surface, and it is
        found when it is asked for.
        """
        if self._is_surface_current:
            return
        # pairs of a start at rest, which no step has found yet
        if self.pairs.skin == 0.0:
            self.pairs.rebuild(REST, self.rows)
        # divergence of the positions (28), and the particles that the light meets first
        particles = self.particles
        self._surface.find(self.pairs.now, particles["volume"], particles["opaque"], self.rows)
        if self.light is not None:
            rows = self._all_rows if self.rows is None else self.rows
            self.light.find_hit(particles["position"], particles["kind"], rows)
        self._is_surface_current = True
