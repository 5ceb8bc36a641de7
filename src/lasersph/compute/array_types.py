"""Types of what loops work on, wherever it lies: arrays of the particles, and rows of them."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np


class Array(Protocol):
    """An array of a backend: NumPy's on the processor, the graphics card's, the strict one.

    Outside `compute` it is handed to loops, and asked for its shape; see `Backend`.
    """

    @property
    def shape(self) -> tuple[int, ...]:
        """(n,) of a scalar field, (dim, n) of a vector field, (dim, dim, n) of a tensor field."""
        ...

    @property
    def dtype(self) -> np.dtype[Any]:
        """Kind "real", "index", "offset" or "flag" of the backend."""
        ...


Rows = Array
"""Numbers of particles, kind "index": the rows of a loop."""
