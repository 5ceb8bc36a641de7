"""What a case will cost, before anything runs: particles, memory, steps, limits, resolution."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi, sqrt

import numpy as np

from lasersph.case import Case
from lasersph.case.active_region import active_share
from lasersph.case.size import BYTES_PER_PARTICLE, bytes_per_neighbor
from lasersph.input import format_quantity
from lasersph.particles.layers import Layers
from lasersph.simulation.ablation_forecast import ablation_steps, ablation_warnings
from lasersph.simulation.build import caloric_curve, lay_out, support_ratio
from lasersph.simulation.flow_forecast import FlowForecast, flow_forecast
from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.conduction.solver import next_light
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.step_control import binding_limit, name_of_longest

PAIRS_PER_SECOND = 2.0e8
"""Of one thread; for the expected time only."""
SECONDS_PER_STEP = 3e-3
"""Besides the products: calls of loops, observers, files."""
PRODUCTS_PER_STEP = {"implicit": 12.0, "explicit": 2.0}
FLOW_PRODUCTS = {"pool": 25.0, "box": 70.0}
"""Of a step in which something flows: a part of the block, or all of a box."""
EXACT_LIMIT = {1: 0.846, 2: 0.80, 3: 0.741}
"""Stable dt D / dx^2 of forward Euler and midpoint at h = 1.5 dx; 2-D interpolated."""


@dataclass(frozen=True)
class Forecast:
    """Numbers of `lasersph check`.

    Attributes:
        particles, layers: counts. pairs: estimate, of what is active. memory: peak [bytes].
        spacing: finest, as used [m]. fine_depth: of the finest layers [m].
        limits: time-step limits [s] while the light is on. binding: name of the smallest.
        steps: estimate. wall_time: rough estimate [s] on `threads` threads.
        absorption_length, penetration: 1/alpha and sqrt(D t_p) [m], None where there is no light.
        warnings: what a user should think about. flow: of what flows, if anything does.
    """

    particles: int
    layers: int
    pairs: float
    memory: float
    spacing: float
    fine_depth: float
    limits: dict[str, float]
    binding: str
    steps: int
    wall_time: float
    absorption_length: float | None
    penetration: float | None
    warnings: tuple[str, ...] = field(default=())
    flow: FlowForecast | None = None


def forecast(case: Case, *, threads: int = 1) -> Forecast:
    """Forecast of a case, without allocating its particles."""
    layers = lay_out(case)
    active = active_share(case, support_ratio(case) * layers.spacing)
    pairs = active * layers.particle_count * _neighbors(case)
    is_moving = isinstance(case.solver, AblationSettings)
    memory = layers.particle_count * BYTES_PER_PARTICLE + pairs * bytes_per_neighbor(case)
    flow = None
    if isinstance(case.solver, MeltPoolSettings):
        flow = flow_forecast(case, layers.spacing, support_ratio(case) * layers.spacing)
    notes = ablation_warnings(case, layers.spacing) if is_moving else []
    limits, steps, moving = _steps(case, layers, flow)
    flowing = FLOW_PRODUCTS["pool" if case.flow is None else "box"]
    products = (steps - moving) * PRODUCTS_PER_STEP[_scheme(case)] + moving * flowing
    length, penetration = _lengths(case)
    spacing = layers.spacing
    is_fine = layers.thickness <= spacing * (1.0 + 1e-9)
    return Forecast(
        particles=layers.particle_count,
        layers=layers.thickness.size,
        pairs=pairs,
        memory=memory,
        spacing=spacing,
        fine_depth=float(layers.thickness[is_fine].sum()),
        limits=limits,
        binding=binding_limit(limits)[0],
        steps=steps,
        wall_time=products * pairs / PAIRS_PER_SECOND / max(1, threads) + steps * SECONDS_PER_STEP,
        absorption_length=length,
        penetration=penetration,
        warnings=(
            *_warnings(case, layers, length, penetration),
            *(flow.warnings if flow else ()),
            *notes,
        ),
        flow=flow,
    )


def _scheme(case: Case) -> str:
    """Key of PRODUCTS_PER_STEP."""
    if isinstance(case.solver, AblationSettings):
        return "explicit"
    return case.solver.scheme if isinstance(case.solver, ConductionSettings) else "implicit"


def _neighbors(case: Case) -> float:
    reach = support_ratio(case)
    return {1: 2.0 * reach, 2: pi * reach**2, 3: 4.0 / 3.0 * pi * reach**3}[case.solver.dimensions]


def _steps(
    case: Case, layers: Layers, flow: FlowForecast | None
) -> tuple[dict[str, float], int, int]:
    """Limits [s] while the light is on and while something flows, and the numbers of all steps and
    of those in which something flows."""
    if isinstance(case.solver, AblationSettings):
        return *ablation_steps(case, layers.spacing), 0
    time = case.time
    if time.is_fixed and time.step is not None:
        steps = int(np.ceil(time.end / time.step))
        return {"fixed step": time.step}, steps, steps if flow is not None else 0
    if case.flow is None or flow is None:
        return _heat_steps(case, layers, flow)
    limits = {"end": time.end} | flow.limits
    if time.step is not None:
        limits[name_of_longest(case.laser is not None)] = time.step
    steps = int(np.ceil(time.end / min(limits.values())))
    return limits, steps, steps


def _heat_steps(
    case: Case, layers: Layers, flow: FlowForecast | None
) -> tuple[dict[str, float], int, int]:
    """As `_steps`, of a block in which a pool may flow from the first light on."""
    time, pulse = case.time, case.laser.pulse if case.laser is not None else None
    limits = {"end": time.end} | (flow.limits if flow is not None else {})
    if _scheme(case) == "explicit":
        curve = caloric_curve(case)
        steepest = float(np.max(np.diff(curve.potential) / np.diff(curve.enthalpy)))
        diffusivity = steepest / case.material.density_reference
        limits["conduction"] = EXACT_LIMIT[case.solver.dimensions] * layers.spacing**2 / diffusivity
        if time.step is not None:
            limits[name_of_longest(pulse is not None)] = time.step
        return limits, int(np.ceil(time.end / min(limits.values()))), 0
    longest = time.step or (0.5 * pulse.resolution if pulse is not None else 1e-3 * time.end)
    limits[name_of_longest(pulse is not None)] = longest
    smallest, duration = min(limits.values()), flow.duration if flow is not None else 0.0
    if pulse is None:
        moving = min(duration, time.end) / smallest
        return limits, int(np.ceil(moving + (time.end - duration) / longest)), int(np.ceil(moving))
    steps, moving, now, lit_until, lit_from = 0, 0, 0.0, 0.0, time.end
    while now < time.end and steps < 10_000_000:
        step = next_light(pulse, now, longest)
        if lit_until > 0.0:
            step = min(step, max(longest, time.cooling * (now - lit_until)))
        if pulse.active(now, now + step):
            lit_from, lit_until = min(lit_from, now), now + step
        if lit_from <= now < lit_from + duration:
            step, moving = min(step, smallest), moving + 1
        now += step
        steps += 1
    return limits, steps, moving


def _lengths(case: Case) -> tuple[float | None, float | None]:
    """Absorption length and thermal penetration of a pulse [m] [Alshaer2017, eq. (34)]."""
    if case.laser is None:
        return None, None
    alpha = case.laser.absorption_coefficient(case.material)
    duration = case.laser.pulse.on_time or 100.0 * case.laser.pulse.resolution
    return 1.0 / alpha, sqrt(case.material.diffusivity_reference * duration)


def _warnings(
    case: Case, layers: Layers, length: float | None, penetration: float | None
) -> list[str]:
    found = []
    spacing = layers.spacing
    if abs(spacing - case.particles.spacing) > 1e-2 * case.particles.spacing:
        found.append(
            f"spacing {format_quantity(case.particles.spacing, 'm')} is rounded to "
            f"{format_quantity(spacing, 'm')} so that whole cells fill the domain"
        )
    if penetration is not None and spacing > penetration / 3.0:
        found.append(
            f"the heat of a pulse reaches {format_quantity(penetration, 'm', 3)}, less than 3 "
            f"spacings of {format_quantity(spacing, 'm', 3)}: take a finer spacing"
        )
    if length and spacing > length:
        found.append(
            f"the light is absorbed within {format_quantity(length, 'm', 3)}, less than one"
            f" spacing of {format_quantity(spacing, 'm', 3)}: its profile is not resolved, though"
            " its energy is exact"
        )
    if penetration is not None and layers.thickness.sum() < 5.0 * penetration:
        found.append("the domain is thinner than 5 penetration depths: the bottom will be felt")
    if case.laser is not None and not case.laser.pulse.delivered(0.0, case.time.end) > 0.0:
        found.append("no light falls before time.end: nothing will be heated")
    changes = case.solver.phase_change and (case.laser is not None or case.material.melting)
    if changes and case.material.vaporization is None:
        found.append(
            f'"{case.material.name}" has no boiling point: its temperature rises without limit; '
            "give temperature and latent_heat in [material.vaporization]"
        )
    if case.time.is_fixed:
        found.append("the time step is fixed: it may be unstable")
    return found
