"""Folded onto the real particles the pairs form a symmetric operator."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of


def operator_of(*settings):
    """Dense matrix of the folded weights, and their sums."""
    case = load_case("dlip-steel", ["solver.kind=conduction", "particles.spacing=125nm", *settings])
    body = recipe_of(case).build(compute.cpu(threads=2)).body
    pairs, to_host = body.pairs, body.backend.to_host
    start = to_host(pairs.neighbors.row_start).astype(np.int64)
    row = np.repeat(np.arange(body.count), np.diff(start))
    matrix = np.zeros((body.count, body.count))
    np.add.at(matrix, (row, to_host(pairs.neighbors.neighbor)), to_host(pairs.weights))
    return matrix, to_host(pairs.total), to_host(pairs.boundary_coefficient)


@pytest.mark.parametrize(
    "settings",
    [
        (),
        ("particles.ratio=0.6",),  # ends in a layer cut to a quarter
        ("particles.support_ratio=6", "domain.depth=4.8um"),
        ("domain.extent=full", "boundaries.sides=periodic", "particles.support_ratio=5"),
        ("boundaries.bottom=wall", "boundaries.surface=free"),
    ],
)
def test_symmetric(settings):
    """What flows from i to j arrives: else the budget of graded layers leaks at the sides."""
    matrix, total, coefficient = operator_of(*settings)
    assert np.abs(matrix - matrix.T).max() < 1e-12 * matrix.max()
    assert matrix.min() >= 0.0
    assert matrix.sum(axis=1) == pytest.approx(total, rel=1e-12)
    assert coefficient.any() == ("boundaries.bottom=wall" in settings)
