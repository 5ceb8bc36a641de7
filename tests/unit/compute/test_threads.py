"""The same bits for any number of threads."""

from types import SimpleNamespace

import numpy as np
import pytest

from lasersph import compute
from lasersph.compute import launch, search
from lasersph.compute.arguments import address
from lasersph.compute.array_function import array_function

LENGTH = """

def length(number, frame, out):
    out[0] = 1.0 if is_long(frame) else 0.0
"""


def flow(T_i, T_j, r_ij):
    return (T_j - T_i) / r_ij


def squared(total):
    return total, total**2


def product(a, b):
    return a * b


def mean(l_i, l_j):
    return 0.5 * (l_i + l_j)


def results(threads, position, T):
    """List, sums and reductions of 20 000 particles."""
    backend = compute.cpu(threads=threads)
    count = position.shape[1]
    row_start, neighbor = search.neighbor_list(
        backend, position, np.full(count, 0.02), count, mean=mean
    )
    neighbors = SimpleNamespace(
        row_end=None,
        row_start=row_start, neighbor=neighbor, position=position,
        support=np.full(count, 0.02), kernel=None, mean=mean, period=(),
    )  # fmt: skip
    out = (backend.zeros(count), None)
    sums = backend.pair_sum(flow, neighbors, {"T": T}, out, finish=squared, reduce=("min", "sum"))
    long = np.tile(T, 3)
    assert min(neighbor.size, long.size) > launch.SHARED
    dot = backend.pointwise(product, {"a": long, "b": long}, None, reduce="sum")
    return row_start.tobytes(), neighbor.tobytes(), out[0].tobytes(), sums, dot


def test_bits_do_not_depend_on_threads():
    """One and two threads: identical lists, sums and reductions over several blocks."""
    rng = np.random.default_rng(3)
    position, T = rng.random((2, 20_000)), rng.random(20_000)
    one = results(1, position, T)
    assert one == results(2, position, T)
    assert one[4][0] == pytest.approx(3.0 * float(np.dot(T, T)), rel=1e-13)


def test_short_loops_take_one_thread():
    """Threads are woken only where that many rows or pairs are visited, by rows that hold many
    pairs as well, however few they are."""
    is_long = array_function(launch.RUN.format(precision="float64") + LENGTH, "length")
    length, least = np.zeros(1), launch.SHARED

    def shares(kind, count, *lists):
        frame = np.array([0, 1, 2, count, 0, 0, 0, 0, kind, *map(address, lists)], np.uint64)
        is_long(frame, length)
        return bool(length[0])

    # rows, and all pairs of a list of four rows
    assert not shares(launch.ROWS, least - 1)
    assert shares(launch.ROWS, least)
    begins = np.array([0, 0, 1, least, least], np.uint64)
    assert shares(launch.PAIRS, 4, begins)
    assert not shares(launch.PAIRS, 2, begins)
    # rows 0 and 1 have one pair; row 2 has nearly all
    few, most = np.array([0, 1], np.uint32), np.array([1, 2], np.uint32)
    assert not shares(launch.PAIRS_OF_ROWS, 2, few, begins, begins[1:])
    assert shares(launch.PAIRS_OF_ROWS, 2, most, begins, begins[1:])


def test_number_of_threads():
    """More threads than processors are cut down; fewer than one is an error."""
    from lasersph.compute import threads

    assert compute.cpu(threads=10_000).threads == threads.chosen(None)
    assert compute.cpu(threads=1).threads == 1
    with pytest.raises(ValueError, match="at least 1"):
        compute.cpu(threads=0)
    with pytest.raises(ValueError, match="precision must be"):
        compute.cpu(precision="half")
