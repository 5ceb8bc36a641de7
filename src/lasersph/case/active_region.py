"""Whether only what heat can reach is computed in a case, and how deep that will be.

Heat is followed down to 1e-11 of its largest rise: erfc(4.8) of the penetration 2 sqrt(D t). Cells
become active ahead of it by some supports. An estimate, for sizes and forecasts only.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from lasersph.boundaries.initial_motion import Rest

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents

PENETRATIONS = 9.6
"""Depth of the active region over sqrt(D t)."""
SUPPORTS = 4.0
"""Supports that become active ahead of the heat."""


def has_active_region(case: CaseContents) -> bool:
    """Whether only what heat reaches is computed: light on matter at rest, without gravity."""
    is_at_rest = isinstance(case.motion or Rest(), Rest)
    return case.laser is not None and is_at_rest and case.solver.leaves_rest_inactive


def active_share(case: CaseContents, support: float) -> float:
    """Estimated largest share of the particles that is active at the end [1].

    Args:
        support: support radius of the particles [m].
    """
    if not has_active_region(case):
        return 1.0
    heat = PENETRATIONS * sqrt(case.material.diffusivity_reference * case.time.end)
    return min(1.0, (heat + SUPPORTS * support) / case.domain.depth)
