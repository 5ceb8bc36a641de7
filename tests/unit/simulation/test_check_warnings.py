"""What `check` warns of, with its numbers, and what it does not."""

import pytest

from lasersph.case import Case, available_cases, load_case
from lasersph.cli import main
from lasersph.materials import load_material
from lasersph.physics.electron_lattice import (
    Electrons,
    coupling_time,
    electrons_of,
    surface_excess,
)
from lasersph.simulation import forecast

COARSE = ("particles.spacing=64 nm", "particles.coarsest=1 um")


def said(name: str, *settings: str) -> str:
    """All warnings of a case."""
    return "\n".join(forecast(load_case(name, [*COARSE, *settings])).warnings)


def test_a_plateau_that_holds_what_should_leave():
    """With how much metal that is, and not where it does not boil, nor where vapor leaves."""
    plateau = ("solver.vaporization=plateau",)
    assert "boiling point of 3087 K, with the heat that would turn" in said(
        "texture-steel", *plateau
    )
    assert "boiling point" not in said("texture-steel")
    assert "boiling point" not in said("texture-steel", *plateau, "laser.fluence=0.3 J/cm^2")
    assert "by estimate the surface is held" in said("dlip-steel", "solver.kind=conduction")


def test_a_metal_that_lacks_what_vapor_needs():
    """The key that is missing is named."""
    data = load_case("texture-steel", COARSE).resolved()
    del data["solver"]["vaporization"], data["solver"]["plateau"]
    vapor = data["material"]["vaporization"]
    vapor["critical_temperature"] = None
    del vapor["source"]["critical_temperature"]
    warnings = " ".join(forecast(Case.model_validate(data)).warnings)
    assert "no vapor leaves the surface that moves" in warnings
    assert "give critical_temperature in [material.vaporization]" in warnings
    data["laser"]["fluence"] *= 0.5  # melts, and stays far from boiling: nothing is left out
    assert "no vapor" not in " ".join(forecast(Case.model_validate(data)).warnings)


@pytest.mark.parametrize(
    ("pulse", "words"),
    [
        ("6 ps", "longer than the pulse of 6 ps"),
        ("100 fs", "longer than the pulse of 100 fs"),
        ("20 ps", "comparable with the pulse of 20 ps"),
        ("1 ns", "at the surface both differ by about 11 % of its rise under a pulse of 1 ns"),
        ("14 ns", ""),
    ],
)
def test_pulses_as_short_as_the_coupling_of_electrons(pulse, words):
    """Copper couples within some 10 ps."""
    settings = ["material=copper", "laser.wavelength=532 nm", f"laser.pulse.fwhm={pulse}"]
    warnings = said("texture-steel", *settings, "laser.fluence=0.5 J/cm^2")
    assert words in warnings
    assert ("this run has one temperature" in warnings) == bool(words)


def test_light_that_does_not_melt():
    """Said with both temperatures; nothing is asked for the resolution of a flow that is not."""
    cold = said("texture-steel", "laser.fluence=0.1 J/cm^2")
    assert "nothing melts by estimate: light heats the surface to" in cold
    assert "melts at 1670 K" in cold and "drags along" not in cold
    assert "nothing melts" not in said("texture-steel")
    assert "nothing melts" not in said(
        "dlip-steel", "solver.kind=conduction", "laser.fluence=0.1 J/cm^2"
    )


def test_a_spot_that_moves_is_not_said_to_be_cold():
    """How hot it gets is not estimated, and so nothing is said of melt."""
    beam = ("laser.beam.kind=gaussian", "laser.beam.radius_1e2=2 um", "laser.beam.beams=")
    track = ("laser.path.kind=linear", "laser.path.speed=6 m/s", "laser.path.direction=90 deg")
    warnings = said("texture-dots-steel", *beam, *track, "laser.beam.period=", "domain.extent=half")
    assert "nothing melts" not in warnings
    assert "nan" not in warnings


def test_proposed_snapshots_fit_a_disk():
    """Of a pulse of femtoseconds ten frames in a pulse to the end would be millions."""
    short = ["laser.pulse.fwhm=100 fs", "laser.fluence=0.1 J/cm^2"]
    assert "write output.snapshots.times" in said("texture-steel", *short)
    assert "write output.snapshots.interval" in said("texture-steel", "laser.pulse.fwhm=3 ns")


ENOUGH = {
    "silver": 30.0, "gold": 24.8, "copper": 12.6, "aluminium": 5.56, "nickel": 1.93,
    "tungsten": 0.676, "titanium": 0.512, "steel-304": 0.229, "iron": 0.00673,
}  # fmt: skip
"""Pulses [ns] from which both temperatures agree within 5 %, with light of 17 nm depth: printed by
`benchmarks/short_pulses.py`, on the page of short pulses."""


@pytest.mark.parametrize("name", ENOUGH)
def test_excess_of_electrons_beside_runs(name):
    """The estimate is 5 % of the rise within a factor of 2.5 where runs with both have that."""
    metal = load_material(name)
    electrons = electrons_of(name)
    assert electrons is not None
    k = float(metal.conductivity_at(metal.reference_temperature))
    found = surface_excess(electrons, k, metal.diffusivity_reference, 17e-9, ENOUGH[name] * 1e-9)
    assert 0.05 / 2.5 < found < 0.05 * 2.5


def test_excess_of_electrons_by_hand():
    """l = 40 nm of k/G = 1600 nm^2 and light of 10 nm: 32 nm over 2 sqrt(a t/pi) = 320 nm."""
    duration = 3.141592653589793 * (160e-9) ** 2 / 1e-5
    found = surface_excess(Electrons(1.0, 1e17), 160.0, 1e-5, 10e-9, duration)
    assert found == pytest.approx(0.1)


def test_coupling_time_by_hand():
    """C_e = gamma T_e of electrons that begin at 10 000 K, beside a lattice with as much."""
    heat = 0.5 * 100.0 * (1e8 - 9e4)
    found = coupling_time(Electrons(100.0, 1e17), heat=heat, lattice=1e6, cold=300.0)
    assert found == pytest.approx(0.5e6 / 1e17)
    assert electrons_of("ti-6al-4v") == electrons_of("titanium") is not None
    assert electrons_of("bronze") is None


@pytest.mark.parametrize(
    ("fluence", "words"),
    [("600 J/cm^2", "times what boils the layer"), ("1e-5 J/cm^2", "heats the surface by 0.")],
)
def test_energies_in_the_wrong_unit(fluence, words):
    """A thousand times as much, or as little, as texturing needs."""
    warnings = said("texture-steel", f"laser.fluence={fluence}")
    assert words in warnings and "laser.fluence right, or its unit" in warnings


def test_a_spot_that_a_run_does_not_move():
    """A cell gets every pulse of the train, also those after which a moving spot is far away."""
    train = ("laser.pulse.count=3", "laser.pulse.repetition_rate=20 kHz", "time.end=100.3 us")
    spot = 'laser.spot={diameter="60 um", definition="1/e^2"'
    words = "does not move by 20 um from pulse to pulse in a run: all 3 pulses fall"
    assert words in said("texture-steel", f'{spot}, shift="20 um"}}', *train)
    assert words in said("texture-steel", f'{spot}, scan_speed="0.4 m/s"}}', *train)
    assert "from pulse to pulse" not in said("texture-steel", f"{spot}}}", *train)
    assert "from pulse to pulse" not in said("texture-steel", f'{spot}, shift="20 um"}}')


def test_a_pattern_finer_than_the_particles():
    """Less than two spacings in the length over which light changes."""
    settings = ["laser.beam.period=300 nm", "domain.width=3 um", "particles.spacing=60 nm"]
    assert "a pattern of 300 nm, less than 2 spacings" in said("texture-steel", *settings)


@pytest.mark.parametrize("name", available_cases())
def test_shipped_cases_have_plausible_sizes(name):
    """None of them is taken for a typing error, none is too short for one temperature."""
    warnings = " ".join(forecast(load_case(name)).warnings)
    assert "its unit" not in warnings and "electrons are hotter" not in warnings


def test_electrons_of_an_alloy():
    """Steel says with numbers what iron's would change; other metals say nothing."""
    assert "from 0.67 of the fluence" in said("texture-steel-10ps")
    assert "its electrons are" not in said("short-pulse-gold")


def test_check_says_what_the_light_does(capsys):
    """Reflectivity and its temperature, absorbed fluence, highest temperature, boiling."""
    main(["check", "texture-steel"])
    rows = dict(
        line.split("  ", 1) for line in capsys.readouterr().out.splitlines() if "  " in line
    )
    assert " at 298 K" in rows["reflectivity"]
    assert "at most" in rows["absorbed fluence"]
    assert (
        "melts (" in rows["highest temperature"]
        and ", boils (3087 K)" in rows["highest temperature"]
    )
    # where most leaves, as the report says it of the run: 0.983 nm
    assert "leaves the surface, up to about 0.99 nm of metal in a pulse" in rows["vapor"]
    assert " in the top " in rows["finest spacing"]


def test_snapshots_further_apart_than_the_pulse_lasts():
    """With the line to write; not where some fall into the pulse, nor where nothing flows."""
    apart = "output.snapshots.interval=25 ns"
    assert "snapshots are 25 ns apart, longer than the pulse of" in said("texture-steel", apart)
    assert 'write output.snapshots.interval = "' in said("texture-steel", apart)
    assert "snapshots are" not in said("texture-steel")
    assert "snapshots are" not in said("texture-steel", apart, 'output.snapshots.times=["30 ns"]')
    assert "snapshots are" not in said("dlip-steel", apart, "solver.kind=conduction")
