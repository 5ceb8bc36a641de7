"""Types of what loops work on, wherever it lies: arrays of the particles, and rows of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
    def dtype(self) -> np.dtype:
        """Kind "real", "index", "offset" or "flag" of the backend."""
        ...

    @property
    def size(self) -> int:
        """Number of elements."""
        ...


Rows = Array
"""Numbers of particles, kind "index": the rows of a loop."""

Constants = dict[str, Any]
"""Numbers, tuples of numbers and tables that a loop takes by name."""
Outputs = Array | None | Sequence[Array | None]
"""One array or several that a loop writes; None where a result is not stored."""


class PairList(Protocol):
    """Members of a neighbor list that loops read; see `particles.neighbor_lists.NeighborList`."""

    @property
    def row_start(self) -> Array:
        """(n + 1,) kind "offset": where the pairs of each row begin, and their number."""
        ...

    @property
    def row_end(self) -> Array | None:
        """(n,) kind "offset": where they end; None where a row ends with the next one."""
        ...

    @property
    def neighbor(self) -> Array:
        """(pairs,) kind "index"."""
        ...

    @property
    def position(self) -> Array | None:
        """(dim, N) [m]; None where no loop reads it."""
        ...

    @property
    def support(self) -> Array | None:
        """(N,) [m]; None where no loop reads it."""
        ...

    @property
    def kernel(self) -> Any:
        """The kernel, with plain functions for its values."""
        ...

    @property
    def mean(self) -> Callable[[float, float], float]:
        """l_ij of l_i and l_j."""
        ...

    @property
    def period(self) -> tuple[float, ...]:
        """Width of the box per axis [m], 0.0 where not periodic; () for no periodic axis."""
        ...
