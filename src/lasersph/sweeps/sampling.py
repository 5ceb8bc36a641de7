"""Where the points of a sweep lie: grids, lists side by side, Sobol sequences, Latin hypercubes,
walks for screening.

Values of ranges are rounded to 12 digits, so that a finer grid meets the points of a coarser one.
"""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from lasersph.sweeps.points import Value

if TYPE_CHECKING:
    import numpy as np

DIGITS = 12
"""Of 16 that a number has: rounding errors of a range stay below them."""


@dataclass(frozen=True)
class Range:
    """Numbers from `first` to `last` (SI), evenly on a "linear" or "log" scale.

    Attributes:
        count: how many of a grid. is_whole: whether both ends were given as whole numbers.
    """

    first: float
    last: float
    count: int = 0
    scale: str = "linear"
    is_whole: bool = False

    def __len__(self) -> int:
        return self.count

    def __iter__(self) -> Iterator[Value]:
        return (self.at(number / (self.count - 1)) for number in range(self.count))

    def at(self, share: float) -> Value:
        """The number at a share of the way, 0 to 1; a whole one where both ends are."""
        if self.scale == "log":
            value = self.first * (self.last / self.first) ** share
        else:
            value = self.first + (self.last - self.first) * share
        # rounded, so that grids of different counts share points bit for bit
        value = float(f"{value:.{DIGITS}g}")
        return int(value) if self.is_whole and value.is_integer() else value


Choices = dict[str, Range | tuple[Value, ...]]
"""Values or range of each varied key."""


def grid(choices: Choices) -> list[dict[str, Value]]:
    """Every combination; the last key varies fastest."""
    return [
        dict(zip(choices, values, strict=True)) for values in itertools.product(*choices.values())
    ]


def paired(choices: Choices) -> list[dict[str, Value]]:
    """The first values of all keys, the second ones, and so on."""
    return [
        dict(zip(choices, values, strict=True)) for values in zip(*choices.values(), strict=True)
    ]


def sobol(choices: Choices, runs: int, seed: int) -> list[dict[str, Value]]:
    """A scrambled Sobol sequence in the box of the ranges; more runs keep the first ones."""
    from scipy.stats import qmc

    with warnings.catch_warnings():  # of numbers that are no power of two: the plan notes it
        warnings.simplefilter("ignore", UserWarning)
        # `seed` is called `rng` from SciPy 1.15 on, which takes both
        points = qmc.Sobol(len(choices), seed=_generator(seed))  # pyright: ignore[reportCallIssue]
        return _in_box(choices, points.random(runs))


def latin_hypercube(choices: Choices, runs: int, seed: int) -> list[dict[str, Value]]:
    """A Latin hypercube in the box of the ranges: each key takes `runs` evenly spread values."""
    from scipy.stats import qmc

    points = qmc.LatinHypercube(len(choices), seed=_generator(seed))  # pyright: ignore[reportCallIssue]
    return _in_box(choices, points.random(runs))


def morris(choices: Choices, trajectories: int, seed: int) -> list[dict[str, Value]]:
    """Walks through the box of the ranges, keys + 1 points each, for screening.

    Each starts at random levels, 0, 1/3, 2/3 or 1 of every range, and moves one key after the
    other, in random order, by 2/3 [Morris1991, section 3]. More trajectories keep the first ones.

    [Morris1991] Morris, Technometrics 33, 161 (1991).
    """
    import numpy as np

    rng, keys = _generator(seed), len(choices)
    walks = np.empty((trajectories, keys + 1, keys))
    for walk in walks:
        # base level 0 or 1/3, and whether the walk starts 2/3 above it and goes down
        low, is_high = rng.integers(2, size=keys) / 3.0, rng.random(keys) < 0.5
        walk[:] = np.where(is_high, low + 2.0 / 3.0, low)
        # each key moves once, and stays for all later points
        for number, key in enumerate(rng.permutation(keys), start=1):
            walk[number:, key] = low[key] if is_high[key] else low[key] + 2.0 / 3.0
    return _in_box(choices, walks.reshape(-1, keys))


def _generator(seed: int) -> np.random.Generator:
    import numpy as np

    return np.random.default_rng(seed)


def _in_box(choices: Choices, shares: np.ndarray) -> list[dict[str, Value]]:
    ranges = [one for one in choices.values() if isinstance(one, Range)]
    return [
        {key: one.at(float(share)) for key, one, share in zip(choices, ranges, row, strict=True)}
        for row in shares
    ]
