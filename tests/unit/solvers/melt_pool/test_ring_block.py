"""Pairs of rings in a pool: weights of flow and of heat, from the axis to the side."""

import numpy as np
import pytest
from flow_boxes import matrix_of
from spot_pools import half_ball, spot_pool

from lasersph.sph.rings import STEPS, evened_ring_weight


@pytest.fixture(params=["moving", "flat"])
def block(request):
    """Of a wide spot, so that rings in its middle need no additions."""
    flow = {"flow": {"surface": request.param}}
    solver = spot_pool(half_ball, width=4e-6, material="steel-304", solver=flow)[1]
    solver.time_step_limits()
    solver.advect(1e-12)
    return solver.flow.block


def test_rings_that_need_none_have_no_additions(block):
    """Beside the axis and the side they have some; in the middle none see one with some."""
    additions = np.asarray(block.lattice.additions).reshape(-1, STEPS)
    r = block.lattice.position[0, : additions.shape[0]]
    has_some = additions.any(axis=1)
    assert has_some[r < 1e-7].any()
    assert has_some[r > 3.9e-6].any()
    assert not has_some[abs(r - 2e-6) < 5e-7].any()


def test_heat_has_additions_wherever_they_are(block):
    """Weights of heat are those that each pair would have, were it asked for its additions."""
    backend = block.backend
    fields = {"g_ij": block.weights, "layer": block.layers.fields["layer"]}
    fields |= {"ring": block.gather(backend.asarray(np.arange(float(block.count))))}
    fields |= {"has_none": block.walls.rules["dirichlet"]}
    table = {"additions": block.lattice.additions, "layers": float(block.lattice.layers)}
    found = backend.zeros(block.weights.shape[0])
    backend.pair_values(evened_ring_weight, block.pairs, fields, found, rows=block.rows, **table)
    start = np.asarray(block.pairs.row_start).astype(int)
    rows = range(block.count) if block.rows is None else np.asarray(block.rows).astype(int)
    pairs = np.concatenate([np.arange(start[row], start[row + 1]) for row in rows])
    heat, weights, found = (
        np.asarray(values)[pairs] for values in (block.heat_weights, block.weights, found)
    )
    assert np.array_equal(heat, found)
    assert np.count_nonzero(heat != weights) > 0


def test_weights_beside_a_steep_axis_are_symmetric():
    """Below a dimple of a slope of 0.8 ghosts of the first rings lie beyond the axis: what goes
    from i to j arrives all the same."""
    dimple = {"amplitude": -3.5e-7, "radius": 4e-7}
    flow = {"surface": "moving", "initial_surface": dimple}
    solver = spot_pool(half_ball, material="steel-304", depth=1.5e-6, solver={"flow": flow})[1]
    solver.time_step_limits()
    solver.advect(1e-12)
    block = solver.flow.block
    place, image = (np.asarray(one) for one in (block.pairs.position, block.crossing))
    beyond = np.asarray(block._radii) < 0.0
    assert np.count_nonzero((place[0] < 0.0) & (image == 1.0) & ~beyond) > 3
    g = matrix_of(block.backend, block.without_ghosts(), block.weights, block.count)
    known = np.ix_(*2 * (np.asarray(block.rows) if block.rows is not None else slice(None),))
    assert np.abs(g - g.T)[known].max() < 1e-11 * g.max()
