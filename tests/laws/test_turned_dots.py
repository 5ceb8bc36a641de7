"""A pattern on a film in three dimensions that is turned, shifted, or met by disordered particles.

cos kx cos ky turned by 45 degrees is (cos qx + cos qy)/2 with q = sqrt(2) k: the same heights in
the middle, whatever the directions of columns and particles.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from flow_boxes import jittered
from surface_films import PERIOD, dots, film_of_period, go

from lasersph.analytic.liquid_film import Drive
from lasersph.surface.flat_surface import ImposedTemperature

MEAN, HEAT = 1727.0, 100.0
AROUND = (
    "domain.extent=full",
    "boundaries.sides=periodic",
    *(f"solver.flow.{side}=periodic" for side in ("left", "right", "front", "back")),
)
SHORT = 1.4e-6
SMALL = (
    *AROUND,
    *(f"domain.{side}=1.4 um" for side in ("width", "breadth")),
    *(f"boundaries.surface_temperature_wave.{key}=1.4 um" for key in ("period", "period_y")),
)
"""A whole period of 25 columns along each axis."""


@dataclass
class Turned:
    """HEAT (cos qx + cos qy)/2 [K] with a period [m] along both axes."""

    period: float

    def mean_over(self, places, begin, end):
        """What the surface has more at places along x and y [K]."""
        x, y = (2.0 * np.pi / self.period * place for place in places)
        return 0.5 * HEAT * (np.cos(x) + np.cos(y))


@dataclass
class Shifted:
    """HEAT cos k(x - a) cos k(y - b) [K] of dots of the period SHORT, moved by (a, b) [m]."""

    by: tuple[float, float]

    def mean_over(self, places, begin, end):
        """What the surface has more at places along x and y [K]."""
        x, y = (2.0 * np.pi / SHORT * (place - a) for place, a in zip(places, self.by, strict=True))
        return HEAT * np.cos(x) * np.cos(y)


def driven_by(pattern, *settings):
    """Solver of a film below another pattern of temperature."""
    solver = dots(*settings)
    surface = solver.domain.surface
    given = replace(surface.forcing, temperature=ImposedTemperature(MEAN, pattern))
    surface.forcing = surface.stress_law.forcing = given
    return solver


def amplitude(line, period, by=(0.0, 0.0)):
    """4/(Lx Ly) times the integral of the height times cos k(x - a) cos k(y - b) [m]."""
    x, y = (2.0 * np.pi / period * (place - a) for place, a in zip(line.places, by, strict=True))
    return 4.0 * np.mean(line.height * np.cos(x) * np.cos(y))


@pytest.mark.slow
def test_turned_by_forty_five_degrees():
    """The same height in the middle as the film that is exact, and as the dots that are not turned,
    within 1 % of the largest; the same along x and along y."""
    period, end = float(PERIOD / np.sqrt(2.0)), 1e-8
    sides = (f"domain.{side}={period!r} m" for side in ("width", "breadth"))
    turned, straight = driven_by(Turned(period), *sides), dots()
    line, wave = (solver.domain.surface.line for solver in (turned, straight))
    for solver in (turned, straight):
        go(solver, end)

    # each of both waves has half of the height in the middle
    x, y = (np.cos(2.0 * np.pi / period * place) for place in line.places)
    along = [2.0 * np.mean(line.height * shape) for shape in (x, y)]
    assert along[0] == pytest.approx(along[1], rel=1e-9, abs=0.0)
    film = film_of_period(period)
    drive = Drive(temperature=HEAT, end=2e-8)
    largest = np.abs(film.amplitude(np.arange(1, 101) * 1e-9, drive)).max()
    middle = sum(along)
    assert middle == pytest.approx(film.amplitude([end], drive)[0], abs=1e-2 * largest)
    assert middle == pytest.approx(wave.first_harmonic(PERIOD, PERIOD), abs=1e-2 * largest)


def test_shifted_by_whole_columns_and_by_half_of_one():
    """Whole columns: the same heights there, to what the pressure is solved to. Half of one: the
    same amplitude, 1e-3."""
    column, end = SHORT / 25, 2e-9
    still = driven_by(Shifted((0.0, 0.0)), *SMALL)
    expected = go(still, end)
    moved = driven_by(Shifted((3.0 * column, -2.0 * column)), *SMALL)
    found = go(moved, end)
    assert np.ptp(expected) > 1e-11
    difference = np.roll(found, (-3, 2), axis=(0, 1)) - expected
    assert np.abs(difference).max() < 1e-7 * np.ptp(expected)

    # particles and columns lie otherwise to the pattern
    by = (0.5 * column, 0.5 * column)
    half = driven_by(Shifted(by), *SMALL)
    go(half, end)
    wanted = amplitude(still.domain.surface.line, SHORT)
    assert amplitude(half.domain.surface.line, SHORT, by) == pytest.approx(
        wanted, rel=1e-3, abs=0.0
    )


@pytest.mark.slow
def test_disordered_particles_over_a_whole_period():
    """Particles out of their places by up to a tenth of a spacing have no symmetry: the amplitude
    is that of the quarter within 1 %, and its heights are within 3 % rms, where the spacing costs
    2.3 %. 0.3 and 1.4 % came out."""
    end = 1e-8
    whole, quarter = dots(*AROUND), dots()
    whole.backend.copy(whole.backend.asarray(jittered(whole, 0.1)), whole.position)
    whole.advect(0.0)
    found, expected = go(whole, end), go(quarter, end)
    harmonics = [
        solver.domain.surface.line.first_harmonic(PERIOD, PERIOD) for solver in (whole, quarter)
    ]
    assert harmonics[0] == pytest.approx(harmonics[1], rel=0.01, abs=0.0)
    part = found[-expected.shape[0] :, -expected.shape[1] :]
    largest = np.abs(expected).max()
    assert np.sqrt(np.mean((part - expected) ** 2)) < 0.03 * largest
    # no height is lost, and the symmetry is
    assert abs(found.sum()) < 1e-9 * np.abs(found).sum()
    assert np.abs(found - found[::-1]).max() > 1e-3 * largest
