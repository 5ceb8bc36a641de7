"""Two, three and four beams: periods, maxima and contrast by hand, energy of a unit cell."""

import numpy as np
import pytest

from lasersph.lasers import InterferenceBeam

WAVELENGTH, ANGLE = 1.064e-6, 0.4
SINE = np.sin(0.5 * ANGLE)


def beam(**given):
    """Beams of 1064 nm under a full angle of 0.4 rad."""
    return InterferenceBeam(**({"wavelength": WAVELENGTH, "angle": ANGLE} | given))


@pytest.mark.parametrize(
    ("beams", "x", "y"),
    [
        (2, WAVELENGTH / (2.0 * SINE), None),
        (3, 2.0 * WAVELENGTH / (3.0 * SINE), 2.0 * WAVELENGTH / (np.sqrt(3.0) * SINE)),
        (4, WAVELENGTH / (np.sqrt(2.0) * SINE), WAVELENGTH / (np.sqrt(2.0) * SINE)),
    ],
)
def test_periods_by_hand(beams, x, y):
    """f repeats with them, and a period gives the same f as the angle."""
    pattern = beam(beams=beams)
    assert pattern.lateral_period == pytest.approx(x, rel=1e-12)
    assert pattern.lateral_period_y == (None if y is None else pytest.approx(y, rel=1e-12))
    places = np.random.default_rng(1).uniform(0.0, 1e-5, (2, 50))
    f = pattern.at(*places)
    assert pattern.at(places[0] + x, places[1]) == pytest.approx(f, abs=1e-11)
    assert pattern.at(places[0], places[1] + (y or 1e-6)) == pytest.approx(f, abs=1e-11)
    assert beam(angle=None, wavelength=None, period=x, beams=beams).at(*places) == pytest.approx(
        f, abs=1e-11
    )


@pytest.mark.parametrize(
    ("beams", "polarization", "low", "high"),
    [
        (2, "s", 0.0, 2.0),
        (2, "p", 1.0 - np.cos(ANGLE), 1.0 + np.cos(ANGLE)),  # E_1.E_2 = cos(theta)
        (3, None, 0.0, 3.0),  # |1 + 1 + 1|^2/3
        (3, "s", 0.0, 1.5),  # 1 - (1/3)(cos + cos + cos), least sum -3/2
        (4, None, 0.0, 4.0),
        (4, "s", 0.0, 2.0),  # two crossed gratings of half the amplitude
    ],
)
def test_extremes_by_hand(beams, polarization, low, high):
    """Smallest and largest f, and the contrast (high - low)/(high + low) of them."""
    pattern = beam(beams=beams, polarization=polarization)
    assert pattern.extremes == pytest.approx((low, high), abs=1e-9)
    assert pattern.peak == pytest.approx(high, abs=1e-9)
    assert pattern.contrast == pytest.approx((high - low) / (high + low), abs=1e-9)


def test_maxima_of_three_and_four_beams_lie_where_waves_are_in_phase():
    """At the corners of the cell, of three also in its middle, of four also; nowhere else."""
    for count in (3, 4):
        pattern = beam(beams=count)
        x, y = pattern.lateral_period, pattern.lateral_period_y
        middle = pattern.at(0.5 * x, 0.5 * y)
        assert pattern.at(0.0, 0.0) == pytest.approx(count)
        assert middle == pytest.approx(count if count == 3 else 0.0, abs=1e-9)


@pytest.mark.parametrize("polarization", [None, "s", "p", 0.3])
@pytest.mark.parametrize("beams", [2, 3, 4])
def test_a_unit_cell_keeps_the_mean(beams, polarization):
    """Cell means over one period add up to 1, whatever shares, phases and polarization."""
    phases, shares = (0.1, 0.7, 2.0, -0.4)[:beams], np.array([0.4, 0.3, 0.2, 0.1])[:beams]
    pattern = beam(
        beams=beams, polarization=polarization, phases=phases, energy_shares=shares / shares.sum()
    )
    nx, ny = 17, 9
    x = np.linspace(0.0, pattern.lateral_period, nx + 1)
    y = np.linspace(0.0, pattern.lateral_period_y or 1e-6, ny + 1)
    low, high = (
        np.stack([a.ravel() for a in np.meshgrid(p, q)])
        for p, q in ((x[:-1], y[:-1]), (x[1:], y[1:]))
    )
    means = pattern.cell_means(low, high, np.array([2e-7, -1e-7]))
    assert means.mean() == pytest.approx(1.0, abs=1e-12)
    assert means.min() >= pattern.extremes[0] - 1e-9
    assert means.max() <= pattern.extremes[1] + 1e-9


def test_unequal_beams_lose_contrast():
    """2 sqrt(s_1 s_2) of two shares: 0.8 for 4 to 1."""
    assert beam(energy_shares=(0.8, 0.2)).contrast == pytest.approx(0.8, abs=1e-12)


def test_phases_of_three_beams_only_move_the_pattern():
    """Three phases are a displacement and a common phase: extremes stay; those of four do not."""
    turned = {count: beam(beams=count, phases=(1.0, 0.0, 0.5, 0.0)[:count]) for count in (3, 4)}
    assert turned[3].extremes == pytest.approx((0.0, 3.0), abs=1e-9)
    assert turned[4].extremes[1] < 3.99


def test_plain_lines_are_as_ever():
    """Two beams that are counted are those by their period."""
    x = np.linspace(0.0, 1e-5, 50)
    plain = InterferenceBeam(period=5e-6)
    assert InterferenceBeam(period=5e-6, beams=2).at(x, 0.0) == pytest.approx(plain.at(x, 0.0))
    assert plain.terms[0].tolist() == [1.0]
    assert plain.description == "2 beams, period 5 um along x, contrast 1"
