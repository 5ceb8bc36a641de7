"""Array in a graphics card's memory as observers see it: copied as far as it is looked at.

To NumPy it is an array that cannot be written. Listed particles, the first ones, components and
the extremes of a scalar come without the rest; anything else copies the whole, once.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from lasersph.compute.cuda_array import CudaArray

_ALL = slice(None)


class FarArray(NDArrayOperatorsMixin):
    """What `look` gives of an array (n,), (dim, n) or (dim, dim, n) on a card.

    Args:
        backend: whose array it is. array: not to be written while this is in use.

    Raises:
        RuntimeError: when looked at after the array was written.
    """

    def __init__(self, backend: Any, array: CudaArray) -> None:
        self._backend, self._array = backend, array
        self._version = array.memory.version
        self._whole: np.ndarray | None = None
        self._ends: tuple[float, float] | None = None
        self.shape, self.dtype, self.ndim, self.size = (
            array.shape, array.dtype, array.ndim, array.size,
        )  # fmt: skip

    # --- the whole ------------------------------------------------------------------------------

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        whole = self._fetched()
        is_other = dtype is not None and dtype != self.dtype
        return whole.astype(dtype or self.dtype) if copy or is_other else whole

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        given = [one._fetched() if isinstance(one, FarArray) else one for one in inputs]
        return getattr(ufunc, method)(*given, **options)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(self._fetched(), name)

    def __len__(self) -> int:
        return self.shape[0]

    def _fetched(self) -> np.ndarray:
        if self._whole is None:
            self._refuse_written()
            self._whole = self._array.to_host()
            self._whole.flags.writeable = False
        return self._whole

    def _refuse_written(self) -> None:
        if self._array.memory.version != self._version:
            raise RuntimeError("an array was looked at after it had been written")

    # --- parts of it ----------------------------------------------------------------------------

    def max(self, axis: Any = None, out: Any = None, **options: Any) -> Any:
        """As NumPy's; the largest of a scalar is found on the card."""
        if axis is None and not options and self._is_scalar:
            return self._extremes()[1]
        return self._fetched().max(axis, out, **options)

    def min(self, axis: Any = None, out: Any = None, **options: Any) -> Any:
        """As NumPy's; the smallest of a scalar is found on the card."""
        if axis is None and not options and self._is_scalar:
            return self._extremes()[0]
        return self._fetched().min(axis, out, **options)

    @property
    def _is_scalar(self) -> bool:
        real = self.dtype == self._backend.real
        return self._whole is None and self.ndim == 1 and self.size > 0 and real

    def _extremes(self) -> tuple[float, float]:
        ends = self._ends
        if ends is None:
            self._refuse_written()
            ends = self._ends = self._backend.extremes(self._array)
        return ends

    def __getitem__(self, index: Any) -> Any:
        if self._whole is not None or self.ndim > 2:
            return self._fetched()[index]
        component, particles = self._split(index)
        array = self._array
        if isinstance(component, int | np.integer) and -self.shape[0] <= component < self.shape[0]:
            array, component = array.component(int(component) % self.shape[0]), _ALL
        elif component != _ALL and self._is_head(particles):
            return self._fetched()[index]
        if self._is_head(particles):
            stop = self.shape[-1] if particles.stop is None else min(particles.stop, self.shape[-1])
            return FarArray(self._backend, array.head(stop))
        if isinstance(particles, int | np.integer):
            return self._listed(array, np.array([particles]))[..., 0][()]
        if isinstance(particles, np.ndarray) and particles.dtype.kind in "iu":
            found = self._listed(array, particles)
            return found if component == _ALL else found[component]
        return self._fetched()[index]

    def _split(self, index: Any) -> tuple[Any, Any]:
        """Which components and which particles an index means."""
        if isinstance(index, tuple) and len(index) == 2:
            component, particles = index
            return (_ALL, particles) if component is Ellipsis else (component, particles)
        if self.ndim == 1:
            return _ALL, index
        return (index, _ALL) if isinstance(index, int | np.integer) else (_ALL, None)

    def _is_head(self, particles: Any) -> bool:
        """Whether an index means the first particles, or all."""
        if not isinstance(particles, slice) or particles.step is not None:
            return False
        return particles.start in (None, 0) and (particles.stop is None or particles.stop >= 0)

    def _listed(self, array: CudaArray, rows: np.ndarray) -> np.ndarray:
        """Values of the particles at `rows`, (..., k)."""
        self._refuse_written()
        count = self.shape[-1]
        if rows.size and not -count <= rows.min() <= rows.max() < count:
            raise IndexError(f"particles {rows.min()} to {rows.max()} of {count}")
        out = self._backend.empty((*array.shape[:-1], rows.size), self.dtype)
        order = self._backend.asarray(np.where(rows < 0, rows + count, rows), "index")
        self._backend.gather(array, order, out)
        return out.to_host()
