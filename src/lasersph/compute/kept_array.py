"""Arrays whose length changes a little from time to time, in memory that stays.

Lists of pairs get longer and shorter as particles move. An array made anew for each length stands
beside the one before, which loops of the last step still hold, and leaves a hole when that goes.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend

SHARE = 4
"""Guard: memory is given back where fewer elements are wanted than one in so many of those that
were written, so that a pool which freezes leaves none behind."""


class KeptArray:
    """An array of a length that changes: the first elements of memory with room.

    Args:
        components: shape before the last axis. kind: of the elements, see `Backend.kind`.
    """

    def __init__(self, backend: Backend, *components: int, kind: str = "real") -> None:
        self.backend, self._components, self._kind = backend, components, kind
        self._memory = self._array = backend.zeros((*components, 0), kind)
        self._written = 0

    def of(self, count: int) -> Array:
        """(..., count) the array, the same one until another length is asked for.

        Its elements are then those of an earlier one, or 0.
        """
        # memory for more, or without what far more have written
        if self._memory.shape[-1] < count or SHARE * count < self._written:
            shape = (*self._components, self.backend.capacity_for(count))
            self._memory, self._written = self.backend.zeros(shape, self._kind), 0
        self._written = max(self._written, count)
        if self._array.shape[-1] != count:
            self._array = self.backend.head(self._memory, count)
        return self._array
