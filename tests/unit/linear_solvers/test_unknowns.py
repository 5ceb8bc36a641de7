"""What is kept of positions and mask is what would be found anew."""

import numpy as np
import pytest
from spot_pools import spot_pool

from lasersph.linear_solvers.unknowns import Unknowns

LINE = np.array([[0.5, 1.5, 2.5, 3.5, 4.5], [-0.5] * 5])
STEPS = 40


def cooling_ball(r, z):
    """Melt within 0.9 um of the center, in cold solid."""
    return np.where(np.hypot(r, z) < 9e-7, 2000.0, 300.0)


def unknowns_of(backend, mask, version):
    """Components and cells of a line of five, some of them masked."""
    unknowns = Unknowns(backend, 5, 3.0, 1.0)
    unknowns.find(backend.asarray(LINE), backend.asarray(mask), version)
    return unknowns


def test_components_and_the_cells_around_them(backend):
    """Cells two spacings wide around four of five particles; each holds two."""
    unknowns = unknowns_of(backend, [0.0, 1.0, 1.0, 1.0, 1.0], None)
    assert backend.to_host(unknowns.components.number).tolist() == [0, 1, 1, 1, 1]
    assert unknowns.cells.grid.shape == (3, 1)
    start = backend.to_host(unknowns.cells.members.row_start)
    assert start.tolist()[:4] == [0, 1, 3, 4]


def test_only_another_version_is_found_anew(backend):
    """The mask of a known version is not read; that of another one is, and of none always."""
    unknowns = unknowns_of(backend, [1.0] * 5, (0, 1))
    position, mask = backend.asarray(LINE), backend.asarray([0.0, 1.0, 1.0, 1.0, 1.0])
    unknowns.find(position, mask, (0, 1))
    assert backend.to_host(unknowns.components.mask).sum() == 5.0
    unknowns.find(position, mask, (0, 2))
    assert backend.to_host(unknowns.components.mask).sum() == 4.0
    unknowns.find(position, backend.asarray([1.0] * 5), None)
    assert backend.to_host(unknowns.components.mask).sum() == 5.0


@pytest.mark.parametrize("surface", ["flat", "moving"])
def test_pools_follow_their_melt(monkeypatch, surface):
    """Melt that flows and freezes: the same bits as where all is found anew in every step."""

    def temperatures():
        flow = {"flow": {"surface": surface}}
        _, solver = spot_pool(cooling_ball, material="steel-304", solver=flow)
        for _ in range(STEPS):
            solver.step(min(solver.time_step_limits().values()))
        return solver.kinds.changes, solver.backend.to_host(solver.particles["temperature"])

    changes, kept = temperatures()
    find = Unknowns.find
    monkeypatch.setattr(Unknowns, "find", lambda self, x, mask, version: find(self, x, mask))
    again, anew = temperatures()
    assert 1 < changes == again
    assert np.array_equal(kept, anew)
