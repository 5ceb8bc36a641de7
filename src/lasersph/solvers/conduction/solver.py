"""`Conduction`: heat and melting of a body at rest. `step()` is the recipe."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.irradiation.light import energies
from lasersph.lasers import Laser
from lasersph.lasers.pulses import PulseTrain
from lasersph.solvers.conduction.body import Body
from lasersph.solvers.conduction.explicit import ExplicitStep
from lasersph.solvers.conduction.implicit import ImplicitStep
from lasersph.solvers.conduction.published.steepest_descent import PublishedStep
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.conduction.state import HeatState
from lasersph.solvers.conduction.surface_exchange import SurfaceExchange
from lasersph.solvers.step_control import common_limits, name_of_longest, retry_step
from lasersph.solvers.time_settings import TimeSettings
from lasersph.surface.recession import Recession

EXPECTED_SHARE = 1e-3
"""Share of the incident energy that scales residuals before any was absorbed. Accuracy: what is
taken for 0 then is 1e-11 of the pulse."""


def temperature_change(T, T_old):
    """Largest change of temperature."""
    return abs(T - T_old)


def clip_enthalpy(h, m, h_limit):
    """Enthalpy cut at the full latent heat, and the energy discarded [J]."""
    return min(h, h_limit), m * max(h - h_limit, 0.0)


LONGEST_PAUSE = 1e4
"""Longest step without light over that in the light. Guard: after nanoseconds of light
that of cooling binds before."""


class Conduction:
    """Solver of a run that computes heat, melting and the vaporization plateau.

    Attributes:
        particles: their fields. state: numbers that survive a step.
        longest_pause: longest step without light over that in the light.
    """

    longest_pause = LONGEST_PAUSE

    def __init__(
        self,
        body: Body,
        settings: ConductionSettings,
        time: TimeSettings,
        laser: Laser | None,
        ambient_pressure: float = 0.0,
        *,
        recedes: bool = False,
        end_of_pulse: float | None = None,
    ) -> None:
        """`ambient_pressure` [Pa]: against which vapor leaves the surface, 0 for vacuum; `recedes`:
        whether the metal follows what has evaporated; `end_of_pulse`: time to compute of each pulse
        where the pauses between them are jumped over [s], else that of the run."""
        self.end_of_pulse = time.end if end_of_pulse is None else end_of_pulse
        # body, what it loses, and metal that follows what has evaporated
        self.body, self.settings, self.time_settings, self.laser = body, settings, time, laser
        self.particles, self.state = body.particles, HeatState()
        self.exchange = SurfaceExchange(
            body, evaporates=settings.evaporates, ambient_pressure=ambient_pressure
        )
        backend: Backend = body.backend
        self.recession: Recession | None = None
        if recedes:
            density = body.material.density_reference
            self.recession = Recession(body.particles, body.filling, density)
        self._before = backend.zeros(body.count)

        # explicit or implicit; residuals no smaller than rounding
        if settings.scheme == "explicit":
            self.scheme: ExplicitStep | ImplicitStep = ExplicitStep(body, self.exchange)
            self._stable = self.scheme.stable_step()
        else:
            scheme = PublishedStep if settings.iteration == "published" else ImplicitStep
            tolerance = max(settings.tolerance, 200.0 * float(np.finfo(backend.real).eps))
            self.scheme = scheme(body, self.exchange, tolerance)
            self._stable = np.inf

        # energy that residuals are measured by before any was absorbed
        self.expected = 0.0
        if laser is not None:
            area = float(np.sum(body.light.surface_area))
            self.expected = EXPECTED_SHARE * laser.mean_fluence * area

    @property
    def fields(self) -> dict[str, Array]:
        """Arrays of a checkpoint by name."""
        return self.particles.kept

    @property
    def iterations(self) -> dict[str, int]:
        """Iterations of the last step."""
        return {"newton": self.scheme.newton, "linear": self.scheme.linear}

    @property
    def is_steady(self) -> bool:
        """A run that conducts goes on to its end."""
        return False

    @property
    def holds_melt(self) -> bool:
        """Whether what is molten stays at rest all the same."""
        return False

    @property
    def backend(self) -> Backend:
        """Of all arrays."""
        return self.body.backend

    @property
    def particle_count(self) -> int:
        """Particles of the body."""
        return self.body.count

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers beside the fields that survive a step."""
        return self.state.numbers()

    def restore(self, arrays: Mapping[str, np.ndarray], numbers: Mapping[str, float]) -> None:
        """Continue from the arrays of `fields` and the numbers of `checkpoint_scalars`."""
        self.particles.restore(arrays)
        self.body.update_temperature()
        self.state.restore(numbers)

    def time_step_limits(self) -> dict[str, float]:
        """Named limits of the next step [s]."""
        state, time = self.state, self.time_settings
        pulse = self.laser.pulse if self.laser is not None else None
        limits = common_limits(time, state.time, pulse)
        if time.fixed_step is not None:
            return limits

        # a surface that recedes passes a part of a particle in a step
        if self.recession is not None and state.recession > 0.0:
            limits["recession"] = self.recession.longest_step(state.recession)
        name = name_of_longest(pulse is not None)
        if self.settings.scheme == "explicit":
            limits["conduction"] = self._stable
            if time.step is not None:
                limits[name] = time.step
        else:
            # light resolved while it is on, 0.5 % of the time since it ended after that
            longest = time.step
            if longest is None and pulse is not None:
                longest = 0.5 * pulse.resolution
            if longest is not None:
                limits[name] = longest
            if longest is not None and pulse is not None:
                limits[name] = next_light(pulse, state.time, longest, self.longest_pause)
            if longest is not None and state.lit_until > 0.0:
                dark = state.time - state.lit_until
                limits["cooling"] = max(longest, time.cooling * dark)
            # no faster than the last step allows, by length and change of temperature
            if state.unclipped_step > 0.0:
                limits["growth"] = time.growth * state.unclipped_step
                if state.temperature_change > 0.0:
                    limits["temperature change"] = (
                        state.time_step * time.temperature_change / state.temperature_change
                    )
            else:
                limits["first step"] = 1e-3 * self.end_of_pulse
        return limits

    def step(self, step: float, unclipped_step: float | None = None) -> float:
        """Advance by `step` [s], or by less where that does not converge; returns the step taken.

        `unclipped_step` [s]: were no time to be hit; growth goes from it.

        Raises:
            NotConverged: not even a 256th of the step converges.
            SupercriticalSurface: the surface is above the critical temperature.
        """
        self.refuse_supercritical(lambda: self.body.filling.position)
        return retry_step(self.attempt, step, unclipped_step)

    def refuse_supercritical(self, position: Callable[[], np.ndarray]) -> None:
        """Stop before a step where the surface has no liquid any more.

        Args:
            position: returns those of the particles, (dim, n) [m].

        Raises:
            SupercriticalSurface: with place and temperature.
        """
        if self.settings.has_vapor_flux:
            self.exchange.refuse_supercritical(self.particles["temperature"], position)

    def attempt(self, step: float, unclipped_step: float | None = None) -> None:
        """Advance by `step` [s] with the light that falls in it.

        Raises:
            NotConverged: the step is too large; the state is as before.
        """
        self.body.light.shine(self.state.time, self.state.time + step)
        self.conduct(step, unclipped_step)

    def conduct(self, step: float, unclipped_step: float | None = None) -> None:
        """Advance by `step` [s] under light that is fixed:

        recession -> enthalpies (scheme) -> plateau rule -> temperatures and fractions -> energies.

        Raises:
            NotConverged: the step is too large; the state is as before.
        """
        state, body, particles = self.state, self.body, self.particles
        backend, temperature = body.backend, particles["temperature"]
        backend.copy(temperature, self._before)
        if self.recession is not None:  # of the last step; a step that fails keeps it
            state.energy["removed"] += self.recession.advance()

        # enthalpies by the scheme, cut by the plateau rule, and what follows from them
        energy = self.scheme.advance(state, step, self._exchanged())
        discarded = self._discard()
        (state.temperature_change,) = self.update_temperature()

        # vapor that has left, and how fast the surface recedes by that
        if self.settings.evaporates:
            self.exchange.accumulate(particles["evaporated_mass"], step)
        if self.recession is not None:
            state.recession = self.recession.speed(self.exchange.mass_flux)

        # energies and times of the step
        self._account(energy, discarded)
        if self.laser is not None and self.laser.pulse.active(state.time, state.time + step):
            state.lit_until = state.time + step
        state.time_step_before = state.time_step
        state.time, state.time_step = state.time + step, step
        state.unclipped_step = step if unclipped_step is None else unclipped_step

    @graph
    def update_temperature(self) -> None:
        """Temperatures and fractions; reduces the largest change of temperature [K]."""
        self.body.update_temperature()
        fields = {"T": self.particles["temperature"], "T_old": self._before}
        self.backend.pointwise(temperature_change, fields, (None,), reduce=("max",))

    def _exchanged(self) -> float:
        """Energy that the tolerance of a step refers to [J]."""
        energy = self.state.energy
        return max(self.expected, energy["absorbed"], abs(energy["lost"]))

    def _discard(self) -> float:
        """Under `clip`, cut enthalpies at the full latent heat; returns the energy cut [J]."""
        limit = self.body.curve.enthalpy_vaporized
        if self.settings.plateau != "clip" or limit is None:
            return 0.0
        fields = self.particles.by_symbol("enthalpy", "mass")
        out, reduce = (fields["h"], None), (None, "sum")
        return self.backend.pointwise(clip_enthalpy, fields, out, reduce=reduce, h_limit=limit)[0]

    def _account(self, energy: dict[str, float], discarded: float) -> None:
        """Add the energies of a step; what walls exchange is the balance of the pair sums."""
        # light by where it went, losses with what walls exchange
        total = self.state.energy
        for name, value in energies(self.body.light, energy["absorbed"]).items():
            total[name] += value
        total["lost"] += energy["lost"] - energy["walls"]
        total["removed"] += energy["removed"]
        total["discarded"] += discarded
        total["newton_residual"] += energy.get("newton_residual", 0.0)


def next_light(
    pulse: PulseTrain, time: float, longest: float, most: float = LONGEST_PAUSE
) -> float:
    """Largest step [s] that resolves the light from `time` on: `longest` while it is on, about
    `most` times that where none comes."""
    step = longest
    while step < most * longest and not pulse.active(time, time + 2.0 * step):
        step *= 2.0
    return step
