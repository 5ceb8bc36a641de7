"""Center lines of the lid-driven cavity: finite differences, and Ghia's table with its misprints.

The finite differences are our own and judge; the tables of Ghia, Ghia & Shin (1982) are drawn
beside them. They differ by a smooth error of up to 0.018 of the lid's speed; two entries leave it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lasersph.validation.references import read_table

REYNOLDS_NUMBERS = (100, 400, 1000)
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
    """The tables for "u" or "v" at a Reynolds number of REYNOLDS_NUMBERS."""
    own = read_table(f"ldc_fd_reference_{component}.csv")
    printed = read_table(f"ghia1982_{component}.csv")
    value, ghia = own[f"Re{reynolds}"], printed[f"Re{reynolds}"]
    return CenterLine(
        component, own["k"] / 128.0, value, own[f"err{reynolds}"], ghia, misprints(ghia - value)
    )


def misprints(deviation: np.ndarray) -> np.ndarray:
    """Which deviations (m,) of a table stand out from those of the two neighbors on each side."""
    size = np.abs(deviation)
    padded = np.concatenate([[0.0, 0.0], size, [0.0, 0.0]])
    around = np.max([padded[k : k + size.size] for k in (0, 1, 3, 4)], axis=0)
    return (size > STANDS_OUT * around) & (size > LEAST)
