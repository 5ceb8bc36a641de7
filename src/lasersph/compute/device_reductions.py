"""NumPy's reductions and searches of device arrays that need no copy of them; see `device_array`.

Each returns NotImplemented where only the host can answer.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np


def _is_number(a: Any) -> bool:
    """Whether an array has elements on the card that are numbers, and none on the host."""
    return not a.is_known and a.dtype.kind == "f" and a.size > 0 and a.ndim <= 2


def _extreme(how: str, of_all: Callable, a: Any, axis: Any, options: dict[str, Any]) -> Any:
    if "where" in options and "initial" in options:
        initial = options.pop("initial")
        a = np.where(options.pop("where"), a, initial)
        found = _extreme(how, of_all, a, axis, options) if _is_on_device(a) else NotImplemented
        return found if found is NotImplemented else of_all(found, initial)
    if options or not _is_on_device(a) or not _is_number(a):
        return NotImplemented
    if axis is None:
        return of_all(a.reduced(how))
    return np.array(a.reduced(how)) if a.ndim == 2 and axis in (1, -1) else NotImplemented


def _is_on_device(a: Any) -> bool:
    return hasattr(a, "is_known")


def largest(a: Any, axis: Any = None, **options: Any) -> Any:
    """As `np.max`."""
    return _extreme("max", max, a, axis, options)


def smallest(a: Any, axis: Any = None, **options: Any) -> Any:
    """As `np.min`."""
    return _extreme("min", min, a, axis, options)


def total(a: Any, axis: Any = None, **options: Any) -> Any:
    """As `np.sum`, in the card's order; over components one after the other."""
    if options or not _is_number(a):
        return NotImplemented
    if axis is None:
        return sum(a.reduced("sum"))
    if axis != 0 or a.ndim != 2:
        return NotImplemented
    found = a[0]
    for k in range(1, a.shape[0]):
        found = found + a[k]
    return found


def is_any(a: Any, **options: Any) -> Any:
    """As `np.any`."""
    return NotImplemented if options or not _is_mask(a) else _number(a) > 0


def count(a: Any, **options: Any) -> Any:
    """As `np.count_nonzero`."""
    return NotImplemented if options or not _is_mask(a) else _number(a)


def _number(mask: Any) -> int:
    """How many elements say yes, added up on the card."""
    return int(mask.reduced("sum")[0])


def numbers(a: Any) -> Any:
    """As `np.flatnonzero`: only the numbers of what is chosen come to the host."""
    return a.rows().to_host().astype(np.int64) if _is_mask(a) else NotImplemented


def place(a: Any, v: Any, **options: Any) -> Any:
    """As `np.searchsorted` of one number in a sorted array."""
    return NotImplemented if options or np.ndim(v) or a.ndim != 1 else np.count_nonzero(a < v)


def first_smallest(a: Any, **options: Any) -> Any:
    """As `np.argmin` of a scalar."""
    if options or not _is_number(a) or a.ndim > 1:
        return NotImplemented
    return numbers(a <= smallest(a))[0]


def partition(a: Any, kth: int, **options: Any) -> Any:
    """As the first part of `np.argpartition`: what is not larger than some value beyond the kth."""
    if options or not _is_number(a) or a.ndim > 1:
        return NotImplemented
    low, high = smallest(a), largest(a)
    if not high < np.inf:
        return NotImplemented
    width = (high - low) * (kth + 1) / a.size
    near = a <= low + width
    while count(near) <= kth:
        width *= 2.0
        near = a <= low + width
    rows = numbers(near)
    return rows[np.argpartition(a[rows], kth)]


def shape(a: Any) -> tuple[int, ...]:
    """As `np.shape`."""
    return a.shape


def _is_mask(a: Any) -> bool:
    return a.is_truth and a.ndim == 1 and not a.is_known


FUNCTIONS: dict[Any, Callable] = {
    np.max: largest,
    np.min: smallest,
    np.sum: total,
    np.any: is_any,
    np.count_nonzero: count,
    np.flatnonzero: numbers,
    np.searchsorted: place,
    np.argmin: first_smallest,
    np.argpartition: partition,
    np.shape: shape,
}
