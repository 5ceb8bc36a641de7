"""Every shipped metal, and metals with less data, with every solver: built, stepped, observed."""

import pytest

from lasersph.case import load_case
from lasersph.cli import main
from lasersph.input import CaseError
from lasersph.materials import available_materials, load_material
from lasersph.simulation import forecast, run

CASE = """
{material}
initial_temperature = "300 K"

[laser]
fluence = "1 J/cm^2"
beam = {{ kind = "uniform" }}
pulse = {{ kind = "square", duration = "10 ns" }}
absorption = {{ kind = "surface" }}

[domain]
depth = "3 um"
width = "2 um"

[particles]
spacing = "0.2 um"

[boundaries]
sides = "periodic"

[time]
end = "0.1 ns"
step = "0.05 ns"

[output.snapshots]
interval = "0.1 ns"

[solver]
kind = "{solver}"
{settings}
"""
SETTINGS = {
    "conduction": "",
    "melt-pool": "",
    "ablation": 'sound_speed = "1000 m/s"\ndimensions = 2',
}
PLAIN = """
[material]
name = "plain"
density = "8000 kg/m^3"
heat_capacity = "500 J/(kg K)"
conductivity = "30 W/(m K)"
viscosity = "5 mPa s"
surface_tension_slope = "-0.4 mN/(m K)"
melting = { solidus = "1650 K", liquidus = "1700 K", latent_heat = "250 kJ/kg" }
optics = { reflectivity = 0.6 }
"""
BOILING = 'vaporization = { temperature = "3000 K", latent_heat = "6.5 MJ/kg" }\n'
MATERIALS = {name: f'material = "{name}"' for name in available_materials()} | {
    "no-boiling-point": PLAIN,
    "no-molar-mass": PLAIN + BOILING,
}


def case_of(folder, material, solver, settings=()):
    """A small block of the material under one pulse; plain keys go before the first table."""
    text = CASE.format(material="@", solver=solver, settings=SETTINGS[solver])
    given = MATERIALS[material]
    text = text.replace("@", given) if "[" not in given else text.replace("@", "") + given
    file = folder / "case.toml"
    file.write_text(text, encoding="utf-8")
    has_choice = "[" not in given and load_material(material).optics.by_wavelength
    return load_case(file, [*settings, *(["laser.wavelength=1064 nm"] if has_choice else [])])


REFUSED = {
    ("aluminium-aa6014", "melt-pool"): "no viscosity",
    ("no-boiling-point", "ablation"): "molar_mass",
    ("no-molar-mass", "ablation"): "molar_mass",
}
"""What a material lacks for a solver that cannot do without."""


@pytest.mark.parametrize("solver", SETTINGS)
@pytest.mark.parametrize("material", MATERIALS)
def test_runs(material, solver, tmp_path):
    """The first steps are computed and observed, or the case is refused before it runs."""
    if (material, solver) in REFUSED:
        with pytest.raises(CaseError, match=REFUSED[material, solver]):
            case_of(tmp_path, material, solver)
        return
    case = case_of(tmp_path, material, solver)
    warned = [text for text in forecast(case).warnings if "no boiling point" in text]
    assert len(warned) == (material == "no-boiling-point")
    summary = run(case, tmp_path / "run", threads=1).summary
    assert summary["steps"] >= 2 and summary["energy"]["absorbed_J"] > 0.0


@pytest.mark.parametrize("solver", SETTINGS)
def test_the_metals_emissivity_radiates_in_every_solver(solver, tmp_path):
    """Heat is lost where the metal has an emissivity, unless the boundary says otherwise."""
    settings = ["material.optics.emissivity=0.8"]
    case = case_of(tmp_path, "steel-304", solver, settings)
    assert run(case, tmp_path / "run", threads=1).summary["energy"]["lost_J"] > 0.0
    dark = case_of(tmp_path, "steel-304", solver, [*settings, "boundaries.emissivity=0"])
    assert run(dark, tmp_path / "dark", threads=1).summary["energy"]["lost_J"] == 0.0


def test_who_says_the_emissivity(tmp_path):
    """The metal's, overridden by the boundary; faces of given temperature and periods have none."""

    def emissivity(*settings):
        case = load_case("stefan", ["boundaries.bottom_temperature=", *settings])
        return case.boundaries.emissivity_of(case.material)

    free = ("boundaries.surface=free", "boundaries.surface_temperature=")
    assert emissivity() == 0.0
    assert emissivity(*free) == 0.09
    assert emissivity(*free, "boundaries.emissivity=0.5") == 0.5
    assert emissivity("boundaries.emissivity=0.5") == 0.5
    assert emissivity(*free, "material=steel-304", "initial_temperature=300 K") == 0.0


def test_check_says_who_gives_the_emissivity(capsys):
    """A row of `check`, where the surface loses heat."""
    assert main(["check", "ablation-depth"]) == 0
    assert "surface loses heat" not in capsys.readouterr().out
    assert main(["check", "ablation-depth", "--set", "boundaries.emissivity="]) == 0
    assert "radiation, emissivity 0.09 of aluminium-aa6014; to 300 K" in capsys.readouterr().out
