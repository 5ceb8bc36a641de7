"""The vortices obey the Navier-Stokes equations, checked by differences, and decay as stated."""

import numpy as np
import pytest

from lasersph.analytic.taylor_green import TaylorGreen

VORTICES = TaylorGreen(speed=1.3, period=0.8, viscosity=0.02, density=3.0)
PLACE = np.array([[0.11, 0.27, -0.31], [0.05, -0.13, 0.22]])
STEP = 1e-4


def along(axis):
    """Unit shift along an axis, (2, 1)."""
    return STEP * np.eye(2)[:, [axis]]


def derivative(function, axis):
    """Central difference of a field at PLACE."""
    return (function(PLACE + along(axis)) - function(PLACE - along(axis))) / (2.0 * STEP)


def test_no_divergence():
    """du/dx + dw/dz = 0."""
    du, dw = (derivative(lambda x: VORTICES.velocity(x, 0.3), axis)[axis] for axis in (0, 1))
    assert du + dw == pytest.approx(0.0, abs=1e-6)


def test_momentum():
    """dv/dt + v.grad v = -grad p/rho + nu laplace v."""
    time = 0.3

    def velocity(x):
        return VORTICES.velocity(x, time)

    v = velocity(PLACE)
    rate = (VORTICES.velocity(PLACE, time + STEP) - VORTICES.velocity(PLACE, time - STEP)) / (
        2.0 * STEP
    )
    transport = v[0] * derivative(velocity, 0) + v[1] * derivative(velocity, 1)
    slope = np.stack([derivative(lambda x: VORTICES.pressure(x, time), a) for a in (0, 1)])
    curvature = sum(
        (velocity(PLACE + along(a)) - 2.0 * v + velocity(PLACE - along(a))) / STEP**2
        for a in (0, 1)
    )
    friction = VORTICES.viscosity * curvature
    assert rate + transport == pytest.approx(friction - slope / VORTICES.density, abs=1e-5)


def test_sides_of_half_a_period_are_free_of_flow_and_shear():
    """At x = period/2 u = 0 and dw/dx = 0, at z = 0 w = 0 and du/dz = 0."""
    half = VORTICES.period / 2
    right = np.array([[half, half], [-0.1, -0.3]])
    top = np.array([[0.1, 0.3], [0.0, 0.0]])
    assert VORTICES.velocity(right)[0] == pytest.approx(0.0, abs=1e-14)
    assert VORTICES.velocity(top)[1] == pytest.approx(0.0, abs=1e-14)
    for place, axis, component in ((right, 0, 1), (top, 1, 0)):
        above, below = (VORTICES.velocity(place + s * along(axis)) for s in (1, -1))
        assert above[component] == pytest.approx(below[component], rel=1e-12)


def test_energy_is_the_mean_of_the_speeds():
    """rho v^2/2 averaged over a period is kinetic_energy, and falls by e^-1 in 1/(2 decay_rate)."""
    s = (np.arange(32) + 0.5) / 32 * VORTICES.period
    x, z = np.meshgrid(s, s)
    time = 0.5 / VORTICES.decay_rate
    v = VORTICES.velocity(np.stack([x.ravel(), z.ravel()]), time)
    energy = 0.5 * VORTICES.density * np.mean(np.sum(v**2, axis=0))
    assert energy == pytest.approx(float(VORTICES.kinetic_energy(time)), rel=1e-12)
    assert energy == pytest.approx(np.exp(-1.0) * 3.0 * 1.3**2 / 4.0, rel=1e-12)


def test_reynolds_number_and_bounds():
    """Re = 1.3 * 0.8/0.02 = 52; without viscosity infinite; a negative one is refused."""
    assert VORTICES.reynolds_number == pytest.approx(52.0)
    assert TaylorGreen(1.0, 1.0, 0.0).reynolds_number == np.inf
    with pytest.raises(ValueError, match="viscosity"):
        TaylorGreen(1.0, 1.0, -1.0)
