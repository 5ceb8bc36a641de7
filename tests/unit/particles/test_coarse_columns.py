"""Coarse columns beside the fine ones: their cells, their dummies, and means of lines."""

import numpy as np
import pytest

from lasersph.particles import Domain, Geometry, Lattice
from lasersph.particles.coarse_columns import linear_means
from lasersph.particles.extended_lattice import DIRICHLET, FACES, FREE, MIRROR
from lasersph.particles.filling import fill
from lasersph.particles.layers import LEAST_BESIDE, stack

GEOMETRIES = {"plane": Geometry(2), "section": Geometry(2, True), "space": Geometry(3)}
FINE = 1e-7


def block(geometry=GEOMETRIES["plane"], *, extent="full", width=1.2e-5, fine_width=1.2e-6):
    """Layers of 0.1 um that grow by 0.8 to 0.4 um, downward and sideways."""
    lattice = Lattice(spacing=FINE, arrangement="graded", ratio=0.8, coarsest=4e-7)
    domain = Domain(depth=2e-6, width=width, extent=extent)
    return stack(domain, lattice, geometry, 8e-7, fine_width)


@pytest.mark.parametrize("name", GEOMETRIES)
def test_cells_fill_the_block(name):
    """Volumes and cross-sections add up to those of the block, and every particle has a number."""
    geometry = GEOMETRIES[name]
    layers = block(geometry)
    filling = fill(layers, surface=MIRROR, bottom=MIRROR, sides=MIRROR)
    whole = {"plane": 1.2e-5, "section": np.pi * 1.44e-10, "space": 1.44e-10}[name]
    assert filling.count == layers.particle_count > filling.fine_count == layers.fine_count
    assert filling.body_volume.sum() == pytest.approx(2e-6 * whole, rel=1e-12)
    at_surface = filling.cross_section[filling.surface]
    assert at_surface.sum() == pytest.approx(whole, rel=1e-12)
    assert np.array_equal(filling.source[: filling.count], np.arange(filling.count))
    over = filling.position[:-1, filling.surface[filling.above]]
    apart = np.abs(over - filling.position[:-1, : filling.count])
    assert np.all(apart <= 0.5 * filling.width[:-1, filling.surface[filling.above]] * (1 + 1e-9))


def test_widths_grow_outward_on_both_sides():
    """From the finest by the ratio to the coarsest, the same to the left and to the right; the last
    one takes what is left."""
    (low, high), *_ = block().beside
    assert np.array_equal(low, high)
    assert high[0] == pytest.approx(FINE, rel=1e-9)
    growing = high[high < 3.9e-7]
    assert growing[1:] == pytest.approx(growing[:-1] / 0.8, rel=1e-9)
    assert high[:-1].max() == pytest.approx(4e-7, rel=1e-9)
    assert block().fine_bounds[0] == pytest.approx((-1.2e-6, 1.2e-6))
    assert block(extent="half").beside[0][0].size == 0


def test_narrow_blocks_have_fine_columns_alone():
    """Nothing grows where pairs of the thickest layer would reach over all that lies beside."""
    reach = LEAST_BESIDE * 3.75 * 4e-7
    narrow, wide = (
        block(width=2.0 * (1.2e-6 + factor * reach), fine_width=1.2e-6) for factor in (0.95, 1.1)
    )
    assert not narrow.beside
    assert narrow.fine_only.fine_bounds == narrow.bounds
    assert wide.beside


def test_dummies_of_coarse_cells():
    """One beyond each outer face, as far from it as the middle of its cell; none of free ones."""
    layers = block(GEOMETRIES["section"])
    filling = fill(layers, surface=FREE, bottom=DIRICHLET, sides=MIRROR)
    beside = filling.beside
    dummy = filling.position.shape[1] - beside.owner.size + np.arange(beside.owner.size)
    below = beside.axis == 1
    assert below.sum() == layers.beside[0][1].size
    assert np.all(filling.dirichlet[dummy[below]] == FACES.index("bottom"))
    middle = 0.5 * (filling.position[:, dummy] + filling.position[:, beside.owner])
    assert middle[1, below] == pytest.approx(-2e-6)
    assert middle[0, ~below] == pytest.approx(1.2e-5)
    assert (~below).sum() == layers.thickness.size


def test_dummies_beside_fine_columns_lie_among_coarse_cells():
    """As they are numbered they come after all particles, and stand for no fine one."""
    filling = fill(block(), surface=MIRROR, bottom=MIRROR, sides=MIRROR)
    beside = filling.beside
    assert np.all(beside.joined >= filling.count)
    x, z = beside.place
    assert np.all((np.abs(x) > 1.2e-6) & (np.abs(x) < 6e-6) & (z < 0.0) & (z > -2e-6))


def test_means_of_lines():
    """Weights of an interval add up to 1 and keep straight lines, beyond the ends, too."""
    random = np.random.default_rng(1)
    nodes = np.cumsum(random.uniform(0.5, 2.0, 12))
    lower = random.uniform(nodes[0] - 0.5, nodes[-1] - 1.0, 40)
    upper = lower + random.uniform(0.1, 6.0, 40)
    interval, node, weight = linear_means(nodes, lower, upper)
    assert np.bincount(interval, weight) == pytest.approx(1.0)
    assert np.bincount(interval, weight * nodes[node]) == pytest.approx(0.5 * (lower + upper))
    # the mean of a tent over its own width and beyond: half its area
    _, node, weight = linear_means(np.array([0.0, 1.0, 2.0]), np.zeros(1), np.array([2.0]))
    assert dict(zip(node, weight, strict=True))[1] == pytest.approx(0.5)


def test_one_node_is_all_there_is():
    """A single coarse column has no slope."""
    assert linear_means(np.array([3.0]), np.zeros(2), np.ones(2))[2].tolist() == [1.0, 1.0]
