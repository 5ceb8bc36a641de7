"""A line that a message tells to write into a material is accepted as it stands."""

import re

import pytest

from lasersph import load_case
from lasersph.input import CaseError
from lasersph.materials import load_material

PROPERTIES = """\
density = { value = "7900 kg/m^3", source = "data sheet" }
heat_capacity = { value = "480 J/(kg K)", source = "data sheet" }
conductivity = { value = "20 W/(m K)", source = "data sheet" }
"""
LINE = re.compile(r"write ((\w+) = \{.*\})$")


def problems_of(file):
    """The lines of the refusal of a material file."""
    with pytest.raises(CaseError) as error:
        load_material(str(file))
    return [str(problem) for problem in error.value.problems]


@pytest.mark.parametrize(
    ("line", "shown"),
    [
        ('density = "7900 kg/m^3"', 'value = "7900 kg/m^3"'),
        ('density = "7900 kg"', 'value = "2700 kg/m^3"'),
        ("conductivity = 20", 'value = "167 W/(m K)"'),
        ('surface_tension = "1.5 N/m"', 'value = "1.5 N/m"'),
        ('melting = "1700 K"', 'solidus = "1300 K"'),
        ("vaporization = 3000", 'temperature = "3000 K"'),
    ],
)
def test_table_is_shown(line, shown, tmp_path):
    """With the number that was given where it is one of the right kind, else with an example."""
    key = line.partition(" ")[0]
    kept = "".join(one + "\n" for one in PROPERTIES.splitlines() if not one.startswith(key))
    file = tmp_path / "alloy.toml"
    file.write_text(f'name = "alloy"\n{line}\n{kept}', encoding="utf-8")
    (problem,) = problems_of(file)
    written = LINE.search(problem)
    assert written and written[2] == key and shown in written[1]
    file.write_text(f'name = "alloy"\n{written[1]}\n{kept}', encoding="utf-8")
    assert getattr(load_material(str(file)), key) is not None


@pytest.mark.parametrize("given", ["0.62", '"62 %"'])
def test_table_of_a_reflectivity(given, tmp_path):
    """Inside [optics], with the share that was given."""
    file = tmp_path / "alloy.toml"
    optics = f'[optics]\nreflectivity = {given}\nsource = "measured"\n'
    file.write_text(f'name = "alloy"\n{PROPERTIES}{optics}', encoding="utf-8")
    (problem,) = problems_of(file)
    assert f"reflectivity = {{ value = {given}, source =" in problem
    mended = optics.replace(f"reflectivity = {given}", LINE.search(problem)[1])
    file.write_text(f'name = "alloy"\n{PROPERTIES}{mended}', encoding="utf-8")
    assert float(load_material(str(file)).reflectivity_at(300.0)) == 0.62


@pytest.mark.parametrize("word", ["slope", "gradient", "temperature_coefficient"])
def test_slope_of_the_surface_tension_in_a_file(word, tmp_path):
    """One line, of the key that is meant, and of none that was not written."""
    file = tmp_path / "alloy.toml"
    tension = f'[surface_tension]\n{word} = "-0.4 mN/(m K)"\n'
    file.write_text(f'name = "alloy"\n{PROPERTIES}{tension}', encoding="utf-8")
    (problem,) = problems_of(file)
    head, values = re.search(r"write (\[\w+\]) with (.*)$", problem).groups()
    mended = f"{head}\n" + values.replace(", ", "\n")
    file.write_text(f'name = "alloy"\n{PROPERTIES}{mended}\n', encoding="utf-8")
    assert float(load_material(str(file)).surface_tension_slope_at(2000.0)) == -4e-4


def test_slope_of_the_surface_tension_in_a_case(tmp_path):
    """The short form, beside the base."""
    text = """\
schema_version = 2
material = { base = "steel-304", surface_tension = { slope = "-0.4 mN/(m K)" } }
[domain]
depth = "10 um"
[particles]
spacing = "1 um"
[solver]
dimensions = 1
[time]
end = "10 ns"
"""
    file = tmp_path / "case.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(CaseError) as error:
        load_case(file)
    (problem,) = error.value.problems
    assert problem.hint == 'write surface_tension_slope = "-0.4 mN/(m K)" in [material]'
    mended = text.replace(
        'surface_tension = { slope = "-0.4 mN/(m K)" }', 'surface_tension_slope = "-0.4 mN/(m K)"'
    )
    file.write_text(mended, encoding="utf-8")
    assert float(load_case(file).material.surface_tension_slope_at(2000.0)) == -4e-4


def test_key_of_another_kind_is_not_meant(tmp_path):
    """A key spelt alike is named only where the value could stand there."""
    file = tmp_path / "alloy.toml"
    text = PROPERTIES.replace('{ value = "20 W/(m K)"', '{ value = "20 W/(m K)", skale = "3 m"')
    file.write_text(f'name = "alloy"\n{text}', encoding="utf-8")
    (problem,) = problems_of(file)
    assert "scale" not in problem.partition("known here")[0].replace("skale", "")


def test_kind_that_was_given_as_text_is_shown(tmp_path):
    """A beam that is named only is shown as the table of that kind."""
    file = tmp_path / "case.toml"
    file.write_text('[laser]\nbeam = "gaussian"\n', encoding="utf-8")
    with pytest.raises(CaseError, match=r'write beam = \{ kind = "gaussian" \}'):
        load_case(file)
