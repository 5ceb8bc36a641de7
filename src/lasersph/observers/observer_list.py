"""The observers of a run as one: one history row, one summary, one state."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from lasersph.observers.box_flow import BoxFlow
from lasersph.observers.crater import Crater
from lasersph.observers.ejecta import Ejecta
from lasersph.observers.energy_budget import EnergyBudget
from lasersph.observers.flow_cells import FlowCells
from lasersph.observers.flow_extrema import FlowExtrema
from lasersph.observers.flow_speed import FlowSpeed
from lasersph.observers.hot_electrons import HotElectrons
from lasersph.observers.matter_motion import MatterMotion
from lasersph.observers.melt_pool import MeltPool
from lasersph.observers.observer import Observer, Row
from lasersph.observers.pool_count import PoolCount
from lasersph.observers.probes import Probes
from lasersph.observers.pulses import Pulses
from lasersph.observers.steps import Steps
from lasersph.observers.surface_pressure import SurfacePressure
from lasersph.observers.surface_speed import SurfaceSpeed
from lasersph.observers.surface_temperature import SurfaceTemperature
from lasersph.observers.topography import Topography
from lasersph.observers.traces import Traces
from lasersph.observers.vaporization import Vaporization
from lasersph.observers.view import View
from lasersph.observers.wall_exchange import WallExchange
from lasersph.output.settings import Probe, Trace

OBSERVERS: tuple[type[Observer], ...] = (
    Steps,
    Pulses,
    SurfaceTemperature,
    HotElectrons,
    MeltPool,
    PoolCount,
    Vaporization,
    Crater,
    Ejecta,
    Traces,
    MatterMotion,
    FlowSpeed,
    SurfaceSpeed,
    FlowExtrema,
    FlowCells,
    SurfacePressure,
    Topography,
    BoxFlow,
    WallExchange,
    EnergyBudget,
    Probes,
)
"""All that exist, in the order in which a report tells of them."""
COLUMNS = {one.key: one for kind in OBSERVERS for one in kind.columns}
"""Quantity of each column of history.csv."""
RESULTS = {one.key: one for kind in OBSERVERS for one in kind.all_results()}
"""Quantity of each key of summary.json that an observer fills."""


def numerical_sd(summary: Mapping[str, Any]) -> dict[str, float]:
    """Numerical standard deviation of the sizes of a summary that jump by whole cells [m].

    A size counted in cells of spacing dx lies anywhere within its cell, evenly, so its standard
    deviation is dx / sqrt(12) (JCGM 100:2008, 4.3.7); a width jumps at both of its ends at once.
    Interpolation halves it: the computed field follows the lattice as well. Sizes of 0 have none.

    Returns:
        By dotted key of the summary. dx is its finest spacing; deeper layers may be coarser.
    """
    found: dict[str, float] = {}
    # value of each quantity that jumps by cells, where the summary has it
    for key, one in RESULTS.items():
        value: Any = summary
        for name in key.split("."):
            value = value.get(name) if isinstance(value, Mapping) else None
        if one.cells and value:
            found[key] = one.cells * float(summary["spacing_m"]) / math.sqrt(12.0)
    return found


class Observers:
    """Several observers as one."""

    def __init__(self, members: Sequence[Observer]) -> None:
        """Raises ValueError where two observers fill the same column."""
        self.members = tuple(members)
        # two observers of one column would overwrite each other
        if len(set(self.columns)) < len(self.columns):
            raise ValueError("two observers fill the same history column")

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the history columns, in order."""
        return tuple(one.key for member in self.members for one in member.columns)

    def observe(self, view: View) -> Row:
        """The history row of this step."""
        row: Row = {}
        for member in self.members:
            row |= member.observe(view)
        return row

    def summary(self) -> dict[str, Any]:
        """Results of all observers at the end; sections of one name are joined."""
        result: dict[str, Any] = {}
        for member in self.members:
            # a section that two observers fill is one in the summary
            for name, part in member.summary().items():
                joined = isinstance(part, dict) and name in result
                result[name] = {**result[name], **part} if joined else part
        return result

    @property
    def last(self) -> Row:
        """The history row of the last step."""
        return {key: value for member in self.members for key, value in member.last.items()}

    def state(self) -> dict[str, Any]:
        """States by class name, for a checkpoint."""
        return {type(member).__name__: member.state() for member in self.members}

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from the states of a checkpoint."""
        for member in self.members:
            member.restore(state[type(member).__name__])


def heat_observers(
    dimension: int,
    *,
    amount_dimension: int | None = None,
    periodic: tuple[bool, bool] | None = None,
    has_electrons: bool = False,
    pulses: Pulses | None = None,
    probes: Sequence[Probe] = (),
    iterations: Sequence[str] = (),
) -> Observers:
    """Observers of every run with heat and melting.

    Args:
        dimension: 1, 2 or 3. amount_dimension: dimensions that energies cover, 3 of a section
            (r, z); the same where it is not given. periodic: whether x and y repeat in 3-D, where
            pools are counted; None counts none. has_electrons: whether they have a temperature of
            their own.
        pulses: of a train; None of a single one or without light.
        probes: points whose temperature is recorded.
        iterations: names of the solver parts that count iterations.
    """
    return Observers(
        [
            Steps(tuple(iterations)),
            SurfaceTemperature(),
            *((HotElectrons(amount_dimension or dimension),) if has_electrons else ()),
            MeltPool(dimension, is_section=(amount_dimension or dimension) > dimension),
            *((PoolCount(periodic),) if dimension == 3 and periodic is not None else ()),
            Vaporization(),
            EnergyBudget(amount_dimension or dimension),
            Probes(tuple(probes)),
            *(() if pulses is None else (pulses,)),
        ]
    )


def flow_observers(
    dimension: int,
    *,
    amount_dimension: int | None = None,
    periodic: tuple[bool, bool] | None = None,
    has_electrons: bool = False,
    box: bool = False,
    topography: Topography | None = None,
    pulses: Pulses | None = None,
    probes: Sequence[Probe] = (),
    iterations: Sequence[str] = (),
) -> Observers:
    """Observers of every run with flow: those of heat, and of the flow.

    Args:
        dimension, amount_dimension, periodic, has_electrons, pulses, probes, iterations: as of
            `heat_observers`.
        box: a closed box that is all liquid has no melt pool, but center lines and heat through
            its walls.
        topography: of a surface that moves; None where it is flat.
    """
    covered = dimension if amount_dimension is None else amount_dimension
    observed = heat_observers(
        dimension,
        amount_dimension=covered,
        periodic=periodic,
        has_electrons=has_electrons,
        pulses=pulses,
        probes=probes,
        iterations=iterations,
    )
    heat = observed.members
    flow: tuple[Observer, ...] = (FlowSpeed(covered), SurfaceSpeed(dimension), SurfacePressure())
    if topography is not None:
        flow = (*flow, topography)

    # a closed box has no pool and no vapor, but walls and eddies
    if box:
        here = (one for one in heat if not isinstance(one, MeltPool | PoolCount | Vaporization))
        return Observers([*here, *flow, BoxFlow(dimension), WallExchange(dimension)])
    cells = (FlowCells(),) if covered > dimension and topography is None else ()
    return Observers([*heat, *flow, FlowExtrema(), *cells])


def ablation_observers(
    dimension: int,
    *,
    pulses: Pulses | None = None,
    probes: Sequence[Probe] = (),
    traces: Sequence[Trace] = (),
    axis: tuple[float, float] | None = None,
    pulse_starts: Sequence[float] = (),
    iterations: Sequence[str] = (),
) -> Observers:
    """Observers of every run with ablation.

    Args:
        dimension, pulses, probes, iterations: as of `heat_observers`.
        traces: particles that are followed.
        axis: x and y of the beam's axis [m]; without a beam there is neither crater nor ejecta,
            but the motion of the whole.
        pulse_starts: times at which the pulses begin [s].
    """
    heat = heat_observers(dimension, pulses=pulses, probes=probes, iterations=iterations)
    members: list[Observer] = [*heat.members]

    # a beam makes a crater; without light matter moves as a whole
    if axis is not None:
        crater = Crater(dimension, axis=axis, pulse_starts=tuple(pulse_starts))
        members += [crater, Ejecta(dimension)]
    else:
        members.append(MatterMotion(dimension))
    return Observers([*members, Traces(tuple(traces))])
