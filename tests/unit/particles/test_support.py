"""Support radius of a pair against the paper's sums."""

import pytest

from lasersph.particles.support import arithmetic, graded

Q = 7.0 / 9.0


@pytest.mark.parametrize("k", [1, 2, 3])
def test_graded_is_equation_63(k):
    """l_ij = l_i / (2 k) (1 + q) (1 - q^k) / (1 - q) for layers k refinements apart."""
    coarse = 3.75e-6
    expected = coarse / (2 * k) * (1 + Q) * (1 - Q**k) / (1 - Q)
    assert graded(coarse, coarse * Q**k) == pytest.approx(expected, rel=1e-8)
    assert graded(coarse * Q**k, coarse) == pytest.approx(expected, rel=1e-8)


def test_one_refinement_is_the_arithmetic_mean():
    """For k = 1 eq. (63) is the mean of both radii."""
    assert graded(9.0, 7.0) == pytest.approx(8.0, rel=1e-8)


def test_equal_radii():
    """Equal radii (k = 0) stay, without dividing by zero; near equality nothing jumps much."""
    assert graded(2.0, 2.0) == 2.0
    assert graded(2.0, 2.0 * 1.00101) == pytest.approx(graded(2.0, 2.0 * 1.00099), rel=6e-3)
    assert arithmetic(1.0, 2.0) == 1.5
