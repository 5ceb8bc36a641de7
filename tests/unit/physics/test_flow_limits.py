"""Limits of the time step of a flow, against numbers worked out for liquid steel at 3.97 nm."""

from math import inf

import pytest

from lasersph.physics.flow_limits import flow_limits

SUPPORT = 3.75 * 3.97e-9
STEEL = {
    "support": SUPPORT, "speed": 4.0, "acceleration": 4.3e-4 * 1e9 / (6863.0 * 3.97e-9),
    "viscosity": 1.02e-6, "diffusivity": 5.24e-6, "density": 6863.0, "surface_tension": 1.8,
}  # fmt: skip


def test_published():
    """931, 243, 27.2, 5.29 and 11.2 ps for the terms of eq. (59)."""
    found = flow_limits("published", **STEEL)
    expected = {
        "advection": 931e-12, "force": 242.8e-12, "viscosity": 27.2e-12, "heat": 5.29e-12,
        "capillary": 11.16e-12,
    }  # fmt: skip
    assert {name: found[name] for name in expected} == pytest.approx(expected, rel=2e-3)


def test_corrected():
    """Advection 0.06 l/v = 223 ps, viscosity 0.05 l^2/nu = 10.9 ps, implicit 0.2 l^2/nu = 43.5 ps;
    no heat and no capillary limit."""
    found = flow_limits("corrected", **STEEL, is_implicit=False)
    assert found["viscosity"] == pytest.approx(10.87e-12, rel=2e-3)
    assert "heat" not in found
    assert "capillary" not in found
    assert found["advection"] == pytest.approx(223.3e-12, rel=2e-3)
    assert flow_limits("corrected", **STEEL)["viscosity"] == pytest.approx(43.5e-12, rel=2e-3)


def test_melt_that_passes():
    """0.12 l/v, as far as that is 0.024 l^2/nu at most, and never less than 0.06 l/v."""
    thin, thick, between = STEEL | {"viscosity": 1e-9}, STEEL, STEEL | {"viscosity": 1.6e-8}
    found = [flow_limits("corrected", **one, is_passing=True) for one in (thin, thick, between)]
    assert found[0]["advection"] == pytest.approx(446.6e-12, rel=2e-3)
    assert found[1]["advection"] == pytest.approx(223.3e-12, rel=2e-3)
    assert found[2]["advection"] == pytest.approx(0.024 * SUPPORT**2 / 1.6e-8)
    published = flow_limits("published", **thin, is_passing=True)
    assert published["advection"] == pytest.approx(931e-12, rel=2e-3)


def test_at_rest():
    """Without speed and force neither limits, nor a surface tension that is not known."""
    at_rest = {"speed": 0.0, "acceleration": 0.0, "surface_tension": 0.0}
    for rule in ("corrected", "published"):
        found = flow_limits(rule, **STEEL | at_rest)
        limited = {name for name, limit in found.items() if limit < inf}
        assert limited == {"viscosity"} | ({"heat"} if rule == "published" else set())
