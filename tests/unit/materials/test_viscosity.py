"""The viscosity of a melt over that at its liquidus, as a table."""

import numpy as np
import pytest

from lasersph.materials import load_material
from lasersph.materials.viscosity import relative_viscosity_table, viscosity_text


def test_steel():
    """Kim's fit, 10^(2385.2/T) mPa s times a constant: 1 up to the liquidus, held above 3000 K."""
    steel = load_material("steel-304")
    T, m = relative_viscosity_table(steel)
    liquidus = steel.liquidus
    exact = 10.0 ** (2385.2 / 2500.0 - 2385.2 / liquidus)
    found = np.interp([300.0, liquidus, 2500.0, 3000.0, 5000.0], T, m)
    assert found[:2].tolist() == [1.0, 1.0]
    assert found[2] == pytest.approx(exact, rel=1e-5)
    assert found[3] == found[4] == m.min()
    assert np.all(np.diff(T) > 0.0)


def test_constant_laws():
    """Exactly 1 at all temperatures, also where nu is given."""
    for name in ("steel-304-demuth", "aluminium-demuth"):
        _, m = relative_viscosity_table(load_material(name))
        assert m.tolist() == [1.0] * 4


def test_both_ends_are_flat():
    """Beyond its nodes a table is continued by its last segments: they hold the values."""
    for name in ("steel-304", "aluminium", "tungsten"):
        _, m = relative_viscosity_table(load_material(name))
        assert m[0] == m[1] and m[-1] == m[-2]


def test_what_a_check_says():
    """One number, or those at both ends; a law without a range as far as the melt boils."""
    texts = [
        viscosity_text(load_material(n)) for n in ("steel-304-demuth", "steel-304", "tungsten")
    ]
    assert texts[0] == "7 mPa s at all temperatures"
    assert texts[1] == "6.07 mPa s at 1730 K and below, 1.58 mPa s at 3000 K and above"
    assert texts[2].endswith("where it boils")
