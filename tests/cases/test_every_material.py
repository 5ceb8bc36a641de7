"""Every shipped metal, and metals with less data, with every solver: built, stepped, observed."""

import pytest

from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.materials import available_materials
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


def case_of(folder, material, solver):
    """A small block of the material under one pulse; plain keys go before the first table."""
    text = CASE.format(material="@", solver=solver, settings=SETTINGS[solver])
    given = MATERIALS[material]
    text = text.replace("@", given) if "[" not in given else text.replace("@", "") + given
    file = folder / "case.toml"
    file.write_text(text, encoding="utf-8")
    return load_case(file)


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
