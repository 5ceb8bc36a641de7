"""`AblationRecipe`: matter that is heated, moves, compresses and leaves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lasersph.compute.backend import Backend
from lasersph.input import format_quantity
from lasersph.observers import Observers, ablation_observers
from lasersph.observers.view import View
from lasersph.physics.compressible_limits import compressible_limits
from lasersph.simulation.recipes.ablation.build import ablation_solver, decay_rates
from lasersph.simulation.recipes.ablation.estimates import ablation_estimates
from lasersph.simulation.recipes.ablation.view import ablation_fields
from lasersph.simulation.recipes.recipe import Recipe, StepCost, StepForecast
from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.ablation.solver import Ablation

COST = StepCost(2.0)
"""Cost of a step. Forecast: rates at its start and in its middle."""


class AblationRecipe(Recipe[AblationSettings, Ablation]):
    """A block under a laser, or matter that only moves."""

    settings_type = AblationSettings

    def build(self, backend: Backend) -> Ablation:
        """The solver with its particles, at the start of the run."""
        return ablation_solver(self.case, self.settings, backend, self.layers)

    def computed_view(self, solver: Ablation, step: int, limit: str) -> View:
        """The state for observers."""
        moving = ablation_fields(self.case, solver, step)
        return View(**moving, **self.common_view(solver, step, limit))

    def observers(self, iterations: Sequence[str]) -> Observers:
        """Crater and ejecta under a laser; without one the motion of the whole."""
        laser = self.case.laser
        return ablation_observers(
            self.settings.dimensions,
            pulses=self.pulse_observer(),
            probes=self.case.probes,
            traces=self.case.traces,
            iterations=iterations,
            axis=None if laser is None else laser.position,
            pulse_starts=() if laser is None else laser.pulse.starts,
        )

    def step_forecast(self) -> StepForecast:
        """Limits at the start, and the steps that they lead to.

        Matter that light falls on while it rests is limited by heat alone, as long as it rests.
        """
        # A fixed step needs no limits.
        if fixed := self.fixed_steps("motion", COST):
            return fixed
        limits = {"end": self.case.time.end} | self.motion_limits(is_still=self.is_at_rest)
        return self.even_steps(limits | self.longest_step(), "motion", COST)

    @property
    def is_at_rest(self) -> bool:
        """Whether nothing moves at the start and nothing pushes."""
        kind = "rest" if self.case.motion is None else self.case.motion.kind
        return kind == "rest" and self.settings.gravity == 0.0

    def motion_limits(self, *, is_still: bool) -> dict[str, float]:
        """Limits [s] of sound, viscosity, gravity and heat."""
        settings, spacing = self.settings, self.layers.spacing
        viscous, diffusive = decay_rates(self.case, settings, spacing)
        return compressible_limits(
            is_still=is_still,
            courant=settings.courant_number,
            smoothing=0.5 * self.case.particles.support_over_spacing * spacing,
            sound_speed=settings.sound_speed,
            closing_speed=0.0,
            acceleration=settings.gravity,
            viscous_rate=viscous,
            diffusive_rate=diffusive,
        )

    def warnings(self) -> list[str]:
        """How short steps become once matter moves."""
        if not self.is_at_rest:
            return []
        # At rest only heat limits the steps; with the first motion sound does.
        moving = self.motion_limits(is_still=False)
        name = min(moving, key=lambda key: moving[key])
        limit = format_quantity(moving[name], "s")
        words = f"once condensed matter moves, steps are limited to {limit} ({name})"
        step = self.case.time.fixed_step
        if step is not None and step > moving[name]:
            words += f", less than the fixed one of {format_quantity(step, 's')}"
        return [words]

    def summary(self) -> dict[str, Any]:
        """Estimates beside the numbers of the run."""
        return {**super().summary(), "estimates": ablation_estimates(self.case)}
