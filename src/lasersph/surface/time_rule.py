"""Time at which forces act in a step: at its end, or in its middle.

Below a surface that moves particles, heights and viscosity are of second order in time; then what
a step finds holds in its middle, and goes on to its end by as much again.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend


def continue_from_middle(v, v_old):
    """Velocity at the end of a step from that in the middle [m/s]."""
    return 2.0 * v - v_old


class WholeStep:
    """Forces of the end of a step: the published scheme.

    Attributes:
        share: of the step after which the positions, at which forces are found, and the velocity
            that viscosity sees lie.
    """

    share = 1.0

    def finish(self, backend: Backend, v: Array, v_old: Array) -> None:
        """Carry the velocity (d, n) [m/s] on to the end of the step, from v_old at its begin."""


class Midpoint(WholeStep):
    """Forces of the middle of a step."""

    share = 0.5

    def finish(self, backend: Backend, v: Array, v_old: Array) -> None:
        """v + (v - v_old)."""
        backend.pointwise(continue_from_middle, {"v": v, "v_old": v_old}, v)
