"""What holds at the boiling point where a case does not say."""

import json

import pytest

from lasersph.case import Case, load_case

MOVING = ("solver.vaporization=", "solver.flow.surface=moving")


@pytest.mark.parametrize("name", ["texture-steel", "texture-aluminium"])
def test_vapor_leaves_a_pool_whose_surface_moves(name):
    """And `resolved.json` says so, which read again is the same case."""
    case = load_case(name, MOVING)
    assert case.solver.has_vapor_flux
    assert case.resolved()["solver"]["vaporization"] == "flux"
    again = Case.model_validate(json.loads(case.model_dump_json()))
    assert again.hash() == case.hash() == load_case(name).hash()


@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("texture-steel", (*MOVING, "solver.flow=")),
        ("texture-steel", (*MOVING, "solver.flow.surface=flat")),
        ("texture-steel", (*MOVING, "solver.plateau=hold")),
        ("texture-steel", (*MOVING, "solver.vaporization=plateau")),
        ("texture-steel", (*MOVING, "solver.kind=conduction", "solver.flow=")),
        ("moving-film", ()),
        ("dlip-steel", ()),
        ("dlip-steel", ("solver.plateau=",)),
    ],
)
def test_the_plateau_stays_elsewhere(name, settings):
    """Without a surface that moves, where a case asks for it, and in a box that is all fluid."""
    case = load_case(name, settings)
    assert not case.solver.has_vapor_flux
    assert case.resolved()["solver"]["vaporization"] == "plateau"


def test_a_case_without_a_solver_table():
    """Its solver is conduction, with the plateau."""
    data = load_case("pulsed-heating").resolved()
    del data["solver"]
    assert Case.model_validate(data).resolved()["solver"]["vaporization"] == "plateau"


@pytest.mark.parametrize("missing", ["molar_mass", "critical_temperature", None])
def test_a_metal_without_what_a_flux_needs(missing):
    """It keeps the plateau, as does one without a boiling point."""
    data = load_case("texture-steel").resolved()
    data["solver"]["vaporization"] = None
    del data["solver"]["plateau"]
    vapor = data["material"]["vaporization"]
    if missing is None:
        data["material"]["vaporization"] = None
    else:
        vapor["source"].pop(missing, "")
        vapor[missing] = None
    assert not Case.model_validate(data).solver.has_vapor_flux


@pytest.mark.parametrize(
    ("missing", "asked"),
    [
        (None, ("temperature", "latent_heat", "molar_mass", "critical_temperature")),
        ("critical_temperature", ("critical_temperature",)),
    ],
)
def test_a_flux_asks_for_all_that_a_metal_lacks(missing, asked):
    """In one line, so that nobody is refused twice."""
    data = load_case("texture-steel").resolved()
    vapor = data["material"]["vaporization"]
    if missing is None:
        data["material"]["vaporization"] = None
    else:
        vapor["source"].pop(missing, "")
        vapor[missing] = None
    with pytest.raises(ValueError, match="lacks; write there") as refused:
        Case.model_validate(data)
    said = str(refused.value)
    wanted = ("temperature", "latent_heat", "molar_mass", "critical_temperature")
    assert [name for name in wanted if f" {name} = " in said] == list(asked)
