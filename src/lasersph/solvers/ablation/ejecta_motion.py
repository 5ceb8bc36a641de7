"""Flight of what has been ejected: straight on, until it passes the edge of what is followed."""

from __future__ import annotations

from lasersph.physics.ejection import EJECTED, GONE


def beyond(x, low, high):
    """How far a coordinate lies outside an interval [m], 0 inside."""
    return max(low - x, 0.0) + max(x - high, 0.0)


def outside(x, low, high):
    """Sum over the axes of how far a position lies outside a box [m], 0 inside."""
    if len(x) == 1:
        return beyond(x[0], low[0], high[0])
    if len(x) == 2:
        return beyond(x[0], low[0], high[0]) + beyond(x[1], low[1], high[1])
    return (
        beyond(x[0], low[0], high[0])
        + beyond(x[1], low[1], high[1])
        + beyond(x[2], low[2], high[2])
    )


def flown(x, v, kind, step, low, high):
    """Position [m] and kind after a step [s], and 1 for what has passed the edge in it.

    Args:
        low, high: corners of the box in which ejecta are followed [m].
    """
    if kind != EJECTED:
        return x, kind, 0.0
    new = x + step * v
    if outside(new, low, high) > 0.0:
        return new, GONE, 1.0
    return new, EJECTED, 0.0
