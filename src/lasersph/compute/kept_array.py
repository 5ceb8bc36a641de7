"""Arrays whose length changes a little from time to time, in memory that stays.

Lists of pairs get longer and shorter as particles move. An array made anew for each length stands
beside the one before, which loops of the last step still hold, and leaves a hole when that goes.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend

RESERVE = 1
"""Guard: elements that there is room for behind those asked for, over their number. Memory of the
processor is not taken before it is written."""


class KeptArray:
    """An array of a length that changes: the first elements of memory with room.

    Args:
        components: shape before the last axis. kind: of the elements, see `Backend.kind`.
    """

    def __init__(self, backend: Backend, *components: int, kind: str = "real") -> None:
        self.backend, self._components, self._kind = backend, components, kind
        self._memory = self._array = backend.zeros((*components, 0), kind)

    def of(self, count: int) -> Array:
        """(..., count) the array, the same one until another length is asked for.

        Its elements are then those of any earlier one, and 0 where there was none.
        """
        if self._memory.shape[-1] < count:
            shape = (*self._components, (1 + RESERVE) * count)
            self._memory = self.backend.zeros(shape, self._kind)
        if self._array.shape[-1] != count:
            self._array = self.backend.head(self._memory, count)
        return self._array
