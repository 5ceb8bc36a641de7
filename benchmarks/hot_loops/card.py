"""Measuring on a graphics card: the same loops, beside the card's own ceilings.

What a loop must move and compute at least is counted on the processor, for fewer particles: per
particle it is the same. Times hold the waiting until the card is done.
"""

from __future__ import annotations

from collections.abc import Callable

from hot_loops.ceilings import LARGE, Ceilings, bandwidth, rate
from hot_loops.counting import CountingBackend
from hot_loops.functions import chains, quotients
from hot_loops.hot_loop import HotLoop, seconds
from hot_loops.least import Least
from hot_loops.measure import ROUNDS, Measured, least_of_loop, loops_of
from lasersph import compute
from lasersph.compute.backend import Backend

COUNTED = 125_000
"""Particles of the loops that are counted: enough for few to lie at the edges."""


def measure_card(
    sizes: tuple[int, ...],
    *,
    large: int = LARGE,
    counted: int = COUNTED,
    report: Callable[[Ceilings | Measured], None],
) -> None:
    """Hand each result to `report` as soon as there is one; args as of `measure`.

    Raises:
        NoDevice: there is no card.
    """
    card, host = compute.cuda(), CountingBackend(1)
    limits = Ceilings(
        1,
        bandwidth(card, large),
        rate(card, host, chains, lambda least: least.operations, large),
        rate(card, host, quotients, lambda least: least.divisions, large),
        card.device,
    )
    report(limits)
    least: dict[str, Least] = {}
    for loop in loops_of(host, counted):
        least[loop.name] = least_of_loop(host, loop)
        del loop
    for size in sorted(sizes):
        for loop in loops_of(card, size):
            if loop.name in least:
                report(_measured(card, loop, least[loop.name], limits))
            del loop


def _measured(card: Backend, loop: HotLoop, least: Least, limits: Ceilings) -> Measured:
    def run() -> int:
        passes = loop.run()
        card.wait()
        return passes

    time = seconds(run, ROUNDS) / loop.count
    return Measured(loop.name, loop.count, limits.threads, least, limits.floors(least), time)
