"""Measuring: the ceilings and all hot loops for each number of threads, and for each size."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from hot_loops import loops
from hot_loops.ceilings import LARGE, Ceilings, ceilings
from hot_loops.counting import CountingBackend
from hot_loops.hot_loop import HotLoop, seconds
from hot_loops.least import Least
from hot_loops.particles import jittered
from hot_loops.solves import hot_solves
from lasersph import compute
from lasersph.compute.backend import Backend
from lasersph.sph.kernels import kernel

KERNEL = "wendland-c2"
ROUNDS = 5
BYTES_PER_PARTICLE = 2700.0
"""Most memory that any of the loops takes, with its list of pairs and while that is made: that of
shifting in 3-D, with the kernel gradients of 90 pairs a particle."""


@dataclass(frozen=True)
class Measured:
    """A loop's numbers per particle and pass.

    Attributes:
        count: particles. least: what it must move and compute. floors: least times that memory,
            arithmetic and division set [s]. time: measured [s].
    """

    name: str
    count: int
    threads: int
    least: Least
    floors: dict[str, float]
    time: float

    @property
    def limit(self) -> str:
        """What sets the floor."""
        return max(self.floors, key=lambda name: self.floors[name])

    @property
    def floor(self) -> float:
        """Least time that the ceilings allow [s]."""
        return self.floors[self.limit]

    @property
    def ratio(self) -> float:
        """Measured time over the floor; below 1 only where arrays stay in the caches."""
        return self.time / self.floor


def memory(size: int) -> float:
    """Memory that `measure` takes at most for so many particles [B]."""
    return 3.0 * 8.0 * LARGE + BYTES_PER_PARTICLE * size


def measure(
    sizes: tuple[int, ...],
    threads: int | None = None,
    *,
    large: int = LARGE,
    report: Callable[[Ceilings | Measured], None],
) -> None:
    """Hand each result to `report` as soon as there is one.

    Args:
        sizes: wanted numbers of particles; used is the nearest square and cube.
        threads: most of them; all sizes are measured with these, the largest with 1, 2, 4, ...
        large: see `ceilings.LARGE`.
    """
    most = compute.cpu(threads).threads
    for count in _numbers_of_threads(most):
        backend = CountingBackend(count)
        limits = ceilings(backend, large)
        report(limits)
        for size in sorted(sizes) if count == most else (max(sizes),):
            for loop in loops_of(backend, size):
                report(_measured(backend, loop, limits))
                del loop  # its arrays, before the next one makes its own


def least_of_loop(backend: CountingBackend, loop: HotLoop) -> Least:
    """What a loop must move and compute, per particle and pass."""
    least = loop.least
    if least is None:
        passes = loop.run()
        least = backend.least(loop.run).times(1.0 / passes)
    return least.times(1.0 / loop.count)


def _measured(backend: CountingBackend, loop: HotLoop, limits: Ceilings) -> Measured:
    least = least_of_loop(backend, loop)
    time = seconds(loop.run, ROUNDS) / loop.count
    return Measured(loop.name, loop.count, limits.threads, least, limits.floors(least), time)


def loops_of(backend: Backend, size: int) -> Iterator[HotLoop]:
    """All loops in 2-D, then those that differ in 3-D; each is made when it is asked for."""
    for dimension in (2, 3):
        edge = max(2, round(size ** (1.0 / dimension)))
        neighbors = jittered(backend, edge, kernel(KERNEL, dimension))
        yield loops.pair_sum(backend, neighbors)
        yield loops.list_build(backend, neighbors)
        yield loops.shifting(backend, neighbors)
        if dimension == 2:
            yield loops.enthalpy_update(backend, edge**2)
            yield from hot_solves(backend, neighbors)


def _numbers_of_threads(most: int) -> list[int]:
    numbers = {most}
    while most > 1:
        most = 1 << ((most - 1).bit_length() - 1)
        numbers.add(most)
    return sorted(numbers)
