"""The film beside tabulated solutions of collocation in depth and implicit steps in time.

The numbers were computed by Chebyshev collocation with Radau IIA and by two inversions of the
transform, which agree to 1e-8.
"""

import numpy as np
import pytest

from lasersph.analytic.liquid_film import Drive, LiquidFilm
from lasersph.analytic.thermocapillary_layer import ThermocapillaryLayer

STEEL = LiquidFilm(280e-9, 5.05e-6, 6863.0, 7.0e-3, 1.6, -4.3e-4)
ALUMINIUM = LiquidFilm(1060e-9, 4.5e-6, 2379.0, 1.38e-3, 0.87, -2.75e-4)
BOX = Drive(temperature=1000.0, end=20e-9)
TIMES = [5e-9, 20e-9, 50e-9, 100e-9, 200e-9]


def wave_film(kd, Oh):
    """Film of depth, density and surface tension 1."""
    return LiquidFilm(1.0, 2.0 * np.pi / kd, 1.0, Oh, 1.0)


@pytest.mark.parametrize(
    ("film", "heights", "speeds"),
    [
        (
            STEEL,
            [-1.167925, -16.873541, -44.584671, -49.864197, -36.926422],
            [6.0477005, 11.448916, 1.973826, -0.2986665, -0.55144707],
        ),
        (
            ALUMINIUM,
            [-2.5757106, -36.298992, -95.166069, -25.295594, 36.711142],
            [16.693973, 32.034009, 7.3937093, 0.95757111, 2.8159627],
        ),
    ],
)
def test_film_under_a_box_of_temperature(film, heights, speeds):
    """Height at the hot crest [nm] and speed of the surface between crests."""
    assert film.amplitude(TIMES, BOX) * 1e9 == pytest.approx(heights, rel=1e-7)
    assert film.velocity(TIMES, 0.0, BOX) == pytest.approx(speeds, rel=1e-6)


def test_speed_over_the_depth():
    """Steel at the end of the box, 28 nm and 140 nm below the surface; the wall holds."""
    for z, speed in ((-28e-9, 9.4778094), (-140e-9, 3.7463587)):
        assert STEEL.velocity([20e-9], z, BOX)[0] == pytest.approx(speed, rel=1e-6)
    assert STEEL.velocity([20e-9], -280e-9, BOX)[0] == pytest.approx(0.0, abs=1e-6)


def test_wave_from_rest():
    """Amplitudes at fractions of the inviscid period 7.199761, kd = 1, Oh = 0.05."""
    film = wave_film(1.0, 0.05)
    times = 2.0 * np.pi / film.natural_frequency * np.array([0.1, 0.25, 0.5, 1.0, 2.0])
    wanted = [0.8295964, 0.18987257, -0.55539436, 0.29863926, 0.07805722]
    assert film.amplitude(times, initial=1.0) == pytest.approx(wanted, abs=1e-7)


@pytest.mark.parametrize(
    ("kd", "Oh", "t", "amplitude"),
    [(0.1, 2.0, 60000.0, 0.37444041), (0.1, 0.01, 300.0, 0.38237816)],
)
def test_waves_of_long_films(kd, Oh, t, amplitude):
    """Amplitudes of a film that levels and of one that swings."""
    film = wave_film(kd, Oh)
    assert film.amplitude([t], initial=1.0)[0] == pytest.approx(amplitude, abs=1e-7)


def test_lasting_wave_of_temperature():
    """Late height and speed are those of the steady film and of the flat layer."""
    assert STEEL.steady_amplitude(10.0) == pytest.approx(-9.0775627e-9, rel=1e-7)
    late = Drive(temperature=10.0)
    found = STEEL.amplitude([3e-6], late)[0]
    assert found == pytest.approx(STEEL.steady_amplitude(10.0), rel=1e-3)
    layer = ThermocapillaryLayer(280e-9, 5.05e-6, 10.0, -4.3e-4, 7.0e-3)
    assert STEEL.velocity([3e-6], 0.0, late)[0] == pytest.approx(layer.surface_speed, rel=1e-3)
    assert STEEL.levelling_rate() == pytest.approx(3291146.1, rel=1e-7)


def test_pressure_and_mass_that_leaves():
    """A steady pressure p_e ends at a = -p_e/(gamma k^2); a uniform-in-time loss of mass at first
    lowers the surface by m t/rho."""
    held = STEEL.amplitude([3e-6], Drive(pressure=1e4))[0]
    assert held == pytest.approx(-1e4 / (1.6 * STEEL.wave_number**2), rel=1e-3)
    early = STEEL.amplitude([1e-10], Drive(mass_flux=1000.0))[0]
    assert early == pytest.approx(-1000.0 * 1e-10 / 6863.0, rel=1e-3)


def test_refusals():
    """A film without depth; more periods than the contour sees."""
    with pytest.raises(ValueError, match="positive"):
        LiquidFilm(0.0, 1.0, 1.0, 1.0, 1.0)
    with pytest.raises(ValueError, match="times must be at most"):
        wave_film(1.0, 0.05).amplitude([100.0], initial=1.0)
