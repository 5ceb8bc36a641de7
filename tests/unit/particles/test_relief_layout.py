"""Particles laid out below a relief."""

import numpy as np
import pytest

from lasersph.particles import Domain, Lattice
from lasersph.particles.filling import fill
from lasersph.particles.layers import stack
from lasersph.particles.relief_layout import lay_below


@pytest.fixture(scope="module")
def layers():
    """Ten fine layers of 20 columns of 100 nm over coarser ones."""
    domain = Domain.model_validate({"width": 2e-6, "depth": 4e-6})
    lattice = Lattice.model_validate({"spacing": 1e-7, "arrangement": "graded"})
    return stack(domain, lattice, 2, 1e-6)


def test_flat_surface_gives_the_lattice(layers):
    """The same places in the same order."""
    sides = {"surface": "mirror", "bottom": "mirror", "sides": "mirror"}
    lattice = fill(layers, **sides).position[:, :200]
    layout = lay_below(layers, np.zeros(20))
    assert np.abs(layout.position - lattice).max() < 1e-12 * 1e-6
    assert np.ptp(layout.volume) < 1e-12 * 1e-14


def test_relief(layers):
    """As many particles with the volume below the relief, even, the uppermost half a cell deep."""
    x = -1e-6 + 1e-7 * (np.arange(20) + 0.5)
    height = 3e-7 * np.cos(np.pi * x / 1e-6) - 2e-8
    layout = lay_below(layers, height)
    assert layout.position.shape == (2, 200)
    assert layout.volume.sum() == pytest.approx((1e-6 + height).sum() * 1e-7, rel=1e-14)
    assert 0.9e-7 < layout.heights[0] < layout.heights[1] < 1.1e-7
    column = np.floor((layout.position[0] + 1e-6) / 1e-7).astype(int)
    for number in range(20):
        inside = column == number
        top = layout.position[1, inside].max() + 0.5e7 * layout.volume[inside][0]
        assert top == pytest.approx(height[number], abs=1e-15)
    places = layout.position.T
    gaps = np.linalg.norm(places[:, None] - places[None], axis=-1) + np.eye(200)
    assert gaps.min() > 0.9e-7


def test_too_deep(layers):
    """A column without a particle is refused."""
    height = np.zeros(20)
    height[3] = -1e-6
    with pytest.raises(ValueError, match="reaches the lower end"):
        lay_below(layers, height)
