"""Vapor behind its Knudsen layer, flux and recoil against surroundings, by tables and by hand.

`surface_knudsen_layer.csv` and `surface_evaporation.csv` are closed forms evaluated elsewhere;
their heads say how.
"""

from __future__ import annotations

from math import erf, exp, pi, sqrt
from pathlib import Path

import numpy as np
import pytest

from lasersph import compute
from lasersph.materials import load_material
from lasersph.physics import evaporation as e
from lasersph.physics.knudsen_layer import (
    net_mass_flux,
    outflow_tables,
    vapor_behind,
)
from lasersph.physics.losses import evaporation_loss
from lasersph.physics.recoil import gauge_recoil_pressure

FOLDER = Path(__file__).parent
ATMOSPHERE = 101325.0
RATIO, FLUX, MACH = outflow_tables()


def rows(name):
    """Rows of a table, without its head."""
    lines = (FOLDER / name).read_text(encoding="utf-8").splitlines()
    return [line.split(",") for line in lines if line and line[0] not in "#Mm"]


def constants(metal="steel-304-demuth"):
    """Those of a shipped metal."""
    vapor = load_material(metal).vaporization
    assert vapor is not None
    return e.vapor_constants(vapor)


def flux_of(T, p_e, metal="steel-304-demuth"):
    """Saturation pressure [Pa] and net mass flux [kg/(m^2 s)] with its slope."""
    c = constants(metal)
    p = e.saturation_pressure(T, **c)
    L = e.latent_heat(T, c["T_b"], c["L_b"], c["T_c"])
    slope = e.saturation_pressure_slope(T, p, L, c["R_s"])
    return p, *net_mass_flux(T, p, slope, c["R_s"], p_e, RATIO, FLUX)


def test_table_of_the_knudsen_layer():
    """Temperature, density, pressure, recoil and flux at eleven Mach numbers, to all digits."""
    table = np.array(rows("surface_knudsen_layer.csv"), float)
    assert table.shape == (11, 6)
    for mach, *expected in table:
        assert vapor_behind(mach) == pytest.approx(expected, rel=5e-8)


@pytest.mark.parametrize("mach", [0.1, 0.5, 0.9, 1.0])
def test_momentum_is_that_of_the_molecules_that_leave_and_return(mach):
    """The surface gives half of p_sat and takes what a drifting Maxwellian brings back, weighed so
    that the balance of mass holds; their sum is the recoil."""
    vapor = vapor_behind(mach)
    # speed ratio of the vapor, and what of it flies back to the surface: mass and momentum
    s, root = mach * sqrt(5.0 / 6.0), sqrt(vapor.temperature)
    back_mass = vapor.density * root * (exp(-s * s) - sqrt(pi) * s * (1.0 - erf(s)))
    back = vapor.pressure * ((s * s + 0.5) * (1.0 - erf(s)) - s * exp(-s * s) / sqrt(pi))
    weight = (1.0 - vapor.flux) / back_mass
    assert 0.5 + weight * back == pytest.approx(vapor.recoil, rel=1e-12)


def test_fluxes_of_the_shipped_metals_into_vacuum():
    """Forty-two temperatures of four metals within 1e-4: p_sat, flux, recoil, heat."""
    table = rows("surface_evaporation.csv")
    assert len(table) > 40
    for name, T_text, *numbers in table:
        T, (L, p, _, mass, recoil, heat) = float(T_text), map(float, numbers)
        c = constants(name)
        found, flux, _ = flux_of(T, 0.0, name)
        assert (found, flux) == pytest.approx((p, mass), rel=1e-4)
        assert gauge_recoil_pressure(found, 0.0, RATIO, MACH) == pytest.approx(recoil, rel=1e-4)
        loss = evaporation_loss(T, **c, p_e=0.0, ratio_nodes=RATIO, flux_nodes=FLUX)
        assert loss[0] == pytest.approx(heat, rel=1e-4)
        assert loss[0] == pytest.approx(L * loss[2], rel=1e-4)


def test_recoil_of_steel_rises_from_zero_at_its_boiling_point():
    """7.5, 31, 71 and 131 kPa at 100, 200, 300 and 400 K above it, in air; 0 below."""
    c = constants()

    def recoil(T):
        return gauge_recoil_pressure(e.saturation_pressure(T, **c), ATMOSPHERE, RATIO, MACH)

    found = [1e-3 * recoil(3273.0 + more) for more in (100.0, 200.0, 300.0, 400.0)]
    assert found == pytest.approx([7.5, 31.0, 71.0, 131.0], abs=0.5)
    assert recoil(3272.0) == recoil(3273.0) == 0.0
    assert 0.0 < recoil(3273.1) < 1.0
    # where the vapor becomes sonic, 4.85 atm, neither recoil nor flux jumps
    assert e.saturation_pressure(3724.0, **c) == pytest.approx(ATMOSPHERE / 0.20618482, rel=1e-3)
    across = np.array([recoil(T) for T in np.arange(3700.0, 3750.0, 0.25)])
    assert np.all(np.diff(across) >= 0.0) and np.max(np.diff(across)) < 600.0


def test_flux_rises_from_zero_and_joins_the_sonic_one():
    """None below boiling, continuous at Mach 1, then that into vacuum."""
    assert flux_of(3200.0, ATMOSPHERE)[1:] == (0.0, 0.0)
    assert flux_of(3273.0 + 1e-6, ATMOSPHERE)[1] < 1e-5 * flux_of(3273.0, 0.0)[1]
    for T in (3730.0, 5000.0):
        assert flux_of(T, ATMOSPHERE)[1] == flux_of(T, 0.0)[1]
    sonic = flux_of(3723.5, ATMOSPHERE)[1] / flux_of(3723.5, 0.0)[1]
    assert sonic == pytest.approx(1.0, abs=2e-4)
    # Mach 0.5 where p_sat is p_ambient / 0.41782981; Knight's flux times 0.82 / 0.81568
    p, mass, _ = flux_of(3500.0, 0.41782981 * flux_of(3500.0, 0.0)[0])
    free = p / sqrt(2.0 * pi * constants()["R_s"] * 3500.0)
    assert mass / free == pytest.approx(0.74787297 * 0.82 / 0.81568064, rel=1e-5)


@pytest.mark.parametrize("T", [3300.0, 3400.0, 3650.0, 4200.0, 7000.0])
def test_slope_is_that_of_the_flux(T):
    """By a central difference that stays between two nodes of the table."""
    step = 1e-3
    above, below = flux_of(T + step, ATMOSPHERE)[1], flux_of(T - step, ATMOSPHERE)[1]
    assert flux_of(T, ATMOSPHERE)[2] == pytest.approx((above - below) / (2.0 * step), rel=1e-4)


def test_compiled_functions_give_what_python_gives():
    """Over an array, on both sides of the boiling point."""
    backend, T = compute.cpu(threads=1), np.array([300.0, 3272.0, 3300.0, 3600.0, 4000.0, 9300.0])
    out = tuple(backend.zeros(T.size) for _ in range(3))
    given = constants() | {"p_e": ATMOSPHERE}
    tables = {"ratio_nodes": backend.asarray(RATIO), "flux_nodes": backend.asarray(FLUX)}
    backend.pointwise(evaporation_loss, {"T": backend.asarray(T)}, out, **given, **tables)
    plain = [evaporation_loss(t, **given, ratio_nodes=RATIO, flux_nodes=FLUX) for t in T]
    for found, expected in zip(out, np.array(plain).T, strict=True):
        np.testing.assert_allclose(backend.to_host(found), expected, rtol=1e-12)


def test_tables_are_made_once_and_cannot_be_written():
    """A run looks at the recoil in each step."""
    assert all(a is b for a, b in zip(outflow_tables(), outflow_tables(), strict=True))
    with pytest.raises(ValueError, match="read-only"):
        RATIO[0] = 1.0
