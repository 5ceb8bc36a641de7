"""Checks of cases that flow: melt pools in a block, and closed boxes that are all fluid."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING

from lasersph.boundaries.flow_conditions import FREE, FlowConditions
from lasersph.boundaries.initial_flow import TabulatedFlow, TaylorGreenFlow
from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.case.size import LARGEST_STEPS
from lasersph.case.solver_choice import computes_flow, no_axis
from lasersph.input import format_quantity
from lasersph.materials import available_materials
from lasersph.particles.faces import BACK, FRONT, LATERAL, faces_of

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents
    from lasersph.solvers.melt_pool.settings import MeltPoolSettings

LARGEST_COURANT = 0.25
"""Share of a spacing that nothing may pass in a step, for the number of steps."""
LARGEST_DIFFUSION = 0.125
"""Share of spacing^2 over viscosity that an explicit step may take, for the number of steps."""


def flow_problems(case: CaseContents) -> Iterator[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of all that concerns flow."""
    if not computes_flow(case.solver):
        return
    yield from _liquid(case, case.solver)
    if case.solver.dimensions == 3 and case.solver.pressure == "published":
        yield (
            "solver.pressure",
            '"published" is the matrix of a plane; write "multigrid", or dimensions = 2',
        )
    yield from _frame(case, case.solver)
    yield from _heat_faces(case)
    if case.flow is None:
        yield from _pool(case, case.solver)
    else:
        yield from _box(case, case.flow)
    yield from _steps(case, case.solver)


def _liquid(case: CaseContents, solver: MeltPoolSettings) -> Iterator[tuple[str, str]]:
    """Properties that the liquid must have."""
    # Flow needs a viscosity, and a slope of surface tension where the surface pulls.
    material = case.material
    given = material.properties()
    base = f'beside base = "{material.name}" ' if material.name in available_materials() else ""
    if "viscosity" not in given and "kinematic_viscosity" not in given:
        yield (
            "material",
            f'"{material.name}" has no viscosity, which flow needs; write e.g. viscosity = '
            f'"5 mPa s" {base}in [material], or kind = "conduction" in [solver]',
        )
    has_slope = "surface_tension" in given or "surface_tension_slope" in given
    pulls = case.flow is None or case.flow.surface.kind in FREE
    if solver.marangoni and pulls and not has_slope:
        yield (
            "material",
            f'"{material.name}" has no surface_tension_slope, which drives the surface; write '
            f'e.g. surface_tension_slope = "-0.4 mN/(m K)" {base}in [material], or marangoni = '
            "false in [solver]",
        )


def _frame(case: CaseContents, solver: MeltPoolSettings) -> Iterator[tuple[str, str]]:
    """Whether particles move or rest, where only one of both can be."""
    is_section = case.geometry.is_axisymmetric
    if solver.frame == "lagrangian" and is_section:
        yield (
            "solver.frame",
            "particles of a section (r, z) keep their distances from the axis; leave it out",
        )
    if solver.frame != "eulerian" or is_section:
        return
    if case.surface_moves:
        yield (
            "solver.frame",
            "below a surface that moves particles move with it; leave it out, or write "
            'surface = "flat" in [solver.flow]',
        )
    if solver.pressure == "published":
        yield (
            "solver.pressure",
            '"published" is the matrix of particles that move; leave it out',
        )
    if solver.is_shifted:
        yield "solver.shifting", "particles that rest are not shifted; leave it out"


def _heat_faces(case: CaseContents) -> Iterator[tuple[str, str]]:
    for face in faces_of(case.solver.dimensions):
        if case.boundaries.kind_of(face) == "free":
            own = getattr(case.boundaries, face) is not None
            yield (
                f"boundaries.{face if own else 'sides'}",
                '"free" cuts supports off, which flow needs whole; write "adiabatic", through '
                "which no heat passes either",
            )


def _pool(case: CaseContents, solver: MeltPoolSettings) -> Iterator[tuple[str, str]]:
    """A pool in a block that is solid at first."""
    # A pool melts into a solid: by phase change, and by some heat.
    if case.material.melting is None:
        yield (
            "material",
            f'"{case.material.name}" has no melting data, so it is fluid everywhere; say in '
            "[solver.flow] what holds at the sides of the box, or add melting",
        )
    elif not solver.phase_change:
        yield (
            "solver.phase_change",
            "nothing melts, so nothing flows; leave it out, or say in [solver.flow] what holds at "
            "the sides of a box that is all fluid",
        )
    is_heated = case.laser is not None or any(
        case.boundaries.kind_of(face) in (*DIRICHLET, NEUMANN)
        for face in faces_of(case.solver.dimensions)
    )
    if not is_heated:
        yield (
            "laser",
            "missing: nothing would melt; give [laser] or a face of given temperature or heat "
            "flux in [boundaries], or [solver.flow] for a box that is all fluid",
        )
    if case.boundaries.surface == "periodic":
        yield "boundaries.surface", 'a pool lies below a surface; write surface = "adiabatic"'


def _box(case: CaseContents, flow: FlowConditions) -> Iterator[tuple[str, str]]:
    """A closed box that is all fluid."""
    # A box is fluid everywhere, with one size of particles.
    if case.material.melting is not None and case.solver.phase_change:
        yield (
            "solver.phase_change",
            f'a box of [solver.flow] is all fluid, but "{case.material.name}" melts; write '
            "phase_change = false",
        )
    if case.particles.arrangement != "uniform":
        yield (
            "particles.arrangement",
            'particles that flow through the whole box need one size; write "uniform"',
        )

    # A side repeats for heat and for flow, or for neither.
    for side in faces_of(case.solver.dimensions):
        heat, kind = case.boundaries.kind_of(side), flow.faces[side].kind
        if (heat == "periodic") == (kind == "periodic"):
            continue
        own = getattr(case.boundaries, side) is not None
        key = (
            _key_of(flow, side) if heat == "periodic" else f"boundaries.{side if own else 'sides'}"
        )
        given, other = (kind, "boundaries") if heat == "periodic" else (heat, "solver.flow")
        yield (
            key,
            f'"{given}", but {side} is periodic in [{other}]; write "periodic" in both or in '
            "neither",
        )

    # Half a box ends in a plane of symmetry of the flow, a quarter in two.
    for axis, side in zip("xy", case.domain.planes_of_symmetry, strict=False):
        kind = flow.faces[side].kind
        if kind not in ("symmetry", "free-slip"):
            yield (
                _key_of(flow, side),
                f'{case.domain.part} a box is symmetric at {axis} = 0, "{kind}" does not fit; '
                f'write {side} = "symmetry", or extent = "full" in [domain]',
            )
    yield from _faces_along_y(case, flow)
    if isinstance(flow.initial, TaylorGreenFlow):
        yield from _vortices(case, flow.initial)
    if isinstance(flow.initial, TabulatedFlow) and case.solver.dimensions == 3:
        yield (
            "solver.flow.initial.kind",
            'a "table" has the velocities of a plane; write kind = "rest", or dimensions = 2 in '
            "[solver]",
        )


def _key_of(flow: FlowConditions, side: str) -> str:
    """Key that says what holds at a side: its own, or that of all of them."""
    is_own = side not in chain(*LATERAL) or flow.sides is None or flow.faces[side] != flow.sides
    return f"solver.flow.{side if is_own else 'sides'}"


def _faces_along_y(case: CaseContents, flow: FlowConditions) -> Iterator[tuple[str, str]]:
    """Sides that a section does not have."""
    if case.solver.dimensions == 3:
        return
    for side in (FRONT, BACK):
        if getattr(flow, side) is not None:
            yield f"solver.flow.{side}", no_axis("y", 3, case.solver.dimensions)


def _vortices(case: CaseContents, initial: TaylorGreenFlow) -> Iterator[tuple[str, str]]:
    """Vortices must fill the box: the walls lie between them."""
    # Walls lie between vortices, half a period apart.
    x, *y = case.domain.lateral(case.geometry)
    period = initial.period or x[1] - x[0]
    sides = {"width": x[1] - x[0], "depth": case.domain.depth}
    if y:
        sides["breadth"] = y[0][1] - y[0][0]
    for key, length in sides.items():
        count = length / (0.5 * period)
        if not math.isclose(count, max(1, round(count)), rel_tol=1e-6):
            yield (
                f"domain.{key}",
                f"{format_quantity(length, 'm')} is no whole number of vortices of "
                f"{format_quantity(0.5 * period, 'm')}; write e.g. {key} = "
                f'"{format_quantity(0.5 * period * max(1, round(count)), "m", 10)}", or another '
                "period in solver.flow.initial",
            )


def _steps(case: CaseContents, solver: MeltPoolSettings) -> Iterator[tuple[str, str]]:
    """Speeds and viscosities that no number of steps follows."""
    spacing, end = case.particles.spacing, case.time.end

    # Speeds that the case itself names; others follow from the run.
    speeds = {}
    if case.flow is not None:
        speeds = {
            f"solver.flow.{name}.velocity": abs(side.velocity)
            for name, side in case.flow.faces.items()
        }
        if isinstance(case.flow.initial, TaylorGreenFlow):
            speeds["solver.flow.initial.speed"] = case.flow.initial.speed

    # Courant number: steps of at most C dx / u.
    for key, speed in speeds.items():
        steps = end * speed / (LARGEST_COURANT * spacing)
        if steps > LARGEST_STEPS:
            yield (
                key,
                f"{speed:.3g} m/s needs {steps:.2g} steps to the end, more than "
                f"{LARGEST_STEPS:.0g}; take a lower speed, a coarser spacing or an earlier end",
            )

    # Diffusion number of explicit viscosity: steps of at most d dx^2 / nu.
    if solver.viscosity == "explicit" and (case.material.melting or case.material.is_liquid):
        try:
            viscosity = float(case.material.kinematic_viscosity_at(case.material.flow_temperature))
        except ValueError:
            return
        steps = end * viscosity / (LARGEST_DIFFUSION * spacing**2)
        if steps > LARGEST_STEPS:
            yield (
                "solver.viscosity",
                f"{viscosity:.3g} m^2/s needs {steps:.2g} explicit steps to the end, more than "
                f'{LARGEST_STEPS:.0g}; write viscosity = "implicit" or take a coarser spacing',
            )
