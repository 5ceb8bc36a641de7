"""Material files: the shipped ones as published, the user's own, mistakes with their messages."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lasersph.input import CaseError
from lasersph.materials import (
    Material,
    available_materials,
    check_material,
    load_material,
)

MINIMAL = """
name = "toy"
[density]
value = "8000 kg/m^3"
source = "made up"
[heat_capacity]
value = "500 J/(kg K)"
source = "made up"
[conductivity]
value = "20 W/(m K)"
source = "made up"
"""


def test_shipped_materials() -> None:
    """Those of the papers and the metals that people texture, each under its own name."""
    assert list(available_materials()) == [
        "aluminium",
        "aluminium-aa6014",
        "aluminium-demuth",
        "copper",
        "gold",
        "inconel-718",
        "iron",
        "nickel",
        "silver",
        "steel-304",
        "steel-304-demuth",
        "steel-316l",
        "ti-6al-4v",
        "titanium",
        "tungsten",
    ]
    for name in available_materials():
        assert load_material(name).name == name


def test_aa6014_is_table_1() -> None:
    """AlShaer, Rogers & Li (2017), Table 1 and the parameters of eq. (5)."""
    m = load_material("aluminium-aa6014")
    assert (m.density_reference, float(m.heat_capacity_at(300))) == (2705.0, 896.0)
    assert (float(m.conductivity_at(300)), m.reference_temperature) == (167.0, 300.0)
    assert float(m.at("diffusivity", 300)) == pytest.approx(6.89e-5)
    assert m.diffusivity_reference == pytest.approx(6.89e-5, rel=1e-4)
    assert m.optics and m.vaporization and m.melting
    assert (m.optics.emissivity, m.optics.absorption_coefficient) == (0.09, 1.23e8)
    assert float(m.reflectivity_at(300.0)) == 0.75
    assert m.vaporization.specific_gas_constant == pytest.approx(308.17, abs=0.005)
    assert (m.vaporization.temperature, m.vaporization.latent_heat) == (2730.0, 10.53e6)
    assert (m.melting.solidus, m.melting.latent_heat) == (933.0, 397e3)


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("steel-304-demuth", (7262, 704, 5.24e-6, 26.8, 7.0e-3, 1.02e-6, 8.5e-5, -4.3e-4, 9.56e7)),
        (
            "aluminium-demuth",
            (2228, 1077, 5.75e-5, 139.5, 1.38e-3, 5.80e-7, 9.8e-5, -2.75e-4, 1.52e8),
        ),
    ],
)
def test_demuth_is_table_3(name: str, values: tuple[float, ...]) -> None:
    """Demuth & Lasagni (2020), Table 3, with the restored signs; conductivity is a rho c_p."""
    m = load_material(name)
    rho, c, a, printed, eta, nu, beta, slope, alpha = values
    T = 2000.0
    ours = [m.density_reference, float(m.heat_capacity_at(T)), float(m.at("diffusivity", T))]
    assert ours == pytest.approx([rho, c, a])
    assert float(m.conductivity_at(T)) == pytest.approx(a * rho * c, rel=1e-9)
    assert float(m.at("conductivity_printed", T)) == pytest.approx(printed)
    ours = [float(m.viscosity_at(T)), float(m.kinematic_viscosity_at(T))]
    assert ours == pytest.approx([eta, nu])
    assert float(m.at("expansion", T)) == pytest.approx(beta)
    assert float(m.surface_tension_slope_at(T)) == pytest.approx(slope)
    assert m.optics and m.optics.absorption_coefficient == alpha
    assert m.optics.wavelength == pytest.approx(355e-9)


def test_density_of_the_melt_follows_from_the_viscosities() -> None:
    """eta / nu of Table 3: 6863 and 2379 kg/m^3, not the average density."""
    assert load_material("steel-304-demuth").density_liquid == pytest.approx(6863, abs=0.5)
    assert load_material("aluminium-demuth").density_liquid == pytest.approx(2379, abs=0.5)
    assert load_material("aluminium").density_liquid == pytest.approx(2377.23)


def test_reflectivity_of_aluminum_is_equation_78() -> None:
    """0.929 at T_0, 0.676 below T_m, 0.65 from T_m on; as a table the same within 1 mK of T_m."""
    m = load_material("aluminium-demuth")
    expected = [1.048 - 3.989e-4 * 298.15, 1.048 - 3.989e-4 * 933.0, 0.65, 0.65]
    T = [298.15, 933.0, 933.35, 2792.0]
    np.testing.assert_allclose(m.reflectivity_at(T), expected, rtol=1e-12)
    nodes, values = m.table("reflectivity", 298.15, 2792.0)
    np.testing.assert_allclose(np.interp(T, nodes, values), expected, rtol=1e-7)
    assert np.all(np.diff(nodes) > 0.0)


@pytest.mark.parametrize(
    ("T", "density", "capacity", "conductivity"),
    [
        (300.0, 7.894, 0.1219, 0.1297),
        (1000.0, 7.603, 0.1444, 0.2429),
        (1600.0, 7.264, 0.1638, 0.34),
    ],
)
def test_steel_304_reproduces_the_tables_of_its_report(
    T: float, density: float, capacity: float, conductivity: float
) -> None:
    """Kim (1975), Tables 2, 7 and 10 for 304L: g/cm^3, cal/(g K), W/(cm K)."""
    m = load_material("steel-304")
    assert float(m.density_at(T)) == pytest.approx(density * 1e3, abs=0.6)
    assert float(m.heat_capacity_at(T)) == pytest.approx(capacity * 4184, abs=0.3)
    assert float(m.conductivity_at(T)) == pytest.approx(conductivity * 100, abs=0.011)


def test_aluminum_reference_correlations() -> None:
    """Assael et al. (2006) at the melting point; 24.2 J/(mol K) at 298.15 K (NIST-JANAF)."""
    m = load_material("aluminium")
    assert float(m.density.liquid_law.at(933.47)) == pytest.approx(2377.23)
    assert float(m.viscosity_at(1000.0)) == pytest.approx(1.178e-3, rel=1e-3)
    assert float(m.heat_capacity_at(298.15)) * 26.9815e-3 == pytest.approx(24.2, abs=0.05)
    assert float(m.surface_tension_at(1600.0)) == pytest.approx(1.05 - 2.75e-4 * 667.0)
    assert float(m.surface_tension_slope_at(1600.0)) == pytest.approx(-2.75e-4, rel=1e-6)


def test_missing_property_says_so() -> None:
    """A solver that asks for more than the file has gets a clear sentence."""
    with pytest.raises(ValueError, match="'aluminium-aa6014' has no viscosity"):
        load_material("aluminium-aa6014").viscosity_at(1000.0)


def test_own_file_by_path_and_by_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A path works at once, a name after LASERSPH_MATERIALS names the folder; edits are seen."""
    file = tmp_path / "toy.toml"
    file.write_text(MINIMAL)
    assert load_material(file).density_reference == 8000.0
    assert load_material(str(file)).name == "toy"
    with pytest.raises(CaseError, match="no material"):
        load_material("toy")
    monkeypatch.setenv("LASERSPH_MATERIALS", str(tmp_path))
    assert load_material("toy").name == "toy"
    assert "steel-304" in available_materials()
    file.write_text(MINIMAL.replace("8000", "18000"))
    assert load_material("toy").density_reference == 18000.0
    monkeypatch.setenv("LASERSPH_MATERIALS", str(tmp_path / "nowhere"))
    with pytest.raises(CaseError, match="names no folder"):
        available_materials()


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"8000 kg/m^3"', "8000", "has no unit"),
        ('"8000 kg/m^3"', '"8000 N/m"', "not a density"),
        ('"8000 kg/m^3"', '"-8000 kg/m^3"', "density must be positive"),
        ('source = "made up"\n[heat', "[heat", "needs its source"),
        ("[density]", "[densiti]", "densit"),
        ('name = "toy"', 'name = "toy"\ncolor = "red"', "color"),
        ("[density]", "[density]\nnote = 3", "note"),
        ('name = "toy"', 'name = ""', "name"),
    ],
)
def test_bad_files_are_refused(tmp_path: Path, old: str, new: str, words: str) -> None:
    """One clear CaseError for each mistake, with the name of the file."""
    assert old in MINIMAL
    file = tmp_path / "bad.toml"
    file.write_text(MINIMAL.replace(old, new, 1))
    with pytest.raises(CaseError, match=words) as caught:
        load_material(file)
    assert "bad.toml" in str(caught.value)


SECTIONS = (
    MINIMAL
    + """
[melting]
solidus = "1000 K"
liquidus = "1100 K"
latent_heat = "250 kJ/kg"
[melting.source]
solidus = "made up"
liquidus = "made up"
latent_heat = "made up"
[vaporization]
temperature = "3000 K"
latent_heat = "6 MJ/kg"
source = "made up"
"""
)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"1100 K"', '"900 K"', "above the liquidus"),
        ('"3000 K"', '"1050 K"', "must lie above the liquidus"),
        ('latent_heat = "made up"', "", "no source for latent_heat"),
        ('latent_heat = "made up"', 'latent_heat = "x"\ncolor = "x"', "color"),
        ('"6 MJ/kg"', '"6 MJ/kg"\ncritical_temperature = "2500 K"', "critical temperature must"),
    ],
)
def test_bad_sections_are_refused(tmp_path: Path, old: str, new: str, words: str) -> None:
    """Orders of temperatures and sources of single numbers."""
    file = tmp_path / "bad.toml"
    assert old in SECTIONS
    file.write_text(SECTIONS.replace(old, new, 1))
    with pytest.raises(CaseError, match=words):
        load_material(file)


def test_unknown_name_suggests_the_nearest() -> None:
    """A slip in the name is answered with the right one."""
    with pytest.raises(CaseError, match='do you mean "steel-304"'):
        load_material("stel-304")


def test_missing_file_is_named() -> None:
    """A path that does not exist is a CaseError, not a traceback."""
    with pytest.raises(CaseError, match="no such file"):
        load_material("nowhere/alloy.toml")


@pytest.mark.parametrize("name", available_materials())
def test_shipped_materials_pass_their_check(name: str) -> None:
    """No warnings; every source is told; units of the figures come from the file."""
    material = load_material(name)
    findings = check_material(material)
    assert not [str(f) for f in findings if f.level == "warning"]
    for property_ in material.properties().values():
        assert all(law.source for law in property_.laws().values())


METALS = {  # melting point [K], kJ/kg to melt, k cold and of the melt [W/(m K)], R at 1064 nm
    "copper": (1357.77, 673, 401, 150.5, 0.973),
    "silver": (1234.93, 349, 429, 174.9, 0.997),
    "gold": (1337.33, 212, 317, 104.5, 0.979),
    "nickel": (1728.0, 1100, 90.7, 54.2, 0.779),
    "iron": (1811.0, 1303, 80.2, 36.4, 0.626),
    "titanium": (1941.0, 1452, 21.9, 34.0, 0.615),
    "tungsten": (3695.0, 926, 174, 66.6, 0.602),
}
"""Enthalpies from 298.15 K on: the polynomials of NASA TP-3287 (copper, nickel, iron; titanium with
this latent heat), the table of JANAF with 52.3 kJ/mol (tungsten), CODATA (silver), Pankratz 1982
(gold); cold conductivities: Ho, Powell & Liley 1972."""


@pytest.mark.parametrize("name", METALS)
def test_metals_hold_what_handbooks_say(name: str) -> None:
    """Heat to melt within 2 %, k cold within 3.5 % and of the melt 1 %, reflectivity 0.001."""
    m = load_material(name)
    melting, heat, cold, molten, R = METALS[name]
    curve = m.caloric_curve(298.15)
    assert m.liquidus == melting
    assert float(curve.enthalpy_at(melting + 0.01)) / 1e3 == pytest.approx(heat, rel=0.02)
    assert float(m.conductivity_at(300.0)) == pytest.approx(cold, rel=0.035)
    assert float(m.conductivity_at(melting)) == pytest.approx(molten, rel=0.01)
    light = m.in_light(1064e-9)
    assert float(light.reflectivity_at(300.0)) == pytest.approx(R, abs=0.001)
    assert m.optics and m.optics.wavelengths() == pytest.approx([1064e-9, 532e-9, 355e-9])


def test_numbers_from_memory_are_counted() -> None:
    """`check` says of how many sources nobody has compared the text."""
    found = {
        name: [f.text for f in check_material(load_material(name)) if f.subject == "sources"]
        for name in ("steel-304", "titanium")
    }
    assert found["steel-304"][0].startswith("1 marked [M]")  # the lattice's share of k
    assert found["titanium"][0].startswith("3 marked [M]")


def test_check_says_where_ranges_end_and_what_is_missing() -> None:
    """Aluminum's liquid density is sourced to 1190 K; AA6014 has no viscosity."""
    texts = [str(f) for f in check_material(load_material("aluminium"))]
    assert any("density.liquid" in text and "above 1190 K" in text for text in texts)
    texts = [str(f) for f in check_material(load_material("aluminium-aa6014"))]
    assert any(text.startswith("note: viscosity: not given") for text in texts)
    metal = load_material("aluminium")
    boiling = metal.vaporization.model_copy(update={"critical_temperature": None})
    found = check_material(metal.model_copy(update={"vaporization": boiling}))
    (note,) = (str(one) for one in found if one.subject == "critical_temperature")
    assert note.startswith("note: critical_temperature: not given; needed for vapor that leaves")


def test_check_warns_of_implausible_numbers() -> None:
    """A wrong printed diffusivity and a latent heat ten times too large are warnings."""
    material = load_material("steel-304-demuth")
    data = material.model_dump(exclude_none=True)
    data["diffusivity"]["value"] = 9.9e-6
    data["melting"]["latent_heat"] = 2.51e6
    subjects = {f.subject for f in check_material(Material(**data)) if f.level == "warning"}
    assert subjects == {"diffusivity", "melting.latent_heat"}


def box_liquid(**more):
    """A liquid without melting point, as written into the case of a box."""
    numbers = {"density": 2.0, "heat_capacity": 1.0, "conductivity": 1.0} | more
    laws = {name: {"value": value, "source": "here"} for name, value in numbers.items()}
    return Material.model_validate({"name": "liquid"} | laws)


def test_liquid_everywhere():
    """Without melting data the reference temperature stands for the liquidus; nu = eta / rho."""
    thick = box_liquid(viscosity=3.0)
    assert thick.is_liquid and thick.flow_temperature == 298.15
    assert thick.density_liquid == 2.0
    assert float(thick.kinematic_viscosity_at(400.0)) == 1.5
    thin = box_liquid(kinematic_viscosity=0.5)
    assert thin.is_liquid and thin.density_liquid == 2.0
    assert float(thin.viscosity_at(400.0)) == 1.0
    assert thin.expansion_at(np.array([300.0, 400.0])).tolist() == [0.0, 0.0]
    assert float(box_liquid(viscosity=3.0, expansion=0.1).expansion_at(300.0)) == 0.1


def test_a_liquid_without_boiling_point_changes_no_phase():
    """Its curve is a straight line under every plateau rule."""
    curve = box_liquid(viscosity=3.0).caloric_curve(300.0, "hold")
    assert curve.temperature_at(5.0) == 305.0
    assert not curve.melt_fraction.any() and not curve.vapor_fraction.any()


def test_a_solid_without_melting_point_does_not_flow():
    """Neither melting point nor viscosity: there is no liquid."""
    solid = box_liquid()
    assert not solid.is_liquid
    with pytest.raises(ValueError, match="has no melting point"):
        _ = solid.density_liquid
