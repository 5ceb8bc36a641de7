"""Checks of cases whose matter moves, and leaves under a laser."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lasersph.boundaries.initial_motion import Rest, SoundWave, Uniform
from lasersph.boundaries.settings import DIRICHLET
from lasersph.case.solver_choice import moves_matter, no_axis
from lasersph.input import format_quantity
from lasersph.particles.faces import LATERAL, VERTICAL, faces_of

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents
    from lasersph.solvers.ablation.settings import AblationSettings

REFUSED = {
    "fixed-temperature": 'holds the face itself; write "wall" for particles of that temperature',
    "prescribed-flux": 'is for bodies at rest; write "adiabatic" or "wall"',
}


def motion_problems(case: CaseContents) -> Iterator[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of all that concerns matter that moves."""
    assert moves_matter(case.solver)
    yield from _faces(case)
    yield from _particles(case, case.solver)
    yield from _motion(case, case.solver)
    yield from _light(case, case.solver)
    yield from _idle_keys(case)


def _faces(case: CaseContents) -> Iterator[tuple[str, str]]:
    # Faces that hold their temperature belong to bodies at rest.
    dimensions = case.solver.dimensions
    for face in faces_of(dimensions):
        kind = case.boundaries.kind_of(face)
        key = face if face in VERTICAL else "sides"
        key = face if getattr(case.boundaries, face, None) else key
        if kind in REFUSED:
            yield f"boundaries.{key}", f'"{kind}" {REFUSED[kind]}'
    if case.vessel is None:
        return
    # Walls of the vessel need a side to stand at.
    for side in LATERAL[0]:
        if getattr(case.vessel, side) > 0.0 and dimensions == 1:
            yield f"solver.vessel.{side}", "a 1-D column has no sides; leave it out"
        elif getattr(case.vessel, side) > 0.0 and case.boundaries.kind_of(side) == "periodic":
            yield f"solver.vessel.{side}", "no wall stands on a periodic side; leave it out"


def _particles(case: CaseContents, solver: AblationSettings) -> Iterator[tuple[str, str]]:
    if case.particles.arrangement != "uniform":
        yield "particles.arrangement", 'particles that move need one size; write "uniform"'
    width = case.domain.width
    if width is None or solver.dimensions == 1:
        return
    # A particle must not meet the same neighbor on both sides of a period.
    ratio = case.particles.support_over_spacing
    shortest = 2.0 * (ratio + solver.skin) * case.particles.spacing
    for key, length, face in (
        ("width", width, "left"),
        ("breadth", case.domain.breadth or width, "front"),
    ):
        is_there = face == "left" or case.solver.dimensions == 3
        if is_there and case.boundaries.kind_of(face) == "periodic" and length <= shortest:
            yield (
                f"domain.{key}",
                f"{format_quantity(length, 'm')} must be more than twice the support and its skin, "
                f"{format_quantity(shortest, 'm')}; take a wider domain or a finer spacing",
            )


def _motion(case: CaseContents, solver: AblationSettings) -> Iterator[tuple[str, str]]:
    motion = case.motion
    # A sound wave repeats in z and stays linear.
    if isinstance(motion, SoundWave):
        if case.boundaries.surface != "periodic":
            yield (
                "solver.motion.kind",
                "a sound wave runs through a block that is periodic in z; write surface = "
                '"periodic" and bottom = "periodic" in [boundaries]',
            )
        if motion.amplitude > 0.1 * solver.sound_speed:
            yield (
                "solver.motion.amplitude",
                f"{motion.amplitude:g} m/s is no small wave where sound runs at "
                f"{solver.sound_speed:g} m/s; take less than a tenth",
            )
    if isinstance(motion, Rest) and motion.hydrostatic and solver.gravity == 0.0:
        yield "solver.motion.hydrostatic", "nothing weighs anything without gravity in [solver]"


def _light(case: CaseContents, solver: AblationSettings) -> Iterator[tuple[str, str]]:
    material = case.material

    # Ejection is the work of light on an open surface.
    if case.laser is None:
        if case.ejection is not None:
            yield "solver.ejection", "nothing leaves without a [laser]; add one or leave it out"
        return
    if case.boundaries.surface not in ("free", "adiabatic"):
        yield "boundaries.surface", 'a surface that ablates lies open; write "free"'

    # The velocity of vapor follows from its molar mass.
    vapor = material.vaporization
    if vapor is None or vapor.molar_mass is None:
        mass = 'molar_mass = "55 g/mol"'
        line = (
            f"write e.g. {mass} in [material.vaporization]"
            if vapor
            else (
                'write e.g. vaporization = { temperature = "3000 K", latent_heat = "6 MJ/kg", '
                f"{mass} }} in [material]"
            )
        )
        yield (
            "material",
            f'"{material.name}" has no vaporization data with molar_mass, which ejection needs; '
            f'{line}, or take kind = "conduction" in [solver]',
        )
    published = case.ejection is not None and case.ejection.model == "published"
    if not solver.phase_change and not published:
        yield (
            "solver.phase_change",
            "the enthalpy model of ejection is about latent heats; leave it out, or write model = "
            '"published" in [solver.ejection]',
        )

    # A preset of the published rule brings a reflectivity, which must be that of the laser.
    rule = case.ejection
    if rule is None or rule.reflectivity is None:
        return
    laser = case.laser
    if laser.has_own_reflectivity and laser.reflectivity != rule.reflectivity:
        yield (
            "solver.ejection.preset",
            f'"{rule.preset}" means a reflectivity of {rule.reflectivity:g}, but [laser] has '
            "another; leave one of them out, or write leave and leave_distance instead of the "
            "preset",
        )


def _idle_keys(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Keys that need an open surface, walls at the sides, or light that goes below a surface."""
    # A surface that is held or repeats exchanges nothing with surroundings.
    boundaries = case.boundaries
    if boundaries.surface in (*DIRICHLET, "periodic"):
        for key in ("convection", "emissivity"):
            if getattr(boundaries, key):
                yield (
                    f"boundaries.{key}",
                    f'says nothing where surface = "{boundaries.surface}", as no surface lies '
                    'open; leave it out or write surface = "free"',
                )
    no_walls = case.solver.dimensions == 1 or boundaries.kind_of("left") == "periodic"
    if case.vessel is not None and case.vessel.above > 0.0 and no_walls:
        yield "solver.vessel.above", "there are no side walls that could be higher; leave it out"
    if case.laser is not None and case.laser.absorption.kind == "beer-lambert":
        yield (
            "laser.absorption.kind",
            "matter that moves takes all light in at what it meets first; write absorption = "
            '{ kind = "surface" }',
        )
    # A uniform motion along an axis that the run does not have.
    if isinstance(case.motion, Uniform):
        for axis, least in (("x", 2), ("y", 3)):
            if case.solver.dimensions < least and getattr(case.motion, axis) != 0.0:
                yield f"solver.motion.{axis}", no_axis(axis, least, case.solver.dimensions)
