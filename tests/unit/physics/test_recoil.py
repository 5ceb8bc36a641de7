"""Recoil of vapor at a temperature: into vacuum, against surroundings, from the table."""

import numpy as np
import pytest

from lasersph.materials import load_material
from lasersph.physics.evaporation import saturation_pressure, vapor_constants
from lasersph.physics.recoil import recoil_at, recoil_moves_melt_at, tabulated_recoil

STEEL = load_material("steel-304").vaporization
ATMOSPHERE = 101325.0
T = STEEL.temperature + np.array([-50.0, 100.0, 800.0, 1400.0])


def test_recoil_into_vacuum():
    """0.54 times the saturation pressure, and nothing is subtracted."""
    pressure = [saturation_pressure(one, **vapor_constants(STEEL)) for one in T]
    assert recoil_at(T, STEEL, None) == pytest.approx(0.54 * np.array(pressure))
    assert recoil_at(T, STEEL, 0.0) == pytest.approx(0.54 * np.array(pressure))


def test_recoil_against_surroundings():
    """None below the boiling point, little above it; 1 atm less than into vacuum if sonic."""
    found, vacuum = recoil_at(T, STEEL, ATMOSPHERE), recoil_at(T, STEEL, None)
    assert found[0] == 0.0 and 0.05 * ATMOSPHERE < found[1] < 0.15 * ATMOSPHERE
    assert found[2:] == pytest.approx(vacuum[2:] - ATMOSPHERE)
    assert recoil_at(T[:1], STEEL, ATMOSPHERE).tolist() == [0.0]


def test_table():
    """Within 1e-5 of the largest, at temperatures of any shape; the same beyond its ends."""
    at = np.linspace(3300.0, 4500.0, 11).reshape(1, 11)
    found, exact = tabulated_recoil(STEEL, ATMOSPHERE)(at), recoil_at(at[0], STEEL, ATMOSPHERE)
    assert found.shape == at.shape
    assert found[0] == pytest.approx(exact, abs=1e-5 * exact.max())
    assert tabulated_recoil(STEEL, ATMOSPHERE)(np.array([100.0])).tolist() == [0.0]


def test_tables_are_kept_apart():
    """A table that is asked for again is of the same metal and the same surroundings."""
    steel, gold = (load_material(name).vaporization for name in ("steel-304", "gold"))
    hot = np.array([3600.0])
    for _ in range(2):
        for metal, ambient in ((steel, 1e5), (gold, 1e5), (steel, 5e4)):
            found = tabulated_recoil(metal, ambient)(hot)
            assert found == pytest.approx(recoil_at(hot, metal, ambient), rel=1e-4, abs=1e-3)


def test_recoil_against_capillary_pressure():
    """With 2 gamma/(0.54 r) = 1 atm the recoil moves the melt from the boiling point on."""
    aluminium = vapor_constants(load_material("aluminium").vaporization)
    radius = 2.0 * 0.87 / (0.54 * 101325.0)
    found = recoil_moves_melt_at(radius, 0.87, aluminium)
    assert found == pytest.approx(aluminium["T_b"])
