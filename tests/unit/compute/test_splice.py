"""Splicing of lists of pairs: hand-made lists of three rows."""

import numpy as np
import pytest

from lasersph.compute.cuda_device import SIMULATED
from lasersph.compute.splice import PairRows, splice


def rows(backend, *lists):
    """A list with the given neighbors; values are 10 i + j plus the list's first number."""
    lengths = [len(one) for one in lists]
    flat = [j for one in lists for j in one]
    values = [10.0 * i + j for i, one in enumerate(lists) for j in one]
    start = np.concatenate([[0], np.cumsum(lengths)])
    return PairRows(
        backend.asarray(start, "offset"), backend.asarray(flat, "index"), backend.asarray(values)
    )


def lists_of(backend, found):
    """Neighbors and values row by row."""
    start, neighbor, values = (backend.to_host(part) for part in found)
    cuts = start[1:-1].astype(int)
    return (
        [part.tolist() for part in np.split(neighbor, cuts)],
        [part.tolist() for part in np.split(values, cuts)],
    )


def marks(backend, *chosen):
    """Marks of the rows that are taken from the first list."""
    return backend.asarray(chosen, "flag")


def test_rows_of_both(backend):
    """Rows 0 and 2 of the first list, row 1 of the second, with their values."""
    first = rows(backend, [1, 2], [0], [7, 8])
    rest = rows(backend, [5], [6, 6, 6], [0, 1])
    neighbors, values = lists_of(backend, splice(backend, first, marks(backend, 1, 0, 1), rest))
    assert neighbors == [[1, 2], [6, 6, 6], [7, 8]]
    assert values == [[1.0, 2.0], [16.0, 16.0, 16.0], [27.0, 28.0]]


def test_all_or_none(backend):
    """No mark gives the second list, all the first; empty rows are rows too."""
    first, rest = rows(backend, [1], [], [2]), rows(backend, [], [3], [])
    none, every = marks(backend, 0, 0, 0), marks(backend, 1, 1, 1)
    assert lists_of(backend, splice(backend, first, none, rest)) == lists_of(backend, rest)
    assert lists_of(backend, splice(backend, first, every, rest)) == lists_of(backend, first)


def test_shorter_first_list(backend):
    """The first list may end after the chosen rows; types of the parts are kept."""
    rest = rows(backend, [5], [0], [1])
    found = splice(backend, rows(backend, [1, 2]), marks(backend, 1, 0, 0), rest)
    assert lists_of(backend, found)[0] == [[1, 2], [0], [1]]
    kinds = [backend.to_host(part).dtype for part in found]
    assert kinds == [np.uint64, np.uint32, np.float64]


def test_refused(backend):
    """Marks of another length or kind, and rows that the first list does not have."""
    first, rest = rows(backend, [1], [0]), rows(backend, [1], [0], [0])
    with pytest.raises(ValueError, match="2 uint8 marks for 3 rows"):
        splice(backend, first, marks(backend, 1, 0), rest)
    with pytest.raises(ValueError, match="3 uint32 marks"):
        splice(backend, first, backend.asarray([1, 0, 0], "index"), rest)
    with pytest.raises(ValueError, match="beyond the 2 of the first list"):
        splice(backend, first, marks(backend, 0, 0, 1), rest)


@pytest.mark.parametrize("seed", [1, 2])
def test_many_rows(backend, seed):
    """More rows than one block of threads, against the same in plain Python."""
    random = np.random.default_rng(seed)
    count = 50 if backend.device == SIMULATED else 5000
    lists = [[random.integers(0, 99, n).tolist() for n in random.integers(0, 5, count)]
             for _ in range(2)]  # fmt: skip
    chosen = random.integers(0, 2, count)
    first, rest = (rows(backend, *one) for one in lists)
    neighbors, _ = lists_of(backend, splice(backend, first, marks(backend, *chosen), rest))
    assert neighbors == [lists[0 if mark else 1][k] for k, mark in enumerate(chosen)]
