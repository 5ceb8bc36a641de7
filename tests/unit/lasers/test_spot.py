"""Spots: local fluence from pulse energy and diameter, cells and whole spots, moved spots."""

import numpy as np
import pytest
from scipy.special import j1

from lasersph.lasers import Laser

ENERGY, DIAMETER = 1e-5, 5e-5
STRIPES = {"kind": "interference", "period": 5e-6}


def laser(definition="1/e^2", spot=(), **given):
    """A pulse of 10 uJ on a spot of 50 um under stripes of 5 um, unless given."""
    pulse = {"kind": "square", "duration": 1e-8}
    envelope = spot
    if spot is not None:
        envelope = {"diameter": DIAMETER, "definition": definition} | dict(spot)
    light = {"pulse_energy": ENERGY, "beam": STRIPES, "spot": envelope}
    return Laser(**({"pulse": pulse, "absorption": {"kind": "surface"}} | light | given))


@pytest.mark.parametrize(
    ("definition", "center", "radius"),
    [
        ("1/e^2", 8.0 * ENERGY / (np.pi * DIAMETER**2), 0.5 * DIAMETER),
        ("fwhm", 4.0 * np.log(2.0) * ENERGY / (np.pi * DIAMETER**2), 0.5 * DIAMETER),
        ("top-hat", 4.0 * ENERGY / (np.pi * DIAMETER**2), 0.499 * DIAMETER),
    ],
)
def test_local_fluence_by_hand(definition, center, radius):
    """2 E/(pi w^2), 4 ln2 E/(pi d^2), E/(pi r^2); what is left at the stated radius."""
    local = laser(definition).spot_fluence
    assert local.center == pytest.approx(center, rel=1e-12)
    left = {"1/e^2": np.exp(-2.0), "fwhm": 0.5, "top-hat": 1.0}[definition]
    assert local.at(0.0, radius) == pytest.approx(left * center, rel=1e-12)
    assert (local.energy, local.period) == pytest.approx((ENERGY, 5e-6))


@pytest.mark.parametrize("definition", ["1/e^2", "fwhm", "top-hat"])
def test_local_fluence_holds_the_pulse_energy(definition):
    """Its integral over the plane is the energy of a pulse."""
    local = laser(definition).spot_fluence
    x = (np.arange(801) - 400.0) * 4.0 * DIAMETER / 800.0
    fluence = local.at(x[:, None], x[None, :])
    assert fluence.sum() * (x[1] - x[0]) ** 2 == pytest.approx(ENERGY, rel=1e-3)


def test_a_cell_receives_the_fluence_of_its_place():
    """The mean over a period is that of the center or of `place`; `fluence` is at the center."""
    low, high = np.array([[0.0]]), np.array([[5e-6]])
    for place in ((0.0, 0.0), (1e-5, -1e-5)):
        cell = laser(spot={"place": place})
        expected = cell.spot_fluence.at(*place)
        assert cell.energy_density(low, high, 0.0, 1.0) == pytest.approx([float(expected)])
        assert cell.mean_fluence == pytest.approx(float(expected))
    named = laser(pulse_energy=None, fluence=6e3, spot={"place": (1e-5, 0.0)})
    assert named.spot_fluence.center == pytest.approx(6e3)
    assert named.mean_fluence == pytest.approx(6e3 * np.exp(-2.0 * (1e-5 / 2.5e-5) ** 2))


@pytest.mark.parametrize("definition", ["1/e^2", "top-hat"])
def test_a_whole_spot_receives_the_pulse_energy(definition):
    """Cells add up to E times the integral of g f over A: 1, or 1 + 2 J1(K R)/(K R) of a disc."""
    edges = np.linspace(-1e-4, 1e-4, 401)
    corners = [np.meshgrid(e, e, indexing="ij") for e in (edges[:-1], edges[1:])]
    low, high = (np.stack([a.ravel() for a in pair]) for pair in corners)
    whole = laser(definition, spot={"extent": "whole"}, position=(3e-6, 1e-6))
    total = whole.energy_density(low, high, 0.0, 1.0).sum() * 2.5e-13
    turns = np.pi * DIAMETER / 5e-6
    cut = 2.0 * j1(turns) / turns if definition == "top-hat" else 0.0
    assert total == pytest.approx(ENERGY * (1.0 + cut), rel=1e-6 if cut == 0.0 else 5e-4)
    assert whole.is_bounded and not laser().is_bounded
    assert not whole.is_even and laser(spot={"extent": "whole"}).is_even


def test_displacement_and_overlap():
    """By shift, scan speed over repetition rate, or path; 10 um of 50 um overlap by 80 %."""
    train = {"kind": "square", "duration": 1e-8, "repetition_rate": 1e4}
    for given in (
        {"spot": {"shift": 1e-5}},
        {"spot": {"scan_speed": 0.1}, "pulse": train},
        {"path": {"kind": "linear", "speed": 0.1}, "pulse": train},
    ):
        moved = laser(**given)
        assert moved.displacement == pytest.approx(1e-5)
        assert moved.spot_fluence.overlap(moved.displacement) == pytest.approx(0.8)
    assert laser().displacement is None
    assert laser().spot_fluence.overlap(1.0) == 0.0


def test_repetition_rate_is_the_period_of_a_train():
    """Three pulses at 10 kHz begin as with a period of 100 us, and deliver three energies."""
    pulse = {"kind": "square", "duration": 1e-8, "count": 3}
    by_rate = laser(pulse=pulse | {"repetition_rate": 1e4}).pulse
    by_period = laser(pulse=pulse | {"period": 1e-4}).pulse
    assert by_rate.starts == pytest.approx(by_period.starts)
    assert by_rate.end == pytest.approx(by_period.end)
    assert by_rate.breakpoints() == pytest.approx(by_period.breakpoints())
    assert by_rate.delivered(0.0, 1.0) == pytest.approx(3.0)


def test_a_uniform_beam_has_no_spot():
    """Unless it is given one."""
    with pytest.raises(ValueError, match="uniform beam has no spot"):
        _ = laser(pulse_energy=None, fluence=1.0, beam={"kind": "uniform"}, spot=None).spot_fluence
    assert laser(beam={"kind": "uniform"}).spot_fluence.period is None
