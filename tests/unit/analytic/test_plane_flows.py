"""Plane flows obey their equation, begin at rest and end as stated."""

import numpy as np
import pytest

from lasersph.analytic.plane_flows import couette, poiseuille, return_flow, sheared

GAP, NU, RHO = 2e-3, 1e-6, 1000.0
Y = np.linspace(0.0, GAP, 41)
LATE, EARLY = 10.0 * GAP**2 / NU, 1e-4 * GAP**2 / NU
FLOWS = {
    "couette": (lambda y, t: couette(y, t, gap=GAP, speed=3.0, viscosity=NU), 0.0),
    "poiseuille": (lambda y, t: poiseuille(y, t, gap=GAP, force=2.0, viscosity=NU), 2.0),
    "sheared": (
        lambda y, t: sheared(y, t, gap=GAP, stress=0.1, viscosity=NU, density=RHO),
        0.0,
    ),
}


@pytest.mark.parametrize("name", FLOWS)
def test_momentum(name):
    """du/dt = g + nu d2u/dy2, by differences, while the flow develops."""
    flow, force = FLOWS[name]
    time, dt, dy = 0.1 * GAP**2 / NU, 1e-5 * GAP**2 / NU, 1e-3 * GAP
    y = Y[4:-4]
    rate = (flow(y, time + dt) - flow(y, time - dt)) / (2.0 * dt)
    curvature = (flow(y + dy, time) - 2.0 * flow(y, time) + flow(y - dy, time)) / dy**2
    assert rate == pytest.approx(force + NU * curvature, rel=1e-5, abs=1e-6 * np.abs(rate).max())


@pytest.mark.parametrize("name", FLOWS)
def test_starts_at_rest_and_sticks_to_the_wall(name):
    """Nothing moves away from the boundary at first; u(0) = 0 always."""
    flow, _ = FLOWS[name]
    final = np.abs(flow(Y, LATE)).max()
    assert flow(Y[:-4], EARLY) == pytest.approx(0.0, abs=2e-3 * final)
    assert flow(np.zeros(1), 0.3)[0] == pytest.approx(0.0, abs=1e-12)


def test_steady_states():
    """Couette linear, Poiseuille a parabola of g H^2/(8 nu), shear tau y/eta."""
    assert FLOWS["couette"][0](Y, LATE) == pytest.approx(3.0 * Y / GAP, abs=1e-12)
    middle = FLOWS["poiseuille"][0](np.array([0.5 * GAP]), LATE)[0]
    assert middle == pytest.approx(2.0 * GAP**2 / (8.0 * NU))
    assert FLOWS["sheared"][0](Y, LATE) == pytest.approx(0.1 * Y / (RHO * NU), abs=1e-9)


def test_return_flow():
    """No net flux, the stress at the surface, at rest at the wall, tau H/(4 eta) at the top."""
    eta, tau = 2e-3, 0.4
    x, w = np.polynomial.legendre.leggauss(4)
    flux = w @ return_flow(0.5 * GAP * (x + 1.0), gap=GAP, stress=tau, viscosity=eta)
    u = return_flow(np.array([0.0, GAP - 1e-9, GAP]), gap=GAP, stress=tau, viscosity=eta)
    assert flux == pytest.approx(0.0, abs=1e-15)
    assert eta * (u[2] - u[1]) / 1e-9 == pytest.approx(tau, rel=1e-5)
    assert u[0] == 0.0
    assert u[2] == pytest.approx(tau * GAP / (4.0 * eta))
