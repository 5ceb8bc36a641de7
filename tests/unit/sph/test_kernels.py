"""Kernels at distances where their values are small fractions."""

from math import pi

import pytest

from lasersph.sph.kernels import kernel


def test_cubic_spline_by_hand():
    """l = 2: 2/3, 1/6 and 0 at 0, 1 and 2 in 1-D, slope -1/2 at 1; 10/(7 pi), 1/pi at 0 else."""
    line = kernel("cubic-spline", 1)
    assert [line.value(r, 2.0) for r in (0.0, 1.0, 2.0, 3.0)] == pytest.approx([2 / 3, 1 / 6, 0, 0])
    assert [line.derivative(r, 2.0) for r in (0.0, 1.0, 2.0)] == pytest.approx([0.0, -0.5, 0.0])
    assert kernel("cubic-spline", 2).value(0.0, 2.0) == pytest.approx(10.0 / (7.0 * pi))
    assert kernel("cubic-spline", 3).value(0.0, 2.0) == pytest.approx(1.0 / pi)


def test_quintic_spline_by_hand():
    """l = 3 in 1-D: 66, 26, 1 and 0 over 120 at 0, 1, 2 and 3, slopes 0, -50 and -5."""
    line = kernel("quintic-spline", 1)
    found = [120.0 * line.value(r, 3.0) for r in (0.0, 1.0, 2.0, 3.0, 4.0)]
    assert found == pytest.approx([66.0, 26.0, 1.0, 0.0, 0.0])
    found = [120.0 * line.derivative(r, 3.0) for r in (0.0, 1.0, 2.0, 3.0)]
    assert found == pytest.approx([0.0, -50.0, -5.0, 0.0], abs=1e-12)


def test_wendland_by_hand():
    """l = 2: (1 - 1/2)^4 (1 + 2) sigma / l^d at 1 in 2-D, -20/2 (1 - 1/2)^3 sigma / l^(d+1)."""
    plane, line = kernel("wendland-c2", 2), kernel("wendland-c2", 1)
    assert plane.value(1.0, 2.0) == pytest.approx(3.0 / 16.0 * 7.0 / (4.0 * pi))
    assert plane.derivative(1.0, 2.0) == pytest.approx(-10.0 / 8.0 * 7.0 / (8.0 * pi))
    assert line.value(1.0, 2.0) == pytest.approx(1.0 / 8.0 * 2.5 * 5.0 / 8.0)
    assert line.derivative(1.0, 2.0) == pytest.approx(-6.0 / 4.0 * 5.0 / 16.0)


@pytest.mark.parametrize("length", [0.5, 3e-8])
@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("name", ["cubic-spline", "quintic-spline", "wendland-c2"])
def test_scaling(name, dimension, length):
    """W l^d and dW/dr l^(d+1) depend on r / l alone."""
    one = kernel(name, dimension)
    scaled = one.value(0.3 * length, length) * length**dimension
    assert scaled == pytest.approx(one.value(0.3, 1.0))
    slope = one.derivative(0.3 * length, length) * length ** (dimension + 1)
    assert slope == pytest.approx(one.derivative(0.3, 1.0))


def test_refusals():
    """Names and dimensions that there are not."""
    with pytest.raises(ValueError, match="there are cubic-spline"):
        kernel("gauss", 2)
    with pytest.raises(ValueError, match="dimension must be"):
        kernel("cubic-spline", 4)
