"""Renewal of rows of lists of pairs: hand-made lists of three rows."""

import numpy as np
import pytest

from lasersph.compute.cuda_device import SIMULATED
from lasersph.compute.row_renewal import RESERVE, SPARE, PairRows, RenewedRows


def rows(backend, *lists):
    """A list with the given neighbors; values are 10 i + j plus the list's first number."""
    lengths = [len(one) for one in lists]
    flat = [j for one in lists for j in one]
    values = [10.0 * i + j for i, one in enumerate(lists) for j in one]
    start = np.concatenate([[0], np.cumsum(lengths)])
    return PairRows(
        backend.asarray(start, "offset"), backend.asarray(flat, "index"), backend.asarray(values)
    )


def numbers(backend, *chosen):
    """Numbers of the rows that are renewed."""
    return backend.asarray(chosen, "index")


def lists_of(backend, renewed):
    """Neighbors and values row by row."""
    start, end = backend.to_host(renewed.row_start), backend.to_host(renewed.row_end)
    neighbor, values = (backend.to_host(part) for part in (renewed.neighbor, renewed.values))
    pieces = [slice(int(a), int(b)) for a, b in zip(start, end, strict=False)]
    return [neighbor[p].tolist() for p in pieces], [values[p].tolist() for p in pieces]


def test_rows_of_both(backend):
    """Rows 0 and 2 are renewed, with their values; row 1 stays."""
    renewed = RenewedRows(backend, rows(backend, [5], [6, 6, 6], [0, 1]))
    assert lists_of(backend, renewed)[0] == [[5], [6, 6, 6], [0, 1]]
    renewed.update(numbers(backend, 0, 2), rows(backend, [1, 2], [0], [7, 8]))
    neighbors, values = lists_of(backend, renewed)
    assert neighbors == [[1, 2], [6, 6, 6], [7, 8]]
    assert values == [[1.0, 2.0], [16.0, 16.0, 16.0], [27.0, 28.0]]


def test_what_was_first_stays(backend):
    """The first list is still there, however often its rows are renewed."""
    renewed = RenewedRows(backend, rows(backend, [5], [6, 6, 6], [0, 1]))
    for one in ([[1]] * 3, [[2, 2, 2]] * 3):
        renewed.update(numbers(backend, 0, 1, 2), rows(backend, *one))
    first = [backend.to_host(part).tolist() for part in renewed.first]
    assert first == [[0, 1, 4, 6], [5, 6, 6, 6, 0, 1], [5.0, 16.0, 16.0, 16.0, 20.0, 21.0]]


def test_place_is_kept_while_a_row_fits(backend):
    """A renewed row stays in its place up to the room it has, and goes behind all others beyond."""
    renewed = RenewedRows(backend, rows(backend, [5], [0], [1]))
    begins, longer = [], SPARE + 1
    for length in (SPARE, longer, 1, longer + 1):
        renewed.update(numbers(backend, 1), rows(backend, [0], [9] * length))
        assert lists_of(backend, renewed)[0] == [[5], [9] * length, [1]]
        begins.append(int(backend.to_host(renewed.row_start)[1]))
    assert begins == [3, 3, 3, 3 + longer]


def test_arrays_stay_while_pairs_change_little(backend):
    """Recorded graphs go on with the arrays that they have, as long as all pairs fit there."""
    renewed = RenewedRows(backend, rows(backend, *[[0] * 50] * 3))
    kept = []
    for length in (50, 50, 54, 56, 57):
        renewed.update(numbers(backend, 1), rows(backend, [0], [9] * length))
        kept.append((renewed.neighbor, renewed.values))
    assert all(one is other for now in kept[1:4] for one, other in zip(now, kept[0], strict=True))
    assert kept[4][0] is not kept[0][0]


def test_more_than_there_is_memory_for(backend):
    """Rows that outgrow the memory behind the first list are all kept."""
    renewed = RenewedRows(backend, rows(backend, [5], [0], [1]))
    for row in range(3):
        new = [list(range(10 * row, 10 * row + 4 * RESERVE))] * 3
        renewed.update(numbers(backend, row), rows(backend, *new))
    assert lists_of(backend, renewed)[0] == [[0, 1, 2, 3], [10, 11, 12, 13], [20, 21, 22, 23]]
    assert backend.to_host(renewed.first.neighbor).tolist() == [5, 0, 1]


def test_no_rows(backend):
    """Without a row nothing changes; empty rows are rows too."""
    renewed = RenewedRows(backend, rows(backend, [], [3], []))
    renewed.update(numbers(backend), rows(backend, [1]))
    assert lists_of(backend, renewed)[0] == [[], [3], []]
    renewed.update(numbers(backend, 0, 1), rows(backend, [1], []))
    assert lists_of(backend, renewed)[0] == [[1], [], []]


def test_refused(backend):
    """Rows that one of the lists does not have, and other reals."""
    renewed = RenewedRows(backend, rows(backend, [1], [0], [0]))
    with pytest.raises(ValueError, match="row 2 is renewed, a list has 2"):
        renewed.update(numbers(backend, 0, 2), rows(backend, [1], [0]))
    with pytest.raises(ValueError, match="row 3 is renewed, a list has 3"):
        renewed.update(numbers(backend, 3), rows(backend, [1], [0], [0], [1]))
    start, neighbor, values = rows(backend, [1])
    singles = PairRows(start, neighbor, backend.single(values))
    with pytest.raises(ValueError, match="float32 in a list of float64"):
        renewed.update(numbers(backend, 0), singles)


@pytest.mark.parametrize("seed", [1, 2])
def test_many_rows(backend, seed):
    """More rows than one block of threads, several times, against the same in plain Python."""
    random = np.random.default_rng(seed)
    count = 50 if backend.device == SIMULATED else 5000

    def some_lists():
        return [random.integers(0, 99, n).tolist() for n in random.integers(0, 12, count)]

    there = some_lists()
    renewed = RenewedRows(backend, rows(backend, *there))
    for _ in range(4):
        new, chosen = some_lists(), np.flatnonzero(random.integers(0, 2, count))
        renewed.update(numbers(backend, *chosen), rows(backend, *new))
        for row in chosen:
            there[row] = new[row]
        assert lists_of(backend, renewed)[0] == there
