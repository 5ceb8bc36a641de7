"""Light on rings: exact means, the energy of a pulse, and what is round."""

import numpy as np
import pytest

from lasersph.lasers import (
    GaussianBeam,
    InterferenceBeam,
    Laser,
    RingBeam,
    SuperGaussianBeam,
    TopHatBeam,
    UniformBeam,
)
from lasersph.lasers.rings import ellipticity, ring_means, round_light

PULSE = {"kind": "square", "duration": 1e-8}
BEAMS = [
    TopHatBeam(radius=3e-6),
    GaussianBeam(radius_1e2=3e-6),
    SuperGaussianBeam(radius_1e2=3e-6, order=4.0),
    RingBeam(radius=4e-6, inner_radius=2e-6),
]


def laser_with(beam, **given):
    """A laser of 1 uJ with a beam."""
    table = {"beam": beam, "pulse": PULSE, "absorption": {"kind": "surface"}}
    return Laser.model_validate({"pulse_energy": 1e-6, **table, **given})


@pytest.mark.parametrize("beam", BEAMS, ids=lambda beam: beam.kind)
def test_rings_receive_the_pulse(beam):
    """All rings together receive its energy, to rounding."""
    laser, edges = laser_with(beam), np.linspace(0.0, 2e-5, 201)
    area = np.pi * np.diff(edges**2)
    means = ring_means(laser, edges[:-1], edges[1:])
    assert np.sum(means * area) * laser.unit_fluence == pytest.approx(1e-6, rel=1e-12)


@pytest.mark.parametrize("beam", BEAMS, ids=lambda beam: beam.kind)
def test_means_of_rings_are_those_of_the_profile(beam):
    """Against the mean of 2 pi r f(r) over each ring by a fine rule."""
    edges = np.linspace(0.0, 6e-6, 25)
    share = (np.arange(4000) + 0.5) / 4000
    r = edges[:-1, None] + share * np.diff(edges)[:, None]
    expected = np.sum(r * beam.at(r, 0.0 * r), axis=1) / np.sum(r, axis=1)
    assert ring_means(laser_with(beam), edges[:-1], edges[1:]) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("beam", BEAMS, ids=lambda beam: beam.kind)
def test_means_of_cells_hold_the_area(beam):
    """The plane cut into cells: their means add up to the integral of f."""
    edges = np.linspace(-1e-5, 1e-5, 161)
    low, high = (np.stack([a.ravel() for a in np.meshgrid(e, e)]) for e in (edges[:-1], edges[1:]))
    means = beam.cell_means(low, high, np.zeros(2))
    assert means.sum() * (edges[1] - edges[0]) ** 2 == pytest.approx(beam.area, rel=1e-6)


def test_super_gaussian_of_order_one_is_gaussian():
    """And its fluence over the circle of 1/e^2 is half of the peak."""
    first, second = SuperGaussianBeam(radius_1e2=3e-6, order=1.0), GaussianBeam(radius_1e2=3e-6)
    x = np.linspace(0.0, 9e-6, 19)
    assert first.at(x, 0.0) == pytest.approx(second.at(x, 0.0))
    assert first.enclosed(x) == pytest.approx(second.enclosed(x))
    assert (first.area, first.mean) == pytest.approx((second.area, second.mean))


def test_even_light_and_cells_of_spots_are_uniform():
    """A uniform beam has mean 1 on every ring."""
    edges = np.linspace(0.0, 1e-5, 11)
    even = laser_with(UniformBeam(), pulse_energy=None, fluence=1e3)
    assert ring_means(even, edges[:-1], edges[1:]) == pytest.approx(np.ones(10))


def test_a_whole_spot_counts_with_its_envelope():
    """Of a uniform beam under a spot; waves that interfere are not round."""
    spot = {"diameter": 6e-6, "definition": "1/e^2", "extent": "whole"}
    laser = laser_with(UniformBeam(), spot=spot)
    assert isinstance(round_light(laser), GaussianBeam)
    assert round_light(laser_with(InterferenceBeam(period=2e-6), spot=spot)) is None


def test_measured_beam_over_the_angle(tmp_path):
    """A round image counts as its Gaussian, an oval one says how far from round it is."""
    y, x = np.mgrid[:61, :61] - 30.0
    for name, stretch in (("round.csv", 1.0), ("oval.csv", 0.7)):
        image = np.exp(-2.0 * (x**2 + (y / stretch) ** 2) / 10.0**2)
        np.savetxt(tmp_path / name, image, delimiter=",")

    def measured(name):
        spot = {"image": str(tmp_path / name), "pixel_size": 1e-6, "extent": "whole"}
        return laser_with(UniformBeam(), spot=spot)

    r = np.linspace(0.0, 2e-5, 21)
    exact = GaussianBeam(radius_1e2=1e-5)
    envelope = round_light(measured("round.csv"))
    assert envelope is not None
    assert envelope.enclosed(r) == pytest.approx(exact.enclosed(r), abs=0.01 * exact.area)
    assert ellipticity(measured("round.csv")) == pytest.approx(1.0, abs=1e-3)
    assert ellipticity(measured("oval.csv")) == pytest.approx(0.7, abs=0.02)
