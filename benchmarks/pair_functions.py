"""Pair functions that the benchmarks time."""

from hot_loops.functions import flow, right_hand_side, same

from lasersph.particles.support import arithmetic as arithmetic_mean

__all__ = [
    "arithmetic_mean", "flow", "right_hand_side", "same", "wendland_shape", "wendland_slope",
]  # fmt: skip


def wendland_shape(s):
    """Wendland C2 kernel in 3-D, (1 - s)^4 (1 + 4 s)."""
    return (1 - s) ** 4 * (1 + 4 * s)


def wendland_slope(s):
    """Its derivative, -20 s (1 - s)^3."""
    return -20 * s * (1 - s) ** 3
