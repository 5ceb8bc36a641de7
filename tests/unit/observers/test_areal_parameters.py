"""Areal parameters against closed forms."""

import numpy as np
import pytest
from scipy.special import ellipe

from lasersph.observers.areal_parameters import areal_parameters

AMPLITUDE, PERIOD, POINTS = 0.8e-6, 5e-6, 400


def sine(tilt=0.0):
    """Two periods along x, a point at the middle of each of equal cells, and a tilt."""
    x = (np.arange(2 * POINTS) + 0.5) * PERIOD / POINTS
    return np.tile(AMPLITUDE * np.sin(2.0 * np.pi * x / PERIOD), (5, 1)), PERIOD / POINTS


def test_plane_of_any_tilt():
    """Nothing is left of a plane but its tilt, which the developed area does not count."""
    y, x = np.mgrid[0:30, 0:40]
    found = areal_parameters(1e-6 * (0.3 + 0.01 * x - 0.02 * y), 1e-7, 1e-7)
    assert max(found.Sa, found.Sq, found.Sz) < 1e-20
    assert (found.Ssk, found.Sdr) == (0.0, pytest.approx(0.0, abs=1e-15))


def test_sine():
    """Sa = 2A/pi, Sq = A/sqrt 2, Sz = 2A, Ssk = 0; the length of a sine is an elliptic integral.

    Leveling takes 3/(pi n)^2 of a sine's squares over n whole periods: cosines have none.
    """
    z, step = sine()
    z = np.roll(z, POINTS // 4, axis=1)
    found = areal_parameters(z, step, 2.0 * step)
    assert found.Sa == pytest.approx(2.0 * AMPLITUDE / np.pi, rel=2e-5)
    assert found.Sq == pytest.approx(AMPLITUDE / np.sqrt(2.0), rel=1e-6)
    assert found.Sz == pytest.approx(2.0 * AMPLITUDE, rel=1e-4)
    assert found.Ssk == pytest.approx(0.0, abs=1e-6)
    slope = 2.0 * np.pi * AMPLITUDE / PERIOD
    length = 2.0 / np.pi * np.sqrt(1.0 + slope**2) * ellipe(slope**2 / (1.0 + slope**2))
    assert found.Sdr == pytest.approx(length - 1.0, rel=2e-3)


def test_pits_are_skewed():
    """Narrow pits have a negative skewness: that of one pit in n points is near -sqrt n."""
    z = np.zeros((20, 20))
    z[10, 10] = -1e-6
    assert areal_parameters(z, 1e-7, 1e-7).Ssk == pytest.approx(-20.0, rel=0.05)


def test_missing_heights():
    """Points that are missing change nothing of a sine but what they leave out."""
    z, step = sine()
    whole = areal_parameters(z, step, step)
    z = z.copy()
    z[2, 100] = np.nan
    assert areal_parameters(z, step, step).Sq == pytest.approx(whole.Sq, rel=1e-3)


def test_too_few_heights():
    """A profile has no areal parameters."""
    with pytest.raises(ValueError, match="three heights"):
        areal_parameters(np.zeros((1, 50)), 1e-7, 1e-7)
