"""Insulated slab: images and series agree, energy is kept, early times are a half-space."""

import numpy as np
import pytest

from lasersph.analytic import half_space, slab

METAL = {"flux": 2.4e11, "conductivity": 167.0, "diffusivity": 6.89e-5}
THICKNESS = 5e-6


def test_images_and_series_meet_where_they_change_over():
    """Just below and above Fo = 0.2 the two forms give the same rise."""
    change = 0.2 * THICKNESS**2 / METAL["diffusivity"]
    depths = np.linspace(0.0, THICKNESS, 7)
    below, above = (
        slab.slab_step_rise(depths, change * f, thickness=THICKNESS, **METAL)
        for f in (1 - 1e-12, 1 + 1e-12)
    )
    assert above == pytest.approx(below, rel=1e-9)


@pytest.mark.parametrize("time", [1e-8, 4e-8, 1e-7, 1e-6])
def test_slab_holds_the_absorbed_heat(time):
    """rho c times the integral over the depth is q t."""
    x, w = np.polynomial.legendre.leggauss(60)
    rise = slab.slab_step_rise(0.5 * THICKNESS * (x + 1), time, thickness=THICKNESS, **METAL)
    heat = METAL["conductivity"] / METAL["diffusivity"] * 0.5 * THICKNESS * (w @ rise)
    assert heat == pytest.approx(METAL["flux"] * time, rel=1e-9)


def test_deep_slab_is_a_half_space():
    """While nothing reaches the bottom both agree."""
    depth, time = 1e-6, np.array([5e-8, 1.5e-7, 3e-7])
    deep = slab.slab_step_rise(depth, time, thickness=1e-4, **METAL)
    assert deep == pytest.approx(half_space.step_rise(depth, time, **METAL))


def test_bottom_is_insulated_and_warmer_than_in_a_half_space():
    """No slope at the bottom; the reflected heat makes it exactly twice as warm early on."""
    near = np.array([THICKNESS - 1e-9, THICKNESS])
    rise = slab.slab_step_rise(near, 2e-8, thickness=THICKNESS, **METAL)
    assert rise[0] == pytest.approx(rise[1], rel=1e-5)
    assert rise[1] == pytest.approx(2 * half_space.step_rise(THICKNESS, 2e-8, **METAL), rel=1e-6)
