"""Checks that need several rooms at once: what is refused, and what is only warned of."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING

from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.case.flow_checks import flow_problems
from lasersph.case.light_checks import light_problems, pulse_problems
from lasersph.case.size import (
    LARGEST_PARTICLES,
    LARGEST_STEPS,
    Size,
    in_words,
    memories,
    size_of,
)
from lasersph.case.solver_choice import (
    SELECTIVE_KEYS,
    has_two_temperatures,
    moves_matter,
    no_axis,
    reader_of,
)
from lasersph.case.surface_checks import key_of_drive, surface_problems
from lasersph.input import CaseError, Model, format_quantity
from lasersph.output.settings import SnapshotSchedule

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents

FEWEST_LAYERS = 4
LARGEST_COST_SHARE = 0.9
USUAL_WIDTH = 5e-6
"""Width that a message names where the light has no period [m]. Display: that of the examples."""
IMPLICIT_STEPS = ("temperature_change", "cooling", "growth")
IMPLICIT_SOLUTION = ("tolerance", "iteration")
"""Keys of [time] and [solver] that implicit steps alone read."""
TWO_TEMPERATURES = ("step_error", "equal_within")
"""Keys of [solver] that two temperatures alone read."""
GRADED = ("fine_depth", "fine_width", "coarsest", "ratio")
"""Keys of [particles] that graded ones alone read."""


def problems_of(case: CaseContents) -> list[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of everything that the rooms contradict in."""
    # Without a block there is nothing that the other checks could be about.
    found = list(_domain(case))
    if found:
        return found
    return [
        *_material(case),
        *_geometry(case),
        *light_problems(case),
        *_electrons(case),
        *_unread_keys(case),
        *_idle_keys(case),
        *_points(case),
        *flow_problems(case),
        *surface_problems(case),
        *pulse_problems(case),
        *_motion(case),
        *_size(case),
        *_snapshots(case),
    ]


def _geometry(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Problems of a section (r, z); none of a planar block."""
    if case.geometry.is_axisymmetric:
        from lasersph.case.geometry_checks import section_problems  # planar blocks read less

        yield from section_problems(case)


def _electrons(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Problems of two temperatures; with one, keys that belong to two."""
    if has_two_temperatures(case.solver):
        from lasersph.case.electron_checks import electron_problems  # most cases have one

        yield from electron_problems(case)
        return
    why = 'belongs to heat = "two-temperature"; leave it out or write that'
    yield from ((f"solver.{key}", why) for key in _changed(case.solver, TWO_TEMPERATURES))


def _motion(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Problems of matter that moves; none of a body at rest or a pool."""
    if moves_matter(case.solver):
        from lasersph.case.motion_checks import motion_problems  # other solvers read less

        yield from motion_problems(case)


def refuse_if_too_large(case: CaseContents, backend: str = "cpu", size: Size | None = None) -> None:
    """Refuse a case whose particles do not fit into the memory of this machine, or of its card.

    Args:
        size: particles and bytes where they are known; else estimated, with some reserve.

    Raises:
        CaseError: with the size, before anything is allocated.
        NoDevice: the backend is "cuda" and there is no graphics card.
    """
    # An estimate may be off by a tenth; an exact size may take all of the memory.
    needed, share = (size_of(case), LARGEST_COST_SHARE) if size is None else (size, 1.0)
    for words, memory in memories(backend):
        if needed.bytes > share * memory:
            raise CaseError(
                f"about {needed} of memory, but {words.format(in_words(memory))}",
                "take a coarser spacing or a smaller domain",
                key="particles.spacing",
            )


def _unread_keys(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Keys that the solver of the case would ignore."""
    for key in sorted(SELECTIVE_KEYS - case.solver.reads):
        if getattr(case, key):
            yield (
                key,
                f'kind = "{case.solver.kind}" does not read it; leave it out, or write kind = '
                f'"{reader_of(key)}" in [solver]',
            )


def _idle_keys(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Keys whose values would change nothing, where they are not the default."""
    # Explicit steps follow from stability, not from accuracy.
    if case.solver.is_explicit:
        why = "says nothing where steps are explicit, as stability limits them; leave it out"
        yield from ((f"time.{key}", why) for key in _changed(case.time, IMPLICIT_STEPS))
        yield from ((f"solver.{key}", why) for key in _changed(case.solver, IMPLICIT_SOLUTION))
    # A uniform block has one size of particles.
    if case.particles.arrangement == "uniform":
        why = 'belongs to graded particles; leave it out or write arrangement = "graded"'
        yield from ((f"particles.{key}", why) for key in _changed(case.particles, GRADED))


def _changed(model: Model, keys: tuple[str, ...]) -> list[str]:
    """Keys that a model has and that are not their default."""
    fields = type(model).model_fields
    return [key for key in keys if key in fields and getattr(model, key) != fields[key].default]


def _domain(case: CaseContents) -> Iterator[tuple[str, str]]:
    domain = case.domain
    lattice = case.particles
    dimensions = case.solver.dimensions
    # More than one dimension needs a width; a period of the light is the best guess.
    if dimensions > 1 and domain.width is None:
        period = getattr(getattr(case.laser, "beam", None), "lateral_period", None)
        width = format_quantity(period or USUAL_WIDTH, "m", 10)
        why = ", a period of the light" if period else ""
        yield "domain.width", f'missing for {dimensions}-D; write e.g. width = "{width}"{why}'
        return
    if dimensions == 1 and domain.extent == "half":
        yield "domain.extent", 'half of a 1-D column means nothing; write extent = "full"'
    if dimensions < 3 and domain.extent == "quarter":
        yield (
            "domain.extent",
            f"a quarter is symmetric about y = 0, too, which a {dimensions}-D run does not have; "
            'write extent = "half", or dimensions = 3 in [solver]',
        )
    if dimensions < 3 and domain.breadth is not None:
        yield "domain.breadth", no_axis("y", 3, dimensions)
    # Each side holds a few particles at least.
    sides = (("depth", domain.depth), ("width", domain.width), ("breadth", domain.breadth))
    for key, length in sides[:dimensions]:
        if length is not None and length < FEWEST_LAYERS * lattice.spacing:
            yield (
                f"domain.{key}",
                f"{format_quantity(length, 'm')} holds fewer than {FEWEST_LAYERS} particles of "
                f"{format_quantity(lattice.spacing, 'm')}; give a larger domain or a finer spacing",
            )
    yield from _faces(case)
    yield from _fine_width(case)


def _faces(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Whether the faces fit the domain and its dimensions."""
    boundaries, dimensions = case.boundaries, case.solver.dimensions

    # Half a block ends in a plane of symmetry, a quarter in two.
    for axis, face in zip("xy", case.domain.planes_of_symmetry, strict=False):
        kind = boundaries.kind_of(face)
        if kind != "adiabatic":
            key = face if getattr(boundaries, face) else "sides"
            yield (
                f"boundaries.{key}",
                f'{case.domain.part} a block is symmetric at {axis} = 0, "{kind}" does not fit; '
                f'write extent = "full" in [domain] or {key} = "adiabatic"',
            )

    # Faces along x exist from two dimensions on, those along y in three, and each is said once.
    for face in ("front", "back"):
        if dimensions < 3 and getattr(boundaries, face) is not None:
            yield f"boundaries.{face}", no_axis("y", 3, dimensions)
    for face in ("left", "right"):
        if dimensions == 1 and getattr(boundaries, face) is not None:
            yield (
                f"boundaries.{face}",
                "a 1-D column has no sides along x; leave it out or write dimensions = 2 in "
                "[solver]",
            )
    has_both = boundaries.left is not None and boundaries.right is not None
    is_default = boundaries.side_temperature is not None or boundaries.side_flux is not None
    if dimensions == 1 and boundaries.sides in (*DIRICHLET, NEUMANN):
        yield "boundaries.sides", no_axis("x", 2, dimensions)
    elif dimensions == 2 and has_both and not is_default and _changed(boundaries, ("sides",)):
        yield "boundaries.sides", "says nothing where left and right are given; leave it out"
    if dimensions == 1 and boundaries.temperature_drive is not None:
        yield (
            f"boundaries.{key_of_drive(case, 'temperature')}",
            "varies along x, which a 1-D run does not have; write dimensions = 2 in [solver]",
        )
    if boundaries.surface == "periodic" and case.particles.arrangement == "graded":
        yield (
            "boundaries.surface",
            'graded particles do not repeat in z; write arrangement = "uniform" in [particles]',
        )


def _fine_width(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Whether columns can be finer in the middle than beside it."""
    if case.particles.fine_width is None:
        return
    faces, key = case.boundaries, "particles.fine_width"
    if case.solver.dimensions == 1:
        yield key, no_axis("x", 2, 1)
    elif "periodic" in (faces.kind_of("left"), faces.kind_of("right"), faces.sides):
        yield (
            key,
            "columns beside the middle of a period would be coarse where it repeats; leave it out, "
            'or write sides = "adiabatic" in [boundaries]',
        )


def _material(case: CaseContents) -> Iterator[tuple[str, str]]:
    # A box of fluid has no phase change of its own.
    changes = case.solver.phase_change and case.flow is None
    try:
        case.material.caloric_curve(
            case.initial_temperature, case.solver.curve_plateau, phase_change=changes
        )
    except ValueError as error:
        # The curve refuses a start outside its range, or what the metal lacks.
        text = str(error)
        is_start = text.startswith("the initial temperature")
        yield "initial_temperature" if is_start else "material", text
    yield from _evaporation(case)
    # An ambient temperature counts only where heat leaves by convection or radiation.
    surroundings = case.boundaries.surroundings(case.material, case.initial_temperature)
    if case.boundaries.ambient_temperature is not None and not surroundings.take_heat:
        yield (
            "boundaries.ambient_temperature",
            "says nothing without convection or emissivity; give one of them or leave it out",
        )


def _evaporation(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Data that vapor which leaves the surface needs."""
    vapor, has_flux = case.material.vaporization, case.solver.has_vapor_flux
    key, right = ("vaporization", "plateau") if has_flux else ("plateau", "hold")
    # Both ways of evaporating need the molar mass, a flux the critical temperature as well.
    if has_flux or (case.solver.evaporates and case.solver.phase_change):
        examples = {"molar_mass": "56 g/mol"}
        if has_flux:
            examples["critical_temperature"] = "9250 K"
        if vapor is None:
            examples = {"temperature": "3000 K", "latent_heat": "6.3 MJ/kg", **examples}
        lacking = [name for name in examples if getattr(vapor, name, None) is None]
        if lacking:
            lines = ", ".join(f'{name} = "{examples[name]}"' for name in lacking)
            yield (
                f"solver.{key}",
                f'"{getattr(case.solver, key)}" needs numbers that [vaporization] of material '
                f'"{case.material.name}" lacks; write there, e.g. {lines}, '
                f'or here {key} = "{right}"',
            )
    if case.solver.evaporates and not case.solver.phase_change:
        yield (
            f"solver.{key}",
            f'"{getattr(case.solver, key)}" says nothing where phase_change = false; leave it out',
        )
    if case.boundaries.ambient_pressure is not None and not has_flux:
        yield (
            "boundaries.ambient_pressure",
            'says nothing but beside vaporization = "flux" in [solver]; leave it out or write that',
        )


def _size(case: CaseContents) -> Iterator[tuple[str, str]]:
    size = size_of(case)
    # Numbers of particles are 32-bit integers.
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


def _points(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Probes and traces: each of one name, inside the domain."""
    bounds = dict(zip("xy", case.domain.lateral(case.geometry), strict=False))
    # Names become columns of the history and must differ.
    for key, points in (("probes", case.probes), ("traces", case.traces)):
        what = key.removesuffix("s")
        for name, count in Counter(point.name for point in points).items():
            if count > 1:
                yield key, f'{count} {key} are named "{name}"; give each its own name'
        for index, point in enumerate(points, start=1):
            if point.depth > case.domain.depth:
                yield (
                    f"{key}[{index}].depth",
                    f"{format_quantity(point.depth, 'm')} lies below the domain of "
                    f"{format_quantity(case.domain.depth, 'm')}; place the {what} inside",
                )
            for axis, (low, high) in bounds.items():  # others are not used, see `NamedPoint`
                place = getattr(point, axis)
                if not low <= place <= high:
                    yield (
                        f"{key}[{index}].{axis}",
                        f"{format_quantity(place, 'm')} lies outside the domain, which runs from "
                        f"{format_quantity(low, 'm')} to {format_quantity(high, 'm')}; place the "
                        f"{what} inside",
                    )


def _snapshots(case: CaseContents) -> Iterator[tuple[str, str]]:
    if case.end_of_pulse <= 0.0:  # which `pulse_problems` tells
        return
    # Snapshots end with the run, or with the pulse where pauses are jumped over.
    late = [time for time in case.output.snapshots.times if time > case.end_of_pulse]
    if late:
        yield (
            "output.snapshots.times",
            f"{format_quantity(late[0], 's')} is after the end, "
            f"{format_quantity(case.end_of_pulse, 's')}; leave it out or give a later end",
        )
    try:
        SnapshotSchedule(case.output.snapshots, case.end_of_pulse)
    except ValueError as error:
        yield "output.snapshots.interval", str(error)
