"""Members of keys in order on the host, by a counting sort, and the places of a value; compiled."""

from __future__ import annotations

import ctypes
from array import array
from collections.abc import Callable
from functools import cache

import numpy as np

from lasersph.compute import cache as folder
from lasersph.compute.arguments import address
from lasersph.compute.generate import NATIVE

_TEXT = """
def loop(frame):
    words = at_uint64(frame)
    count, key_count, one = words[0], words[1], np.uint64(1)
    keys, start, order = at_uint32(words[2]), at_uint64(words[3]), at_uint32(words[4])
    for k in range(count):
        key = np.uint64(keys[k])
        if key >= key_count:
            words[5], words[6] = one, key
            return
        start[key + one] += one
    for key in range(key_count):
        start[key + one] += start[key]
    for k in range(count):
        key = np.uint64(keys[k])
        order[start[key]] = np.uint32(k)
        start[key] += one
    for left in range(key_count):
        key = key_count - left
        start[key] = start[key - one]
    start[0] = 0
"""
"""Counts become ends of the keys' parts, and these the beginnings, which move on when filled."""
_COUNT = """
def loop(frame):
    words = at_uint64(frame)
    keys, counts = at_uint32(words[2]), at_uint32(words[3])
    for k in range(words[0]):
        key = np.uint64(keys[k])
        if key >= words[1]:
            words[4], words[5] = np.uint64(1), key
            return
        counts[key] += np.uint32(1)
"""
_PLACES = """
def loop(frame):
    words = at_uint64(frame)
    values, rows, wanted = at_{kind}(words[1]), at_uint32(words[2]), at_{kind}(words[3])[words[5]]
    found = words[5]
    for k in range(words[0]):
        rows[found] = np.uint32(k)
        found += np.uint64(values[k] == wanted)
    words[4] = found
"""
"""Each number is written, and kept where the next one does not take its place."""


def rows_by_key(keys: np.ndarray, key_count: int) -> tuple[np.ndarray, np.ndarray]:
    """Where the members of each key begin, (key_count + 1,), and the members in order, (n,).

    Args:
        keys: (n,) uint32, 0 ... key_count - 1.

    Raises:
        ValueError: a key is not below `key_count`.
    """
    keys = np.ascontiguousarray(keys)
    start, order = np.zeros(key_count + 1, np.uint64), np.empty(keys.size, np.uint32)
    places = [address(one) for one in (keys, start, order)]
    frame = array("Q", [keys.size, key_count, *places, 0, 0])
    _compiled(_TEXT)(frame.buffer_info()[0])
    _refuse(frame[5], frame[6], key_count)
    return start, order


def count_by_key(keys: np.ndarray, key_count: int) -> np.ndarray:
    """How often each key occurs, (key_count,) uint32; args and errors as of `rows_by_key`."""
    keys = np.ascontiguousarray(keys)
    counts = np.zeros(key_count, np.uint32)
    frame = array("Q", [keys.size, key_count, address(keys), address(counts), 0, 0])
    _compiled(_COUNT)(frame.buffer_info()[0])
    _refuse(frame[4], frame[5], key_count)
    return counts


def rows_where(values: np.ndarray, value: float) -> np.ndarray:
    """Places of a value among (n,) others, in order, uint32."""
    values = np.ascontiguousarray(values)
    rows, wanted = np.empty(values.size, np.uint32), np.array([value], values.dtype)
    frame = array("Q", [values.size, address(values), address(rows), address(wanted), 0, 0])
    _places(values.dtype)(frame.buffer_info()[0])
    return rows[: frame[4]].copy()


def _refuse(is_beyond: int, key: int, key_count: int) -> None:
    if is_beyond:
        raise ValueError(f"key {key} is not below {key_count}")


@cache
def _places(kind: np.dtype) -> Callable[[int], None]:
    """Compiled search for the places of a value of a kind, whose name takes NumPy long."""
    return _compiled(_PLACES.format(kind=kind.name))


@cache
def _compiled(text: str) -> Callable[[int], None]:
    """Foreign function of the address of a frame."""
    whole = NATIVE.format(precision="float64") + text
    return ctypes.PYFUNCTYPE(None, ctypes.c_uint64)(folder.entry(whole, is_fast=False))
