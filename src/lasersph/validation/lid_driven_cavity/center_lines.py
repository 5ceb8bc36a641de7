"""Center lines of the cavity: finite differences, and Ghia's table with its misprints."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lasersph.validation.study import home_of
from lasersph.validation.tables import read_table

HOME = home_of("lid-driven-cavity")
STANDS_OUT = 5.0
"""A misprint deviates from the finite differences this many times more than its neighbors do."""
LEAST = 5e-4
"""... and by more than this share of the speed of the lid."""


@dataclass(frozen=True)
class CenterLine:
    """u on the vertical ("u") or w on the horizontal center line ("v") at one Reynolds number.

    Attributes:
        component: "u" or "v". share: (m,) places in parts of the side from bottom or left.
        value, error: (m,) by finite differences, and its estimated error, over the lid's speed.
        ghia: (m,) as printed. is_misprint: (m,) whether that leaves its neighbors' deviation.
    """

    component: str
    share: np.ndarray
    value: np.ndarray
    error: np.ndarray
    ghia: np.ndarray
    is_misprint: np.ndarray

    @property
    def inner(self) -> np.ndarray:
        """(m,) places between the walls, where the velocity is not given."""
        return (self.share > 0.0) & (self.share < 1.0)


def center_line(component: str, reynolds: int) -> CenterLine:
    """The tables for "u" or "v" at Reynolds number 100, 400 or 1000."""
    # Finite differences of our own, and the printed table.
    own = read_table(HOME / f"ldc_fd_reference_{component}.csv")
    printed = read_table(HOME / f"ghia1982_{component}.csv")
    value, ghia = own[f"Re{reynolds}"], printed[f"Re{reynolds}"]
    return CenterLine(
        component, own["k"] / 128.0, value, own[f"err{reynolds}"], ghia, misprints(ghia - value)
    )


def misprints(deviation: np.ndarray) -> np.ndarray:
    """Which deviations (m,) of a table stand out from those of the two neighbors on each side."""
    # Two neighbors on each side, without the number itself.
    size = np.abs(deviation)
    padded = np.concatenate([[0.0, 0.0], size, [0.0, 0.0]])
    around = np.max([padded[k : k + size.size] for k in (0, 1, 3, 4)], axis=0)
    return (size > STANDS_OUT * around) & (size > LEAST)
