"""Checks of cases with two temperatures: the metal's electrons, and what does not go with them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lasersph.input import format_quantity

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents

TWO = 'heat = "two-temperature"'
LONGEST = 0.1
"""Longest step over the pulse that may be asked for. Guard: light would be jumped over."""


def electron_problems(case: CaseContents) -> Iterator[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of all that concerns hot electrons."""
    solver = case.solver
    # data of the metal
    if case.material.electrons is None:
        yield (
            "material.electrons",
            f"missing, and {TWO} needs it; write in [material.electrons] e.g. heat_capacity = "
            '{ coefficient = "70 J/(m^3 K^2)" } and coupling = "2e16 W/(m^3 K)" of '
            f'"{case.material.name}", or choose a metal that has them: lasersph material list',
        )

    # steps of another kind, and a box of fluid
    wrong = {"scheme": "explicit", "iteration": "published", "plateau": "clip"}
    right = {"scheme": "implicit", "iteration": "newton", "plateau": "hold"}
    for key, value in wrong.items():
        if getattr(solver, key, None) == value:
            yield f"solver.{key}", f'"{value}" does not go with {TWO}; write "{right[key]}"'
    if case.flow is not None:
        yield "solver.heat", "a box of fluid has one temperature; leave it out"
    yield from _steps(case)


def _steps(case: CaseContents) -> Iterator[tuple[str, str]]:
    """Steps that are too long for the pulse."""
    if case.laser is None or case.time.step is None:
        return
    pulse = case.laser.pulse
    longest = LONGEST * (pulse.on_time or 100.0 * pulse.resolution)
    if case.time.step > longest:
        yield (
            "time.step",
            f"{format_quantity(case.time.step, 's')} is too long for the pulse of "
            f"{format_quantity(longest / LONGEST, 's', 3)}, whose light it would jump over; leave "
            f'it out, or write step = "{format_quantity(longest, "s", 3)}" or less',
        )
