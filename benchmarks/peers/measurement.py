"""What was measured of one program in one round, and what of it is compared."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from statistics import median
from typing import Any, Literal

Clock = Literal["wall", "processor"]


@dataclass(frozen=True)
class Measurement:
    """One program on one case.

    Attributes:
        case, program: names. threads: processors that it was given. particles: or cells.
        wall: time of a step [s]. processor: time of all processors in a step [s].
        sums: right-hand sides in a step. pairs: directed pairs within the support, of one
            right-hand side; 0 where they are not what is compared.
        detail: what else is known, by name with unit.
    """

    case: str
    program: str
    threads: int
    particles: int
    wall: float
    processor: float
    sums: int = 1
    pairs: float = 0.0
    detail: Mapping[str, float] = field(default_factory=dict)

    def time(self, clock: Clock) -> float:
        """Time of a step [s]: as it passed, or as the program had the processors."""
        return self.wall if clock == "wall" else self.processor / self.threads

    def pair_rate(self, clock: Clock) -> float:
        """Directed pairs per second [1/s], 0 where pairs are not counted."""
        return self.sums * self.pairs / self.time(clock)

    def speed(self, clock: Clock) -> float:
        """What ratios compare [1/s]: pairs per second, else steps per second."""
        return self.pair_rate(clock) or 1.0 / self.time(clock)

    def as_json(self) -> dict[str, Any]:
        """All of it as plain numbers and texts."""
        return asdict(self)


def middle(segments: list[tuple[float, float]], steps: int) -> tuple[float, float]:
    """Median wall and processor time of a step [s] from those of segments of `steps` steps."""
    return tuple(median(times) / steps for times in zip(*segments, strict=True))  # pyright: ignore[reportReturnType]
