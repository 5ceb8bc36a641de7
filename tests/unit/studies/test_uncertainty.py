"""Errors of a run's numbers: by hand on formulas, and on conduction with a known solution."""

import json
import math
from types import SimpleNamespace

import pytest

from lasersph.analytic.half_space import step_rise
from lasersph.analytic.melt_depth import MeltEstimate
from lasersph.case import load_case
from lasersph.input import QuantityError
from lasersph.output import open_run
from lasersph.studies import Input, assess_uncertainty, inputs_of, read_input
from lasersph.studies.companions import coarser_cases, shifted, with_fixed_layers
from lasersph.validation.stefan.rows import exact_solution

HEATING = ("particles.spacing=2 um", "time.end=50 ns", "output.snapshots.interval=50 ns")


def heating(*settings):
    """One pulse on a half-space, 100 particles."""
    return load_case("pulsed-heating", [*HEATING, "laser.pulse.count=1", *settings])


def formula(case, folder):
    """T = 300 + F / k^0.5 + d^2 and a bent number; the summary of a run that needs no time."""
    folder.mkdir(parents=True, exist_ok=True)
    F = case.laser.fluence / 96000.0
    k = case.material.conductivity.value / 167.0
    d = case.particles.spacing / 2e-6
    summary = {
        "spacing_m": case.particles.spacing, "particles": 3,
        "temperature_max_K": 300.0 + 100.0 * F / math.sqrt(k) + d**2,
        "bent_K": 500.0 - (F - 1.0) ** 2,
        "rounding_K": 400.0 + 1e-13 * F,
    }  # fmt: skip
    return SimpleNamespace(summary=summary)


INPUTS = (Input("laser.fluence", 0.04, "x"), Input("material.conductivity", 0.05, "y"))


def test_parts_add_in_squares(tmp_path):
    """d = 1, 2, 4 and order 2: 1.25 x 1; 4 % of 100 K and 5 %/2 of 100 K, doubled."""
    found = assess_uncertainty(heating(), tmp_path, inputs=INPUTS, run=formula)
    entry = found["numbers"]["temperature_max_K"]
    assert entry["numerical"] == pytest.approx(1.25)
    assert (entry["behavior"], entry["order"]) == ("converging", pytest.approx(2.0))
    assert entry["inputs"]["laser.fluence"]["standard"] == pytest.approx(4.0)
    half = 50.0 * (0.95**-0.5 - 1.05**-0.5)
    assert entry["inputs"]["material.conductivity"]["standard"] == pytest.approx(half)
    assert entry["error"] == pytest.approx(math.hypot(1.25, 2 * 4.0, 2 * half))
    assert json.loads((tmp_path / "uncertainty.json").read_text())["numbers"].keys() == {
        "temperature_max_K", "bent_K", "rounding_K",
    }  # fmt: skip
    assert open_run_uncertainty(tmp_path)["inputs"]["laser.fluence"]["source"] == "x"


def open_run_uncertainty(folder):
    """What a reader of the folder sees."""
    (folder / "resolved.json").write_text("{}")
    return open_run(folder).uncertainty


def test_bent_number_counts_its_larger_change(tmp_path):
    """Both sides lower it by 0.0016: half of their difference would be 0."""
    found = assess_uncertainty(heating(), tmp_path, inputs=INPUTS[:1], run=formula)
    part = found["numbers"]["bent_K"]["inputs"]["laser.fluence"]
    assert part["is_linear"] is False
    assert part["standard"] == pytest.approx(0.0016)
    part = found["numbers"]["rounding_K"]["inputs"]["laser.fluence"]
    assert (part["standard"], part["is_linear"]) == (0.0, True)


def test_companions_are_prepared_in_two_rounds(tmp_path):
    """Coarser ones and higher inputs; then lower ones, but where higher changed nothing."""
    rounds = []

    def run(case, folder):
        found = formula(case, folder)
        (folder / "resolved.json").write_text("{}")
        (folder / "summary.json").write_text(json.dumps(found.summary))
        return found

    def prepare(cases):
        rounds.append([folder.name for folder in cases])
        for folder, case in cases.items():
            run(case, folder)

    inputs = [*INPUTS, Input("initial_temperature", 0.01, "z")]
    assess_uncertainty(heating(), tmp_path, inputs=inputs, run=run, prepare=prepare)
    higher = ["laser.fluence+4%", "material.conductivity+5%", "initial_temperature+1%"]
    assert rounds[0] == ["spacing-4um", "spacing-8um", *higher]
    assert rounds[1:] == [["laser.fluence-4%", "material.conductivity-5%"]]


def test_side_that_the_case_refuses_is_left_out(tmp_path):
    """A reflectivity of 0.99 cannot be 5 % higher: one run, said in the notes."""
    case = heating("laser.reflectivity=0.99")
    names = []

    def run(case, folder):
        names.append(folder.name)
        return formula(case, folder)

    inputs = [Input("laser.reflectivity", 0.05, "x")]
    found = assess_uncertainty(case, tmp_path, inputs=inputs, run=run)
    assert names[1:] == ["spacing-4um", "spacing-8um", "laser.reflectivity-5%"]
    assert len(found["notes"]) == 1
    assert found["notes"][0].startswith("laser.reflectivity +5%: ")
    part = found["numbers"]["temperature_max_K"]["inputs"]["laser.reflectivity"]
    assert (part["up"], part["down"], part["is_linear"]) == (None, 0.0, None)


def test_input_without_effect_takes_one_run(tmp_path):
    """A latent heat that this case does not read: no second run, and no part."""
    names = []

    def run(case, folder):
        names.append(folder.name)
        return formula(case, folder)

    inputs = [Input("material.vaporization.latent_heat", 0.05, "x"), *INPUTS[:1]]
    found = assess_uncertainty(heating(), tmp_path, inputs=inputs, run=run)
    assert names[3:] == [
        "material.vaporization.latent_heat+5%", "laser.fluence+4%", "laser.fluence-4%",
    ]  # fmt: skip
    part = found["numbers"]["temperature_max_K"]["inputs"]["material.vaporization.latent_heat"]
    assert part == {"up": 0.0, "down": 0.0, "standard": 0.0, "is_linear": True}


def test_case_that_cannot_be_coarser(tmp_path):
    """15 um in 200 um: no numerical part, one line that says why; inputs are still assessed."""
    case = heating("particles.spacing=15 um")
    lines = []
    found = assess_uncertainty(case, tmp_path, inputs=INPUTS[:1], run=formula, report=lines.append)
    (note,) = found["notes"]
    assert lines[0] == note  # before the first run
    assert note.startswith("no numerical part: a spacing of 15 um cannot be made coarser twice")
    assert "above 20 um" in note
    entry = found["numbers"]["temperature_max_K"]
    assert (entry["error"], entry["numerical"]) == (None, pytest.approx(math.nan, nan_ok=True))
    assert entry["from_inputs"] == pytest.approx(8.0)
    assert json.loads((tmp_path / "uncertainty.json").read_text())["numbers"]  # nan is null there


def test_crater_is_not_made_smaller_than_a_particle():
    """An ablation whose crater is a particle and a half deep has no coarser companions."""
    case = load_case("ablation-depth", quick=True)
    assert isinstance(coarser_cases(case, None), str)


def melts(depth):
    """An estimate that the case melts so deep [m]."""
    return MeltEstimate(depth, 40e-9, 80e-9, 3000.0)


def test_layers_and_steps_grow_alike():
    """Spacing, coarsest layer and step by r, the ratio of layers to its r-th power, then r^2; the
    depth of the finest layers is that of the case, as it is where an input is shifted."""
    case = load_case("dlip-steel", ["solver.kind=conduction"])
    melt = melts(300e-9)
    case = with_fixed_layers(case, melt)
    first, second = coarser_cases(case, melt)
    assert first.particles.spacing == pytest.approx(16e-9)
    assert second.particles.spacing == pytest.approx(32e-9)
    assert first.particles.ratio == pytest.approx(0.9**2)
    assert second.particles.ratio == pytest.approx(0.9**4)
    assert second.particles.coarsest == pytest.approx(4e-6)
    assert second.time.step == pytest.approx(200e-12)
    other = shifted(case, Input("material.conductivity", 0.1, "x"), 1)
    assert first.particles.fine_depth == other.particles.fine_depth == case.particles.fine_depth
    assert case.particles.fine_depth > melt.depth
    shallow = coarser_cases(case, melts(60e-9))  # 4 cells of 15 nm
    assert shallow[1].particles.spacing == pytest.approx(15e-9)
    assert "above 12 nm" in coarser_cases(case, melts(48e-9))
    assert other.material.conductivity.value == pytest.approx(1.1 * 26.78922752)
    assert other.laser == case.laser


def test_stated_and_given_inputs():
    """Those of the metal, named as keys of the case; a given one in a unit or in percent."""
    case = load_case("dlip-aluminium", ["material=aluminium"])
    assert [one.key for one in inputs_of(case)][:2] == [
        "material.density.liquid", "material.conductivity.solid",
    ]  # fmt: skip
    assert read_input(case, "laser.pulse.fwhm=0.5 ns").relative == pytest.approx(0.05)
    assert read_input(case, "material.viscosity = 7 %").relative == pytest.approx(0.07)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("laser.fluence", '"laser.fluence" is not KEY=U; write e.g. laser.fluence=5%'),
        ("laser.fluenc=5%", '"laser.fluenc" is no key of this case (do you mean "fluence"?)'),
        ("laser.fluence=5", 'laser.fluence: "5" has no unit'),
        ("laser.fluence=5 ns", 'laser.fluence: "5 ns" is a time, not a fluence'),
        ("laser.fluence=-5%", 'laser.fluence: "-5%" must lie above 0'),
        ("laser.power=5%", '"laser.power" is not given in this case'),
        ("solver.kind=5%", '"solver.kind" is no number with a unit'),
        ("material.heat_capacity=9 J/(kg K)", ""),
        ("domain.depth.x=5%", '"domain.depth.x" is no key of this case'),
    ],
)
def test_bad_inputs_are_refused(text, words):
    """One line with the key, what is wrong and what would be right."""
    if not words:
        assert read_input(heating(), text).relative == pytest.approx(9.0 / 896.0)
        return
    with pytest.raises(QuantityError) as caught:
        read_input(heating(), text)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_heated_half_space(tmp_path):
    """The first particle under a constant flux: its rise is proportional to the fluence and falls
    with the conductivity as the exact solution does; the exact rise lies inside the error."""
    case = heating()
    found = assess_uncertainty(case, tmp_path, inputs=INPUTS)
    entry = found["numbers"]["temperature_max_K"]
    rise = entry["value"] - 300.0
    assert entry["inputs"]["laser.fluence"]["standard"] == pytest.approx(0.04 * rise, rel=1e-9)

    def exact(factor):
        k = 167.0 * factor
        D = k / (2705.0 * 896.0)
        return float(step_rise(1e-6, 50e-9, flux=0.25 * 9.6e11, conductivity=k, diffusivity=D))

    change = 0.5 * abs(exact(1.05) - exact(0.95))
    part = entry["inputs"]["material.conductivity"]
    assert part["is_linear"]
    assert part["standard"] == pytest.approx(change, rel=0.05)
    assert abs(rise - exact(1.0)) < entry["numerical"]


def test_melting_front_lies_inside_its_error(tmp_path):
    """Neumann's front after 1 us and the temperature of the surface, from 50, 25 and 13
    particles."""
    case = load_case("stefan", quick=True)
    found = assess_uncertainty(case, tmp_path)["numbers"]
    front, hottest = found["melt.volume_max_m3"], found["temperature_max_K"]
    assert abs(front["value"] - float(exact_solution(case).front(1e-6))) < front["error"]
    assert front["error"] < 0.02 * front["value"]
    assert abs(hottest["value"] - 1333.0) < hottest["error"] < 0.03 * 1333.0


def test_a_shifted_viscosity_keeps_the_density_of_the_melt():
    """Of a metal that gives both viscosities both are shifted."""
    base = load_case("dlip-steel")
    case = shifted(base, read_input(base, "material.viscosity=7%"), +1)
    nu = [float(one.material.kinematic_viscosity_at(1727.0)) for one in (base, case)]
    assert nu[1] == pytest.approx(1.07 * nu[0])
    assert case.material.density_liquid == pytest.approx(base.material.density_liquid)
