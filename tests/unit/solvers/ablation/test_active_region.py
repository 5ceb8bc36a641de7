"""Active regions: who becomes active when, and that nothing is lost by the inactive."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.compute import search
from lasersph.particles.kinds import EJECTED, INTERIOR
from lasersph.particles.neighbor_lists import NeighborList, search_pairs
from lasersph.particles.support import arithmetic
from lasersph.solvers.ablation.active_region import ActiveRegion
from lasersph.sph.kernels import kernel

SUPPORT = 3.0


def block(columns, layers):
    """Lattice of spacing 1, layer by layer from the surface down, shape (len(columns) + 1, n)."""
    axes = [-(np.arange(layers) + 0.5), *(np.arange(n) + 0.5 for n in columns)]
    mesh = np.meshgrid(*axes, indexing="ij")
    return np.array([part.ravel() for part in (*mesh[1:], mesh[0])])


class Block:
    """A region on a lattice whose first layer is active, with the fields that growing reads."""

    def __init__(self, backend, columns, layers, period):
        self.backend = backend
        host = block(columns, layers)
        count = host.shape[1]
        self.host = host
        self.fields = {
            "x": backend.asarray(host), "h": backend.zeros(count),
            "v": backend.zeros(host.shape), "kind": backend.zeros(count),
        }  # fmt: skip
        top = np.flatnonzero(host[-1] > -1.0)
        self.region = ActiveRegion(
            backend, self.fields["x"], SUPPORT, period, backend.asarray(top, "index")
        )

    def put(self, name, particle, value):
        """Set a field at one particle."""
        field = self.backend.to_host(self.fields[name])
        field[..., particle] = value
        self.fields[name] = self.backend.asarray(field)

    def grow(self):
        """Grow; returns whether it did."""
        return self.region.grow(self.fields)

    def depth(self):
        """Active layers in a column."""
        return int(-self.host[-1, self.backend.to_host(self.region.rows)].min() + 0.5)


@pytest.fixture
def column(backend):
    """A column of 60 layers: 19 cells of 59 / 19 = 3.1 spacings."""
    return Block(backend, (), 60, (0.0,))


def test_start(column):
    """The cell of the surface and two below are active: 9.3 spacings."""
    assert column.depth() == 10 and column.region.active_count == 10
    assert not column.grow()


def test_heat_activates_cells_around(column):
    """Above 1e-11 of the largest rise, and only then; one more cell becomes active."""
    column.put("h", 0, 1e6)
    assert not column.grow()
    column.put("h", 9, 0.9e-5)
    assert not column.grow()
    column.put("h", 9, 1.1e-5)
    assert column.grow() and column.depth() == 19
    assert not column.grow()


def test_motion_activates_and_ejecta_do_not(column):
    """What moves activates its surroundings; what has been ejected disturbs nothing."""
    column.put("h", 0, 1e6)
    assert not column.grow()
    column.put("v", 9, 1.0)
    column.put("h", 9, 1e5)
    column.put("kind", 9, EJECTED)
    assert not column.grow()
    column.put("kind", 9, INTERIOR)
    column.put("h", 9, 0.0)
    assert column.grow() and column.depth() == 19


def test_everything_active_has_no_rows(column):
    """Once all are active no index is needed."""
    for particle in range(60):
        column.put("h", particle, 1.0)
    assert column.grow()  # what was warm from the start is found wherever it is
    assert column.region.rows is None and column.region.active_count == 60
    assert not column.grow()


def test_periodic_sides(backend):
    """Cells become active around the ends of a period, not around those of a wall."""
    for period, active in (((24.0, 0.0), {0, 1, 2, 3, 5, 6, 7}), ((0.0, 0.0), {0, 1, 2, 3})):
        found = Block(backend, (24,), 40, period)
        found.put("h", 24 * 30, 1.0)  # layer 30, first column
        assert found.grow()
        rows = found.backend.to_host(found.region.rows)
        deep = rows[found.host[1, rows] == -30.5]
        width = 24.0 / 8 if period[0] else 23.0 / 7
        low = 0.5
        assert {int((x - low) / width) for x in found.host[0, deep]} == active


@pytest.mark.parametrize("period", [(18.0, 0.0), (0.0, 0.0)])
def test_pairs_are_those_of_all(backend, period):
    """Active rows have the neighbors that they have in the list of everything, others none."""
    found = Block(backend, (18,), 40, period)
    support = backend.asarray(np.full(18 * 40, SUPPORT))
    pairs = search_pairs(backend, found.fields["x"], support, period, found.region.subset)
    start, neighbor = (backend.to_host(a) for a in pairs)
    every = search.neighbor_list(
        backend, found.fields["x"], support, 18 * 40, mean=arithmetic, period=period
    )
    full_start, full = (backend.to_host(a) for a in every)
    active = set(backend.to_host(found.region.rows).tolist())
    assert 0 < len(active) < 18 * 40
    for row in range(18 * 40):
        mine = neighbor[start[row] : start[row + 1]]
        expected = full[full_start[row] : full_start[row + 1]] if row in active else []
        assert sorted(mine) == sorted(expected)


def flow(h_i, h_j, r_ij, dW_ij):
    """Heat from a neighbor for unit volumes and diffusivity."""
    return 2.0 * (h_i - h_j) * dW_ij / r_ij


def rate(total, q):
    """Conduction and light."""
    return total + q


def advanced(h, rate, step):
    """Explicit step."""
    return h + step * rate


def heated(backend, steps, *, is_partial):
    """Enthalpies after `steps` midpoint steps of a block heated over part of its surface."""
    found = Block(backend, (18,), 60, (18.0, 0.0))
    count = found.host.shape[1]
    q = np.where((found.host[1] > -1.0) & (found.host[0] < 9.0), 1.0, 0.0)
    support = backend.asarray(np.full(count, SUPPORT))
    if not is_partial:
        found.put("v", slice(None), 1e-3)
        found.grow()
        assert found.region.rows is None
    h, half, dh = found.fields["h"], backend.zeros(count), backend.zeros(count)
    light, pairs = backend.asarray(q), None
    for _ in range(steps):
        if found.grow() or pairs is None:
            start, neighbor = search_pairs(
                backend, found.fields["x"], support, (18.0, 0.0), found.region.subset
            )
            pairs = NeighborList(
                start, neighbor, found.fields["x"], support, kernel("cubic-spline", 2), arithmetic,
                (18.0, 0.0),
            )  # fmt: skip
        rows = found.region.rows
        for source, target, step in ((h, half, 0.1), (half, h, 0.2)):
            backend.pair_sum(
                flow, pairs, {"h": source, "q": light}, dh, finish=rate, rows=rows
            )  # fmt: skip
            backend.pointwise(advanced, {"h": h, "rate": dh}, target, rows=rows, step=step)
    return backend.to_host(h), found.region.active_count


def test_inactive_particles_change_nothing():
    """Equal to the full computation within 1e-8 of the temperature rise."""
    backend = compute.cpu(threads=1)
    partial, active_count = heated(backend, 60, is_partial=True)
    full, count = heated(backend, 60, is_partial=False)
    assert active_count < 0.95 * count
    assert np.abs(partial - full).max() < 1e-8 * full.max()
    assert np.abs(partial - full).max() < 1e-10 * full.max()  # far below what is promised
    assert partial.sum() == pytest.approx(full.sum(), rel=1e-9)


def test_restored_region_goes_on(column):
    """Mask and largest rise survive a checkpoint."""
    column.put("h", 0, 1e6)
    column.put("h", 9, 1.1e-5)
    assert column.grow()
    arrays = {"active": column.backend.to_host(column.region.fields["active"])}
    other = Block(column.backend, (), 60, (0.0,))
    other.region.restore(arrays, column.region.checkpoint_scalars())
    np.testing.assert_array_equal(
        column.backend.to_host(other.region.rows), column.backend.to_host(column.region.rows)
    )
    other.fields = column.fields
    assert not other.grow()
