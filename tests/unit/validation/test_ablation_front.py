"""The front-fitted Stefan problem against closed forms, balances and a second method."""

from __future__ import annotations

import numpy as np
import pytest

from lasersph.analytic.half_space import step_rise
from lasersph.validation.ablation_depth.front import Metal, ablate, chebyshev, onset, weights

METAL = Metal()
DURATION = 10e-9


def absorbed_flux(fluence: float) -> float:
    """Flux [W/m^2] of a fluence [J/cm^2] in 10 ns at R = 0.75."""
    return 0.25 * fluence * 1e4 / DURATION


@pytest.mark.parametrize(("fluence", "depth"), [(10.0, 0.587), (20.0, 1.333)])
def test_reference_depths(fluence: float, depth: float) -> None:
    """Depths [um] at 10 and 20 J/cm2, 10 ns, R = 0.75, to one in a thousand."""
    found = ablate(absorbed_flux(fluence), DURATION)
    assert found.depth * 1e6 == pytest.approx(depth, rel=1.1e-3)
    assert found.imbalance < 3e-6


@pytest.mark.parametrize(("fluence", "depth"), [(10.0, 0.596), (20.0, 1.336)])
def test_lumped_latent_heats(fluence: float, depth: float) -> None:
    """With the heat of melting taken up in boiling instead, the depths are other ones."""
    lumped = Metal(melting_heat=1e3, vaporization_heat=10.53e6 + 396e3)
    assert ablate(absorbed_flux(fluence), DURATION, lumped).depth * 1e6 == pytest.approx(
        depth, abs=6e-4
    )


def test_long_pulse_recedes_steadily() -> None:
    """The front of a long pulse approaches da/dt = q/(rho [c (T_v - T_0) + L_m + L_v])."""
    flux = absorbed_flux(100.0)
    found = ablate(flux, DURATION)
    steady = flux / (METAL.density * METAL.full_heat)
    speed = (found.fronts[-1] - found.fronts[-5]) / (found.times[-1] - found.times[-5])
    assert speed == pytest.approx(steady, rel=2e-3)


def test_steady_layers() -> None:
    """Below a steadily receding front T - T_0 falls as exp(-v z/D) and v D rho L_m is taken at T_m.

    In the liquid T = T_v - A (1 - exp(-v z/D)), in the solid T - T_0 = (T_m - T_0) exp(-v z/D);
    the jump of the flux at T_m gives A exp(-v s/D) = T_m - T_0 + L_m/c.
    """
    flux = absorbed_flux(100.0)
    found = ablate(flux, DURATION)
    speed = flux / (METAL.density * METAL.full_heat)
    span = METAL.vaporization - METAL.melting
    below = METAL.melting - METAL.initial + METAL.melting_heat / METAL.specific_heat
    thickness = METAL.diffusivity / speed * np.log1p(span / below)
    assert found.melt_depth - found.depth == pytest.approx(thickness, rel=0.01)


def test_weak_pulse_only_warms() -> None:
    """Below the onset of melting nothing is ablated and the surface is as hot as in (A.1)."""
    flux = 0.5 * absorbed_flux(0.4)
    found = ablate(flux, DURATION)
    exact = step_rise(
        0.0, DURATION, flux=flux, conductivity=METAL.conductivity, diffusivity=METAL.diffusivity
    )
    assert found.depth == 0.0
    assert found.melting_time is None
    assert found.temperatures[0] == pytest.approx(METAL.initial + float(exact))


def test_pulse_that_only_melts() -> None:
    """Between the onsets the metal melts and keeps its surface; the energy balances."""
    found = ablate(absorbed_flux(1.5), DURATION)
    assert found.depth == 0.0
    assert found.boiling_time is None
    assert found.melt_depth > 0.0
    assert METAL.melting < found.temperatures[0] < METAL.vaporization
    assert found.imbalance < 3e-5


def test_against_differences() -> None:
    """A plain enthalpy scheme on fixed cells tends to the same depth."""
    flux, duration = absorbed_flux(10.0), 2e-9
    expected = ablate(flux, duration).depth
    coarse, fine = (cells_gone(flux, duration, size) for size in (20e-9, 10e-9))
    assert 2.0 * fine - coarse == pytest.approx(expected, rel=0.05)


def cells_gone(flux: float, duration: float, size: float) -> float:
    """Depth by explicit differences: a cell leaves when it holds its full heat; the cell that is
    leaving counts by its share of the latent heat [m]."""
    metal, count = METAL, int(3e-6 / size)
    solid = metal.specific_heat * (metal.melting - metal.initial)
    liquid = solid + metal.melting_heat
    boiling = liquid + metal.specific_heat * (metal.vaporization - metal.melting)
    nodes_h = (-1e6, solid, liquid, boiling, 1e9)
    nodes_t = (metal.initial - 1e6 / metal.specific_heat, metal.melting, metal.melting,
               metal.vaporization, metal.vaporization)  # fmt: skip
    h = np.zeros(count)
    step = 0.3 * size**2 / metal.diffusivity
    steps = int(np.ceil(duration / step))
    first, gain = 0, flux * (duration / steps) / (metal.density * size)
    exchange = metal.conductivity * (duration / steps) / (metal.density * size**2)
    for _ in range(steps):
        flow = exchange * np.diff(np.interp(h, nodes_h, nodes_t))
        flow[:first] = 0.0
        h[:-1] += flow
        h[1:] -= flow
        h[first] += gain
        if h[first] >= metal.full_heat:
            h[first + 1] += h[first] - metal.full_heat
            first += 1
    share = max(float(h[first]) - boiling, 0.0) / metal.vaporization_heat
    return (first + share) * size


def test_refuses_what_it_cannot() -> None:
    """A flux that is not positive is refused."""
    with pytest.raises(ValueError, match="positive"):
        ablate(0.0, DURATION)


def test_onset() -> None:
    """At the onset the surface of (A.1) has risen by just that much."""
    time = onset(633.0, 2.5e12, METAL)
    rise = step_rise(
        0.0, time, flux=2.5e12, conductivity=METAL.conductivity, diffusivity=METAL.diffusivity
    )
    assert float(rise) == pytest.approx(633.0)


def test_chebyshev_derivative_and_integral() -> None:
    """Exact for x^3 on 0..2: derivative 3 x^2, integral 4."""
    x, matrix = chebyshev(6, 2.0)
    np.testing.assert_allclose(matrix @ x**3, 3.0 * x**2, atol=1e-12)
    assert float(weights(x) @ x**3) == pytest.approx(4.0)
