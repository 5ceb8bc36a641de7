"""Films around an axis against another program's Hankel transform and a free bump in time."""

import numpy as np
import pytest

from lasersph.analytic.film_bump import FilmBump
from lasersph.analytic.liquid_film import Drive, LiquidFilm

R = np.array([0.0, 1e-6, 2e-6, 3e-6])
WARM = Drive(temperature=100.0, end=2e-8)


@pytest.mark.parametrize(
    ("film", "time", "heights"),
    [
        ((2.8e-7, 6863.0, 7e-3, 1.6, -4.3e-4), 2e-8, [-1.7469, -0.6959, 0.2162, 0.1213]),
        ((2.8e-7, 6863.0, 7e-3, 1.6, -4.3e-4), 5e-8, [-3.8887, -1.8404, 0.4072, 0.3854]),
        ((1.06e-6, 2379.0, 1.38e-3, 0.87, -2.75e-4), 2e-8, [-2.9301, -1.2419, 0.3310, 0.2284]),
    ],
)
def test_bump_of_temperature(film, time, heights):
    """100 K for 20 ns with a radius of 1.5 um: heights [nm] computed by another program."""
    depth, *liquid = film
    found = FilmBump(LiquidFilm(depth, 1.0, *liquid), 1.5e-6).heights(R, [time], WARM)[0]
    assert 1e9 * found == pytest.approx(heights, abs=1e-4)


def test_free_bump():
    """Oh = 0.05, two depths wide: height on the axis after 1 and 2 sqrt(rho d^3/gamma)."""
    film = LiquidFilm(1e-6, 1.0, 2379.0, 0.05 * np.sqrt(2379.0 * 0.87e-6), 0.87)
    unit = np.sqrt(2379e-18 / 0.87)
    found = FilmBump(film, 2e-6).heights([0.0], [unit, 2.0 * unit], initial=1.0)[:, 0]
    assert found == pytest.approx([0.651160, 0.329277], abs=1e-5)
