"""Static and partial lists, and the particles of keys as rows of a list."""

from itertools import pairwise

import numpy as np
import pytest

from lasersph.compute.search import EscapedParticle
from lasersph.particles.neighbor_lists import Box, find_neighbors, members_of
from lasersph.particles.support import arithmetic
from lasersph.sph.kernels import kernel

COUNT = 10
BOX = Box((0.0,), (10.0,), (0.0,))


def row_of(backend, **how):
    """Rows of particles at 0.5, 1.5, ... with supports of 1.5, as sets."""
    x = backend.asarray(np.arange(COUNT)[None, :] + 0.5)
    support = backend.asarray(np.full(COUNT, 1.5))
    found = find_neighbors(
        backend, x, support, COUNT, kernel=kernel("cubic-spline", 1), mean=arithmetic, **how
    )
    start, neighbor = (backend.to_host(a) for a in (found.row_start, found.neighbor))
    return [set(neighbor[a:b].tolist()) for a, b in pairwise(start)]


def test_static(backend):
    """Each has those beside it."""
    expected = [{i - 1, i + 1} & set(range(COUNT)) for i in range(COUNT)]
    assert row_of(backend) == row_of(backend, box=BOX) == expected


def test_partial(backend):
    """Rows that are not wanted stay empty; a longer radius lists more than the support."""
    wanted = backend.asarray(np.array([3, 7]), "index")
    rows = row_of(backend, wanted=wanted, radius=backend.asarray(np.full(COUNT, 2.5)))
    assert rows[3] == {1, 2, 4, 5} and rows[7] == {5, 6, 8, 9}
    assert not any(rows[i] for i in range(COUNT) if i not in (3, 7))


def test_outside_the_box(backend):
    """A particle that has left the box is named."""
    with pytest.raises(EscapedParticle, match="particle 9"):
        row_of(backend, box=BOX._replace(high=(9.0,)))


def test_members(backend):
    """In order; a key behind the last one is no row."""
    found = members_of(backend, backend.asarray(np.array([2, 0, 3, 2]), "index"), 3)
    assert backend.to_host(found.row_start).tolist() == [0, 1, 1, 3]
    assert backend.to_host(found.neighbor).tolist()[:3] == [1, 0, 3]
