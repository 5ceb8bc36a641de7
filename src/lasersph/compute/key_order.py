"""Members of keys in order on the host: a counting sort, compiled."""

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
    _sort()(frame.buffer_info()[0])
    if frame[5]:
        raise ValueError(f"key {frame[6]} is not below {key_count}")
    return start, order


@cache
def _sort() -> Callable[[int], None]:
    """Foreign function of the address of a frame."""
    text = NATIVE.format(precision="float64") + _TEXT
    return ctypes.PYFUNCTYPE(None, ctypes.c_uint64)(folder.entry(text, is_fast=False))
