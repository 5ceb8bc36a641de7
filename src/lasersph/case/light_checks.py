"""Checks of cases with light: optics of the metal, beam and domain, trains of pulses."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from lasersph.boundaries.settings import DIRICHLET
from lasersph.case.solver_choice import computes_flow
from lasersph.input import format_quantity
from lasersph.lasers import InterferenceBeam, Laser
from lasersph.materials import NoOptics
from lasersph.solvers.solver_settings import SolverSettings

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents


def light_problems(case: CaseContents) -> Iterator[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of all that concerns light and its beam."""
    laser = case.laser
    if laser is None:
        return
    surface = case.boundaries.surface
    # A face cannot be held at a temperature and be lit.
    if surface in DIRICHLET or surface == "periodic":
        what = "holds its temperature" if surface in DIRICHLET else "has none"
        yield (
            "boundaries.surface",
            f'a laser heats the surface, "{surface}" {what}; remove one of the two',
        )
    # Optics may lack the wavelength, the absorption or the reflectivity of this metal.
    found: dict[str, str] = {}
    for key, ask in (
        ("laser.absorption.absorption_coefficient", laser.absorption_coefficient),
        ("laser.reflectivity", partial(laser.reflectivity_table, lower=1.0, upper=1e4)),
    ):
        try:
            ask(case.material)
        except NoOptics as error:
            found["laser.wavelength"] = str(error)
        except ValueError as error:
            found[key] = str(error)
    yield from found.items()
    yield from _beam(case, laser)


def _beam(case: CaseContents, laser: Laser) -> Iterator[tuple[str, str]]:
    """Whether beam, domain and symmetry fit together."""
    dimensions, domain = case.solver.dimensions, case.domain

    # A column sees one fluence.
    if dimensions == 1 and not laser.beam.is_uniform:
        yield (
            "laser.beam.kind",
            f'a "{laser.beam.kind}" beam varies along the surface, which a 1-D run does not have; '
            "write dimensions = 2 in [solver], or a uniform beam",
        )
        return
    holds_spot = laser.spot is not None and laser.spot.extent == "whole"
    if dimensions == 1 and holds_spot:
        yield "laser.spot.extent", 'a 1-D run cannot hold a spot; write extent = "cell"'
        return

    # A half or quarter needs light that is even about its planes.
    for axis, name in zip((0, 1), "xy"[: len(domain.planes_of_symmetry)], strict=False):
        even = laser.first_pulse.is_even if dimensions == 2 else laser.first_pulse.is_mirrored(axis)
        if not even:
            yield (
                "domain.extent",
                f'this beam is not symmetric about {name} = 0; write extent = "full"'
                + (' or "half"' if axis else ""),
            )
    yield from _position(laser, dimensions)
    if not isinstance(laser.beam, InterferenceBeam):
        return

    # A section shows only what is the same at all y.
    if dimensions == 2 and laser.beam.varies_along_y:
        yield _pattern_across(laser.beam, case.solver)
    if holds_spot:
        return

    # A shifted pattern has no planes of symmetry at the old sides.
    is_moved_off = bool(laser.beam.pulse_shift) and not laser.is_even
    if is_moved_off and case.boundaries.kind_of("left") == "adiabatic":
        yield (
            "laser.beam.shift",
            "takes the pattern away from the planes of symmetry at the sides; shift by half a "
            'period, or write sides = "periodic" in [boundaries] and extent = "full" in [domain]',
        )

    # Between sides that mirror or repeat, the pattern must repeat as well.
    repeating = ("adiabatic", "periodic")
    ends = {case.boundaries.kind_of("left"), case.boundaries.kind_of("right")}
    if ends & set(repeating):
        yield from _whole_periods("width", domain.width, laser.beam.lateral_period)
    across = {case.boundaries.kind_of("front"), case.boundaries.kind_of("back")}
    if dimensions == 3 and across & set(repeating):
        yield from _whole_periods(
            "breadth", domain.breadth or domain.width, laser.beam.lateral_period_y
        )


def _position(laser: Laser, dimensions: int) -> Iterator[tuple[str, str]]:
    """Light that is the same wherever its axis lies."""
    x, y = laser.position
    if laser.is_bounded or (x, y) == (0.0, 0.0):
        return
    if laser.beam.is_uniform:
        right = "leave it out" if laser.spot is None else "write spot.place instead"
        yield "laser.position", f"says nothing of light that is the same everywhere; {right}"
    elif dimensions == 2 and y != 0.0:
        yield (
            "laser.position",
            "its y says nothing where the light is the same at all y; write "
            f'position = ["{format_quantity(x, "m")}", "0 m"]',
        )


def _pattern_across(beam: InterferenceBeam, solver: SolverSettings) -> tuple[str, str]:
    """The refusal of a pattern that no plane section shows."""
    # The refusal names what would make the pattern one along x.
    key, right = "beams", "beams = 2"
    if beam.waves:
        key, right = "waves", "waves whose azimuths are all 0 or 180 deg"
    period = beam.lateral_period_y
    every = "" if period is None else f", every {format_quantity(period, 'm', 4)}"
    solid = ' with solver.kind = "conduction"' if computes_flow(solver) else ""
    return (
        f"laser.beam.{key}",
        f"the pattern varies along y{every}, but a 2-D run is a section with the same light at all "
        f"y; write {right}, or solver.dimensions = 3{solid}",
    )


def _whole_periods(
    key: str, length: float | None, period: float | None
) -> Iterator[tuple[str, str]]:
    """Patterns must fill a periodic or mirrored domain a whole number of times."""
    if length is None or period is None:
        return
    # Nearest whole number of periods, one at least.
    count = max(1, round(length / period))
    if not math.isclose(length, count * period, rel_tol=1e-6):
        yield (
            f"domain.{key}",
            f"{format_quantity(length, 'm')} is no whole number of the pattern's periods of "
            f"{format_quantity(period, 'm', 7)}; write "
            f'{key} = "{format_quantity(count * period, "m", 10)}"',
        )


def pulse_problems(case: CaseContents) -> Iterator[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of all that concerns several pulses."""
    has_pool = computes_flow(case.solver) and case.flow is None

    # A pause needs several pulses, and a pool whose heat can be spread or removed.
    if case.time.pause is not None:
        if case.laser is None or case.laser.pulse.count == 1:
            yield "time.pause", "says nothing with one pulse; leave it out, or give more pulses"
            return
        if case.pause != "compute" and not has_pool:
            yield (
                "time.pause",
                f'"{case.pause}" jumps over pauses of melt pools only; leave it out, or write '
                'kind = "melt-pool" in [solver]',
            )
            return
    if case.laser is None or case.pause == "compute":
        return

    # Jumping over a pause needs one: the light of a pulse ends before the next begins.
    pulse = case.laser.pulse
    if pulse.interval is not None and pulse.interval <= pulse.window[1]:
        yield (
            "laser.pulse." + ("period" if pulse.period else "repetition_rate"),
            f"the light of a pulse ends {format_quantity(pulse.window[1], 's', 4)} after its "
            f"start, a period of {format_quantity(pulse.interval, 's')} leaves no pause; write "
            'pause = "compute" in [time], or give a longer period',
        )
    elif case.end_of_pulse <= pulse.window[1]:
        start = case.time.end - case.end_of_pulse
        right = start + max(case.time.end, 2.0 * pulse.window[1])
        yield (
            "time.end",
            f"pulse {pulse.count} begins at {format_quantity(start, 's')} and is not over then; "
            f'write e.g. end = "{format_quantity(right, "s", 10)}"',
        )
