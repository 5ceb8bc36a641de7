"""Checks of cases whose surface moves, and of what is imposed on a surface."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from typing import TYPE_CHECKING

from lasersph.case.solver_choice import computes_flow
from lasersph.input import format_quantity
from lasersph.materials import available_materials

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents

FEWEST_ROWS = 3
"""Spacings in the depth of a liquid whose surface moves; flow in fewer is not seen."""
FEWEST_COLUMNS = 12
"""Columns of a line whose differences of fifth order see both of its ends."""
STEEPEST = 1.0
"""Slope of a surface that is a function of x, as its particles see it."""
DRIVES = ("surface_pressure_wave", "surface_mass_flux_wave")


def surface_problems(case: CaseContents) -> Iterator[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of all that concerns a surface that moves."""
    wave, moves = case.boundaries.surface_temperature_wave, case.surface_moves
    is_timed = wave is not None and (wave.start, wave.end) != (0.0, None)
    if is_timed and not computes_flow(case.solver):
        yield (
            "boundaries.surface_temperature_wave",
            'start and end need [solver] kind = "melt-pool"; leave them out',
        )
    for name in DRIVES:
        if getattr(case.boundaries, name) is not None and not moves:
            yield (
                f"boundaries.{name}",
                'says nothing where the surface is flat; write surface = "moving" in '
                "[solver.flow], or leave it out",
            )
    if moves:
        yield from _tension(case)
        yield from _shape(case)
        yield from _solver(case)


def _tension(case: CaseContents) -> Iterator[tuple[str, str]]:
    if case.material.surface_tension is None:
        name = case.material.name
        base = f'beside base = "{name}" ' if name in available_materials() else ""
        yield (
            "material",
            f'"{name}" has no surface_tension, which a surface that moves needs; write e.g. '
            f'surface_tension = "1.6 N/m" (liquid steel; aluminium "0.87 N/m") {base}in '
            '[material], or surface = "flat" in [solver.flow]',
        )


def _shape(case: CaseContents) -> Iterator[tuple[str, str]]:
    spacing = case.particles.spacing
    (x,) = case.domain.lateral(2)
    if x[1] - x[0] < FEWEST_COLUMNS * spacing:
        yield (
            "particles.spacing",
            f"a surface that moves needs {FEWEST_COLUMNS} columns of particles; write spacing = "
            f'"{1e9 * (x[1] - x[0]) / FEWEST_COLUMNS:.3g} nm" or less',
        )
    start = None if case.flow is None else case.flow.initial_surface
    if start is None:
        return
    height, slope = abs(start.amplitude), 2.0 * pi * abs(start.amplitude) / start.period
    if case.domain.depth - height < FEWEST_ROWS * spacing:
        yield (
            "solver.flow.initial_surface.amplitude",
            f"leaves {format_quantity(case.domain.depth - height, 'm')} of liquid, less than "
            f"{FEWEST_ROWS} spacings; write a smaller amplitude",
        )
    if slope > STEEPEST:
        yield (
            "solver.flow.initial_surface.amplitude",
            f"is a slope of {slope:.3g}, more than {STEEPEST:.0f}; write a smaller amplitude or a "
            "longer period",
        )


def _solver(case: CaseContents) -> Iterator[tuple[str, str]]:
    if getattr(case.solver, "pressure", "") == "published":
        yield (
            "solver.pressure",
            '"published" knows no pressure at a surface; write "multigrid" where it moves',
        )
    if case.flow is None:
        return
    for side in ("left", "right"):
        if case.flow.faces[side].kind == "moving-wall":
            yield (
                f"solver.flow.{side}",
                "a wall that moves along itself has no place to which a surface is pinned; write "
                '"no-slip", "symmetry" or "periodic"',
            )
