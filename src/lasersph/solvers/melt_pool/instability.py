"""Where a flow has become unstable: speeds that have grown beyond what can be."""

from __future__ import annotations

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.input import format_quantity
from lasersph.solvers.melt_pool.domain import PoolDomain
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.solvers.step_control import NotConverged

MIN_CROSSING_TIME = 1e-9
"""Time in which the fastest particle crosses its support, over the time to compute. Guard: in a
flow that takes less its speeds have grown without bound."""


def refuse_unstable(flow: Flow, domain: PoolDomain, position: Array, time: float) -> None:
    """Stop a flow that has become unstable.

    Args:
        position: (d, n) [m]. time: to compute [s].

    Raises:
        NotConverged: with the speed, the place and what to change.
    """
    speed = flow.largest_speed
    is_possible = speed <= domain.surface.largest_speed
    if is_possible and speed * MIN_CROSSING_TIME * time <= domain.support:
        return
    # the fastest particle, for the message
    host = flow.backend.to_host
    fastest = int(np.argmax(np.sum(host(flow.velocity) ** 2, axis=0)))
    place = host(position)[:, fastest]
    at = ", ".join(
        f"{axis} = {format_quantity(float(one), 'm', 3)}"
        for axis, one in zip("xz" if place.size == 2 else "xyz", place, strict=True)
    )
    raise NotConverged(
        f"the flow has become unstable: {speed:.3g} m/s at {at}; take another particles.spacing, "
        "a weaker drive or an earlier end"
    )
