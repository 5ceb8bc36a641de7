"""Steady recession against a table of roots found elsewhere, and its own balance of heat."""

from pathlib import Path

import numpy as np
import pytest
from receding_metals import recession_of

TABLE = Path(__file__).with_name("surface_recession.csv")


def test_table():
    """Temperature, speed, depth of the melting point, D/v and D/v^2 of six rows."""
    lines = [line for line in TABLE.read_text(encoding="utf-8").splitlines() if line[0] in "sa"]
    assert len(lines) == 6
    for line in lines:
        metal, *numbers = line.split(",")
        flux, T_s, _, _, _, v, _, _, depth, length, time = map(float, numbers)
        found = recession_of(metal, flux)
        assert found.surface_temperature == pytest.approx(T_s, abs=0.02)
        assert found.speed == pytest.approx(v, rel=2e-5)
        assert found.melt_depth == pytest.approx(depth * 1e-9, rel=1e-4)
        assert found.thermal_length == pytest.approx(length * 1e-9, rel=1e-4)
        assert found.time == pytest.approx(time * 1e-9, rel=1e-4)


def test_profile_balances_at_every_depth():
    """k dT/dz = -rho v h on both sides of the melting point, where T is continuous."""
    found = recession_of("steel-304-demuth", 1e11)
    z = np.array([0.1, 0.5, 0.9, 1.2, 3.0]) * found.melt_depth
    step = 1e-4 * found.thermal_length
    slope = (found.temperature(z + step) - found.temperature(z - step)) / (2.0 * step)
    heat = found.heat_capacity * (found.temperature(z) - 298.15)
    heat = heat + np.where(z < found.melt_depth, found.melting, 0.0)
    expected = -found.density * found.speed * heat / found.conductivity
    assert slope == pytest.approx(expected, rel=1e-6)
    front = found.temperature(found.melt_depth + np.array([-1e-15, 1e-15]))
    assert front == pytest.approx([1727.0, 1727.0], abs=0.01)
    assert float(found.temperature(0.0)) == pytest.approx(found.surface_temperature)
