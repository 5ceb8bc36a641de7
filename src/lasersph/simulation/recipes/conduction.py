"""The recipe of heat and melting in particles at rest, on which that of melt pools builds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.lasers import Laser
from lasersph.lasers.pulses import PulseTrain
from lasersph.observers import Observers, heat_observers
from lasersph.observers.electron_view import ElectronView
from lasersph.observers.view import View
from lasersph.particles.filling import Filling
from lasersph.simulation.hot_electrons import optics_of_hot_electrons
from lasersph.simulation.recipes.recipe import Recipe, RunStage, SolverT, StepCost, StepForecast
from lasersph.solvers.conduction.body import assemble
from lasersph.solvers.conduction.electron_body import with_electrons
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.conduction.solver import Conduction, next_light
from lasersph.solvers.conduction.two_temperatures import LIGHT_SHARE, TwoTemperatures
from lasersph.solvers.heat_settings import HeatSettings
from lasersph.solvers.step_control import name_of_longest

HeatT = TypeVar("HeatT", bound=HeatSettings)

PRODUCTS = {"implicit": 4.0, "implicit in space": 2.0, "explicit": 2.0, "two": 150.0}
"""Cost of a step of heat, in sums over all pairs: iterations of Newton and of conjugate gradients,
the two stages, or six linear solves of two temperatures. Forecast: `dlip-steel` and
`dlip-aluminium` take 3 to 5 by `benchmarks/forecasts.py`, with one and two threads; 20 a solve of
two; in space as `dots-steel` and the steps of `texture-dots-steel` in which nothing flows."""
RELAXING = 0.05
"""Step of two temperatures after the light, over the time since it. Forecast: `short-pulse-gold`
takes 0.02 to 0.2."""
EXACT_LIMIT = {1: 0.846, 2: 0.80, 3: 0.741}
"""Stable dt D / dx^2 of forward Euler and midpoint at h = 1.5 dx. Forecast: largest eigenvalues of
the discrete Laplacian; the one of 2-D is interpolated."""
SPAN = 50
"""Most steps of a stage. Forecast: within it steps are taken as equally long."""
LARGEST_STEPS = 10_000_000
"""Steps that are counted one by one. Forecast: more are told as "more than"."""


class HeatRecipe(Recipe[HeatT, SolverT]):
    """Recipe of runs whose heat is conducted between particles of a body."""

    def build_heat(
        self, backend: Backend, settings: ConductionSettings, *, recedes: bool = False
    ) -> Conduction:
        """The solver of heat; `recedes`: whether the metal follows what has evaporated."""
        case = self.case
        body = assemble(
            backend,
            lattice=case.particles,
            layers=self.layers,
            boundaries=case.boundaries,
            material=case.material,
            laser=self.light,
            curve=self.curve,
            use_second_moment=settings.weights == "second-moment",
            hot=optics_of_hot_electrons(case),
        )
        pressure = case.boundaries.pressure_of_surroundings if settings.has_vapor_flux else 0.0
        others = settings, case.time, case.laser, pressure
        named = {"recedes": recedes, "end_of_pulse": case.end_of_pulse}
        if settings.has_two_temperatures:
            return TwoTemperatures(with_electrons(body), *others, **named)
        return Conduction(body, *others, **named)  # pyright: ignore[reportArgumentType]

    @property
    def light(self) -> Laser | None:
        """The laser, whose light hot electrons carry deeper than it reaches."""
        laser, material = self.case.laser, self.case.material
        if laser is None or not self.settings.has_two_temperatures or not material.electrons:
            return laser
        return laser.carried_by(material, material.electrons.ballistic_range or 0.0)

    def heat_view(
        self, solver: Any, step: int, limit: str, fetch: Callable[[Array], np.ndarray]
    ) -> dict[str, Any]:
        """Fields of `View` for a body at rest; `fetch` gets an array of the solver."""
        body = solver.body
        particles = solver.particles
        count = solver.body.count
        shown = body.backend.shown
        return self.common_view(solver, step, limit) | {
            "position": shown(body.filling.position[:, :count]),
            "width": shown(body.filling.width[:, :count]),
            "volume": shown(body.filling.body_volume),
            "mass": body.backend.host_view(particles["mass"]),
            "latent_heats": body.curve.latent_heats,
            "temperature": fetch(particles["temperature"]),
            "enthalpy": fetch(particles["enthalpy"]),
            "melt_fraction": fetch(particles["melt_fraction"]),
            "vapor_fraction": fetch(particles["vapor_fraction"]),
            "surface": body.filling.surface,
            "solidus": body.curve.solidus,
            "liquidus": body.curve.liquidus,
            "vaporization": body.curve.vaporization,
            "critical": self.critical_temperature,
            "electrons": self.electrons(particles, fetch),
        }

    def electrons(
        self, particles: Any, fetch: Callable[[Array], np.ndarray]
    ) -> ElectronView | None:
        """Electrons of `View`; None in a run with one temperature."""
        if not self.settings.has_two_temperatures:
            return None
        T, energy = (fetch(particles[f"electron_{name}"]) for name in ("temperature", "energy"))
        return ElectronView(T, energy)

    @property
    def critical_temperature(self) -> float | None:
        """That a surface which evaporates must not reach [K]; None where a plateau holds it."""
        vapor = self.case.material.vaporization
        return vapor.critical_temperature if vapor and self.settings.has_vapor_flux else None

    @cached_property
    def density(self) -> float:
        """Density that fixed particles keep [kg/m^3]."""
        return self.case.material.density_reference

    def evaporated(self, solver: Any) -> dict[str, Any]:
        """Fields of `View` of what has evaporated: thickness of each column [m], and its share of
        the surface; empty where it is not followed."""
        if not self.settings.evaporates:
            return {}
        filling = solver.body.filling
        columns = filling.surface
        mass = solver.backend.host_view(solver.particles["evaporated_mass"])[columns]
        return {
            "evaporated": mass / self.density,
            "column_share": shares_of_surface(filling),
        }

    def observers(self, iterations: Sequence[str]) -> Observers:
        """Observers of every run with heat and melting."""
        return heat_observers(
            self.settings.dimensions,
            amount_dimension=self.case.geometry.amount_dimension,
            periodic=self.periodic,
            has_electrons=self.settings.has_two_temperatures,
            pulses=self.pulse_observer(),
            probes=self.case.probes,
            iterations=iterations,
        )

    def lit_stages(
        self, pulse: PulseTrain, longest: float, shortest: float
    ) -> tuple[RunStage, ...]:
        """Stages of a run with light and implicit steps, by walking along its steps.

        Args:
            longest: step while the light is on [s]. shortest: while something flows [s].
        """
        time, melt = self.case.time, self.melt
        cooling = RELAXING if self.settings.has_two_temperatures else time.cooling
        end = self.case.end_of_pulse
        molten = (melt.start, melt.end) if melt is not None and self.flow else (np.nan, np.nan)
        found: list[tuple[str, float, int]] = []
        count = 0
        now = 0.0
        lit_until = 0.0
        while now < end and count < LARGEST_STEPS:
            # A step goes to the next change of the light; after it steps grow with the time of
            # cooling.
            step = next_light(pulse, now, longest)
            if lit_until > 0.0:
                step = min(step, max(longest, cooling * (now - lit_until)))
            is_lit = pulse.active(now, now + step)
            if is_lit:
                lit_until = now + step
            # Name of the stage: the pool flows while metal is expected to be molten.
            name = "light" if is_lit else "cooling" if lit_until > 0.0 else "before the light"
            if molten[0] <= now < molten[1]:
                name, step = "flow", min(step, shortest)
            now += step
            count += 1
            # Steps of one name are counted together, up to `SPAN` of them.
            if found and found[-1][0] == name and found[-1][2] < SPAN:
                found[-1] = (name, now, found[-1][2] + 1)
            else:
                found.append((name, now, 1))
        return tuple(RunStage(name, end, steps, self.cost_of(name)) for name, end, steps in found)

    def cost_of(self, _stage: str) -> StepCost:
        """Cost of a step."""
        if self.settings.has_two_temperatures:
            return StepCost(PRODUCTS["two"])
        if self.settings.is_explicit:
            return StepCost(PRODUCTS["explicit"])
        return StepCost(PRODUCTS["implicit in space" if self.is_in_space else "implicit"])

    @property
    def is_in_space(self) -> bool:
        """Whether the run has three dimensions."""
        return self.settings.dimensions == 3

    def implicit_forecast(self, flow_limits: dict[str, float]) -> StepForecast:
        """Steps of a body whose heat is implicit; a pool may flow from the first light on."""
        time, laser = self.case.time, self.case.laser
        limits = {"end": self.case.end_of_pulse} | flow_limits

        # Without light a thousandth of the run, else half of what resolves the pulse.
        longest = time.step or (1e-3 * time.end if laser is None else 0.5 * laser.pulse.resolution)
        if laser is not None and self.settings.has_two_temperatures:
            longest = time.step or LIGHT_SHARE * 100.0 * laser.pulse.resolution
        limits[name_of_longest(laser is not None)] = longest
        shortest = min(limits.values())

        # With light: the walk of one pulse, repeated where pauses are jumped over.
        if laser is not None:
            if self.case.pause == "compute":
                return StepForecast(limits, self.lit_stages(laser.pulse, longest, shortest))
            one = self.lit_stages(laser.first_pulse.pulse, longest, shortest)
            starts = (number * (laser.pulse.interval or 0.0) for number in range(laser.pulse.count))
            return StepForecast(
                limits,
                tuple(replace(stage, end=start + stage.end) for start in starts for stage in one),
            )

        # Without light: what flows does so from the start, then heat alone remains.
        duration = min(self.flow.duration, time.end) if self.flow is not None else 0.0
        resting = RunStage(
            "conduction",
            time.end,
            int(np.ceil((time.end - duration) / longest)),
            self.cost_of("conduction"),
        )
        if duration == 0.0:
            return StepForecast(limits, (resting,))
        flowing = int(np.ceil(duration / shortest))
        first = RunStage("flow", duration, flowing, self.cost_of("flow"))
        return StepForecast(limits, (first, resting))


def shares_of_surface(filling: Filling) -> np.ndarray:
    """Share of the surface that each of its particles covers, (columns,); their sum is 1."""
    area = filling.cross_section[filling.surface]
    return area / np.sum(area)


class ConductionRecipe(HeatRecipe[ConductionSettings, Conduction]):
    """Heat and melting, implicit or explicit."""

    settings_type = ConductionSettings

    def build(self, backend: Backend) -> Conduction:
        """The solver with its particles, at the start of the run."""
        return self.build_heat(backend, self.settings, recedes=self.settings.has_vapor_flux)

    def computed_view(self, solver: Conduction, step: int, limit: str) -> View:
        """The state for observers."""
        fields = self.heat_view(solver, step, limit, solver.backend.host_view)
        return View(**fields, **self.evaporated(solver))

    def step_forecast(self) -> StepForecast:
        """Limits, number and cost of the steps."""
        cost = self.cost_of("conduction")
        if fixed := self.fixed_steps("conduction", cost):
            return fixed
        if not self.settings.is_explicit:
            return self.implicit_forecast({})
        # Explicit steps: dt <= C dx^2 / D, with the steepest D = (dPhi/dh)/rho of the curve.
        steepest = float(np.max(np.diff(self.curve.potential) / np.diff(self.curve.enthalpy)))
        diffusivity = steepest / self.case.material.density_reference
        stable = EXACT_LIMIT[self.settings.dimensions] * self.layers.spacing**2 / diffusivity
        limits = {"end": self.case.time.end, "conduction": stable} | self.longest_step()
        return self.even_steps(limits, "conduction", cost)
