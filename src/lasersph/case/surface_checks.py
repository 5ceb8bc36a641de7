"""Checks of cases whose surface moves, and of what is imposed on a surface."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import TYPE_CHECKING

from lasersph.boundaries.initial_surface import MIN_LAYERS, STEEPEST, InitialSurface
from lasersph.case.solver_choice import computes_flow, no_axis
from lasersph.input import format_quantity
from lasersph.materials import available_materials

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents

FEWEST_COLUMNS = 12
"""Columns of a line whose differences of fifth order see both of its ends."""
SLOPE_COLUMNS = 6.0
"""Columns over which the slope of a relief from a file counts; single ones have noise."""
SURFACE_FORCES = ("surface_pressure_wave", "surface_pressure_bump", "surface_mass_flux_wave")


def surface_problems(case: CaseContents) -> Iterator[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of all that concerns a surface that moves."""
    # A wave or bump that begins or ends in the run changes the flow, which only a pool follows.
    drive, moves = case.boundaries.temperature_drive, case.surface_moves
    if drive is not None and drive.is_timed and not computes_flow(case.solver):
        yield (
            f"boundaries.{key_of_drive(case, 'temperature')}",
            'start and end need [solver] kind = "melt-pool"; leave them out',
        )
    # Pressure and mass flux act on a surface that can give way.
    for name in SURFACE_FORCES:
        if getattr(case.boundaries, name) is not None and not moves:
            yield (
                f"boundaries.{name}",
                'says nothing where the surface is flat; write surface = "moving" in '
                "[solver.flow], or leave it out",
            )
    yield from _bumps(case)
    yield from _periods_along_y(case)
    if moves:
        yield from _tension(case)
        yield from _shape(case)
        yield from _solver(case)


def key_of_drive(case: CaseContents, what: str) -> str:
    """Key of the wave or the bump that varies a quantity along the surface."""
    wave = f"surface_{what}_wave"
    return wave if getattr(case.boundaries, wave) is not None else f"surface_{what}_bump"


def _bumps(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Bumps and caps that do not fit into the block."""
    if case.solver.dimensions == 1:
        return
    faces, start = case.boundaries, case.initial_surface
    reaches = {
        "boundaries.surface_temperature_bump.radius": faces.surface_temperature_bump,
        "boundaries.surface_pressure_bump.radius": faces.surface_pressure_bump,
    }
    found = {key: bump.radius for key, bump in reaches.items() if bump is not None}
    if start is not None and start.shape is not None and start.shape.extent:
        key = "radius" if start.radius else "cap_radius"
        found[f"solver.flow.initial_surface.{key}"] = start.shape.extent
    # The block from r = 0 outward.
    sides = case.domain.lateral(case.geometry)
    for (key, radius), (axis, (_, end)) in product(found.items(), enumerate(sides)):
        if radius > end:
            yield (
                key,
                f"{format_quantity(radius, 'm')} reaches beyond the block, which ends at "
                f"{format_quantity(end, 'm')}; write a smaller one, or a larger domain."
                f"{('width', 'breadth')[axis]}",
            )


def _periods_along_y(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Waves along y in a section."""
    faces, start = case.boundaries, case.initial_surface
    waves = {
        "boundaries.surface_temperature_wave": faces.surface_temperature_wave,
        "boundaries.surface_pressure_wave": faces.surface_pressure_wave,
        "boundaries.surface_mass_flux_wave": faces.surface_mass_flux_wave,
        "solver.flow.initial_surface": start,
    }
    for key, wave in waves.items():
        if wave is not None and wave.period_y is not None and case.solver.dimensions < 3:
            yield f"{key}.period_y", no_axis("y", 3, case.solver.dimensions)


def _tension(case: CaseContents) -> Iterator[tuple[str, str]]:
    if case.material.surface_tension is None:
        name = case.material.name
        base = f'beside base = "{name}" ' if name in available_materials() else ""
        yield (
            "material",
            f'"{name}" has no surface_tension, which a surface that moves needs; write e.g. '
            f'surface_tension = "1.6 N/m" (liquid steel; aluminum "0.87 N/m") {base}in '
            '[material], or surface = "flat" in [solver.flow]',
        )


def _shape(case: CaseContents) -> Iterator[tuple[str, str]]:
    spacing, sides = case.particles.spacing, case.domain.lateral(case.geometry)
    narrowest = min(high - low for low, high in sides)
    # Differences of fifth order need their columns.
    if narrowest < FEWEST_COLUMNS * spacing:
        yield (
            "particles.spacing",
            f"a surface that moves needs {FEWEST_COLUMNS} columns of particles; write spacing = "
            f'"{1e9 * narrowest / FEWEST_COLUMNS:.3g} nm" or less',
        )
    if case.initial_surface is not None:
        yield from _start(case, case.initial_surface, sides)


def _start(
    case: CaseContents, start: InitialSurface, sides: Sequence[tuple[float, float]]
) -> Iterator[tuple[str, str]]:
    """Whether a surface can begin as it is given."""
    # Liquid below the deepest place of the surface at the start.
    name = "path" if start.rows else "cap_height" if start.cap_height else "amplitude"
    key = f"solver.flow.initial_surface.{name}"
    depth = case.domain.depth if case.flow is not None else case.particles.fine_depth
    if depth is not None and depth - start.depth < MIN_LAYERS * case.particles.spacing:
        what, right = "liquid", "a shallower one"
        if case.flow is None:
            what, right = "the finest layers", "a larger particles.fine_depth"
        yield (
            key,
            f"leaves {format_quantity(depth - start.depth, 'm')} of {what}, less than "
            f"{MIN_LAYERS} spacings; write {right}",
        )
    # A slope over a few columns; single points of a measured relief are noise.
    steepest = start.steepest(SLOPE_COLUMNS * case.particles.spacing)
    if steepest > STEEPEST:
        yield (
            key,
            f"is a slope of {steepest:.3g}, more than {STEEPEST:.0f}; write a smaller one, or one "
            "that is wider",
        )
    # A relief over x and y has no place in a section.
    if start.grid is not None and len(sides) < 2:
        yield key, no_axis("y", 3, case.solver.dimensions)
        return
    # A relief from a file must reach from side to side.
    for axis, (low, high) in enumerate(sides):
        if start.covers(axis, low, high):
            continue
        places = start.x if start.grid is None else (start.grid.x, start.grid.y)[axis]
        first, last, begin, end = (
            format_quantity(place, "m") for place in (places[0], places[-1], low, high)
        )
        along = ("as wide as", "as long along y as")[axis]
        yield (
            key,
            f"has heights from {first} to {last}, but the domain is {along} {begin} to {end}; name "
            f"the relief of a run with this {('width', 'breadth')[axis]} and extent",
        )


def _solver(case: CaseContents) -> Iterator[tuple[str, str]]:
    if getattr(case.solver, "pressure", "") == "published":
        yield (
            "solver.pressure",
            '"published" knows no pressure at a surface; write "multigrid" where it moves',
        )
    if case.flow is None:
        return
    # The ends of the line are pinned to walls that rest.
    for side in ("left", "right"):
        if case.flow.faces[side].kind == "moving-wall":
            yield (
                f"solver.flow.{side}",
                "a wall that moves along itself has no place to which a surface is pinned; write "
                '"no-slip", "symmetry" or "periodic"',
            )
