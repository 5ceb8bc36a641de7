"""`MeltPoolRecipe`: heat and melting, and the flow of the melt or of a closed box of fluid."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from lasersph.boundaries.flow_conditions import FREE
from lasersph.compute.backend import Backend
from lasersph.observers import Observers, flow_observers
from lasersph.observers.area_relief import AreaRelief
from lasersph.observers.even_places import WHOLE
from lasersph.observers.relief import Relief
from lasersph.observers.topography import Topography
from lasersph.observers.view import View
from lasersph.simulation.recipes.conduction import HeatRecipe
from lasersph.simulation.recipes.melt_pool.build import with_flow
from lasersph.simulation.recipes.melt_pool.forecast import (
    flow_forecast,
    flowing_share,
    recession_warning,
)
from lasersph.simulation.recipes.melt_pool.surfaces import surface_line
from lasersph.simulation.recipes.melt_pool.view import flow_view, numbers_of
from lasersph.simulation.recipes.recipe import FlowForecast, StepCost, StepForecast
from lasersph.simulation.scales import box_numbers, melt_numbers
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.heat_settings import HeatSettings
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.melt_pool.solver import MeltPool
from lasersph.surface.height_field import HeightField
from lasersph.surface.moving_surface import MovingSurface

FLOW_COST = {
    "flat in space": StepCost(25.0),
    "moving": StepCost(18.0, 20e-3),
    "moving in space": StepCost(24.6, 46e-3),
    "box": StepCost(25.0, 6e-3),
    "box at rest": StepCost(18.0, 3e-3),
}
"""Cost of a step in which something flows, a part of the block or all of a box. Forecast: as
measured with two threads; below a surface that moves `texture-steel` at 8 and 5 nm, `spot-steel`,
and `texture-dots-steel` at 64 and 48 nm, over the expected number of steps; boxes of particles that
move as shipped, and cubes of 24 to 48 a side; of particles that rest 0.6 of it in a cavity, all of
it in a cube and with natural convection."""
FLAT_MOVING, FLAT_RESTING = (3.0, 13e-6, 6.5e-3), (0.8, 5e-6, 4e-3)
"""Cost of a step below a flat surface, of particles that move or rest: products of all pairs for
heat, seconds for each particle that flows, and seconds besides. Forecast: `benchmarks/forecasts.py`
with `dlip-steel` at 8 and 16 nm and `dlip-aluminium` at 16 nm, one and two threads, 1.13 to 1.5 of
the time taken; at rest, where pairs stay and solves take fewer iterations, `spot-weld` at 6 um on
one thread, 1.04."""


class MeltPoolRecipe(HeatRecipe[MeltPoolSettings, MeltPool]):
    """A pool that melts into a block and flows, or a closed box that is all fluid."""

    settings_type = MeltPoolSettings

    @cached_property
    def flow(self) -> FlowForecast:
        """Forecast of the flow of the pool or of the box."""
        return flow_forecast(
            self.case, self.settings, self.layers.spacing, self.heating or self.melt
        )

    @cached_property
    def liquid_numbers(self) -> dict[str, float]:
        """Numbers of the liquid for observers."""
        return numbers_of(self.case.material)

    def build(self, backend: Backend) -> MeltPool:
        """The solver with its particles, at the start of the run; heat is implicit."""
        # The melt pool's settings of heat are those of conduction with the same names.
        shared = set(HeatSettings.model_fields) - {"kind"}
        settings = ConductionSettings(**{name: getattr(self.settings, name) for name in shared})
        heat = self.build_heat(backend, settings)
        return with_flow(self.case, self.settings, self.layers, heat)

    def computed_view(self, solver: MeltPool, step: int, limit: str) -> View:
        """The state for observers: arrays where they lie, those of a closed box as copies, whose
        observer looks at some states later than the step after which it is shown them."""
        backend = solver.backend
        fetch = backend.host_view if self.case.flow is None else backend.snapshot
        flow = flow_view(self.case, self.liquid_numbers, solver, fetch)
        fields = self.heat_view(solver, step, limit, fetch)
        fields |= {"position": fetch(solver.position), "flow": flow}
        # Where the surface is: of the flow, else the top row of a box.
        if flow.surface.size:
            fields["surface"] = flow.surface
        elif flow.box:
            top = fields["position"][-1] > -solver.domain.spacing
            fields["surface"] = np.flatnonzero(top)
        # A box is all fluid; a moving line adds its heights and the volumes it changes.
        if flow.box:
            fields["melt_fraction"] = np.ones(solver.particle_count)
        if isinstance(surface := solver.domain.surface, MovingSurface):
            fields["relief"] = self._relief(surface.line)
            fields["volume"] = fetch(solver.flow.volume)
        else:
            fields["columns"] = self.flat_columns
        return View(**fields, **self.evaporated(solver))

    def observers(self, iterations: Sequence[str]) -> Observers:
        """Observers of a flow; a box has no pool, but center lines and heat through its walls."""
        return flow_observers(
            self.settings.dimensions,
            amount_dimension=self.case.geometry.amount_dimension,
            periodic=self.periodic,
            has_electrons=self.settings.has_two_temperatures,
            box=self.case.flow is not None,
            topography=self._topography(),
            pulses=self.pulse_observer(),
            probes=self.case.probes,
            iterations=iterations,
        )

    def _topography(self) -> Topography | None:
        """Observer of a surface that moves; its first harmonic where whole half periods fit."""
        if not self.case.surface_moves:
            return None
        faces = self.case.boundaries
        waves = (
            faces.surface_temperature_wave,
            faces.surface_pressure_wave,
            faces.surface_mass_flux_wave,
            self.case.initial_surface,
        )
        # The first wave that anything imposes on the surface.
        wave = next((wave for wave in waves if wave is not None and wave.period), None)
        periods = (None, None) if wave is None else (wave.period, wave.period_y)
        sides = self.case.domain.lateral(self.case.geometry)
        fits = [_holds_halves(*side, period) for side, period in zip(sides, periods, strict=False)]
        return Topography(
            *(period if all(fits) else None for period in periods),
            dimensions=self.settings.dimensions,
            is_section=self.case.geometry.is_axisymmetric,
        )

    @cached_property
    def flat_columns(self) -> AreaRelief | None:
        """Columns of a free surface in 3-D that stays flat; None elsewhere."""
        is_free = self.case.flow is None or self.case.flow.surface.kind in FREE
        if self.settings.dimensions < 3 or self.case.surface_moves or not is_free:
            return None
        found = self._relief(surface_line(self.case, self.layers))
        return found if isinstance(found, AreaRelief) else None

    def _relief(self, line: HeightField) -> Relief | AreaRelief:
        """Heights of a surface that moves, as observers see them."""
        height = line.height.copy()
        if len(line.shape) == 1:
            is_section = self.case.geometry.is_axisymmetric
            return Relief(line.centers(), height, line.ends[0][0], is_section=is_section)
        (x, _), (y, _) = line.ends
        return AreaRelief(line.centers(), line.centers(1), height, (x, y))

    def cost_of(self, stage: str) -> StepCost:
        """Cost of a step."""
        if stage != "flow":
            return super().cost_of(stage)
        if self.case.flow is not None:
            is_resting = self.settings.rests and not self.case.surface_moves
            return FLOW_COST["box at rest" if is_resting else "box"]
        if not self.case.surface_moves and not self.is_in_space:
            share = flowing_share(self.case, self.layers, self.heating or self.melt)
            flowing = share * self.layers.fine_count
            heat, each, besides = FLAT_RESTING if self.settings.rests else FLAT_MOVING
            return StepCost(heat, besides + each * flowing)
        if not self.case.surface_moves:
            return FLOW_COST["flat in space"]
        return FLOW_COST["moving in space" if self.is_in_space else "moving"]

    def step_forecast(self) -> StepForecast:
        """Limits, number and cost of the steps."""
        cost = self.cost_of("flow")
        if fixed := self.fixed_steps("flow", cost):
            return fixed
        if self.case.flow is None:
            return self.implicit_forecast(self.flow.limits)
        limits = {"end": self.case.time.end} | self.flow.limits | self.longest_step()
        return self.even_steps(limits, "flow", cost)

    def warnings(self) -> list[str]:
        """Warnings for a user before the run: recession, resolution of the layer that moves."""
        gone = 0.0 if self.heating is None else self.heating.evaporated
        recession = recession_warning(self.case, self.layers, gone)
        return [*([recession] if recession else []), *self.flow.warnings]

    def dimensionless(self) -> dict[str, dict[str, float]]:
        """Scales and numbers of the pulse and of the melt; of a box those of its walls."""
        if self.case.flow is not None:
            return {"numbers": box_numbers(self.case, self.case.flow, self.settings)}
        found = super().dimensionless()
        if found:
            found["numbers"] |= melt_numbers(self.case, self.settings, found["scales"]["length_m"])
        return found


def _holds_halves(low: float, high: float, period: float | None) -> bool:
    """Whether a side holds whole half periods, as it does where there is none."""
    halves = 1.0 if period is None else 2.0 * (high - low) / period
    return halves > 0.5 and abs(halves - round(halves)) <= WHOLE * halves
