"""Ejection as published: from the boiling temperature on with the velocity of the vapor.

A particle that leaves keeps absorbing until it has left [Alshaer2017, Sections 3.3 and 4.4]. There
are no latent heats, and the depth depends on when a particle counts as left.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.particles.kinds import LEAVING
from lasersph.physics.ejection import (
    BELOW_ALIGNMENT,
    BELOW_REACH,
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
        self.backend, self.vapor, self.left_after = backend, vapor, left_after
        self.reach = BELOW_REACH * spacing
        self._covered = backend.zeros(count)

    def longest_step(self, flux: float, density: float) -> float:
        """No limit: the rule depends on the step, as published."""
        return np.inf

    def eject(
        self, fields: dict[str, Any], pairs: Any, rows: Any, time: float, step: float
    ) -> Ejecta:
        """Set kind, velocity, left_at and p_v of what leaves at `time`, the end of the step [s].

        Args:
            fields: by symbol; kind, lift, v, h, T, m, exposed, normal, left_at, p_v.
        """
        backend, kind, v = self.backend, fields["kind"], fields["v"]
        own = fields | {"covered": self._covered}
        backend.pointwise(advance_lift, own, fields["lift"], rows=rows, step=step)
        leaving = backend.rows_where(kind, LEAVING)
        backend.pair_sum(
            covers_neighbor, pairs, own, self._covered, rows=leaving, reach=self.reach,
            alignment=BELOW_ALIGNMENT,
        )  # fmt: skip
        backend.pointwise(
            published_departure, own, (kind, v), rows=rows, T_v=self.vapor.temperature,
            R_s=self.vapor.gas_constant, is_effusion=self.vapor.is_effusion,
            distance=self.left_after,
        )  # fmt: skip
        return self.vapor.account(fields, rows, time)
