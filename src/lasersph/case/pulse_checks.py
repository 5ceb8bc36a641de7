"""Checks of pulse trains and of the pauses between their pulses."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lasersph.case.solver_choice import computes_flow
from lasersph.input import format_quantity

if TYPE_CHECKING:
    from lasersph.case.contents import CaseContents


def pulse_problems(case: CaseContents) -> Iterator[tuple[str, str]]:
    """(key, "what is wrong; what would be right") of all that concerns several pulses."""
    has_pool = computes_flow(case.solver) and case.flow is None
    if case.time.pause is not None:
        if case.laser is None or case.laser.pulse.count == 1:
            yield "time.pause", "says nothing with one pulse; leave it out, or give more pulses"
            return
        if case.pause != "compute" and not has_pool:
            yield (
                "time.pause",
                f'"{case.pause}" jumps over pauses of melt pools only; leave it out, or write '
                'kind = "melt-pool" in [solver]',
            )
            return
    if case.laser is None or case.pause == "compute":
        return
    pulse = case.laser.pulse
    if pulse.interval is not None and pulse.interval <= pulse.window[1]:
        yield (
            "laser.pulse." + ("period" if pulse.period else "repetition_rate"),
            f"the light of a pulse ends {format_quantity(pulse.window[1], 's', 4)} after its "
            f"start, a period of {format_quantity(pulse.interval, 's')} leaves no pause; write "
            'pause = "compute" in [time], or give a longer period',
        )
    elif case.end_of_pulse <= pulse.window[1]:
        start = case.time.end - case.end_of_pulse
        right = start + max(case.time.end, 2.0 * pulse.window[1])
        yield (
            "time.end",
            f"pulse {pulse.count} begins at {format_quantity(start, 's')} and is not over then; "
            f'write e.g. end = "{format_quantity(right, "s", 10)}"',
        )
