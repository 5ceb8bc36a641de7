"""Connected cells of a grid: by sides, corners and around ends, the same on every backend."""

import numpy as np
import pytest

from lasersph.compute.connected import first_connected


def first(backend, filled, wraps=(False, False)):
    """Smallest number of a cell connected with each, in the shape of the grid."""
    filled = np.array(filled)
    cells = backend.asarray(filled.ravel(), "index")
    found = backend.first_connected(cells, *filled.shape, wraps)
    return backend.to_host(found).reshape(filled.shape).tolist()


def test_sides_and_corners(backend):
    """Cells that touch at a corner are connected; empty ones have their own numbers."""
    assert first(backend, [[1, 0, 0, 0], [0, 1, 0, 1], [0, 0, 0, 1]]) == [
        [0, 1, 2, 3], [4, 0, 6, 7], [8, 9, 10, 7],
    ]  # fmt: skip


def test_smallest_number_of_a_winding_part(backend):
    """Two arms that meet only at their far end are one part."""
    arms = [[0, 1, 1, 1, 1], [0, 0, 0, 0, 1], [1, 1, 1, 1, 0]]
    assert first(backend, arms)[2] == [1, 1, 1, 1, 14]


@pytest.mark.parametrize("wraps, expected", [
    ((False, False), [0, 2, 4, 6]), ((True, False), [0, 0, 4, 4]), ((False, True), [0, 2, 0, 2]),
    ((True, True), [0, 0, 0, 0]),
])  # fmt: skip
def test_around_ends(backend, wraps, expected):
    """Across a period the last column touches the first, the last line the first."""
    filled = np.zeros((4, 4), int)
    filled[[0, 3, 0, 3], [0, 0, 3, 3]] = 1
    found = np.array(first(backend, filled, wraps))
    names = {0: 0, 3: 4, 12: 2, 15: 6}
    assert [names[k] for k in found[[0, 3, 0, 3], [0, 0, 3, 3]]] == expected


def test_random_grids(backend):
    """As the host's labels say, for grids between sparse and full."""
    random = np.random.default_rng(4)
    for share, wraps in ((0.3, (True, False)), (0.45, (False, False)), (0.7, (False, True))):
        filled = random.random((7, 9)) < share
        expected = first_connected(filled.ravel().astype(np.uint32), *filled.shape, wraps)
        assert np.array_equal(np.ravel(first(backend, filled, wraps)), expected)


def test_nothing(backend):
    """A grid without filled cells, and one of a single cell."""
    assert first(backend, [[0, 0]]) == [[0, 1]]
    assert first(backend, [[1]], (True, True)) == [[0]]


def test_as_labels_of_images_say():
    """Parts of a grid without periods are those of an image."""
    ndimage = pytest.importorskip("scipy.ndimage")
    filled = np.random.default_rng(7).random((40, 30)) < 0.4
    label, count = ndimage.label(filled, np.ones((3, 3)))
    cells = filled.ravel().astype(np.uint32)
    found = first_connected(cells, *filled.shape, (False, False)).reshape(filled.shape)
    assert count > 10
    for k in range(1, count + 1):
        assert np.all(found[label == k] == np.flatnonzero(label == k)[0])
