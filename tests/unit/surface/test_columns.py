"""Shares of a flat surface: the whole area whatever the places, means by hand."""

import numpy as np
import pytest

from lasersph.surface.columns import SurfaceColumns


def columns_of(backend, x, count=4):
    """Columns of 1 m from 0 on, with particles at places x [m] among some that lie deeper."""
    position = np.array([np.append(x, [9.0, 9.0]), np.zeros(len(x) + 2)])
    columns = SurfaceColumns(backend, len(x) + 2, (0.0,), (1.0,), (count,))
    columns.find(backend.asarray(position), backend.asarray(np.arange(len(x)), "index"))
    return columns


@pytest.mark.parametrize("count", [3, 4, 11])
def test_area_is_the_whole_surface(backend, count):
    """Fewer particles than columns or more, at any places: they share 4 m."""
    rng = np.random.default_rng(3)
    x = (np.arange(count) + rng.uniform(0.1, 0.9, count)) * 4.0 / count
    area = backend.to_host(columns_of(backend, x).area)
    assert (area[:-2] > 0.0).all() and not area[-2:].any()
    assert area.sum() == pytest.approx(4.0, rel=1e-6)


def test_by_hand(backend):
    """Two particles in a column of their own, one between two columns with none beside it."""
    columns = columns_of(backend, [0.5, 1.5, 3.0])
    assert backend.to_host(columns.area)[:3] == pytest.approx([1.0, 1.0, 2.0], rel=1e-6)
    mean = columns.mean(backend.asarray([10.0, 20.0, 40.0, 7.0, 7.0]))
    assert backend.to_host(mean) == pytest.approx([10.0, 20.0, 40.0, 40.0], rel=1e-6)


def test_others_come_up(backend):
    """The area of what has gone down is 0 again."""
    columns = columns_of(backend, [0.5, 1.5, 2.5, 3.5])
    position = backend.asarray(np.array([[9.0, 9.0, 0.5, 1.5, 2.5, 3.5], np.zeros(6)]))
    columns.find(position, backend.asarray(np.arange(2, 6), "index"))
    assert backend.to_host(columns.area) == pytest.approx([0.0, 0.0, 1.0, 1.0, 1.0, 1.0])


def test_area_of_a_grid(backend):
    """Particles at any places share 3 m by 4 m; one on a corner stands for all of four columns."""
    rng = np.random.default_rng(3)
    place = [9.0 * np.ones((2, 20)), np.zeros((1, 20))]
    place[0][:, :18] = rng.uniform(0.1, 0.9, (2, 18)) * [[3.0], [4.0]]
    columns = SurfaceColumns(backend, 20, (0.0, 0.0), (1.0, 1.0), (3, 4))
    columns.find(backend.asarray(np.concatenate(place)), backend.asarray(np.arange(18), "index"))
    covered = backend.to_host(columns.mean(backend.asarray(np.ones(20))))
    area = backend.to_host(columns.area)
    assert area.sum() == pytest.approx(covered.sum(), rel=1e-6) and not area[18:].any()
    columns.find(backend.asarray([[1.0], [2.0], [0.0]]), backend.asarray(np.zeros(1), "index"))
    shares = [(int(backend.to_host(c)[0]), backend.to_host(s)[0]) for c, s in columns.shares(2.0)]
    assert sorted(shares) == [(1, 2.0), (2, 2.0), (5, 2.0), (6, 2.0)]
    assert backend.to_host(columns.area)[0] == pytest.approx(4.0)
