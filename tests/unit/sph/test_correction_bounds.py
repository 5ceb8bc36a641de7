"""Where the kernel correction is refused: M of disturbed, one-sided, dense and thin bodies."""

import numpy as np
import pytest

from lasersph.sph import correction
from lasersph.sph.kernels import kernel

ROWS = np.arange(-5.0, 6.0)
LATTICE = np.array([(x, z) for x in ROWS for z in ROWS])
"""Places over the spacing, the particle itself at 0."""


def moments(places, name, ratio, volume=1.0):
    """M (2, 2) of the particle at 0 from neighbors within `ratio` spacings."""
    distance = np.hypot(*places.T)
    is_near = (distance > 0.0) & (distance < ratio)
    pairs = zip(-places[is_near], distance[is_near], strict=True)
    slope = kernel(name, 2).derivative
    return sum(correction.correction_term(volume, x, r, slope(r, ratio)) for x, r in pairs)


def shape_of(M):
    """det M and (tr M)^2 / det M."""
    size = np.linalg.det(M)
    return size, np.trace(M) ** 2 / size


def is_corrected(M):
    """Whether M is inverted; else C = 1."""
    found = np.array(correction.bounded_inverse(M))
    assert np.allclose(found, np.linalg.inv(M)) or np.array_equal(found, np.eye(2))
    return not np.array_equal(found, np.eye(2))


@pytest.mark.parametrize("ratio", [3.1, 3.75])
@pytest.mark.parametrize("name", ["cubic-spline", "wendland-c2"])
def test_bounds_of_the_correction(name, ratio):
    """Particles as disturbed as in a flow are corrected, those beside a gap are not."""
    random = np.random.default_rng(1)
    places = LATTICE + random.uniform(-0.3, 0.3, (200, *LATTICE.shape))
    places[:, len(LATTICE) // 2] = 0.0
    found = [moments(one, name, ratio) for one in places]
    sizes, directions = np.array([shape_of(M) for M in found]).T
    assert sizes.min() > 0.68 and sizes.max() < 1.28 and directions.max() < 4.2
    assert all(is_corrected(M) for M in found)
    half = moments(LATTICE[LATTICE[:, 1] <= 0.0], name, ratio)
    quarter = moments(LATTICE[np.max(LATTICE, axis=1) <= 0.0], name, ratio)
    dense = moments(LATTICE, name, ratio, volume=1.3)
    assert not is_corrected(half) and not is_corrected(quarter) and not is_corrected(dense)
    assert np.linalg.det(half) < 0.37 and shape_of(dense)[0] == pytest.approx(1.68, abs=0.02)
    # two rows alone, of the size of a body, are corrected, what is thinner is not
    strip = moments(LATTICE[np.abs(LATTICE[:, 1] - 0.5) < 1.0], name, ratio)
    size, direction = shape_of(strip)
    assert 4.6 < direction < 5.5
    assert is_corrected(strip / size**0.5) and not is_corrected(np.diag([1.8, 0.55]))
