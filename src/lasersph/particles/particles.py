"""`Particles`: the fields of a run's particles, or of the columns of a surface, by name.

Arrays are made once, with room for `capacity` particles, and keep their identity: recorded loops
bind them, and restoring a checkpoint or going back copies values into them. Nothing grows silently.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.particles.fields import FIELDS, Field


class Particles:
    """Fields of the particles of one backend.

    Args:
        fields: names from the table of fields, or fields of one's own.
        capacity: length of the arrays; default: the count.

    Attributes:
        count: particles of the body, which come first; others, such as walls, follow.
        dimension: of space. table: the fields by name.
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        dimension: int,
        fields: tuple[str | Field, ...] = (),
        *,
        capacity: int | None = None,
    ) -> None:
        self.backend, self.count, self.dimension = backend, count, dimension
        self.capacity = count if capacity is None else capacity
        if self.capacity < self.count:
            raise ValueError(f"{count} particles in arrays of {self.capacity}")
        self.table: dict[str, Field] = {}
        self._arrays: dict[str, Array] = {}
        self._saved: dict[str, Array] = {}
        self.add(*fields)

    def add(self, *fields: str | Field) -> None:
        """Make arrays of zeros for further fields.

        Raises:
            KeyError: a name that the table of fields lacks. ValueError: a field that is there.
        """
        for given in fields:
            field = FIELDS[given] if isinstance(given, str) else given
            if field.name in self.table:
                raise ValueError(f"particles already have the field {field.name}")
            # (n,), (dim, n) or (dim, dim, n)
            lead = {"scalar": 0, "vector": 1, "tensor": 2}[field.shape] * (self.dimension,)
            self.table[field.name] = field
            self._arrays[field.name] = self.backend.zeros((*lead, self.capacity), field.storage)

    def keep(self, *names: str) -> None:
        """Let a checkpoint hold fields that are derived as a rule."""
        for name in names:
            self.table[name] = replace(self.table[name], is_kept=True)

    def __getitem__(self, name: str) -> Array:
        """The array of a field; the same one at every call."""
        return self._arrays[name]

    def __contains__(self, name: object) -> bool:
        return name in self._arrays

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def by_symbol(self, *names: str) -> dict[str, Array]:
        """Arrays of these fields, or of all, by the symbols that loops know them by."""
        return {self.table[name].symbol: self._arrays[name] for name in names or self._arrays}

    def set(self, name: str, values: np.ndarray) -> None:
        """Copy host values into a field, of the same shape."""
        array = self.backend.asarray(values, self.table[name].storage)
        self.backend.copy(array, self._arrays[name])

    @property
    def kept(self) -> dict[str, Array]:
        """Arrays that a checkpoint holds, by name."""
        return {name: self._arrays[name] for name, field in self.table.items() if field.is_kept}

    def restore(self, arrays: Mapping[str, np.ndarray]) -> None:
        """Copy the arrays of a checkpoint into the kept fields; derived ones are left as they are.

        Raises:
            ValueError: a field is missing or has another shape.
        """
        missing = [name for name in self.kept if name not in arrays]
        if missing:
            raise ValueError(f"the checkpoint lacks {', '.join(missing)}")
        for name in self.kept:
            self.set(name, arrays[name])

    def save(self) -> None:
        """Remember the kept fields, for `go_back`."""
        # copies are made at the first call: few runs go back
        if not self._saved.keys() >= self.kept.keys():
            for name, array in self.kept.items():
                self._saved[name] = self.backend.zeros(array.shape, self.table[name].storage)
        self._copy_kept()

    @graph
    def _copy_kept(self) -> None:
        """Copy the kept fields into what is saved of them."""
        for name, array in self.kept.items():
            self.backend.copy(array, self._saved[name])

    def go_back(self) -> None:
        """Give the kept fields the values that `save` remembered."""
        for name, array in self._saved.items():
            self.backend.copy(array, self._arrays[name])
