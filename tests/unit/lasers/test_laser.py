"""Laser: what its energy statements mean, energies on cells, moving spots, refusals."""

from itertools import pairwise

import numpy as np
import pytest
from pydantic import ValidationError

from lasersph.lasers import GaussianBeam, InterferenceBeam, Laser, LinearPath, TabulatedPath

SQUARE = {"kind": "square", "duration": 1e-7}
GAUSSIAN = {"kind": "gaussian", "fwhm": 1e-8, "center": 5e-8}
SPOT = {"kind": "gaussian", "radius_1e2": 1e-5}
STRIPES = {"kind": "interference", "period": 5e-6}


def laser(**given):
    """A laser with surface absorption; a square pulse unless given."""
    return Laser(**({"pulse": SQUARE, "absorption": {"kind": "surface"}} | given))


def plane(half, n):
    """Corners and area of n x n cells over [-half, half]^2."""
    edges = np.linspace(-half, half, n + 1)
    lower, upper = (
        np.stack([a.ravel() for a in np.meshgrid(e, e, indexing="ij")])
        for e in (edges[:-1], edges[1:])
    )
    return lower, upper, (2 * half / n) ** 2


def test_interference_fluence_is_the_mean():
    """0.6 J/cm2 with two waves: mean 6000, peak 12000 J/m2; named peak the other way round."""
    mean = laser(fluence=6e3, beam=STRIPES)
    assert (mean.mean_fluence, mean.peak_fluence) == (6e3, 12e3)
    peak = laser(fluence=6e3, fluence_kind="peak", beam=STRIPES)
    assert (peak.mean_fluence, peak.peak_fluence) == (3e3, 6e3)


def test_means_of_a_resting_beam_are_kept():
    """A beam that rests gives the same fluence from means found once; one that moves has none."""
    lower, upper, _ = plane(2e-5, 6)
    rests = laser(pulse_energy=1.0, beam=SPOT)
    means = rests.resting_means(lower, upper)
    known = rests.energy_density(lower, upper, 2e-8, 5e-8, means)
    np.testing.assert_array_equal(known, rests.energy_density(lower, upper, 2e-8, 5e-8))
    moves = laser(pulse_energy=1.0, beam=SPOT, path=LinearPath(speed=2.0))
    assert moves.resting_means(lower, upper) is None


def test_gaussian_statements_agree():
    """Pulse energy E, power E/t, peak 2E/(pi w^2), mean E/(pi w^2) are the same light."""
    energy = 1e-3
    peak = 2 * energy / (np.pi * 1e-10)
    same = [
        laser(pulse_energy=energy, beam=SPOT),
        laser(power=energy / 1e-7, beam=SPOT),
        laser(fluence=peak, fluence_kind="peak", beam=SPOT),
        laser(fluence=peak / 2, fluence_kind="mean", beam=SPOT),
        laser(intensity=peak / 1e-7, fluence_kind="peak", beam=SPOT),
    ]
    assert [each.unit_fluence for each in same] == pytest.approx([peak] * 5)


def test_intensity_of_a_uniform_square_pulse():
    """9.6e11 W/m2 for 100 ns is 96 kJ/m2; half of it after 50 ns, in any dimension."""
    beam = laser(intensity=9.6e11)
    for dimension in (0, 1, 2):
        corners = np.zeros((dimension, 2))
        got = beam.energy_density(corners, corners + 1e-6, 0.0, 5e-8)
        assert got == pytest.approx([4.8e4, 4.8e4])


def test_power_of_a_tabulated_pulse():
    """Relative power 1 stands for the stated one: a triangle to 2 over 2 us at 10 W is 20 uJ."""
    pulse = {"kind": "tabulated", "table": ((0.0, 0.0), (1e-6, 2.0), (2e-6, 0.0))}
    beam = laser(power=10.0, pulse=pulse, beam={"kind": "top-hat", "radius": 1e-5})
    assert beam.unit_fluence * np.pi * 1e-10 == pytest.approx(20e-6)


def test_column_lies_in_the_interference_maximum():
    """A 1-D run gets the peak fluence."""
    nothing = np.empty((0, 1))
    got = laser(fluence=6e3, beam=STRIPES).energy_density(nothing, nothing, 0.0, 1.0)
    assert got == pytest.approx([12e3])


def test_fixed_spot_delivers_its_pulse_energy():
    """Cells that catch the whole beam add up to the pulse energy; also step by step."""
    beam = laser(pulse_energy=1e-3, beam=SPOT, pulse=GAUSSIAN, position=(3e-6, -2e-6))
    lower, upper, area = plane(4e-5, 21)
    assert beam.energy_density(lower, upper, 0.0, 1.0).sum() * area == pytest.approx(1e-3, rel=1e-9)
    steps = np.linspace(0.0, 1e-7, 8)
    parts = sum(beam.energy_density(lower, upper, a, b).sum() * area for a, b in pairwise(steps))
    assert parts == pytest.approx(1e-3, rel=1e-9)


@pytest.mark.parametrize("beam", [SPOT, {"kind": "top-hat", "radius": 1e-5}])
@pytest.mark.parametrize("pulse", [SQUARE, GAUSSIAN, SQUARE | {"count": 3, "period": 1.5e-7}])
def test_moving_spot_delivers_its_pulse_energy(beam, pulse):
    """300 m/s over 100 ns is three radii; the total is right to 1e-6 in uneven steps."""
    path = {"kind": "linear", "speed": 300.0, "direction": 0.5}
    moving = laser(pulse_energy=1e-3, beam=beam, pulse=pulse, path=path, position=(-2e-5, 0.0))
    lower, upper, area = plane(2e-4, 61)
    steps = [0.0, 3e-8, 3.1e-8, 9e-8, 3.7e-7, 6e-7]
    total = sum(moving.energy_density(lower, upper, a, b).sum() * area for a, b in pairwise(steps))
    assert total == pytest.approx(1e-3 * pulse.get("count", 1), rel=1e-6)


def test_moving_spot_leaves_its_energy_where_it_passes():
    """On the line of travel a long pass leaves P sqrt(2/pi)/(w v) J/m2."""
    path = {"kind": "linear", "speed": 1000.0}
    pulse = {"kind": "square", "duration": 1e-7}
    moving = laser(power=100.0, beam=SPOT, pulse=pulse, path=path, position=(-5e-5, 0.0))
    point = np.zeros((2, 1))
    cell = point - 1e-9, point + 1e-9
    parts = sum(moving.energy_density(*cell, a, a + 1e-8)[0] for a in np.arange(10) * 1e-8)
    assert parts == pytest.approx(100.0 * np.sqrt(2 / np.pi) / (1e-5 * 1000.0), rel=1e-6)


def test_tabulated_path_is_followed():
    """Straight between its rows, at rest outside them."""
    path = {"kind": "tabulated", "table": ((1e-8, 0.0, 0.0), (2e-8, 1e-5, 0.0), (3e-8, 1e-5, 2e-5))}
    moving = laser(pulse_energy=1e-3, beam=SPOT, path=path)
    x, y = moving.axis([0.0, 1.5e-8, 2.5e-8, 1.0])
    assert x == pytest.approx([0.0, 5e-6, 1e-5, 1e-5])
    assert y == pytest.approx([0.0, 0.0, 1e-5, 2e-5])
    lower, upper, area = plane(8e-5, 41)
    assert moving.energy_density(lower, upper, 0.0, 1.0).sum() * area == pytest.approx(1e-3)


def test_symmetry_is_known():
    """Centered beams are even; shifted or moving ones and shifted patterns are not."""
    assert laser(fluence=1.0, beam=STRIPES).is_even
    assert laser(fluence=1.0).is_even
    assert laser(pulse_energy=1.0, beam=SPOT).is_even
    assert not laser(pulse_energy=1.0, beam=SPOT, position=(1e-6, 0.0)).is_even
    assert not laser(fluence=1.0, beam=STRIPES, path={"kind": "linear", "speed": 1.0}).is_even


@pytest.mark.parametrize(
    "path",
    [
        {"kind": "linear", "speed": 6.0, "direction": np.pi / 2.0},
        {"kind": "tabulated", "table": ((0.0, 0.0, 0.0), (1e-8, 0.0, 2e-5))},
    ],
)
def test_a_spot_that_stays_in_a_plane_is_symmetric_about_it(path):
    """Along y the light is the same at x and -x, not at y and -y."""
    moving = laser(pulse_energy=1.0, beam=SPOT, path=path)
    assert moving.is_mirrored(0)
    assert not moving.is_mirrored(1)


def test_written_case_is_read_with_units():
    """Text with units in every place, as a case file has it."""
    given = {
        "fluence": "0.6 J/cm^2", "reflectivity": "55.6 %",
        "beam": {"kind": "interference", "wavelength": "355 nm", "angle": "0.071 rad"},
        "pulse": {"kind": "gaussian", "fwhm": "10 ns", "center": "50 ns"},
        "absorption": {"kind": "beer-lambert"},
    }  # fmt: skip
    read = Laser.model_validate(given, context={"strict_units": True})
    assert read.unit_fluence == pytest.approx(6e3)
    assert read.reflectivity == pytest.approx(0.556)
    assert Laser.model_validate(read.model_dump()) == read
    assert Laser.model_json_schema()["properties"]["beam"]


def test_reflectivity_and_absorption_of_case_or_material():
    """The case's own numbers win; else the material's; else the message names the key."""
    from lasersph.materials import load_material

    steel = load_material("steel-304-demuth")
    own = laser(fluence=1.0, reflectivity=0.3)
    assert own.reflectivity_table(steel, 300.0, 3000.0)[1].tolist() == [0.3, 0.3]
    table = laser(fluence=1.0, reflectivity={"table": ((300.0, 0.5), (900.0, 0.4))})
    assert table.reflectivity_table(steel, 300.0, 3000.0)[1].tolist() == [0.5, 0.4]
    from_metal = laser(fluence=1.0, absorption={"kind": "beer-lambert"})
    assert from_metal.reflectivity_table(steel, 300.0, 3000.0)[1] == pytest.approx(0.556)
    assert from_metal.absorption_coefficient(steel) == pytest.approx(9.56e7)
    assert own.absorption_coefficient(steel) == np.inf
    bare = steel.model_copy(update={"optics": None})
    with pytest.raises(ValueError, match=r"write e\.g\. reflectivity = 0\.9 in \[laser\]"):
        laser(fluence=1.0).reflectivity_table(bare, 300.0, 3000.0)


PHASES = tuple({"polar": 0.1, "azimuth": a, "phase": p} for a, p in ((0, 0), (2, 1), (4, 0)))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({}, "got none; write e.g. fluence"),
        ({"fluence": 1.0, "intensity": 1.0}, "got fluence and intensity"),
        ({"fluence": 1.0, "beam": SPOT}, 'write fluence_kind = "peak" or "mean"'),
        ({"pulse_energy": 1.0}, "no meaning for the unbounded uniform beam"),
        ({"power": 1.0, "beam": STRIPES}, "unbounded interference beam"),
        ({"power": 1.0, "beam": SPOT, "pulse": GAUSSIAN}, "write instead pulse_energy"),
        ({"intensity": 1.0, "pulse": GAUSSIAN}, "write instead fluence"),
        ({"pulse_energy": 1.0, "beam": SPOT, "fluence_kind": "peak"}, "leave it out"),
        ({"fluence": -1.0}, "greater than 0"),
        ({"fluence": 1.0, "path": {"kind": "linear", "speed": 1.0}}, "uniform beam cannot move"),
        (
            {"fluence": 1.0, "fluence_kind": "peak",
             "beam": {"kind": "interference", "wavelength": 1e-6, "waves": PHASES}},
            "depends on the phases",
        ),
        (
            {"pulse_energy": 1.0, "beam": SPOT, "position": (1e-6, 0.0),
             "path": {"kind": "tabulated", "table": ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))}},
            "leave position out",
        ),
        ({"fluence": 1.0, "reflectivity": 1.2}, "less than or equal to 1"),
        ({"fluence": 1.0, "reflectivity": {"table": ((300.0, 0.5),)}}, "at least 2"),
    ],
)  # fmt: skip
def test_ambiguous_or_impossible_lasers_are_refused(given, message):
    """What is wrong and what would be right."""
    with pytest.raises(ValidationError, match=message):
        laser(**given)


def test_objects_may_be_passed_instead_of_tables():
    """Beams and paths built in Python."""
    built = laser(pulse_energy=1.0, beam=GaussianBeam(radius_1e2=1e-5), path=LinearPath(speed=2.0))
    assert built.axis(1.0).tolist() == [2.0, 0.0]
    table = TabulatedPath(table=((0.0, 0.0, 0.0), (1.0, 1.0, 0.0)))
    assert laser(fluence=1.0, beam=InterferenceBeam(period=1e-6), path=table).axis(0.5)[0] == 0.5


def test_shift_of_the_pattern():
    """Each pulse lands a shift further on; two pulses half a period apart leave no pattern."""
    beam = {"kind": "interference", "period": 4e-6, "shift": 2e-6}
    pulse = {"kind": "square", "duration": 1e-8, "count": 2, "period": 1e-7}
    laser = Laser.model_validate(
        {"fluence": 1.0, "beam": beam, "pulse": pulse, "absorption": {"kind": "surface"}}
    )
    edges = np.linspace(0.0, 4e-6, 9)
    cells = edges[None, :-1], edges[None, 1:]
    first, second = (laser.energy_density(*cells, t, t + 5e-8) for t in (0.0, 1e-7))
    assert first == pytest.approx(np.roll(second, 4))
    assert laser.first_pulse.energy_density(*cells, 0.0, 1.0) == pytest.approx(first)
    assert laser.energy_density(*cells, 0.0, 1.0) == pytest.approx(np.full(8, 2.0))
