"""Standard uncertainties of materials: read in percent or in a unit, refused in one line."""

import pytest

from lasersph.input import CaseError
from lasersph.materials import load_material

METAL = """name = "metal"
density = { value = "2000 kg/m^3", source = "x"%s }
conductivity = { value = "100 W/(m K)", source = "x" }
[heat_capacity]
polynomial = [1000.0, 0.1]
scale = "1 J/(kg K)"
source = "x"%s
[melting]
solidus = "1000 K"
latent_heat = "400 kJ/kg"
source = "x"
%s
"""


def read(tmp_path, density="", capacity="", melting=""):
    """The metal with lines added to its density, its heat capacity and its melting."""
    file = tmp_path / "metal.toml"
    file.write_text(METAL % (density, capacity, melting))
    return load_material(file)


def given(text, source="y"):
    """An uncertainty as an inline table."""
    return f'{{ standard = "{text}", source = "{source}" }}'


def test_percent_and_unit(tmp_path):
    """2 % stays 2 %; 20 of 2000 kg/m^3 are 1 %, 5 K of 1000 K are 0.5 %; who says so is kept."""
    metal = read(
        tmp_path,
        density=f", uncertainty = {given('20 kg/m^3', 'weighed')}",
        capacity=f"\nuncertainty = {given('2 %')}",
        melting=f"uncertainty = {{ solidus = {given('5 K')} }}",
    )
    assert metal.uncertainties() == {
        "density": (pytest.approx(0.01), "weighed"),
        "heat_capacity": (pytest.approx(0.02), "y"),
        "melting.solidus": (pytest.approx(0.005), "y"),
    }
    assert metal.conductivity.relative_uncertainty is None
    # no run depends on them: the content by which cases are told apart is the same
    assert metal.model_dump_json() == read(tmp_path).model_dump_json()


@pytest.mark.parametrize(
    ("place", "text", "line", "words"),
    [
        ("density", "20 K", 2, '"20 K" is a temperature, not a density'),
        ("density", "120 %", 2, '"120 %" must lie above 0 and below the value; write e.g. "2 %"'),
        ("density", "-1 %", 2, '"-1 %" must lie above 0'),
        ("density", "much", 2, '"much" does not start with a number'),
        ("capacity", "20 J/(kg K)", 8, "stands beside a law; write it in percent"),
    ],
)
def test_bad_values_are_refused_in_one_line(tmp_path, place, text, line, words):
    """File, line, key, what is wrong, what would be right."""
    before = ", " if place == "density" else "\n"
    with pytest.raises(CaseError) as caught:
        read(tmp_path, **{place: f"{before}uncertainty = {given(text)}"})
    said = str(caught.value)
    assert f"metal.toml:{line}: " in said
    assert "uncertainty.standard: " in said
    assert words in said
    assert "\n" not in said


def test_uncertainty_of_what_is_not_given(tmp_path):
    """A section's uncertainty belongs to a number that is there; a source is asked for."""
    with pytest.raises(CaseError, match=r"melting\.uncertainty\.boiling: is not given here"):
        read(tmp_path, melting=f"uncertainty = {{ boiling = {given('5 K')} }}")
    with pytest.raises(CaseError, match=r"density\.uncertainty\.source: missing"):
        read(tmp_path, density=', uncertainty = { standard = "2 %" }')


def test_two_laws_have_two_uncertainties(tmp_path):
    """An uncertainty beside the tables solid and liquid says of neither what it means."""
    laws = ", ".join(f'{phase} = {{ value = "1 kg/m^3", source = "x" }}' for phase in PHASES)
    text = METAL.replace('value = "2000 kg/m^3", source = "x"%s', f"{laws}%s")
    file = tmp_path / "metal.toml"
    file.write_text(text % (f", uncertainty = {given('2 %')}", "", ""))
    with pytest.raises(CaseError, match="write it into the tables solid and liquid"):
        load_material(file)


PHASES = ("solid", "liquid")


def test_scaled_laws(tmp_path):
    """A table, a formula and both phases grow by the same factor at every temperature."""
    metal = load_material("aluminium")
    for name in ("density", "heat_capacity", "viscosity"):
        property_ = getattr(metal, name)
        for T in (300.0, 700.0, 1000.0):
            both = property_.scaled(1.1).at(T, 900.0, 950.0), property_.at(T, 900.0, 950.0)
            assert both[0] == pytest.approx(1.1 * both[1], rel=1e-14)


def test_aluminium_states_those_of_its_sources():
    """Half of the 0.7 % and 13.7 % of Assael et al. 2006, which hold 95 %."""
    stated = load_material("aluminium").uncertainties()
    assert stated["density.liquid"][0] == pytest.approx(0.007 / 2)
    assert stated["viscosity"][0] == pytest.approx(0.137 / 2)
    assert all("divided by" in source for _, source in stated.values())
    assert load_material("steel-304").uncertainties() == {}
