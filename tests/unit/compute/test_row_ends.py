"""Lists whose rows end before the next one begins, or lie in any order."""

from dataclasses import replace

import pytest

from lasersph.particles.neighbor_lists import NeighborList


def chain(backend):
    """Particles 0, 1, 2, each a neighbor of the next."""
    return NeighborList(
        row_start=backend.asarray([0, 1, 3, 4], "offset"),
        neighbor=backend.asarray([1, 0, 2, 1], "index"),
    )


def flow(g_ij, T_i, T_j):
    return g_ij * (T_j - T_i)


def double(g_ij):
    return 2.0 * g_ij


def sums(backend, neighbors):
    """sum_j g_ij (T_j - T_i) of each particle."""
    fields = {"T": backend.asarray([1.0, 2.0, 5.0]), "g_ij": backend.asarray([1.0, 2.0, 3.0, 4.0])}
    out = backend.zeros(3)
    backend.pair_sum(flow, neighbors, fields, out)
    return backend.to_host(out).tolist()


def ends(backend, *numbers):
    """Ends of the rows."""
    return backend.asarray(numbers, "offset")


def test_rows_that_end_early(backend):
    """What lies between the end of a row and the next one counts for nothing."""
    neighbors = chain(backend)
    assert sums(backend, neighbors) == [1.0, 7.0, -12.0]
    assert sums(backend, replace(neighbors, row_end=ends(backend, 1, 2, 4))) == [1.0, -2.0, -12.0]
    assert sums(backend, replace(neighbors, row_end=ends(backend, 0, 3, 3))) == [0.0, 7.0, 0.0]


def test_rows_in_any_order(backend):
    """A row may lie behind all others; the last number is that of all places."""
    start = backend.asarray([3, 1, 0, 4], "offset")
    neighbors = replace(chain(backend), row_start=start, row_end=ends(backend, 4, 3, 0))
    assert sums(backend, neighbors) == [4.0, 7.0, 0.0]


def test_values_of_pairs(backend):
    """Values are stored for the pairs of rows alone."""
    g, values = backend.asarray([1.0, 2.0, 3.0, 4.0]), backend.zeros(4)
    neighbors = replace(chain(backend), row_end=ends(backend, 1, 2, 4))
    backend.pair_values(double, neighbors, {"g_ij": g}, values)
    assert backend.to_host(values).tolist() == [2.0, 4.0, 0.0, 8.0]


def test_refused(backend):
    """Ends of another kind, and fewer than there are rows."""
    with pytest.raises(ValueError, match="row_end has 2 uint64 for 3 rows"):
        sums(backend, replace(chain(backend), row_end=ends(backend, 1, 3)))
    with pytest.raises(ValueError, match="row_end has 3 uint32 for 3 rows"):
        sums(backend, replace(chain(backend), row_end=backend.asarray([1, 3, 4], "index")))


def test_the_same_call_with_and_without(backend):
    """A loop that has run takes lists of both kinds, and refuses what it refused at first."""
    neighbors = chain(backend)
    for early, expected in ((None, 7.0), (ends(backend, 1, 2, 4), -2.0), (None, 7.0)):
        assert sums(backend, replace(neighbors, row_end=early))[1] == expected
    with pytest.raises(ValueError, match="row_end has 2 uint64"):
        sums(backend, replace(neighbors, row_end=ends(backend, 1, 3)))
