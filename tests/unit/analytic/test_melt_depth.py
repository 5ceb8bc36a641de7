"""Melt depth estimate: safe for the published cases, right where an exact solution exists."""

import numpy as np
import pytest
from scipy.special import erf

from lasersph.analytic.melt_depth import _Block, melt_depth

SIGMA = 10e-9 / np.sqrt(8 * np.log(2))


def delivered(start, end):
    """Share of a 10 ns pulse around 50 ns."""
    first, last = (erf((np.asarray(t) - 50e-9) / (SIGMA * np.sqrt(2))) for t in (start, end))
    return (last - first) / 2


def metal(Ts, Tl, Tv, Lf, Lv, density, c, k, alpha, reflectivity):
    """Caloric curve with constant properties, held at T_v."""
    T = np.array([298.15, Ts, Tl, Tv, Tv])
    h = c * (T - T[0]) + [0, 0, Lf, Lf, Lf + Lv]
    return {
        "enthalpy": h, "temperature": T, "potential": k * (T - T[0]),
        "melt_fraction": [0, 0, 1, 1, 1], "density": density, "absorption_coefficient": alpha,
        "reflectivity": reflectivity, "delivered": delivered, "end_time": 200e-9,
    }  # fmt: skip


STEEL = metal(1673, 1727, 3273, 251e3, 6500e3, 7262, 704, 26.8, 9.56e7, 0.556)
ALUMINIUM = metal(
    933.35, 933.35, 2792, 397e3, 10860e3, 2228, 1077, 137.97, 1.52e8,
    lambda T, begin, end: np.where(T < 933.35, 1.048 - 3.989e-4 * T, 0.65),
)  # fmt: skip


def half_period(mean, columns=8):
    """Mean fluence of equal columns over half of a 5 um period, and their width."""
    edges = np.linspace(0.0, np.pi, columns + 1)
    fluence = mean * (1.0 + np.diff(np.sin(edges)) / np.diff(edges))
    return {"fluence": fluence, "column_width": 2.5e-6 / columns}


def test_steel_pool_is_met_and_safe():
    """Reference pool at 0.6 J/cm2: 296 nm (f_m > 0), last mush at 87.6 ns, T_v reached."""
    found = melt_depth(**STEEL, **half_period(6e3))
    assert found.depth == pytest.approx(296e-9, rel=0.08)
    assert 296e-9 < found.safe_depth < 350e-9
    assert found.end == pytest.approx(87.6e-9, abs=4e-9)
    assert found.start == pytest.approx(45.94e-9, abs=0.5e-9)
    assert found.temperature == pytest.approx(3273.0)


def test_aluminium_pool_is_met_and_safe():
    """Reference pool at 1.0 J/cm2: 1090 nm, last mush at 95.7 ns."""
    found = melt_depth(**ALUMINIUM, **half_period(1e4))
    assert found.depth == pytest.approx(1090e-9, rel=0.08)
    assert 1090e-9 < found.safe_depth < 1300e-9
    assert found.end == pytest.approx(95.7e-9, abs=7e-9)


@pytest.mark.parametrize(
    ("metal", "mean", "reference"), [(STEEL, 6e3, 285e-9), (ALUMINIUM, 1e4, 1066e-9)]
)
def test_one_column_at_the_peak_is_an_upper_bound(metal, mean, reference):
    """Without lateral conduction the pool (f_m > 0.5) is deeper than the reference's."""
    assert melt_depth(**metal, fluence=2 * mean, level=0.5).depth > reference


def test_nothing_melts_at_low_fluence():
    """0.1 J/cm2 heats and melts nothing."""
    found = melt_depth(**STEEL, fluence=1e3)
    assert (found.depth, found.safe_depth) == (0.0, 0.0)
    assert np.isnan(found.start)
    assert 400.0 < found.temperature < 1673.0


def test_heating_without_phase_change_is_the_exact_solution():
    """A square pulse absorbed at the surface, melting never reached: 2 q sqrt(D t/pi)/k."""
    plain = {
        "enthalpy": [0, 1e7], "temperature": [300, 300 + 1e7 / 900], "melt_fraction": [0, 0],
        "potential": [0, 167 * 1e7 / 900], "density": 2700.0, "absorption_coefficient": np.inf,
        "reflectivity": 0.75, "fluence": 1e4, "end_time": 2e-7,
        "delivered": lambda a, b: (np.minimum(b, 1e-7) - np.minimum(a, 1e-7)) / 1e-7,
    }  # fmt: skip
    found = melt_depth(**plain)
    exact = 2 * 2.5e10 * np.sqrt(1e-7 / (np.pi * 167 * 2700 * 900))
    assert found.temperature - 300 == pytest.approx(exact, rel=0.02)


def test_absurd_energy_is_estimated_at_once(monkeypatch):
    """A typing error in the fluence takes as many solves as light that boils the metal: the curve
    goes on beyond all that a cell can take up."""
    count = [0]
    solve = _Block._newton_change

    def counted(*given):
        count[0] += 1
        return solve(*given)

    monkeypatch.setattr(_Block, "_newton_change", counted)
    names = ("enthalpy", "temperature", "potential", "melt_fraction")
    rising = STEEL | {name: np.asarray(STEEL[name])[:-1] for name in names}  # no plateau at its end
    solves = []
    for fluence in (1e5, 1e9):
        count[0] = 0
        found = melt_depth(**rising, fluence=fluence)
        solves.append(count[0])
    assert solves[1] < 2 * solves[0]
    assert found.temperature > 3273.0 and found.depth > 0.0


def test_before_the_light_nothing_melts():
    """A run that ends before the pulse: depth 0 at the initial temperature."""
    found = melt_depth(**(STEEL | {"end_time": 1e-9}), fluence=1e4)
    assert found.depth == 0.0 and np.isnan(found.start) and np.isnan(found.end)
    assert found.temperature == 298.15


def test_wrong_input_is_refused():
    """Columns without a width."""
    with pytest.raises(ValueError, match="column_width"):
        melt_depth(**STEEL, fluence=[1e4, 5e3])
