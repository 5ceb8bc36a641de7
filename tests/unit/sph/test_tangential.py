"""Gradient along flat and tilted surfaces, and the values that particles near them take."""

import numpy as np
import pytest
from lattices import lattice, with_neighbors

from lasersph.sph.tangential import (
    extend_from_surface,
    extension_terms,
    tangential_gradient,
    tangential_terms,
)

SLOPES = {2: np.array([2.0, 3.0]), 3: np.array([2.0, 3.0, -1.0])}


def turned(dimension, angle):
    """Lattice of 7 layers a side turned about y by `angle`, its top layer and its normal."""
    place = lattice(dimension, 7) - 3.0
    top = (place[-1] == 3.0).astype(float)
    c, s = np.cos(angle), np.sin(angle)
    R = np.eye(dimension)
    R[0, 0] = R[-1, -1] = c
    R[0, -1], R[-1, 0] = s, -s
    return R @ place, top, R[:, -1]


def gradient_on(backend, place, top, normal, f, *, is_field):
    """The tangential gradient of f; the normal as a constant or as a field."""
    dimension, count = place.shape
    neighbors = with_neighbors(backend, place, 3.0)
    fields = {
        "f": backend.asarray(f),
        "s": backend.asarray(top),
        "V": backend.asarray(np.ones(count)),
    }
    constants = {}
    if is_field:
        fields["n"] = backend.asarray(np.repeat(normal[:, None], count, axis=1))
    else:
        constants["n"] = tuple(float(v) for v in normal)
    out = backend.zeros((dimension, count))
    backend.pair_sum(
        tangential_terms, neighbors, fields, out, finish=tangential_gradient, **constants
    )
    return backend.to_host(out)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("angle", [0.0, 0.4, -1.1])
@pytest.mark.parametrize("is_field", [False, True])
def test_exact_on_linear_fields(backend, dimension, angle, is_field):
    """grad f without its part along n, at rims and corners of the surface too; 0 below it."""
    place, top, normal = turned(dimension, angle)
    slope = SLOPES[dimension]
    found = gradient_on(backend, place, top, normal, 5.0 + slope @ place, is_field=is_field)
    along = slope - (slope @ normal) * normal
    expected = top * along[:, None]
    assert found == pytest.approx(expected, abs=1e-12)


def test_curved_surface(backend):
    """On a circle the normal turns with the place: d f/ds of f = angle is 1 / radius."""
    radius, count = 40.0, 80
    angle = 2.0 * np.pi * np.arange(count) / count
    normal = np.array([np.sin(angle), np.cos(angle)])
    neighbors = with_neighbors(backend, radius * normal, 12.0)
    f = np.sin(angle)
    fields = {
        "f": backend.asarray(f), "s": backend.asarray(np.ones(count)),
        "V": backend.asarray(np.ones(count)), "n": backend.asarray(normal),
    }  # fmt: skip
    out = backend.zeros((2, count))
    backend.pair_sum(tangential_terms, neighbors, fields, out, finish=tangential_gradient)
    tangent = np.array([np.cos(angle), -np.sin(angle)])
    found = (backend.to_host(out) * tangent).sum(axis=0)
    assert found == pytest.approx(np.cos(angle) / radius, abs=0.03 / radius)
    assert (backend.to_host(out) * normal).sum(axis=0) == pytest.approx(0.0, abs=1e-12)


def test_two_terms_by_hand():
    """Neighbor at +2 e_x, V = 3, W' = -0.5: V df 0.5 e_x = 6 e_x, M = 3 * 0.5 * 2 e_x e_x."""
    x_ij = np.array([-2.0, 0.0])
    slope, M = tangential_terms(1.0, 5.0, 1.0, 3.0, x_ij, 2.0, -0.5)
    assert slope.tolist() == [6.0, 0.0]
    assert M.tolist() == [[3.0, 0.0], [0.0, 0.0]]
    up = np.array([0.0, 1.0])
    assert tangential_gradient(slope, M, up, 1.0).tolist() == [2.0, 0.0]
    assert tangential_gradient(slope, M, up, 0.0).tolist() == [0.0, 0.0]
    below, nothing = tangential_terms(1.0, 5.0, 0.0, 3.0, x_ij, 2.0, -0.5)
    assert not below.any() and not nothing.any()


def test_extension():
    """Its own value at the surface; near it the mean of the surface by W; far below none."""
    terms = np.array([extension_terms(4.0, 1.0, 0.5), extension_terms(1.0, 1.0, 1.0)])
    total = terms.sum(axis=0)
    assert extend_from_surface(*total, 7.0, 1.0) == 7.0
    assert extend_from_surface(*total, 0.0, 0.0) == pytest.approx((4.0 * 0.5 + 1.0) / 1.5)
    assert extension_terms(9.0, 0.0, 0.5) == (0.0, 0.0)
    assert extend_from_surface(0.0, 0.0, 9.0, 0.0) == 0.0
