"""The measured loops as rows of text and as numbers for a file, every one with its unit."""

from __future__ import annotations

from hot_loops.ceilings import Ceilings
from hot_loops.measure import Measured

HEADER = (
    "loop", "threads", "bytes", "operations", "divisions", "floor [ns]", "set by",
    "time [ns]", "time / floor", "GB/s", "speed-up",
)  # fmt: skip


def ceilings_line(limits: Ceilings) -> str:
    """One line for a number of threads."""
    where = limits.device or f"{limits.threads} thread{'s' if limits.threads > 1 else ''}"
    return (
        f"{where}:"
        f" {1e-9 * limits.bandwidth:.1f} GB/s, per second {1e-9 * limits.arithmetic:.1f} billion"
        f" multiplications and additions, {1e-9 * limits.divisions:.2f} billion divisions"
    )


def table(loops: list[Measured]) -> list[tuple[str, ...]]:
    """Header and the largest size's loops: per particle and pass, threads below each other."""
    rows = _sorted([one for one in loops if one.count == _largest(loops, one.name)])
    single = {one.name: one.time for one in rows if one.threads == 1}
    return [HEADER, *(_row(one, single[one.name]) for one in rows)]


def growth(loops: list[Measured]) -> list[tuple[str, ...]]:
    """Header and each loop's time per particle [ns] at all sizes, with all threads."""
    most = max(one.threads for one in loops)
    rows = _sorted([one for one in loops if one.threads == most])
    times: dict[str, list[Measured]] = {}
    for one in rows:
        times.setdefault(one.name, []).append(one)
    first = max(times.values(), key=len)
    header = ("loop", *(f"{one.count} particles [ns]" for one in first))
    lines = [(name, *(f"{1e9 * one.time:.2f}" for one in some)) for name, some in times.items()]
    return [header, *lines]


def _largest(loops: list[Measured], name: str) -> int:
    return max(one.count for one in loops if one.name == name)


def _sorted(loops: list[Measured]) -> list[Measured]:
    """Rows of one loop together, by size and threads."""
    order = {name: k for k, name in enumerate(dict.fromkeys(one.name for one in loops))}
    return sorted(loops, key=lambda one: (order[one.name], one.count, one.threads))


def _row(one: Measured, single: float) -> tuple[str, ...]:
    least = one.least
    return (
        one.name, str(one.threads), f"{least.traffic:.0f}", f"{least.operations:.0f}",
        f"{least.divisions:.0f}", f"{1e9 * one.floor:.2f}", one.limit,
        f"{1e9 * one.time:.2f}", f"{one.ratio:.1f}", f"{1e-9 * least.traffic / one.time:.1f}",
        f"{single / one.time:.2f}",
    )  # fmt: skip


def as_dict(limits: list[Ceilings], loops: list[Measured]) -> dict[str, list[dict]]:
    """The same numbers in SI units, per particle and pass."""
    return {
        "ceilings": [
            {
                "threads": one.threads,
                "device": one.device,
                "bandwidth_B_s": one.bandwidth,
                "arithmetic_operations_s": one.arithmetic,
                "divisions_s": one.divisions,
            }
            for one in limits
        ],
        "loops": [
            {
                "name": one.name,
                "particles": one.count,
                "threads": one.threads,
                "bytes_per_particle": one.least.traffic,
                "operations_per_particle": one.least.operations,
                "divisions_per_particle": one.least.divisions,
                "floor_s": one.floor,
                "floor_set_by": one.limit,
                "time_s": one.time,
                "time_over_floor": one.ratio,
            }
            for one in loops
        ],
    }
