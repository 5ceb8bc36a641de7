"""Absorptivity as a number, over temperature and over time, and the energies that come of it."""

import re

import numpy as np
import pytest

from lasersph import compute
from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.lasers import Laser
from lasersph.lasers.reflectivity import AbsorptivityTable
from lasersph.materials import load_material
from lasersph.simulation.heating import heating_forecast
from lasersph.simulation.recipes import recipe_of

CASE = """
material = "steel-304-demuth"
[laser]
fluence = "0.1 J/cm^2"
absorption = { kind = "surface" }
pulse = { kind = "tabulated", table = [["0 ns", 0.0], ["4 ns", 1.0]] }
absorptivity = { path = "absorptivity.csv" }
[domain]
depth = "2 um"
[particles]
spacing = "0.1 um"
[solver]
dimensions = 1
[time]
end = "4 ns"
"""
RISING = "t,absorptivity\n0,0\n4e-9,1\n"
ABLATION = ("solver.kind=ablation", "solver.sound_speed=1000 m/s")


def case_with(folder, rows, *settings):
    """Case whose absorptivity is a file over time."""
    (folder / "absorptivity.csv").write_text(rows)
    file = folder / "case.toml"
    file.write_text(CASE)
    return load_case(file, settings)


def laser(**given):
    """A laser of 1 J/m^2 on the surface, in 1 s."""
    pulse = {"kind": "square", "duration": 1.0}
    plain = {"fluence": 1.0, "absorption": {"kind": "surface"}, "pulse": pulse}
    return Laser.model_validate(plain | given)


def test_number_and_table_over_temperature():
    """R = 1 - A, also of a jump."""
    steel = load_material("steel-304-demuth")
    _, R = laser(absorptivity=0.3).reflectivity_table(steel, 300.0, 3000.0)
    assert R.tolist() == pytest.approx([0.7, 0.7])
    law = laser(absorptivity={"table": ((300.0, 0.3), (900.0, 0.3), (900.0, 0.6))})
    T, R = law.reflectivity_table(steel, 300.0, 3000.0)
    assert R.tolist() == pytest.approx([0.7, 0.7, 0.4]) and np.all(np.diff(T) > 0.0)
    assert Laser.model_validate(law.model_dump()) == law


def test_mean_over_time_is_weighted_with_the_power():
    """P = t and A = t: the mean is 2/3 of the last, (b^3 - a^3)/(b^2 - a^2) 2/3 of a part."""
    pulse = laser(pulse={"kind": "tabulated", "table": ((0.0, 0.0), (3.0, 3.0))}).pulse
    rising = AbsorptivityTable(over_time=((0.0, 0.0), (3.0, 0.9)))
    assert rising.mean(pulse) == pytest.approx(0.6)
    assert rising.mean(pulse, (1.0, 2.0)) == pytest.approx(0.3 * 2.0 / 3.0 * 7.0 / 3.0)
    # held beyond its ends, and where no light comes
    assert rising.mean(pulse, (4.0, 5.0)) == 0.9
    jump = AbsorptivityTable(over_time=((0.0, 0.2), (1.0, 0.2), (1.0, 0.8), (2.0, 0.8)))
    flat = laser().pulse.model_copy(update={"duration": 2.0})
    assert jump.mean(flat, (0.5, 1.5)) == pytest.approx(0.5)


@pytest.mark.parametrize("kind", ["layered", "first hit"])
def test_absorbed_energy_of_a_measured_absorptivity(kind, tmp_path):
    """P ~ t, A ~ t: two thirds of the light are absorbed, step by step to rounding."""
    case = case_with(tmp_path, RISING, *(ABLATION if kind == "first hit" else ()))
    recipe = recipe_of(case)
    assert recipe.heating is None or recipe.heating.temperature > 1000.0
    solver = recipe.build(compute.cpu(threads=1))
    begin = 0.0
    for end in (0.9e-9, 2e-9, 4e-9):
        light = solver.light if kind == "first hit" else solver.body.light
        light.shine(begin, end)
        absorbed = light.absorb(solver.particles["temperature"])
        share = 2.0 / 3.0 * (end**3 - begin**3) / (end**2 - begin**2) / 4e-9
        assert absorbed == pytest.approx(share * light.incident, rel=1e-9)
        assert light.reflected == pytest.approx((1.0 - share) * light.incident, rel=1e-9)
        begin = end


def test_rows_are_kept_and_the_estimate_knows_them(tmp_path):
    """The case needs its file once; light that is absorbed late heats more than in the mean."""
    case = case_with(tmp_path, RISING)
    assert case.laser.absorptivity.over_time == ((0.0, 0.0), (4e-9, 1.0))
    (tmp_path / "absorptivity.csv").unlink()
    assert type(case).model_validate(case.resolved()).hash() == case.hash()
    late = heating_forecast(case, recipe_of(case).heating)
    mean = case_with(tmp_path, "t,absorptivity\n0,0.6666667\n4e-9,0.6666667\n")
    even = heating_forecast(mean, recipe_of(mean).heating)
    assert late.reflectivity == pytest.approx(even.reflectivity)
    assert late.absorbed_mean == pytest.approx(even.absorbed_mean)
    assert late.temperature > 1.05 * even.temperature


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ("0,0.5\n2e-9,0.5\n1e-9,0.5\n", "absorptivity.csv:4: time 1e-09 s lies before 2e-09 s of"),
        ("-1,0.5\n0,0.5\n", "absorptivity.csv:2: time -1 s lies before 0 s, the start of the run"),
        ("0,0.5\n1e-9,-1\n", "absorptivity.csv:3: absorptivity -1 is negative; give 0 or more"),
        ("0,40\n1e-9,50\n", "absorptivity.csv:2: absorptivity 40 is more than 1; give 1 or less"),
        (
            "0,0.5\n",
            "laser.absorptivity.over_time: needs two rows or more; give a table over",
        ),
        (
            "0,0.5\n0,0.6\n0,0.7\n",
            "laser.absorptivity.over_time: has times that go back; they must",
        ),
    ],
)
def test_bad_files(tmp_path, rows, message):
    """File, line, what is wrong."""
    with pytest.raises(CaseError, match=re.escape(message)):
        case_with(tmp_path, "t,absorptivity\n" + rows)


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("absorptivity=120 %", 'laser.absorptivity: must be at most 1, got "120 %"'),
        ("reflectivity=0.4", "laser.absorptivity: says the same as reflectivity, which is 1 - abs"),
        ("absorptivity={ over_time = [['2 ns', 0.5], ['1 ns', 0.5]] }", "has times that go back"),
        ("absorptivity={ table = [['900 K', 0.5], ['300 K', 0.5]] }", "has temperatures that go"),
        ("absorptivity={}", "laser.absorptivity.over_time: needs two rows or more"),
        (
            "absorptivity={ table = [['3 K', 0.5], ['9 K', 0.5]], over_time = [['1 s', 0.5]] }",
            "laser.absorptivity.over_time: contradicts table; leave one of them out",
        ),
        ("absorptivity={ path = 'none.csv' }", "none.csv: cannot be read: No such file"),
    ],
)
def test_bad_keys(tmp_path, setting, message):
    """The key, and what would be right."""
    with pytest.raises(CaseError, match=re.escape(message)):
        case_with(tmp_path, RISING, f"laser.{setting}")


def test_a_preset_of_ejection_brings_its_own(tmp_path):
    """A second absorptivity beside it is refused."""
    preset = "solver.ejection={ model = 'published', preset = 'timeline' }"
    with pytest.raises(CaseError, match=r"means a reflectivity of 0\.8, but"):
        case_with(tmp_path, RISING, *ABLATION, preset)
