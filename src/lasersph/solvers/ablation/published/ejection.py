"""Ejection as published: from the boiling temperature on with the velocity of the vapor.

A particle that leaves keeps absorbing until it has left [Alshaer2017, Sections 3.3 and 4.4]. There
are no latent heats, and the depth depends on when a particle counts as left. No heat pays for the
motion of what leaves: its kinetic energy is booked as work of the rule.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import Any

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.particles.kinds import LEAVING
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.physics.ejection import (
    ALIGNMENT,
    NEXT_LAYER,
    advance_lift,
    covers_neighbor,
    published_departure,
)
from lasersph.solvers.ablation.ejecta import Ejecta, Vapor


class PublishedEjection:
    """Exposed particles above T_v leave along their normal.

    Args:
        left_after: distance after which a particle has left [m]; negative where it has left when
            it covers no particle any more.
    """

    def __init__(
        self, backend: Backend, vapor: Vapor, count: int, spacing: float, left_after: float
    ) -> None:
        self.backend, self.vapor = backend, vapor
        self._covered = backend.zeros(count)
        self._layer: dict[str, Any] = {"distance": NEXT_LAYER * spacing, "alignment": ALIGNMENT}
        self._rule = {"T_v": vapor.temperature, "distance": left_after, **vapor.speed}

    def longest_step(self, flux: float, density: float) -> float:
        """No limit: the rule depends on the step, as published."""
        return inf

    def eject(
        self,
        fields: Mapping[str, Array],
        pairs: NeighborList,
        rows: Rows | None,
        time: float,
        step: float,
    ) -> Ejecta:
        """Set kind, velocity, left_at and p_v of what leaves at `time`, the end of the step [s].

        Args:
            fields: by symbol; kind, lift, v, h, T, m, exposed, normal, left_at, p_v.
        """
        backend, kind, covered = self.backend, fields["kind"], self._covered
        fields = {**fields, "covered": covered}

        # how far what leaves has been lifted, and which particles it still covers
        backend.pointwise(advance_lift, fields, fields["lift"], rows=rows, step=step)
        leaving = backend.rows_where(kind, LEAVING)
        backend.pair_sum(covers_neighbor, pairs, fields, covered, rows=leaving, **self._layer)

        # above T_v along the normal with the velocity of the vapor; left after the distance
        out = (kind, fields["v"])
        backend.pointwise(published_departure, fields, out, rows=rows, **self._rule)

        # no heat pays for the motion: it is booked as work
        ejecta = self.vapor.account(fields, rows, time)
        return ejecta._replace(work=ejecta.kinetic)
