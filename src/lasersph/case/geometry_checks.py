"""Checks of a section (r, z): what has an axis of revolution, and what has none."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lasersph.boundaries.flow_conditions import AT_REST, FlowConditions, RestingFlow
from lasersph.case.solver_choice import computes_flow, moves_matter
from lasersph.input import format_quantity
from lasersph.lasers import Laser
from lasersph.lasers.rings import ellipticity, round_light

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents

ROUND = 0.87
"""Smaller over larger width of a beam that counts as round. Source: [ISO11146-1]."""

WAVES = {
    "temperature": "write surface_temperature_bump instead",
    "pressure": "write surface_pressure_bump instead",
    "mass_flux": "leave it out",
}
"""Drives along x, and what to write instead of them along r."""


def section_problems(case: CaseContents) -> Iterator[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of all that a section (r, z) cannot have."""
    if case.solver.dimensions != 2:
        yield (
            "solver.geometry",
            f'"axisymmetric" is a section (r, z), not {case.solver.dimensions}-D; write dimensions '
            "= 2",
        )
    if moves_matter(case.solver):
        yield (
            "solver.geometry",
            'matter that moves is computed in "planar" blocks; leave it out, or write kind = '
            '"melt-pool" or "conduction"',
        )
    if computes_flow(case.solver) and case.solver.pressure == "published":
        yield (
            "solver.pressure",
            '"published" is the matrix of a plane; leave it out in a section (r, z)',
        )
    yield from _block(case)
    if case.flow is not None:
        yield from _box(case.flow)
    if case.laser is not None:
        yield from _light(case, case.laser)


def _block(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Keys of the block that a section from the axis outward does not have."""
    domain, boundaries = case.domain, case.boundaries
    if domain.extent != "full":
        yield (
            "domain.extent",
            "a section (r, z) begins at its axis, and its width is the radius of the block; leave "
            "it out",
        )
    if boundaries.left is not None:
        yield "boundaries.left", "the left side of a section (r, z) is its axis; leave it out"
    for key in ("right", "sides"):
        if getattr(boundaries, key) == "periodic":
            yield f"boundaries.{key}", f'nothing repeats along r; write {key} = "adiabatic"'
    # Waves along x; what is imposed on a section is a bump, and so is what it starts from.
    for what, right in WAVES.items():
        key = f"surface_{what}_wave"
        if getattr(boundaries, key) is not None:
            yield (
                f"boundaries.{key}",
                f"has a period along x, and nothing repeats along r; {right}",
            )
    if case.initial_surface is not None and case.initial_surface.period is not None:
        yield (
            "solver.flow.initial_surface.period",
            "is along x, and nothing repeats along r; write the radius of a bump instead",
        )


def _box(flow: FlowConditions) -> Iterator[tuple[str, str]]:
    """Keys of a box that is all fluid that hold in a plane alone."""
    if flow.left != AT_REST:
        yield "solver.flow.left", "the left side of a section (r, z) is its axis; leave it out"
    if flow.initial != RestingFlow():
        yield (
            "solver.flow.initial",
            "is the flow of a plane; leave it out in a section (r, z), which starts at rest",
        )


def _light(case: CaseContents, laser: Laser) -> Iterator[tuple[str, str]]:
    """Light that is not the same all around the axis."""
    if round_light(laser) is None:
        yield (
            "laser.beam.kind",
            "waves that interfere make no light that is the same around an axis; write geometry = "
            '"planar" in [solver]',
        )
        return
    if laser.position != (0.0, 0.0):
        x, y = (format_quantity(one, "m") for one in laser.position)
        yield (
            "laser.position",
            f"({x}, {y}) is beside the axis of a section (r, z), on which its beam lies; leave it "
            "out",
        )
    if laser.path is not None:
        yield (
            "laser.path",
            'takes the beam off the axis of a section (r, z); write geometry = "planar" and '
            "dimensions = 3 in [solver]",
        )
    if not laser.is_bounded:
        return

    # A spot has to be round, and to lie in the block.
    if (roundness := ellipticity(laser)) < ROUND:
        yield (
            "laser.spot.image",
            f"shows a beam whose smaller width is {roundness:.2f} of the larger one, and round is "
            f'{ROUND} or more [ISO 11146-1]; write geometry = "planar" and dimensions = 3 in '
            "[solver]",
        )
    radius, width = 0.5 * laser.spot_fluence.diameter, case.domain.width
    if width is not None and radius > width:
        yield (
            "domain.width",
            f"{format_quantity(width, 'm')} is the radius of the block, less than that of the spot,"
            f' {format_quantity(radius, "m")}; write e.g. width = "'
            f'{format_quantity(2.0 * radius, "m")}"',
        )
