"""What the machine can do at most: bytes, operations and divisions per second.

Bandwidth is that of a = b + s c on arrays far larger than the caches, 32 B an entry: two read, one
written, and its line fetched before. Arithmetic is that of multiplications and additions on
numbers in registers, which a processor with fused multiply-add does in pairs. Divisions and roots
have a unit of their own, several times slower.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from hot_loops.counting import CountingBackend
from hot_loops.functions import chains, quotients, triad
from hot_loops.hot_loop import seconds
from hot_loops.least import Least
from lasersph.compute.backend import Backend

LARGE, SMALL, ROUNDS = 2**23, 2**16, 7
"""Entries of each array beyond the caches, of each within them per thread, and repetitions."""
LAUNCHES = 20


@dataclass(frozen=True)
class Ceilings:
    """Of some threads together: bandwidth [B/s], arithmetic [operations/s], divisions [1/s].

    device: name of the graphics card whose they are, None for the processor.
    """

    threads: int
    bandwidth: float
    arithmetic: float
    divisions: float
    device: str | None = None

    def floors(self, least: Least) -> dict[str, float]:
        """Least time [s] of each kind of work; the longest counts, as all is done together."""
        return {
            "memory": least.traffic / self.bandwidth,
            "arithmetic": least.operations / self.arithmetic,
            "division": least.divisions / self.divisions,
        }


def ceilings(backend: CountingBackend, large: int = LARGE) -> Ceilings:
    """Measure all three."""
    count = SMALL * backend.threads
    return Ceilings(
        backend.threads,
        bandwidth(backend, large),
        rate(backend, backend, chains, lambda least: least.operations, count),
        rate(backend, backend, quotients, lambda least: least.divisions, count),
    )


def bandwidth(backend: Backend, large: int = LARGE) -> float:
    """Bytes per second [B/s] between memory and processor."""
    b, c, out = (backend.zeros(large) for _ in range(3))
    for array, value in ((b, 1.0), (c, 2.0), (out, 0.0)):
        backend.fill(array, value)

    def run() -> int:
        backend.pointwise(triad, {"b": b, "c": c}, out, s=0.5)
        backend.wait()
        return 1

    # a card does not fetch the line that it writes
    passes = 4.0 if backend.device is None else 3.0
    return passes * large * backend.real.itemsize / seconds(run, ROUNDS)


def rate(
    backend: Backend,
    counting: CountingBackend,
    function: Callable,
    of: Callable[[Least], float],
    count: int,
) -> float:
    """What a function of `count` numbers does per second, of one kind, as `counting` counts it."""

    def fields_on(where: Backend, size: int) -> dict[str, Any]:
        fields = {name: where.zeros(size) for name in "abc"}
        for name, value in (("a", 0.1), ("b", 0.99), ("c", 0.01)):
            where.fill(fields[name], value)
        return fields

    many, one = fields_on(backend, count), fields_on(counting, 1)

    def run() -> int:
        for _ in range(LAUNCHES):
            backend.pointwise(function, many, None, reduce="sum")
        return LAUNCHES

    least = counting.least(lambda: counting.pointwise(function, one, None, reduce="sum"))
    return count * of(least) / seconds(run, ROUNDS)
