"""Layers of uniform and graded lattices: counts, growth, cut, columns."""

import numpy as np
import pytest

from lasersph.particles import Domain, Geometry, Lattice
from lasersph.particles.layers import stack

FINE = 1e-8


def graded(depth, fine_depth, coarsest=1e-7):
    """Layers of a graded 2-D block 1 um wide."""
    lattice = Lattice(spacing=FINE, arrangement="graded", coarsest=coarsest)
    return stack(Domain(depth=depth, width=1e-6), lattice, Geometry(2), fine_depth)


def test_uniform_box():
    """1 um x 2 um in cells of 0.1 um: 20 layers of 10 columns, centers at -0.05, -0.15, ... um."""
    layers = stack(Domain(depth=2e-6, width=1e-6), Lattice(spacing=1e-7), Geometry(2), 0.0)
    assert layers.thickness.size == 20
    assert layers.particle_count == 200
    assert np.all(layers.columns == 10)
    assert layers.center()[:2] == pytest.approx([-0.5e-7, -1.5e-7])
    assert layers.center()[-1] == pytest.approx(-1.95e-6)
    assert layers.dimension == 2


def test_spacing_is_rounded_to_fill_width_and_depth():
    """0.3 um into 1 um wide: 3 columns of 1/3 um; 2 um deep: 6 layers of 1/3 um."""
    layers = stack(Domain(depth=2e-6, width=1e-6), Lattice(spacing=0.3e-6), Geometry(2), 0.0)
    assert np.all(layers.columns == 3)
    assert layers.thickness == pytest.approx(np.full(6, 1e-6 / 3))
    assert layers.column_width() == pytest.approx(np.full((1, 6), 1e-6 / 3))


def test_one_and_three_dimensions():
    """1-D has no columns; 3-D multiplies those of x and y."""
    lattice = Lattice(spacing=1e-7)
    line = stack(Domain(depth=1e-6), lattice, Geometry(1), 0.0)
    assert (line.dimension, line.particle_count, line.columns.shape) == (1, 10, (0, 10))
    block = stack(Domain(depth=1e-6, width=5e-7, breadth=3e-7), lattice, Geometry(3), 0.0)
    assert block.particle_count == 10 * 5 * 3


def test_half_extent_starts_at_the_symmetry_plane():
    """Half of 1 um: x from 0 to 0.5 um, half the columns."""
    domain = Domain(depth=1e-6, width=1e-6, extent="half")
    layers = stack(domain, Lattice(spacing=1e-7), Geometry(2), 0.0)
    assert layers.bounds == ((0.0, 5e-7),)
    assert np.all(layers.columns == 5)
    assert domain.symmetry_factor == 2


def test_graded_layers_grow_by_nine_sevenths():
    """Fine layers first, each next one 9/7 thicker until the coarsest, all of them the depth."""
    layers = graded(2e-6, 1e-7)
    d = layers.thickness
    assert d[:10] == pytest.approx(np.full(10, FINE))
    ratio = d[1:] / d[:-1]
    assert ratio[9:18] == pytest.approx(np.full(9, 9.0 / 7.0))
    assert np.all(ratio[:-1] >= 1.0 - 1e-12)
    assert d.max() <= 1e-7 * 1.25
    assert d.sum() == pytest.approx(2e-6, rel=1e-12)
    assert layers.center()[-1] - 0.5 * d[-1] == pytest.approx(-2e-6)


def test_published_stack():
    """1 um (7/9)^22 = 3.970 nm; the 22 layers above it up to 1 um sum to 4.48 um."""
    spacing = 1e-6 * (7.0 / 9.0) ** 22
    assert spacing == pytest.approx(3.970e-9, rel=1e-3)
    lattice = Lattice(spacing=spacing, arrangement="graded", coarsest=1e-6)
    coarse = 1e-6 * np.sum((7.0 / 9.0) ** np.arange(22))
    domain = Domain(depth=10 * spacing + coarse, width=5e-6)
    layers = stack(domain, lattice, Geometry(2), 10 * spacing)
    spacing_used = 5e-6 / 1259
    assert layers.columns[0, 0] == 1259
    assert layers.thickness[:10] == pytest.approx(np.full(10, spacing_used))
    assert coarse == pytest.approx(4.482e-6, rel=1e-3)
    assert layers.thickness.size in (32, 33)


@pytest.mark.parametrize("rest", [0.05, 0.2, 0.3, 0.8])
def test_last_layer_is_cut_or_joined(rest):
    """A last layer below a quarter of its thickness is joined to the one above, else cut."""
    layers = graded(2e-7 + FINE * 9 / 7 * rest, 2e-7)
    d = layers.thickness
    assert d.sum() == pytest.approx(2e-7 + FINE * 9 / 7 * rest, rel=1e-12)
    if rest < 0.25:
        assert d.size == 20
        assert d[-1] == pytest.approx(FINE * (1 + 9 / 7 * rest))
    else:
        assert d.size == 21
        assert d[-1] == pytest.approx(FINE * 9 / 7 * rest)


def test_fine_depth_beyond_the_domain_is_uniform():
    """Where the fine depth exceeds the domain all layers are fine."""
    layers = graded(1e-7, 1.0)
    assert layers.thickness == pytest.approx(np.full(10, FINE))


def test_domain_without_width():
    """2-D without a width is refused."""
    with pytest.raises(ValueError, match="needs a width"):
        stack(Domain(depth=1e-6), Lattice(spacing=1e-7), Geometry(2), 0.0)
