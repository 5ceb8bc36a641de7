"""`--quick`: the same case coarser, to see within seconds that it works and what it is about."""

from __future__ import annotations

from lasersph.analytic.half_space import ablated_depth
from lasersph.case.case import Case
from lasersph.case.surface_checks import FEWEST_COLUMNS
from lasersph.input import format_quantity

SPACING_FACTOR = 4.0
FEWEST_CELLS = 10
STEP_FACTOR = 2.0
LAYERS_OF_CRATER = 1.25
"""Particles that a depth needs to be seen: where it is estimated a fifth too large, one is left."""


def quick_settings(case: Case) -> list[str]:
    """Overrides that make a case coarse: spacing times 4 and steps times 2.

    At least 10 cells stay along each side of the domain, 12 below a surface that moves, and a
    crater that is expected stays deeper than a particle.
    """
    # Coarser, but with cells along each side and in the crater.
    largest = largest_spacing(case)
    spacing = max(case.particles.spacing, min(SPACING_FACTOR * case.particles.spacing, largest))
    settings = [f"particles.spacing={spacing!r} m"]
    if case.particles.arrangement == "graded" and case.particles.coarsest < spacing:
        settings.append(f"particles.coarsest={spacing!r} m")
    if case.particles.fine_depth is not None and case.particles.fine_depth < spacing:
        settings.append(f"particles.fine_depth={spacing!r} m")
    # Solid beside a pool takes as many spacings.
    if case.particles.fine_width is not None:
        width = case.particles.fine_width * spacing / case.particles.spacing
        settings.append(f"particles.fine_width={width!r} m")
    # Longer steps; explicit ones follow from the spacing.
    if case.time.step is not None and not case.solver.is_explicit:
        settings.append(f"time.step={STEP_FACTOR * case.time.step!r} s")
    return settings


def largest_spacing(case: Case) -> float:
    """Coarsest spacing that still shows what the case is about [m]."""
    # The narrowest side holds a few cells; an expected crater is deeper than one.
    sides = [high - low for low, high in case.domain.lateral(case.geometry)]
    largest = min([case.domain.depth, *sides]) / FEWEST_CELLS
    if case.surface_moves:
        # rounded down, so that the columns fit
        largest = min([largest, *(0.999 * side / FEWEST_COLUMNS for side in sides)])
    crater = expected_crater(case)
    return min(largest, crater / LAYERS_OF_CRATER) if crater else largest


def expected_crater(case: Case) -> float:
    """Depth that light is expected to ablate by heat alone [m]; 0 where nothing can be ablated."""
    laser, material = case.laser, case.material
    boiling = material.vaporization
    # A crater needs light, a boiling point and a solver that lets particles leave.
    if laser is None or boiling is None or "ejection" not in type(case.solver).model_fields:
        return 0.0
    cold = case.initial_temperature
    reflectivity = float(laser.reflectivity_table(material, cold, cold + 1.0)[1][0])
    if case.ejection is not None and case.ejection.reflectivity is not None:
        reflectivity = case.ejection.reflectivity
    # Depth of ablation by heat alone, with melting as a part of the heat.
    return ablated_depth(
        (1.0 - reflectivity) * laser.peak_fluence,
        laser.pulse.on_time or 100.0 * laser.pulse.resolution,
        density=material.density_reference,
        heat_capacity=float(material.heat_capacity_at(material.reference_temperature)),
        diffusivity=material.diffusivity_reference,
        rise=boiling.temperature - cold,
        latent_heat=boiling.latent_heat
        + (0.0 if material.melting is None else material.melting.latent_heat),
    )


def what_is_not_shown(case: Case) -> str:
    """One line where a particle is larger than the crater to be found; empty elsewhere."""
    crater, spacing = expected_crater(case), case.particles.spacing
    if crater == 0.0 or spacing <= crater:
        return ""
    return (
        f"the crater of a pulse is expected to be {format_quantity(crater, 'm', 3)} deep, less "
        f"than a particle of {format_quantity(spacing, 'm', 3)}: it is not shown; take a finer "
        "spacing"
    )
