"""Members of keys in order on the host, by a counting sort, and the places of a value; compiled."""

from __future__ import annotations

import numpy as np

from lasersph.compute.array_function import array_function

_TEXT = '''
ONE = np.uint64(1)


def rows_by_key(_, keys, start, order, beyond):
    """Count the members of each key; the counts become ends of the keys' parts, and these the
    beginnings, which move on when filled."""
    count, key_count = np.uint64(keys.size), np.uint64(start.size - 1)
    for k in range(count):
        key = np.uint64(keys[k])
        if key >= key_count:
            beyond[0], beyond[1] = ONE, key
            return
        start[key + ONE] += ONE
    for key in range(key_count):
        start[key + ONE] += start[key]
    for k in range(count):
        key = np.uint64(keys[k])
        order[start[key]] = np.uint32(k)
        start[key] += ONE
    for left in range(key_count):
        key = key_count - left
        start[key] = start[key - ONE]
    start[0] = 0


def count_by_key(_, keys, counts, beyond):
    """How often each key occurs."""
    for k in range(np.uint64(keys.size)):
        key = np.uint64(keys[k])
        if key >= np.uint64(counts.size):
            beyond[0], beyond[1] = ONE, key
            return
        counts[key] += np.uint32(1)


def rows_where(_, values, wanted, rows, found):
    """Each number is written, and kept where the next one does not take its place."""
    value, place = wanted[0], np.uint64(0)
    for k in range(np.uint64(values.size)):
        rows[place] = np.uint32(k)
        place += np.uint64(values[k] == value)
    found[0] = place
'''


def rows_by_key(keys: np.ndarray, key_count: int) -> tuple[np.ndarray, np.ndarray]:
    """Where the members of each key begin, (key_count + 1,), and the members in order, (n,).

    Args:
        keys: (n,) uint32, 0 ... key_count - 1.

    Raises:
        ValueError: a key is not below `key_count`.
    """
    keys = np.ascontiguousarray(keys)
    start, order = np.zeros(key_count + 1, np.uint64), np.empty(keys.size, np.uint32)
    beyond = np.zeros(2, np.uint64)
    array_function(_TEXT, "rows_by_key")(keys, start, order, beyond)
    _refuse(beyond, key_count)
    return start, order


def count_by_key(keys: np.ndarray, key_count: int) -> np.ndarray:
    """How often each key occurs, (key_count,) uint32; args and errors as of `rows_by_key`."""
    keys = np.ascontiguousarray(keys)
    counts, beyond = np.zeros(key_count, np.uint32), np.zeros(2, np.uint64)
    array_function(_TEXT, "count_by_key")(keys, counts, beyond)
    _refuse(beyond, key_count)
    return counts


def rows_where(values: np.ndarray, value: float) -> np.ndarray:
    """Places of a value among (n,) others, in order, uint32."""
    values = np.ascontiguousarray(values)
    rows, wanted = np.empty(values.size, np.uint32), np.array([value], values.dtype)
    found = np.zeros(1, np.uint64)
    array_function(_TEXT, "rows_where")(values, wanted, rows, found)
    return rows[: int(found[0])].copy()


def _refuse(beyond: np.ndarray, key_count: int) -> None:
    if beyond[0]:
        raise ValueError(f"key {beyond[1]} is not below {key_count}")
