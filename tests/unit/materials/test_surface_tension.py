"""Surface tension with sulfur: by hand, against Belton's Fe-S, its slope and where that changes."""

from __future__ import annotations

from math import exp, log

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.materials import check_material, load_material

R = 8.314462618


def steel(sulfur):
    """`steel-304` with a mass fraction of sulfur."""
    return load_material("steel-304").model_copy(update={"sulfur": sulfur})


def test_by_hand():
    """1.943 - 4.3e-4 (T - 1809) - R T 1.3e-5 ln(1 + 3.18e-3 exp(166000 / (R T)) 0.01) at 2000 K."""
    K = 3.18e-3 * exp(166e3 / (R * 2000.0))
    expected = 1.943 - 4.3e-4 * 191.0 - R * 2000.0 * 1.3e-5 * log(1.0 + K * 0.01)
    assert float(steel(1e-4).surface_tension_at(2000.0)) == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize("T", [1750.0, 1900.0, 2200.0, 3000.0])
@pytest.mark.parametrize("percent", [0.003, 0.03])
def test_slope_is_the_derivative_of_the_source(T, percent):
    """-A - R Gamma ln(1 + K a) - K a / (1 + K a) Gamma H / T."""
    Ka = 3.18e-3 * exp(166e3 / (R * T)) * percent
    slope = -4.3e-4 - R * 1.3e-5 * log(1.0 + Ka) + Ka / (1.0 + Ka) * 1.3e-5 * 166e3 / T
    ours = float(steel(percent / 100.0).surface_tension_slope_at(T))
    assert ours == pytest.approx(slope, abs=1e-9)


def test_slope_changes_sign_where_sulfur_has_left():
    """Melt flows inward below that temperature, which rises with the content; clean iron never."""
    T = np.linspace(1700.0, 3000.0, 1301)
    turning = []
    for sulfur in (5e-5, 1e-4, 3e-4):
        slope = steel(sulfur).surface_tension_slope_at(T)
        assert slope[0] > 0.0 > slope[-1]
        turning.append(float(T[np.argmax(slope < 0.0)]))
        assert steel(sulfur).slope_reversal(3000.0) == pytest.approx(turning[-1], abs=1.0)
    assert turning == pytest.approx([1860.0, 1966.0, 2152.0], abs=1.5)
    assert np.all(steel(0.0).surface_tension_slope_at(T) < 0.0)
    assert steel(0.0).slope_reversal(3000.0) is None
    assert load_material("steel-304-demuth").slope_reversal(3000.0) is None


def test_316l_has_the_sulfur_of_the_reference_sample():
    """20 ppm of NIST SRM 1155a, by the key alone; `check` does not warn of its slope."""
    metal = load_material("steel-316l")
    assert metal.sulfur == pytest.approx(2e-5)
    assert metal.slope_reversal(3000.0) == pytest.approx(1734.0, abs=1.0)
    clean = metal.model_copy(update={"sulfur": 0.0})
    assert clean.slope_reversal(3000.0) is None
    slopes = [one for one in check_material(metal) if one.subject == "surface_tension_slope"]
    assert [one.level for one in slopes] == ["ok"]


@pytest.mark.parametrize("percent", [0.001, 0.01, 0.1])
def test_belton_measured_the_same_iron_with_sulfur(percent):
    """0.195 ln(1 + 185 S) N/m below pure iron at 1823 K (Belton 1976): within 2 %."""
    loss = steel(0.0).surface_tension_at(1823.0) - steel(percent / 100.0).surface_tension_at(1823.0)
    assert float(loss) == pytest.approx(0.195 * log(1.0 + 185.0 * percent), rel=0.02)


def test_table_follows_the_curve():
    """The table that solvers read, 78 K from node to node, and finite in the cold solid."""
    material = steel(1e-4)
    T, gamma = material.table("surface_tension", 1.0, 2.0e4, 257)
    assert np.all(np.isfinite(gamma))
    points = np.linspace(1700.0, 5000.0, 400)
    off = np.interp(points, T, gamma) - material.surface_tension_at(points)
    assert np.max(np.abs(off)) < 2e-3


def test_content_is_a_key_of_the_material():
    """Of a case, with its unit; a metal without the constants of adsorption refuses it."""
    case = load_case("dlip-steel", ["material=steel-304", "material.sulfur=50 ppm"])
    assert case.material.sulfur == pytest.approx(5e-5)
    gamma = float(case.material.surface_tension_at(1809.0))
    assert gamma == pytest.approx(float(steel(5e-5).surface_tension_at(1809.0)), rel=1e-12)
    with pytest.raises(CaseError, match=r"surface_tension\.adsorption") as refused:
        load_case("dlip-aluminium", ["material=aluminium", "material.sulfur=50 ppm"])
    assert "sulfur" in str(refused.value)
