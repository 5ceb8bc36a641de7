"""Checks that need several rooms at once: what is refused, and what is only warned of."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from lasersph.boundaries.settings import DIRICHLET
from lasersph.case.flow_checks import flow_problems
from lasersph.case.motion_checks import motion_problems
from lasersph.case.pulse_checks import pulse_problems
from lasersph.case.size import (
    LARGEST_PARTICLES,
    LARGEST_STEPS,
    Size,
    in_words,
    memories,
    size_of,
)
from lasersph.case.solver_choice import SELECTIVE_KEYS, reader_of
from lasersph.case.surface_checks import surface_problems
from lasersph.input import CaseError, format_quantity
from lasersph.lasers import InterferenceBeam, Laser, UniformBeam
from lasersph.materials import NoOptics
from lasersph.output.settings import SnapshotSchedule

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents

FEWEST_LAYERS = 4
LARGEST_COST_SHARE = 0.9


def problems_of(case: CaseContents) -> list[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of everything that the rooms contradict in."""
    found = list(_domain(case))
    if found:
        return found
    return [
        *_material(case),
        *_laser(case),
        *_unread_keys(case),
        *flow_problems(case),
        *surface_problems(case),
        *pulse_problems(case),
        *motion_problems(case),
        *_size(case),
        *_probes(case),
        *_snapshots(case),
    ]


def refuse_if_too_large(case: CaseContents, backend: str = "cpu", size: Size | None = None) -> None:
    """Refuse a case whose particles do not fit into the memory of this machine, or of its card.

    Args:
        size: what it needs where that is known; else it is estimated, and some room left.

    Raises:
        CaseError: with the size, before anything is allocated.
        NoDevice: the backend is "cuda" and there is no graphics card.
    """
    needed, share = (size_of(case), LARGEST_COST_SHARE) if size is None else (size, 1.0)
    for words, memory in memories(backend):
        if needed.bytes > share * memory:
            raise CaseError(
                f"about {needed} of memory, but {words.format(in_words(memory))}",
                "take a coarser spacing or a smaller domain",
                key="particles.spacing",
            )


def _unread_keys(case: CaseContents) -> Iterator[tuple[str, str]]:
    """What the solver of the case would ignore."""
    for key in sorted(SELECTIVE_KEYS - case.solver.reads):
        if getattr(case, key):
            yield (
                key,
                f'kind = "{case.solver.kind}" does not read it; leave it out, or write kind = '
                f'"{reader_of(key)}" in [solver]',
            )


def _domain(case: CaseContents) -> Iterator[tuple[str, str]]:
    domain, lattice, dimensions = case.domain, case.particles, case.solver.dimensions
    if dimensions > 1 and domain.width is None:
        yield "domain.width", f'missing for {dimensions}-D; write e.g. width = "5 um"'
        return
    if dimensions == 1 and domain.extent == "half":
        yield "domain.extent", 'half of a 1-D column means nothing; write extent = "full"'
    for key, length in (("depth", domain.depth), ("width", domain.width)):
        if key == "width" and dimensions == 1:
            continue
        if length is not None and length < FEWEST_LAYERS * lattice.spacing:
            yield (
                f"domain.{key}",
                f"{format_quantity(length, 'm')} holds fewer than {FEWEST_LAYERS} particles of "
                f"{format_quantity(lattice.spacing, 'm')}; give a larger domain or a finer spacing",
            )
    if lattice.fine_depth is not None and lattice.arrangement == "uniform":
        yield (
            "particles.fine_depth",
            'belongs to graded particles; leave it out or write arrangement = "graded"',
        )
    yield from _faces(case)


def _faces(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Whether the faces fit the domain and its dimensions."""
    boundaries, dimensions = case.boundaries, case.solver.dimensions
    left = boundaries.kind_of("left")
    if case.domain.extent == "half" and left != "adiabatic":
        key = "left" if boundaries.left else "sides"
        yield (
            f"boundaries.{key}",
            f'half a block is symmetric at x = 0, "{left}" does not fit; write '
            f'extent = "full" in [domain] or {key} = "adiabatic"',
        )
    for face in ("left", "right"):
        if dimensions == 1 and getattr(boundaries, face) is not None:
            yield (
                f"boundaries.{face}",
                "a 1-D column has no sides along x; leave it out or write dimensions = 2 in "
                "[solver]",
            )
    if dimensions == 1 and boundaries.surface_temperature_wave is not None:
        yield (
            "boundaries.surface_temperature_wave",
            "varies along x, which a 1-D run does not have; write dimensions = 2 in [solver]",
        )
    if boundaries.surface == "periodic" and case.particles.arrangement == "graded":
        yield (
            "boundaries.surface",
            'graded particles do not repeat in z; write arrangement = "uniform" in [particles]',
        )


def _material(case: CaseContents) -> Iterator[tuple[str, str]]:
    changes = case.solver.phase_change and case.flow is None
    try:
        case.material.caloric_curve(
            case.initial_temperature, case.solver.curve_plateau, phase_change=changes
        )
    except ValueError as error:
        text = str(error)
        is_start = text.startswith("the initial temperature")
        yield "initial_temperature" if is_start else "material", text
    yield from _evaporation(case)
    losses = case.boundaries.surroundings(case.material, case.initial_temperature)
    if case.boundaries.ambient_temperature is not None and not losses["h_c"] and not losses["eps"]:
        yield (
            "boundaries.ambient_temperature",
            "says nothing without convection or emissivity; give one of them or leave it out",
        )


def _evaporation(case: CaseContents) -> Iterator[tuple[str, str]]:
    """What vapor that leaves the surface needs."""
    vapor, has_flux = case.material.vaporization, case.solver.has_vapor_flux
    key, right = ("vaporization", "plateau") if has_flux else ("plateau", "hold")
    if has_flux or (case.solver.evaporates and case.solver.phase_change):
        if vapor is None or vapor.molar_mass is None:
            yield (
                f"solver.{key}",
                f'"{getattr(case.solver, key)}" needs vaporization data with molar_mass, which '
                f'material "{case.material.name}" lacks; write {key} = "{right}"',
            )
        elif has_flux and vapor.critical_temperature is None:
            yield (
                "solver.vaporization",
                '"flux" needs the temperature above which there is no liquid surface; write e.g. '
                'critical_temperature = "9250 K" in vaporization of the material',
            )
    if case.boundaries.ambient_pressure is not None and not has_flux:
        yield (
            "boundaries.ambient_pressure",
            'says nothing but beside vaporization = "flux" in [solver]; leave it out or write that',
        )


def _laser(case: CaseContents) -> Iterator[tuple[str, str]]:
    laser = case.laser
    if laser is None:
        return
    surface = case.boundaries.surface
    if surface in DIRICHLET or surface == "periodic":
        what = "holds its temperature" if surface in DIRICHLET else "has none"
        yield (
            "boundaries.surface",
            f'a laser heats the surface, "{surface}" {what}; remove one of the two',
        )
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
    if dimensions == 1 and not isinstance(laser.beam, UniformBeam):
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
    if domain.extent == "half" and not laser.first_pulse.is_even:
        yield (
            "domain.extent",
            'this beam is not symmetric about x = 0; write extent = "full"',
        )
    if not isinstance(laser.beam, InterferenceBeam) or holds_spot:
        return
    if laser.beam.shift and not laser.is_even and case.boundaries.kind_of("left") == "adiabatic":
        yield (
            "laser.beam.shift",
            "takes the pattern away from the planes of symmetry at the sides; shift by half a "
            'period, or write sides = "periodic" in [boundaries] and extent = "full" in [domain]',
        )
    repeating = ("adiabatic", "periodic")
    ends = {case.boundaries.kind_of("left"), case.boundaries.kind_of("right")}
    if ends & set(repeating):
        yield from _whole_periods("width", domain.width, laser.beam.lateral_period)
    if dimensions == 3 and case.boundaries.sides in repeating:
        yield from _whole_periods(
            "breadth", domain.breadth or domain.width, laser.beam.lateral_period_y
        )


def _whole_periods(
    key: str, length: float | None, period: float | None
) -> Iterator[tuple[str, str]]:
    """Patterns must fill a periodic or mirrored domain a whole number of times."""
    if length is None or period is None:
        return
    count = max(1, round(length / period))
    if not math.isclose(length, count * period, rel_tol=1e-6):
        yield (
            f"domain.{key}",
            f"{format_quantity(length, 'm')} is no whole number of the pattern's periods of "
            f"{format_quantity(period, 'm', 7)}; write "
            f'{key} = "{format_quantity(count * period, "m", 10)}"',
        )


def _size(case: CaseContents) -> Iterator[tuple[str, str]]:
    size = size_of(case)
    if size.particles > LARGEST_PARTICLES:
        yield (
            "particles.spacing",
            f"about {size} of memory, more than lasersph can number; take a coarser spacing or a "
            "smaller domain",
        )
    if case.time.step is not None and case.time.end / case.time.step > LARGEST_STEPS:
        yield (
            "time.step",
            f"{case.time.end / case.time.step:.2g} steps to the end at least, more than "
            f"{LARGEST_STEPS:.0g}; take longer steps or an earlier end",
        )


def _probes(case: CaseContents) -> Iterator[tuple[str, str]]:
    for name, count in Counter(probe.name for probe in case.probes).items():
        if count > 1:
            yield "probes", f'{count} probes are named "{name}"; give each its own name'
    bounds = case.domain.lateral(case.solver.dimensions)
    for index, probe in enumerate(case.probes, start=1):
        if probe.depth > case.domain.depth:
            yield (
                f"probes[{index}].depth",
                f"{format_quantity(probe.depth, 'm')} lies below the domain of "
                f"{format_quantity(case.domain.depth, 'm')}; place the probe inside",
            )
        for axis, (low, high) in zip("xy", bounds, strict=False):
            place = getattr(probe, axis)
            if not low <= place <= high:
                yield (
                    f"probes[{index}].{axis}",
                    f"{format_quantity(place, 'm')} lies outside the domain, which runs from "
                    f"{format_quantity(low, 'm')} to {format_quantity(high, 'm')}; place the probe "
                    "inside",
                )


def _snapshots(case: CaseContents) -> Iterator[tuple[str, str]]:
    if case.end_of_pulse <= 0.0:  # which `pulse_problems` tells
        return
    try:
        SnapshotSchedule(case.output.snapshots, case.end_of_pulse)
    except ValueError as error:
        yield "output.snapshots.interval", str(error)
