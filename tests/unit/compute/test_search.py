"""Neighbor lists and cell order against all-pairs checks."""

import itertools

import numpy as np
import pytest

from lasersph import compute
from lasersph.compute import search
from lasersph.compute.cuda_device import SIMULATED


def mean(l_i, l_j):
    return 0.5 * (l_i + l_j)


def larger(l_i, l_j):
    return max(l_i, l_j)


def all_pairs(x, reach, count, rule, period):
    """Rows of neighbors by comparing each pair."""
    rows = []
    for i in range(count):
        d = x[:, [i]] - x
        for k, width in enumerate(period):
            if width:
                d[k] -= width * np.rint(d[k] / width)
        near = np.sqrt((d**2).sum(axis=0)) < rule(reach[i], reach)
        near[i] = False
        rows.append(np.flatnonzero(near))
    return rows


def is_slow(backend):
    """Whether the loops run in Python."""
    return backend.device == SIMULATED


def rows_of(backend, x, reach, count, **options):
    """Rows of a list, sorted within each row."""
    options.setdefault("mean", mean)
    start, neighbor = search.neighbor_list(
        backend, backend.asarray(x), backend.asarray(reach), count, **options
    )
    starts, host = backend.to_host(start), backend.to_host(neighbor)
    assert starts.dtype == np.uint64 and host.dtype == np.uint32
    assert starts[-1] == host.size or (starts[-1] < host.size and "room" in options)
    return [np.sort(host[int(a) : int(b)]) for a, b in itertools.pairwise(starts)]


@pytest.mark.parametrize("graded", [False, True])
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_all_pairs(backend, dimension, periodic, graded):
    """Random particles; supports equal or spanning a factor of 250; not all are targets."""
    rng = np.random.default_rng(dimension)
    count, rows = (30, 20) if is_slow(backend) else (400, 300)
    x = rng.random((dimension, count))
    reach = 0.3 * 250.0 ** (-rng.random(count)) if graded else np.full(count, 0.2)
    period = (1.0,) * dimension if periodic else ()
    found = rows_of(backend, x, reach, rows, period=period)
    expected = all_pairs(x, reach, rows, mean, period)
    assert len(found) == rows
    for got, row in zip(found, expected, strict=True):
        assert got.tolist() == row.tolist()


def test_graded_rows(backend):
    """Lattice rows from 4 nm to 1 um (ratio 7/9) with another mean: exactly the close pairs."""
    spacing, places, widths = 1e-6, [], []
    z = 0.0
    while spacing > (1e-7 if is_slow(backend) else 4e-9):
        for x in np.arange(0.0, 1.9e-6, max(spacing, 5e-8)):
            places.append((x, z))
            widths.append(1.5 * spacing)
        z += spacing
        spacing *= 7 / 9
    x, reach = np.array(places).T, np.array(widths)
    found = rows_of(backend, x, reach, reach.size, mean=np_free_larger)
    expected = all_pairs(x, reach, reach.size, np.maximum, (0.0, 0.0))
    for got, row in zip(found, expected, strict=True):
        assert got.tolist() == row.tolist()


def np_free_larger(l_i, l_j):
    return max(l_i, l_j)


def test_three_particles(backend):
    """x = 0, 1, 2.5 with l = 1.2: only the first two are neighbors; strictly closer than l."""
    assert [row.tolist() for row in rows_of(backend, [[0.0, 1, 2.5]], [1.2, 1.2, 1.2], 3)] == [
        [1], [0], [],
    ]  # fmt: skip
    assert rows_of(backend, [[0.0, 1.0]], [1.0, 1.0], 2)[0].size == 0


def test_dense_rows_grow(backend):
    """Every particle sees every other: far more than the first guess of places per row."""
    count = 20 if is_slow(backend) else 700
    x = np.random.default_rng(0).random((2, count))
    found = rows_of(backend, x, np.full(count, 2.0), count)
    assert all(row.size == count - 1 for row in found)


def test_coincident_particles(backend):
    """Particles at one place are neighbors of each other but not of themselves."""
    assert [row.tolist() for row in rows_of(backend, np.zeros((3, 2)), [1.0, 1.0], 2)] == [[1], [0]]


def test_empty(backend):
    """No rows: an empty list."""
    assert rows_of(backend, np.zeros((2, 3)), np.ones(3), 0) == []


@pytest.mark.parametrize("bad", [np.nan, np.inf, 7.0])
def test_escape(backend, bad):
    """A particle that is not finite or outside the box is named with its position."""
    x = np.random.default_rng(0).random((2, 50))
    x[1, 17] = bad
    with pytest.raises(search.EscapedParticle, match=r"particle 17 escaped: position \(0\.\d+, "):
        rows_of(backend, x, np.full(50, 0.1), 50, lower=(0.0, 0.0), upper=(1.0, 1.0))


def test_refusals(backend):
    """Short periods, particles wider than the period and bad supports are refused."""
    x = np.random.default_rng(0).random((2, 50))
    with pytest.raises(ValueError, match="must be longer than twice the search radius"):
        rows_of(backend, x, np.full(50, 0.5), 50, period=(1.0, 0.0))
    with pytest.raises(ValueError, match="more than its period"):
        rows_of(backend, x, np.full(50, 0.1), 50, period=(0.5, 0.0))
    with pytest.raises(ValueError, match=r"support of particle 3 is -1\.0 m"):
        rows_of(backend, x, np.where(np.arange(50) == 3, -1.0, 0.1), 50)
    with pytest.raises(ValueError, match="60 rows, 50 particles"):
        rows_of(backend, x, np.full(50, 0.1), 60)


def test_lists_in_one_room(backend):
    """Each of them is what it would be in memory of its own, also where it is longer or shorter."""
    room, rng = search.Room(), np.random.default_rng(4)
    for count, reach in ((20, 0.3), (40, 0.6), (30, 0.2)):
        x, support = rng.random((2, count)), np.full(count, reach)
        found = rows_of(backend, x, support, count, room=room)
        alone = rows_of(backend, x, support, count)
        assert [row.tolist() for row in found] == [row.tolist() for row in alone]


def test_a_room_is_used_again(backend):
    """The second list lies where the first one lay."""
    if backend.search is not None:
        pytest.skip("lists on the graphics card have memory of their own")
    room, x = search.Room(), backend.asarray(np.random.default_rng(5).random((3, 50)))
    places = []
    for reach in (0.3, 0.2):
        support = backend.asarray(np.full(50, reach))
        _, neighbor = search.neighbor_list(backend, x, support, 50, mean=mean, room=room)
        places.append(backend.unwrap(neighbor).ctypes.data)
    assert places == [room.neighbor.ctypes.data] * 2


def test_gather_beyond_the_end():
    """A particle that is not there is refused; what no particle is named for keeps its value."""
    backend = compute.cpu(threads=1)
    source, out = backend.asarray(np.arange(3.0)), backend.asarray(np.full(3, 7.0))
    backend.gather(source, backend.asarray([2, 0], "index"), out)
    assert backend.to_host(out).tolist() == [2.0, 0.0, 7.0]
    with pytest.raises(IndexError, match="particle 3 of 3"):
        backend.gather(source, backend.asarray([3], "index"), out)
