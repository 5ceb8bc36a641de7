"""Gaussian pulse absorbed in the volume: against direct integration and finite volumes."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.special import erfc

from lasersph.analytic import pulsed_source

STEEL = {"conductivity": 26.8, "volumetric_heat_capacity": 7262.0 * 704.0}
DIFFUSIVITY = 26.8 / (7262.0 * 704.0)
ALPHA = 9.56e7
PULSE = {"fluence": 0.444 * 6e3, "fwhm": 10e-9, "center": 50e-9}


def rise(depth, time, **more):
    """Rise under the steel pulse at 0.6 J/cm2."""
    return pulsed_source.gaussian_pulse_rise(
        depth, time, absorption_coefficient=ALPHA, **PULSE, **STEEL, **more
    )


def test_impulse_density_is_the_textbook_expression():
    """Where nothing overflows, the plain formula with erfc gives the same."""
    a = ALPHA * np.sqrt(DIFFUSIVITY * 1e-12)
    z = 7e-9
    b = z / (2 * np.sqrt(DIFFUSIVITY * 1e-12))
    plain = 0.5 * ALPHA * np.exp(a**2) * (
        np.exp(-ALPHA * z) * erfc(a - b) + np.exp(ALPHA * z) * erfc(a + b)
    )  # fmt: skip
    got = pulsed_source.impulse_density(z, 1e-12, ALPHA, DIFFUSIVITY)
    assert got == pytest.approx(plain, rel=1e-13)


@pytest.mark.parametrize("alpha", [ALPHA, np.inf])
@pytest.mark.parametrize("elapsed", [1e-14, 1e-11, 1e-8])
def test_impulse_share_is_the_integral_of_the_density(alpha, elapsed):
    """Closed form of the integral over depth against quadrature; all of it ends up below."""
    z = 3.0 * np.sqrt(DIFFUSIVITY * elapsed) + (0.0 if np.isinf(alpha) else 1e-8)
    area, _ = quad(
        lambda d: float(pulsed_source.impulse_density(d, elapsed, alpha, DIFFUSIVITY)), 0.0, z,
        epsrel=1e-11, limit=200,
    )  # fmt: skip
    share = pulsed_source.impulse_share(z, elapsed, alpha, DIFFUSIVITY)
    assert share == pytest.approx(area, rel=1e-9)
    assert pulsed_source.impulse_share(1.0, elapsed, alpha, DIFFUSIVITY) == pytest.approx(1.0)


@pytest.mark.parametrize("wavenumber", [0.0, 2 * np.pi / 5e-6])
@pytest.mark.parametrize(("depth", "time"), [(0.0, 45e-9), (2e-9, 57e-9), (3e-7, 120e-9)])
def test_rise_is_the_convolution(depth, time, wavenumber):
    """Adaptive quadrature of pulse times response, with s = u^2, agrees to 1e-8."""
    sigma = 10e-9 / np.sqrt(8 * np.log(2))

    def integrand(u):
        s = u * u
        pulse = np.exp(-0.5 * ((time - 50e-9 - s) / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        density = float(pulsed_source.impulse_density(depth, s, ALPHA, DIFFUSIVITY))
        return 2 * u * pulse * density * np.exp(-(wavenumber**2) * DIFFUSIVITY * s)

    marks = np.sqrt(np.maximum(time - 50e-9 + sigma * np.array([-4, -2, 0, 2, 4]), 1e-14))
    edges = np.unique(np.concatenate([[1e-12, 1e-7, 1e-6, 1e-5], marks, [np.sqrt(time)]]))
    total = sum(quad(integrand, a, b, epsrel=1e-11)[0] for a, b in pairwise(edges))
    expected = PULSE["fluence"] / STEEL["volumetric_heat_capacity"] * total
    assert rise(depth, time, wavenumber=wavenumber)[0, 0] == pytest.approx(expected, rel=1e-8)


def test_cell_mean_is_the_mean_over_the_cell():
    """Gauss-Legendre mean of point values over a 4 nm cell."""
    x, w = np.polynomial.legendre.leggauss(6)
    points = 2e-9 * (x + 1.0)
    mean = 0.5 * rise(points, [52e-9, 70e-9]) @ w
    got = rise(0.0, [52e-9, 70e-9], depth_bottom=4e-9)[:, 0]
    assert got == pytest.approx(mean, rel=1e-9)


def test_surface_absorption_is_the_limit_of_strong_absorption():
    """alpha = inf and alpha = 1e12/m agree."""
    args = (np.array([0.0, 1e-7]), 55e-9)
    strong = pulsed_source.gaussian_pulse_rise(*args, absorption_coefficient=1e12, **PULSE, **STEEL)
    surface = pulsed_source.gaussian_pulse_rise(*args, **PULSE, **STEEL)
    assert surface == pytest.approx(strong, rel=1e-4)


def test_interference_pattern_against_finite_volumes():
    """One lateral mode in a slab, by the method of lines: the same temperatures within 0.1 %."""
    thickness, n, k = 3e-7, 300, 2 * np.pi / 1e-6
    faces = np.linspace(0.0, thickness, n + 1)
    dz = faces[1]
    share = -np.diff(np.exp(-ALPHA * faces))
    share[-1] += np.exp(-ALPHA * thickness)
    sigma = 1e-9 / np.sqrt(8 * np.log(2))
    scale = 1e3 / (STEEL["volumetric_heat_capacity"] * dz)

    def rate(t, T):
        flow = np.concatenate([[0.0], np.diff(T) / dz, [0.0]])
        pulse = np.exp(-0.5 * ((t - 4e-9) / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
        return DIFFUSIVITY * (np.diff(flow) / dz - k * k * T) + scale * share * pulse

    fine = solve_ivp(rate, (0.0, 12e-9), np.zeros(n), method="LSODA", t_eval=[4.5e-9, 12e-9],
                     rtol=1e-6, atol=1e-3, lband=1, uband=1, max_step=2e-10)  # fmt: skip
    exact = pulsed_source.gaussian_pulse_rise(
        faces[:-1], [4.5e-9, 12e-9], fluence=1e3, fwhm=1e-9, center=4e-9, depth_bottom=faces[1:],
        absorption_coefficient=ALPHA, wavenumber=k, thickness=thickness, **STEEL,
    )  # fmt: skip
    assert exact == pytest.approx(fine.y.T, rel=1e-3)


def test_images_conserve_the_energy_in_a_slab():
    """With an insulated bottom, long after the pulse, the slab holds all of it, evenly."""
    late = rise([0.0, 1e-7, 2e-7], 3e-6, thickness=2e-7)[0]
    even = PULSE["fluence"] / (STEEL["volumetric_heat_capacity"] * 2e-7)
    assert late == pytest.approx(even, rel=1e-9)


def test_pattern_combines_mean_and_mode():
    """At the maximum mean + mode, at the minimum mean - mode, in between the mean."""
    pulse = {"absorption_coefficient": ALPHA, **PULSE, **STEEL}
    x = np.array([0.0, 1.25e-6, 2.5e-6])
    got = pulsed_source.interference_rise(x, np.zeros(3), 57e-9, period=5e-6, **pulse)[0]
    mean = rise(0.0, 57e-9)[0, 0]
    mode = rise(0.0, 57e-9, wavenumber=2 * np.pi / 5e-6)[0, 0]
    assert got == pytest.approx([mean + mode, mean, mean - mode])


def test_nothing_before_the_pulse():
    """More than 9 sigma before the maximum the rise is zero."""
    assert rise(0.0, [0.0, 1e-9]).tolist() == [[0.0], [0.0]]
