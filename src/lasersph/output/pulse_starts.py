"""When the pulses of a train begin, and which of them a time follows."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from typing import Any

START_SHARE = 1.0 - 1e-12
"""Of the time at which a pulse begins: at it, but for rounding."""


def pulse_at(time: float, starts: Sequence[float]) -> int:
    """Number of the pulse that a time follows, from 0; `starts` [s] in their order, not empty."""
    return max(bisect_right([start * START_SHARE for start in starts], time) - 1, 0)


def starts_of_pulses(case: Mapping[str, Any]) -> list[float]:
    """Times at which the clocks of the pulses of a train begin within a run [s]; none of one pulse.

    Args:
        case: as `Run.case`, with every default.
    """
    pulse = (case.get("laser") or {}).get("pulse") or {}
    # Rate and period say the same; the case has one of the two.
    count, rate = int(pulse.get("count") or 1), pulse.get("repetition_rate")
    period = 1.0 / rate if rate else pulse.get("period")
    if count == 1 or not period:
        return []
    return [k * period for k in range(count) if k * period < case["time"]["end"]]
