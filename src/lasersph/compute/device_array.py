"""Array in a graphics card's memory as observers see it: copied as far as it is looked at.

To NumPy it is an array that cannot be written. Listed particles come without the rest; what the
functions of `device_functions` make of arrays, numbers and host arrays of one value stays on the
card; anything else copies the whole, once.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from lasersph.compute import device_functions, device_reductions
from lasersph.compute.cuda_array import CudaArray

_ALL = slice(None)


class DeviceArray(NDArrayOperatorsMixin):
    """View for reading of an array (n,), (dim, n) or (dim, dim, n) on a card.

    Args:
        backend: whose array it is. array: not to be written while this is in use. is_truth:
            whether its flags say yes or no. whole: the same on the host, where it is known.

    Raises:
        RuntimeError: when looked at after the array was written.
    """

    def __init__(
        self,
        backend: Any,
        array: CudaArray,
        *,
        is_truth: bool = False,
        whole: np.ndarray | None = None,
    ) -> None:
        self._backend, self._array = backend, array
        self._version = array.version
        self._whole = whole
        self._ends: tuple[float, float] | None = None
        self.shape, self.ndim, self.size = array.shape, array.ndim, array.size
        self.dtype = np.dtype(bool) if is_truth else array.dtype

    # --- the whole ------------------------------------------------------------------------------

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        whole = self._fetched()
        is_other = dtype is not None and dtype != self.dtype
        return whole.astype(dtype or self.dtype) if copy or is_other else whole

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        # on the card where that is known, else with copies on the host
        found = NotImplemented
        if method == "__call__" and not options:
            found = self._computed(ufunc, inputs)
        if found is not NotImplemented:
            return found
        return getattr(ufunc, method)(*map(_on_host, inputs), **options)

    def __array_function__(self, function: Any, types: Any, args: Any, kwargs: Any) -> Any:
        # choices and reductions that need no copy
        if function is np.where and len(args) == 3:
            found = self.elementwise(device_functions.chosen, args)
        else:
            reduction = device_reductions.FUNCTIONS.get(function)
            found = NotImplemented if reduction is None else reduction(*args, **kwargs)
        if found is not NotImplemented:
            return found
        # everything else on the host
        named = {name: _on_host(one) for name, one in kwargs.items()}
        return function(*map(_on_host, args), **named)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(self._fetched(), name)

    def __len__(self) -> int:
        return self.shape[0]

    def _fetched(self) -> np.ndarray:
        if self._whole is None:
            self._refuse_written()
            self._whole = self._array.to_host().astype(self.dtype, copy=False)
            self._whole.flags.writeable = False
        return self._whole

    def _refuse_written(self) -> None:
        if self._array.version != self._version:
            raise RuntimeError("an array was looked at after it had been written")

    # --- on the card ----------------------------------------------------------------------------

    @property
    def is_truth(self) -> bool:
        """Whether its elements say yes or no."""
        return self.dtype == bool

    @property
    def is_known(self) -> bool:
        """Whether the host has a copy."""
        return self._whole is not None

    def components(self) -> list[CudaArray]:
        """The components (n,) of a scalar or vector.

        Raises:
            RuntimeError: the array has been written.
        """
        self._refuse_written()
        return [self._array.component(k) for k in range(len(self._array.parts))]

    def reduced(self, how: str) -> list[float]:
        """The "sum", "max" or "min" of each component."""
        run, value = self._backend.pointwise, device_functions.value
        return [run(value, {"a": one}, (None,), reduce=(how,))[0] for one in self.components()]

    def rows(self) -> CudaArray:
        """Numbers of the elements of a scalar that say yes."""
        (flags,) = self.components()
        return self._backend.rows_where(flags, 1.0)

    def elementwise(self, function: Any, inputs: Any, *, is_truth: bool = False) -> Any:
        """Device array of a plain function of device arrays, numbers and host arrays of one value.

        NotImplemented where there is anything else.
        """
        # all operands by component, or none of it on the card
        found = [self._operand(one) for one in inputs]
        operands = [one for one in found if one is not None]
        if len(operands) < len(found) or self.ndim > 2:
            return NotImplemented
        backend = self._backend
        out = backend.empty(self.shape, np.uint8 if is_truth else backend.real)
        # a loop for each component: arrays are its fields, numbers its constants
        for k in range(len(out.parts)):
            names = function.__code__.co_varnames[: len(operands)]
            values = {name: one[k] for name, one in zip(names, operands, strict=True)}
            fields = {name: one for name, one in values.items() if isinstance(one, CudaArray)}
            constants = {name: one for name, one in values.items() if name not in fields}
            backend.pointwise(function, fields, out.component(k), **constants)
        return DeviceArray(backend, out, is_truth=is_truth)

    def _computed(self, ufunc: Any, inputs: Any) -> Any:
        """Result of a function of NumPy; NotImplemented where it is not known here."""
        # numbers from numbers in the working precision
        on_device = [one for one in inputs if isinstance(one, DeviceArray)]
        real = self._backend.real
        if ufunc in device_functions.NUMBERS and any(one.dtype == real for one in on_device):
            return self.elementwise(device_functions.NUMBERS[ufunc], inputs)
        # yes or no; the operators & | ~ mean bits unless all say yes or no
        is_meant = ufunc not in device_functions.OF_TRUTHS or all(one.is_truth for one in on_device)
        if ufunc in device_functions.TRUTHS and is_meant:
            return self.elementwise(device_functions.TRUTHS[ufunc], inputs, is_truth=True)
        return NotImplemented

    def _operand(self, one: Any) -> list | None:
        """Value of an operand for each component; None for what only the host can take."""
        number = len(self._array.parts)
        if isinstance(one, DeviceArray):
            known = (self._backend.real, np.dtype(bool), np.dtype(np.uint32))
            return one.components() if one.shape == self.shape and one.dtype in known else None
        if isinstance(one, int | float | np.integer | np.floating):
            return [one.item() if isinstance(one, np.generic) else one] * number
        if isinstance(one, np.ndarray) and _is_even(one, self.shape):
            return [float(row[0]) for row in np.atleast_2d(one)]
        return None

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
        return not self.is_known and self.ndim == 1 and self.size > 0 and real

    def _extremes(self) -> tuple[float, float]:
        ends = self._ends
        if ends is None:
            self._refuse_written()
            ends = self._ends = self._backend.extremes(self._array)
        return ends

    def __getitem__(self, index: Any) -> Any:
        if self.ndim > 2:
            return self._fetched()[index]
        # which components: one of them, or all
        component, particles = self._split(index)
        array = self._array
        if isinstance(component, int | np.integer) and -self.shape[0] <= component < self.shape[0]:
            array, component = array.component(int(component) % self.shape[0]), _ALL
        elif component != _ALL and self._is_head(particles):
            return self._fetched()[index]
        # the first particles: a view on the card
        if self._is_head(particles):
            stop = self.shape[-1] if particles.stop is None else min(particles.stop, self.shape[-1])
            whole = None if self._whole is None else self._whole[index]
            view = array.head(stop)
            return DeviceArray(self._backend, view, is_truth=self.is_truth, whole=whole)
        # a mask: only the numbers of what is chosen come to the host
        if isinstance(particles, DeviceArray) and particles.is_truth:
            particles = np.flatnonzero(particles)
            index = particles if self.ndim == 1 else (component, particles)
        # the host has all of it; else fetch the particles that are listed
        if self.is_known:
            return self._fetched()[index]
        if isinstance(particles, int | np.integer):
            found = self._listed(array, np.array([particles]))[..., 0]
            return found[()] if component == _ALL else found[component]
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
        # gather on the card, then copy what is gathered
        out = self._backend.empty((*array.shape[:-1], rows.size), array.dtype)
        order = self._backend.asarray(np.where(rows < 0, rows + count, rows), "index")
        self._backend.gather(array, order, out)
        return out.to_host().astype(self.dtype, copy=False)


def _is_even(host: np.ndarray, shape: tuple[int, ...]) -> bool:
    """Whether each component of a host array has one value for all particles."""
    if host.shape == shape:
        return host.strides[-1] == 0
    return len(shape) > 1 and host.shape == (*shape[:-1], 1)


def _on_host(one: Any) -> Any:
    """A device array on the host, anything else as it is."""
    if isinstance(one, DeviceArray):
        return one._fetched()
    if isinstance(one, list | tuple):
        return type(one)(_on_host(part) for part in one)
    return one
