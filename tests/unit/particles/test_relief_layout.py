"""Particles laid out below a relief."""

import numpy as np
import pytest

from lasersph.particles import Domain, Geometry, Lattice
from lasersph.particles.filling import fill
from lasersph.particles.layers import stack
from lasersph.particles.relief_layout import carry_over, lay_below, resample


@pytest.fixture(scope="module")
def layers():
    """Ten fine layers of 20 columns of 100 nm over coarser ones."""
    domain = Domain.model_validate({"width": 2e-6, "depth": 4e-6})
    lattice = Lattice.model_validate({"spacing": 1e-7, "arrangement": "graded"})
    return stack(domain, lattice, Geometry(2), 1e-6)


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


def test_resample():
    """Sums stay, a constant stays, the same edges change nothing, and a line is exact inside."""
    rng = np.random.default_rng(3)
    edges = np.append(0.0, np.cumsum(rng.uniform(0.5, 1.0, 20)))
    new = np.linspace(0.0, edges[-1], 15)
    line = 0.5 * (edges[1:] + edges[:-1])
    values = np.array([np.ones(20), line, rng.uniform(size=20)])
    found = resample(edges[None], values[:, None], new)[:, 0]
    assert np.abs(found @ np.diff(new) - values @ np.diff(edges)).max() < 1e-13
    assert np.abs(found[0] - 1.0).max() < 1e-14
    inside = slice(2, -2)
    assert np.abs(found[1] - 0.5 * (new[1:] + new[:-1]))[inside].max() < 1e-13
    assert found[2].max() <= values[2].max() and found[2].min() >= values[2].min()
    assert np.abs(resample(edges[None], values[:, None], edges)[:, 0] - values).max() < 1e-13


def test_particles_carry_what_they_hold(layers):
    """Below a relief from which much has left, with columns that hold too much or too little."""
    rng = np.random.default_rng(5)
    start = lay_below(layers, np.zeros(20))
    x, z = start.position
    lost = 3e-7 + 1e-7 * np.cos(np.pi * x / 1e-6)
    volume = start.volume * (1.0 - lost / 1e-6)
    place = np.array([x + rng.uniform(-3e-8, 3e-8, x.size), z * (1.0 - lost / 1e-6) - lost])
    h, u = 1e6 * np.exp(z / 3e-7), np.sin(np.pi * x / 1e-6)
    height = -3e-7 - 1e-7 * np.cos(np.pi * (-1e-6 + 1e-7 * (np.arange(20) + 0.5)) / 1e-6)
    volume *= 1.0 + 0.02 * rng.uniform(-1.0, 1.0, x.size)
    layout = lay_below(layers, height)
    new_volume, (new_h, new_u) = carry_over(layers, layout, place, volume, np.array([h, u]))
    assert new_volume.sum() == pytest.approx(volume.sum(), rel=1e-14)
    assert new_volume @ new_h == pytest.approx(volume @ h, rel=1e-13)
    assert new_volume @ new_u == pytest.approx(volume @ u, abs=1e-13 * (volume @ np.abs(u)))
    assert np.ptp(new_volume / layout.volume) < 1e-12
    # what lay at one height below the relief still does
    depth = np.interp(layout.position[0], x[:20], height) - layout.position[1]
    wanted = 1e6 * np.exp(-depth / (1.0 - lost[np.argsort(x)].mean() / 1e-6) / 3e-7)
    assert np.abs(new_h - wanted).max() < 0.1e6
    assert np.abs(new_u - np.sin(np.pi * layout.position[0] / 1e-6)).max() < 0.06


def test_relief_over_x_and_y():
    """In 3-D: the lattice below a plane; below a dot the volume is what lies below it, and what
    particles carry stays in sum, a constant everywhere the same."""
    domain = Domain.model_validate({"width": 1e-6, "breadth": 1.2e-6, "depth": 4e-6})
    lattice = Lattice.model_validate({"spacing": 1e-7, "arrangement": "graded"})
    layers = stack(domain, lattice, Geometry(3), 5e-7)
    sides = {"surface": "mirror", "bottom": "mirror", "sides": "mirror"}
    shape = tuple(int(n) for n in layers.columns[:, 0])
    flat = lay_below(layers, np.zeros(shape))
    count = flat.volume.size
    assert np.abs(flat.position - fill(layers, **sides).position[:, :count]).max() < 1e-18

    x, y = (np.linspace(-1.0, 1.0, 2 * n + 1)[1::2] for n in shape)
    height = 8e-8 * np.cos(np.pi * x)[:, None] * np.cos(np.pi * y) - 2e-8
    layout = lay_below(layers, height)
    area = 1.2e-12 / height.size
    below = (layers.fine_depth + height).sum() * area
    assert layout.volume.sum() == pytest.approx(below, rel=1e-14, abs=0.0)
    fields = np.array([np.full(count, 3.0), flat.position[0] * 1e6, flat.position[1] * 1e6])
    volume, found = carry_over(layers, layout, flat.position, flat.volume, fields)
    assert volume.sum() == pytest.approx(flat.volume.sum(), rel=1e-14, abs=0.0)
    assert found[0] == pytest.approx(3.0, rel=1e-12)
    scale = np.abs(fields) @ flat.volume
    assert found @ volume == pytest.approx(fields @ flat.volume, abs=1e-12 * scale.max())
    # what was passed on has hardly moved
    assert np.abs(found[1] - 1e6 * layout.position[0]).max() < 0.1
