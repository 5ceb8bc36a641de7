"""What a run whose matter moves will cost: limits of its steps and their number.

Matter that light falls on while it rests is limited by heat alone, as long as it rests.
"""

from __future__ import annotations

from math import ceil

from lasersph.case import Case
from lasersph.physics.compressible_limits import compressible_limits
from lasersph.simulation.build_ablation import decay_rates
from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.conduction.body import SUPPORT
from lasersph.solvers.step_control import name_of_longest


def ablation_steps(case: Case, spacing: float) -> tuple[dict[str, float], int]:
    """Limits [s] at the start, and the number of steps that they lead to."""
    time = case.time
    if time.is_fixed and time.step is not None:
        return {"fixed step": time.step}, ceil(time.end / time.step)
    limits = {"end": time.end} | flow_limits_of(case, spacing, is_still=rests(case))
    if time.step is not None:
        limits[name_of_longest(case.laser is not None)] = time.step
    return limits, ceil(time.end / min(limits.values()))


def rests(case: Case) -> bool:
    """Whether nothing moves at the start and nothing pushes."""
    settings = case.solver
    assert isinstance(settings, AblationSettings)
    kind = "rest" if case.motion is None else case.motion.kind
    return kind == "rest" and settings.gravity == 0.0


def flow_limits_of(case: Case, spacing: float, *, is_still: bool) -> dict[str, float]:
    """Limits [s] of sound, viscosity, gravity and heat."""
    settings = case.solver
    assert isinstance(settings, AblationSettings)
    ratio = case.particles.support_ratio or SUPPORT[case.particles.kernel]
    viscous, diffusive = decay_rates(case, spacing)
    return compressible_limits(
        is_still=is_still,
        courant=settings.courant_number,
        smoothing=0.5 * ratio * spacing,
        sound_speed=settings.sound_speed,
        closing_speed=0.0,
        acceleration=settings.gravity,
        viscous_rate=viscous,
        diffusive_rate=diffusive,
    )


def ablation_warnings(case: Case, spacing: float) -> list[str]:
    """What a user of such a case should know of its steps."""
    if not rests(case):
        return []
    moving = flow_limits_of(case, spacing, is_still=False)
    name = min(moving, key=lambda key: moving[key])
    words = f"once condensed matter moves, steps are limited to {moving[name]:.3g} s ({name})"
    step = case.time.step
    if case.time.is_fixed and step is not None and step > moving[name]:
        words += f", less than the fixed one of {step:.3g} s"
    return [words]
