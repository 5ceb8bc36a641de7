"""`Recipe`: what a run, a forecast and `--quick` need of a solver beside its steps.

A recipe builds the solver of one case, shows its state to observers and says what its steps will
cost. All that depends on the kind of a solver, and is not in its folder, is in its recipe.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import ceil, floor, log10
from typing import Any, ClassVar, Generic, NamedTuple, TypeVar, cast

from lasersph.analytic.melt_depth import MeltEstimate
from lasersph.case import Case
from lasersph.compute.backend import Backend
from lasersph.input import format_quantity
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.observers import Observers
from lasersph.observers.pulses import Pulses
from lasersph.observers.view import View, of_whole
from lasersph.particles.layers import Layers
from lasersph.simulation.heating import estimate_with_vapor
from lasersph.simulation.layers import caloric_curve, expected_melt, lay_out
from lasersph.simulation.scales import heat_scales
from lasersph.simulation.spot_edges import halves_spot, mirror_images
from lasersph.solvers.solver_settings import SolverSettings
from lasersph.solvers.step_control import Solver, name_of_longest

SettingsT = TypeVar("SettingsT", bound=SolverSettings)
SolverT = TypeVar("SolverT", bound=Solver)

FEWEST_ROWS = 2
"""Rows of a boundary layer below which it is not resolved. Forecast: `run` asks for --anyway."""


SECONDS_PER_STEP = 3e-3
"""Besides the products [s]: calls of loops, observers, files. Forecast:
`benchmarks/small_steps.py`."""


class StepCost(NamedTuple):
    """Cost of a step on one thread.

    Attributes:
        products: of a matrix of all pairs with a vector. seconds: besides, by the host [s].
    """

    products: float
    seconds: float = SECONDS_PER_STEP


@dataclass(frozen=True)
class RunStage:
    """A span of a run in which all steps cost alike.

    Attributes:
        name: for a reader. end: simulated time at which it ends [s]. steps: expected number.
        cost: of a step.
    """

    name: str
    end: float
    steps: int
    cost: StepCost


@dataclass(frozen=True)
class StepForecast:
    """Named limits of the steps of a run [s], the smallest ones, and its stages in their order."""

    limits: dict[str, float]
    stages: tuple[RunStage, ...]

    @property
    def steps(self) -> int:
        """Expected number of all steps."""
        return sum(stage.steps for stage in self.stages)


@dataclass(frozen=True)
class FlowForecast:
    """Expected speed [m/s], thickness of the layer that moves [m] (None in boxes without one), time
    over which something flows [s], limits [s] and warnings; numbers and boundary layers [m] of a
    pool, by name; sentences of the layers that the spacing does not resolve."""

    speed: float
    layer: float | None
    duration: float
    limits: dict[str, float]
    warnings: tuple[str, ...]
    numbers: dict[str, float] = field(default_factory=dict)
    layers: dict[str, float] = field(default_factory=dict)
    unresolved: tuple[str, ...] = ()


def resolving_spacing(layer: float, rows: float) -> str:
    """Spacing that puts at least so many rows into a layer [m], as text of two digits."""
    spacing = layer / rows
    # rounded down, so that the rows fit
    digit = 10.0 ** (floor(log10(spacing)) - 1)
    return format_quantity(digit * floor(spacing / digit), "m", 2)


class Recipe(ABC, Generic[SettingsT, SolverT]):
    """One solver for one case.

    Attributes:
        case, settings: of the run; the settings are those of the solver's own type.
    """

    settings_type: ClassVar[type[SolverSettings]]

    def __init__(self, case: Case) -> None:
        """Raises TypeError where the case has another solver."""
        if not isinstance(case.solver, self.settings_type):
            raise TypeError(f'{case.name} has the solver "{case.solver.kind}"')
        self.case, self.settings = case, cast(SettingsT, case.solver)

    @cached_property
    def layers(self) -> Layers:
        """Layers of the particles."""
        return lay_out(self.case, lambda: self.melt)

    @cached_property
    def melt(self) -> MeltEstimate | None:
        """Expected melt under the light; None without light or melting."""
        return expected_melt(self.case)

    @cached_property
    def heating(self) -> MeltEstimate | None:
        """How hot the light makes the surface, and what evaporates; None without light, and where a
        spot moves along the surface."""
        return estimate_with_vapor(self.case, self.melt)

    @property
    def periodic(self) -> tuple[bool, bool]:
        """Whether x and y repeat beyond their ends."""
        kinds = (self.case.boundaries.kind_of(side) for side in ("left", "front"))
        x, y = (kind == "periodic" for kind in kinds)
        return x, y

    @cached_property
    def mirror_images(self) -> int:
        """How many times the computed part makes up the whole."""
        return mirror_images(self.case)

    @property
    def flow(self) -> FlowForecast | None:
        """Forecast of a flow; None where nothing flows."""
        return None

    @cached_property
    def curve(self) -> CaloricCurve:
        """Enthalpy curve of the material."""
        return caloric_curve(self.case)

    @abstractmethod
    def build(self, backend: Backend) -> SolverT:
        """The solver with its particles, at the start of the run."""

    def view(self, solver: SolverT, step: int, limit: str) -> View:
        """The state for observers, with amounts of the whole; the solver stays as it is."""
        return of_whole(self.computed_view(solver, step, limit), self.mirror_images)

    @abstractmethod
    def computed_view(self, solver: SolverT, step: int, limit: str) -> View:
        """The state for observers, with amounts of the part that is computed."""

    @abstractmethod
    def observers(self, iterations: Sequence[str]) -> Observers:
        """Observers of a run; `iterations` are the names of what the solver counts."""

    def pulse_observer(self) -> Pulses | None:
        """Observer of the pulses of a train; None of a single one or without light."""
        pulse = None if self.case.laser is None else self.case.laser.pulse
        if pulse is None or pulse.count == 1 or pulse.interval is None:
            return None
        # Pulses that begin after the end of the case are not observed.
        starts = (number * pulse.interval for number in range(pulse.count))
        begun = tuple(start for start in starts if start < self.case.time.end)
        return Pulses(pulse.count, pulse.interval, begun)

    @abstractmethod
    def step_forecast(self) -> StepForecast:
        """Limits, number and cost of the steps."""

    def warnings(self) -> list[str]:
        """Warnings for a user before the run."""
        return []

    def dimensionless(self) -> dict[str, dict[str, float]]:
        """Scales and dimensionless numbers of the summary."""
        return heat_scales(self.case)

    def amounts(self) -> dict[str, int]:
        """Entries of the summary that say what volumes and energies cover."""
        return {
            "dimensions": self.case.solver.dimensions,
            "amount_dimensions": self.case.geometry.amount_dimension,
            "mirror_images": self.mirror_images,
        }

    def summary(self) -> dict[str, Any]:
        """Further sections of the summary: the fluence of a pulse where it is computed."""
        laser = self.case.laser
        if laser is None:
            return {}
        fluences = {"mean": laser.mean_fluence, "peak": laser.peak_fluence}
        return {"laser": {f"{name}_fluence_J_m2": value for name, value in fluences.items()}}

    def fixed_steps(self, name: str, cost: StepCost) -> StepForecast | None:
        """The forecast of a study with a fixed step; None elsewhere."""
        step = self.case.time.fixed_step
        return None if step is None else self.even_steps({"fixed step": step}, name, cost)

    def even_steps(self, limits: dict[str, float], name: str, cost: StepCost) -> StepForecast:
        """The forecast of a run whose steps are all alike, from its limits [s]."""
        end = self.case.time.end
        steps = ceil(end / min(limits.values()))
        return StepForecast(limits, (RunStage(name, end, steps, cost),))

    def longest_step(self) -> dict[str, float]:
        """The limit that the case sets, by its name [s]; empty where it sets none."""
        step = self.case.time.step
        return {} if step is None else {name_of_longest(self.case.laser is not None): step}

    def common_view(self, solver: SolverT, step: int, limit: str) -> dict[str, Any]:
        """Entries of `View` of every run: times, energies, symmetry, the limit of the step."""
        state = solver.state
        return {
            "time": state.time,
            "step": step,
            "time_step": state.time_step,
            "symmetry_factor": self.case.symmetry_factor,
            "halves_spot": halves_spot(self.case),
            "energy": dict(state.energy),
            "iterations": solver.iterations,
            "limit": limit,
        }
