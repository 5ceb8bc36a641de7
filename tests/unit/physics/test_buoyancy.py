"""Buoyancy by hand."""

import numpy as np
import pytest

from lasersph.physics.buoyancy import buoyancy

UP = np.array([0.0, 1.0])


def test_hot_fluid_rises():
    """beta dT g = 1e-4 * 50 * 10 = 0.05 m/s2 upward; downward where it is colder; none at T_l."""
    constants = {"beta": 1e-4, "T_l": 1000.0, "g": 10.0, "up": UP}
    assert buoyancy(1050.0, **constants).tolist() == pytest.approx([0.0, 0.05])
    assert buoyancy(950.0, **constants).tolist() == pytest.approx([0.0, -0.05])
    assert buoyancy(1000.0, **constants).tolist() == [0.0, 0.0]
