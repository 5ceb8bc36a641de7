"""`--quick`: the same case four times coarser, to see within seconds that it works."""

from __future__ import annotations

from lasersph.case.case import Case

COARSER = 4.0
FEWEST_CELLS = 10
LONGER = 2.0


def quick_settings(case: Case) -> list[str]:
    """Overrides that make a case coarse: spacing times 4 and steps times 2.

    At least 10 cells stay along each side of the domain.
    """
    sides = [high - low for low, high in case.domain.lateral(case.solver.dimensions)]
    largest = min([case.domain.depth, *sides]) / FEWEST_CELLS
    spacing = max(case.particles.spacing, min(COARSER * case.particles.spacing, largest))
    settings = [f"particles.spacing={spacing!r} m"]
    if case.particles.coarsest < spacing:
        settings.append(f"particles.coarsest={spacing!r} m")
    if case.particles.fine_depth is not None and case.particles.fine_depth < spacing:
        settings.append(f"particles.fine_depth={spacing!r} m")
    if case.time.step is not None and not case.solver.is_explicit:
        settings.append(f"time.step={LONGER * case.time.step!r} s")
    return settings
