"""Corrected weights conduct exactly through every plane; the plain ones do not."""

import numpy as np
import pytest
from lattice_pairs import pairs_of

KERNELS = [("quintic-spline", 3.75), ("cubic-spline", 3.0), ("wendland-c2", 3.0)]
REACH = 5


@pytest.mark.parametrize(("name", "ratio"), KERNELS)
@pytest.mark.parametrize("dimension", [1, 2])
def test_linear_temperature_flows_exactly_on_graded_layers(dimension, name, ratio):
    """A unit gradient along z carries unit flux through each plane within 1e-3."""
    pairs = pairs_of(dimension, name, ratio=ratio)
    flux = pairs.flux_through_planes()[REACH:]
    assert flux == pytest.approx(np.ones(flux.size), abs=1e-3)


def test_linear_temperature_flows_exactly_in_three_dimensions():
    """The same in 3-D."""
    flux = pairs_of(3).flux_through_planes()[REACH:]
    assert flux == pytest.approx(np.ones(flux.size), abs=1e-3)


def test_plain_weights_lose_flux_where_layers_grow():
    """Without correction the graded zone conducts percents too little: what the factors repair."""
    flux = pairs_of(2, corrected=False).flux_through_planes()[REACH:]
    assert np.abs(flux - 1.0).max() > 0.02


@pytest.mark.parametrize("dimension", [2, 3])
def test_lateral_second_moment_of_each_layer(dimension):
    """sum of g x^2 over the pairs of a layer is 2 V, for each lateral axis."""
    pairs = pairs_of(dimension)
    for axis in range(dimension - 1):
        moment = np.bincount(pairs.i, pairs.g * pairs.offset(axis) ** 2)
        layer = pairs.filling.layer[: pairs.filling.count]
        volume = pairs.filling.volume[: pairs.filling.count]
        share = np.bincount(layer, moment) / np.bincount(layer, 2.0 * volume)
        assert share == pytest.approx(np.ones(share.size), abs=2e-3)


@pytest.mark.parametrize(("name", "ratio"), KERNELS)
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_uniform_lattice_has_the_second_moment_of_the_bulk(dimension, name, ratio):
    """On a uniform lattice sum g x_a x_b = 2 V delta_ab for every particle (mirrored faces)."""
    pairs = pairs_of(dimension, name, ratio=ratio, is_graded=False, depth=1.2e-6)
    volume = pairs.filling.volume[0]
    for a in range(dimension):
        for b in range(dimension):
            moment = np.bincount(pairs.i, pairs.g * pairs.offset(a) * pairs.offset(b))
            expected = 2.0 * volume if a == b else 0.0
            assert moment == pytest.approx(expected, abs=2e-3 * volume)


@pytest.mark.parametrize("dimension", [1, 2])
def test_weights_are_symmetric_and_not_negative(dimension):
    """g_ij = g_ji to rounding and no weight is negative, so that energy and order are kept."""
    pairs = pairs_of(dimension)
    count = pairs.filling.count
    inner = pairs.j < count
    i, j, g = pairs.i[inner], pairs.j[inner], pairs.g[inner]
    forward, backward = np.lexsort((j, i)), np.lexsort((i, j))
    assert np.array_equal(i[forward], j[backward])
    assert g[forward] == pytest.approx(g[backward], rel=1e-11, abs=1e-13 * g.max())
    assert pairs.g.min() >= 0.0
