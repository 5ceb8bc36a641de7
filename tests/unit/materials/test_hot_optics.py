"""Optics of hot electrons: by hand, those of cold metal when cold, and where there are none."""

from cmath import sqrt

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.materials import load_material
from lasersph.materials.hot_optics import SPEED_OF_LIGHT, hot_optics, refraction_of

LIGHT = 1064e-9


def test_by_hand():
    """A metal of n = 0.3, k = 7, w_p = 5 w: R when nu = w/2 and nu_0 = w/50."""
    w = 2e15
    index = refraction_of(np.array([0.5 * w]), 0.02 * w, 0.3 + 7.0j, w, 5.0 * w)
    # eps = -48.91 + 4.2 i; D(nu) = -25/(1 + i/2) = -20 + 10 i, D(nu_0) = -24.990004 + 0.49980008 i
    assert index[0] == pytest.approx(sqrt(-43.919996 + 13.70019992j), rel=1e-9)
    # Fresnel at normal incidence: n = 1.0215, k = 6.7059
    n, k = index[0].real, index[0].imag
    assert abs((index[0] - 1.0) / (index[0] + 1.0)) ** 2 == pytest.approx(
        ((n - 1.0) ** 2 + k**2) / ((n + 1.0) ** 2 + k**2)
    )
    assert (n, k) == pytest.approx((1.0215, 6.7059), abs=5e-4)


@pytest.mark.parametrize("metal", ["gold", "copper", "silver", "aluminium"])
def test_cold_metal_is_what_it_was(metal):
    """At 300 K R and depth are those of n and k; R falls with heat, without jumps."""
    material = load_material(metal)
    table = hot_optics(material, LIGHT)
    assert table is not None and material.optics is not None
    cold, lit = table.at(300.0, 300.0), material.optics.at(LIGHT)
    assert lit.reflectivity is not None and lit.absorption_coefficient is not None
    assert cold[0] == pytest.approx(float(lit.reflectivity.at(300.0)), abs=1e-5)
    assert cold[1] == pytest.approx(1.0 / lit.absorption_coefficient, rel=1e-4)
    R = table.at(np.linspace(300.0, 2e4, 300), 300.0)[0]
    assert np.all(np.diff(R) < 1e-9) and np.all((R > 0.0) & (R < 1.0))
    assert np.abs(np.diff(R)).max() < 0.02


def test_collisions():
    """nu = A T_e^2 + B T_l of gold: 1.2e7 and 1.23e11, never beyond those from atom to atom."""
    electrons = load_material("gold").electrons
    assert electrons is not None
    expected = 1.2e7 * 5000.0**2 + 1.23e11 * 400.0
    assert electrons.collisions_at(5000.0, 400.0) == pytest.approx(expected, rel=5e-3)
    assert electrons.collisions_at(1e5, 400.0) == 8.8e15


def test_metals_and_lights_without():
    """No numbers of the electrons, no n and k of the light, or a reflectivity of its own: none."""
    assert hot_optics(load_material("titanium"), LIGHT) is None
    assert hot_optics(load_material("gold"), 800e-9) is None
    case = load_case("short-pulse-gold")
    assert case.laser is not None
    assert case.laser.hot_optics(case.material) is not None
    given = load_case("short-pulse-gold", ["laser.reflectivity=0.7"])
    assert given.laser is not None and given.laser.hot_optics(given.material) is None


def test_depth_of_the_case():
    """An absorption that the laser gives stays; a range of electrons is added to any depth."""
    case = load_case("short-pulse-gold", ["laser.absorption.absorption_coefficient=5e7 1/m"])
    assert case.laser is not None
    table = case.laser.hot_optics(case.material, 100e-9)
    assert table is not None
    assert table.depth == pytest.approx(np.full(table.depth.shape, 120e-9))
    own = load_case("short-pulse-gold")
    assert own.laser is not None
    table = own.laser.hot_optics(own.material, 100e-9)
    assert table is not None
    cold = table.at(300.0, 300.0)[1]
    assert cold == pytest.approx(100e-9 + 532e-9 / (4.0 * np.pi * 2.236), rel=1e-4)
    assert SPEED_OF_LIGHT == 299792458.0
