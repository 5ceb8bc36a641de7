"""Surface of a body of particles: two particles by hand, and lattices."""

import numpy as np
import pytest
from lattices import lattice, with_neighbors

from lasersph.sph.divergence import SURFACE_THRESHOLD
from lasersph.sph.free_surface import SMALLEST_NORMAL, surface_state, surface_terms

CASES = {1: (0.494, 0.790), 2: (1.231, 1.799), 3: (1.985, 2.810)}
"""Divergence of the positions in the first and second layer, cubic spline, h = 1.5 dx."""


def test_two_particles():
    """A neighbor below gives -V r dW to the divergence and a normal upward."""
    x_ij = np.array([0.0, 2.0])
    divergence, normal = surface_terms(0.5, 1.0, x_ij, 2.0, -3.0)
    assert divergence == 3.0
    np.testing.assert_array_equal(normal, [0.0, 1.5])
    divergence, normal = surface_terms(0.5, 0.0, x_ij, 2.0, -3.0)
    assert divergence == 0.0 and not normal.any()


def test_state():
    """Exposed below the threshold; a particle without direction points up."""
    up = np.array([0.0, 1.0])
    total = np.array([0.0, -4.0])
    assert surface_state(1.6, total, 1.0, 1.5, up, 0.1, 7.0)[1] == 0.0
    _, exposed, normal, area = surface_state(1.4, total, 1.0, 1.5, up, 0.1, 7.0)
    assert exposed == 1.0 and area == 7.0
    np.testing.assert_array_equal(normal, [0.0, -1.0])
    np.testing.assert_array_equal(surface_state(0.0, 0.0 * total, 1.0, 1.5, up, 0.1, 7.0)[2], up)
    assert surface_state(0.0, total, 0.0, 1.5, up, 0.1, 7.0)[1] == 0.0


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_top_layer_of_a_lattice(backend, dimension):
    """The threshold picks exactly the top layer, whose normals point up."""
    side = {1: 20, 2: 12, 3: 10}[dimension]
    position = 2e-7 * lattice(dimension, side)
    count = position.shape[1]
    neighbors = with_neighbors(backend, position, 6e-7)
    fields = {
        "V": backend.asarray(np.full(count, 2e-7**dimension)),
        "o": backend.asarray(np.ones(count)),
    }
    out = (
        backend.zeros(count), backend.zeros(count), backend.zeros((dimension, count)),
        backend.zeros(count),
    )  # fmt: skip
    backend.pair_sum(
        surface_terms, neighbors, fields, out, finish=surface_state,
        threshold=SURFACE_THRESHOLD[dimension], up=(0.0,) * (dimension - 1) + (1.0,),
        least=SMALLEST_NORMAL / 2e-7, face=2e-7 ** (dimension - 1),
    )  # fmt: skip
    divergence, exposed, normal, area = (backend.to_host(part) for part in out)
    # away from the other faces: the column through the middle, from the top down
    center = 0.5 * (position.min(axis=1) + position.max(axis=1))[:-1, None]
    middle = np.all(np.abs(position[:-1] - center) < 1.1e-7, axis=0)
    column = np.flatnonzero(middle)[np.argsort(-position[-1, middle])]
    per_layer = 2 ** (dimension - 1)
    top, second, third = (column[k * per_layer] for k in range(3))
    np.testing.assert_allclose(divergence[[top, second]], CASES[dimension], atol=1e-3)
    assert exposed[top] == 1.0 and exposed[second] == 0.0 and exposed[third] == 0.0
    np.testing.assert_allclose(normal[:, top], np.eye(dimension)[-1], atol=1e-12)
    assert area[top] == pytest.approx(2e-7 ** (dimension - 1)) and area[third] == 0.0
