"""Cases: overrides, materials by name, path and change, content as data, new files."""

import json
import math
import re

import pytest

from lasersph.case import (
    Case,
    available_cases,
    case_file,
    estimate_count,
    load_case,
    write_new_case,
)
from lasersph.case import size as size_module
from lasersph.case.checks import refuse_if_too_large
from lasersph.case.quick import expected_crater, quick_settings, what_is_not_shown
from lasersph.case.size import in_words
from lasersph.compute import cuda_device
from lasersph.input import CaseError, parse_quantity
from lasersph.input.document import split_settings
from lasersph.materials import material_file


def test_overrides_are_toml_or_text():
    """TOML where it is TOML, text where not; the later one wins; an empty value removes."""
    case = load_case(
        "dlip-steel",
        [
            "laser.fluence=0.8 J/cm^2",
            "particles.spacing=16nm",
            'particles.spacing="32 nm"',
            "solver.kind=conduction",
            "solver.phase_change=false",
            "laser.pulse.count=1",
            "probes[2].x=1um",
            "time.step=",
            "title=a = b",
        ],
    )
    assert case.laser is not None and case.laser.fluence == 8000
    assert case.particles.spacing == 3.2e-8
    assert case.solver.phase_change is False
    assert case.probes[1].x == 1e-6
    assert case.time.step is None
    assert case.title == "a = b"
    assert case.text.startswith("# --set laser.fluence=0.8 J/cm^2\n")
    assert case.text.endswith(case_file("dlip-steel").read_text(encoding="utf-8"))


BAD_OVERRIDES = [
    (
        "laser.fluense=1",
        '--set laser.fluense=1: laser.fluense: unknown key; do you mean "fluence"?',
    ),
    ("fluence=1", '--set fluence=1: fluence: unknown key; do you mean "laser.fluence"?'),
    (
        "laser.fluence=3 N/m",
        '--set laser.fluence=3 N/m: laser.fluence: "3 N/m" is a surface tension',
    ),
    ("laser.fluence=3", "--set laser.fluence=3: laser.fluence: 3 has no unit"),
    ("laser.fluence=nan", "--set laser.fluence=nan: laser.fluence: nan is not a finite number"),
    ("laser.fluenc=3", "--set laser.fluenc=3: laser.fluence: 3 has no unit"),
    ("laser.pulse.center=1ns", "--set laser.pulse.center=1ns on {file}:18: laser.pulse: a pulse"),
    ("material=gold", "--set material=gold on {file}:11: laser.wavelength: material 'gold' has"),
    ("spacing", "--set spacing: is not key=value"),
    ("=3", "--set =3: is not key=value"),
    ("a b=3", '--set a b=3: "a b" is no key'),
    ("title.x=3", '--set title.x=3: "title" is not a table'),
    ("probes[7].depth=1um", "--set probes[7].depth=1um: there is no element 7, only 2"),
    ("probes[0].depth=1um", '--set probes[0].depth=1um: "probes[0]" counts from 1'),
    ("laser[1].fluence=1um", "--set laser[1].fluence=1um: there is no element 1, only 0"),
    ("x=" + "[" * 5000, "--set x=["),
]


@pytest.mark.parametrize(("setting", "message"), BAD_OVERRIDES)
def test_bad_overrides_name_themselves(setting, message):
    """A wrong override is refused with the override as its place, also where the line that does not
    fit it is one of the file, and where its value would go elsewhere."""
    file = case_file("dlip-steel")
    with pytest.raises(CaseError) as error:
        load_case(file, [setting])
    lines = str(error.value).splitlines()
    assert any(line.startswith(message.replace("{file}", str(file))) for line in lines), lines
    assert not any(line.startswith(str(file)) for line in lines)


def test_a_file_that_is_wrong_by_itself_is_blamed_itself(tmp_path):
    """Of a file with a mistake, what is wrong at its lines is not blamed on a setting."""
    file = tmp_path / "case.toml"
    text = case_file("dlip-steel").read_text(encoding="utf-8")
    file.write_text(text.replace('center = "50 ns"', 'center = "1 ns"'), encoding="utf-8")
    with pytest.raises(CaseError) as error:
        load_case(file, ["laser.fluence=0.8 J/cm^2"])
    assert str(error.value).startswith(f"{file}:18: laser.pulse: ")


def test_a_misspelt_table_of_an_override_is_all_that_is_said():
    """The keys that the file gives in the right table are not missed."""
    with pytest.raises(CaseError) as error:
        load_case("dlip-steel", ["laser.puls.fwhm=8ns"])
    (line,) = str(error.value).splitlines()
    assert line.startswith(
        '--set laser.puls.fwhm=8ns: laser.puls: unknown key; do you mean "pulse"?'
    )


def test_an_override_sets_one_key_only():
    """A line break in a value does not smuggle in a second key."""
    assert load_case("dlip-steel", ["title=1\nsolver.dimensions = 3"]).solver.dimensions == 2


def test_material_relative_to_the_case_file(tmp_path):
    """A path in the file counts from the file, on the command line from the working folder."""
    text = material_file("steel-304").read_text(encoding="utf-8")
    (tmp_path / "own.toml").write_text(text.replace('"steel-304"', '"own"'), encoding="utf-8")
    case_text = case_file("dlip-steel").read_text(encoding="utf-8")
    file = tmp_path / "case.toml"
    file.write_text(case_text.replace('"steel-304-demuth"', '"own.toml"'), encoding="utf-8")
    assert load_case(file).material.name == "own"


def test_material_on_the_command_line_is_relative_to_the_working_folder(tmp_path, monkeypatch):
    """--set material=own.toml finds the file where the command runs."""
    text = material_file("steel-304").read_text(encoding="utf-8")
    (tmp_path / "own.toml").write_text(text.replace('"steel-304"', '"own"'), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert load_case("dlip-steel", ["material=own.toml"]).material.name == "own"


def test_changed_material():
    """A property replaces the base's law, a section keeps the other numbers; sources are kept."""
    base = load_case("dlip-steel").material
    case = load_case(
        "dlip-steel",
        ["material.conductivity=20 W/(m K)", "material.melting.solidus=1600 K"],
    )
    material = case.material
    assert float(material.conductivity_at(300.0)) == 20.0
    assert material.conductivity.source == "set in the case"
    assert material.melting is not None and base.melting is not None
    assert material.melting.solidus == 1600.0
    assert material.melting.liquidus == base.melting.liquidus
    assert material.melting.source_of("solidus") == "set in the case"
    assert material.melting.source_of("liquidus") == base.melting.source_of("liquidus")
    assert "conductivity, melting" in material.note
    assert case.hash() != load_case("dlip-steel").hash()


@pytest.mark.parametrize(
    ("metal", "key", "value", "density"),
    [
        ("steel-304", "kinematic_viscosity", "2e-6 m^2/s", 6900.0),
        ("steel-304-demuth", "kinematic_viscosity", "2e-6 m^2/s", 6863.0),
        ("aluminium-demuth", "viscosity", "4 mPa s", 2379.0),
    ],
)
def test_a_viscosity_that_is_set_replaces_both_of_its_base(metal, key, value, density):
    """The melt flows with it, with the density that it had; both twice as large keep it, too."""
    settings = (f"material={metal}", f"material.{key}={value}")
    base = load_case("dlip-steel", settings[:1]).material
    material = load_case("dlip-steel", settings).material
    assert base.density_liquid == pytest.approx(density, rel=5e-3)
    assert material.density_liquid == base.density_liquid
    assert material.density_reference == base.density_reference
    T = material.flow_temperature
    kinematic, dynamic = material.kinematic_viscosity_at(T), material.viscosity_at(T)
    assert float(dynamic) == pytest.approx(float(kinematic) * base.density_liquid)
    one = kinematic if key == "kinematic_viscosity" else dynamic
    assert float(one) == parse_quantity(value, key)


def test_a_diffusivity_that_is_set_replaces_the_conductivity_of_its_base():
    """k = D rho c_p of constants; where they are none, or with a conductivity, it is refused."""
    material = load_case("dlip-steel", ["material.diffusivity=1e-5 m^2/s"]).material
    assert float(material.conductivity_at(300.0)) == pytest.approx(1e-5 * 7262.0 * 704.0)
    for more in ("material=steel-304", "material.conductivity=20 W/(m K)"):
        with pytest.raises(CaseError, match="diffusivity: says nothing"):
            load_case("dlip-steel", [more, "material.diffusivity=1e-5 m^2/s"])


def test_changed_number_loses_the_uncertainty_of_its_base():
    """An uncertainty of 6700 K says nothing about 7000 K; a case may state its own."""
    kept = load_case("dlip-aluminium", ["material.vaporization.temperature=2800 K"]).material
    assert "vaporization.critical_temperature" in kept.uncertainties()
    key = "material.vaporization.critical_temperature"
    assert load_case("dlip-aluminium", [f"{key}=7000 K"]).material.uncertainties() == {}
    stated = '{standard = "3 %", source = "x"}'
    own = load_case("dlip-aluminium", [f"material.melting.uncertainty.latent_heat={stated}"])
    assert own.material.uncertainties()["melting.latent_heat"] == (0.03, "x")


def test_changed_material_with_laws_and_optics():
    """Laws for solid and liquid, tables and reflectivity may be changed as well."""
    case = load_case(
        "dlip-steel",
        [
            'material = { base = "steel-304", optics = { reflectivity = 0.5 }, '
            'conductivity = { solid = "20 W/(m K)", liquid = "30 W/(m K)" } }'
        ],
    )
    assert float(case.material.conductivity_at(2000.0)) == 30.0
    assert float(case.material.reflectivity_at(300.0)) == 0.5
    with pytest.raises(CaseError, match="base must be the name"):
        load_case("dlip-steel", ["material={base=3}"])


def test_resolved_is_plain_json_in_si():
    """All defaults, SI, no objects."""
    resolved = load_case("dlip-steel").resolved()
    assert json.loads(json.dumps(resolved)) == resolved
    assert resolved["particles"]["spacing"] == 8e-9
    assert resolved["solver"]["tolerance"] == 1e-8
    assert resolved["schema_version"] == 2


def test_hash_depends_on_content_only():
    """Spelling, order and comments do not matter; values do."""
    same = load_case("dlip-steel", ["laser.fluence=6000 J/m2"])
    assert same.hash() == load_case("dlip-steel").hash()
    assert load_case("dlip-steel", ["time.end=201ns"]).hash() != same.hash()


def test_python_built_case():
    """From Python numbers are SI, and the rooms' models are the arguments."""
    case = Case.model_validate(
        {
            "material": "aluminium-demuth",
            "domain": {"depth": 1e-6},
            "particles": {"spacing": 1e-8},
            "solver": {"dimensions": 1},
            "time": {"end": 1e-8},
        }
    )
    assert case.material.name == "aluminium-demuth"
    assert case.name == "case"
    assert case.text.startswith("#")


def test_json_schema_is_complete():
    """The schema names every table, and its quantities ask for text."""
    schema = Case.model_json_schema()
    assert set(schema["properties"]) >= {"material", "laser", "domain", "particles", "time"}
    assert schema["$defs"]["Laser"]["properties"]["fluence"]["anyOf"][0]["x-kind"] == "fluence"
    assert "material" in schema["required"]


@pytest.mark.parametrize("name", available_cases())
def test_new_case_is_the_commented_text(name, tmp_path):
    """The written file loads as the same case and keeps its comments."""
    file = write_new_case(name, tmp_path / "mine.toml")
    text = file.read_text(encoding="utf-8")
    assert "#" in text
    assert load_case(file).hash() == load_case(name).hash()
    if load_case(name).laser is not None:
        light = text.partition("[laser]")[2].partition("\n[")[0]
        assert 'fluence = "' in light or 'power = "' in light
    with pytest.raises(CaseError, match="exists already"):
        write_new_case(name, file)


def test_new_case_in_a_folder_that_is_missing(tmp_path):
    """The reason is said."""
    with pytest.raises(CaseError, match=r"there is no folder .*none; make it first"):
        write_new_case("stefan", tmp_path / "none" / "mine.toml")


def test_names_of_cases():
    """The nearest shipped name is offered; a path is a path."""
    with pytest.raises(CaseError, match='no case "dlip-stele"; do you mean "dlip-steel"'):
        load_case("dlip-stele")
    with pytest.raises(CaseError, match=r"mine\.toml: no such file"):
        load_case("mine.toml")
    with pytest.raises(CaseError):
        load_case("a\0b")


@pytest.mark.parametrize("name", available_cases())
def test_quick_is_four_times_coarser(name):
    """Spacing times 4 but 10 cells at least and finer than a crater, steps times 2 (implicit),
    unless an override says otherwise."""
    usual, quick = load_case(name), load_case(name, quick=True)
    sides = [high - low for low, high in usual.domain.lateral(usual.geometry)]
    coarser = min(4 * usual.particles.spacing, min([usual.domain.depth, *sides]) / 10)
    crater = expected_crater(usual)
    assert math.isclose(quick.particles.spacing, min(coarser, crater / 1.25) if crater else coarser)
    scheme = getattr(usual.solver, "scheme", "implicit")
    is_explicit = usual.solver.kind == "ablation" or scheme == "explicit"
    if usual.time.step is not None and not is_explicit:
        assert quick.time.step == 2 * usual.time.step
    spacing = 0.5 * usual.particles.spacing
    chosen = load_case(name, [f"particles.spacing={spacing} m"], quick=True)
    assert chosen.particles.spacing == spacing


@pytest.mark.parametrize("name", ["ablation-aluminium", "ablation-depth"])
def test_quick_shows_the_crater(name):
    """0.55 um deep by the balance of energy; particles of 0.8 um leave a crater of 0 m."""
    quick = load_case(name, quick=True)
    assert expected_crater(quick) == pytest.approx(0.55e-6, rel=0.01)
    assert quick.particles.spacing < 0.45e-6
    assert what_is_not_shown(quick) == ""
    coarse = load_case(name, ["particles.spacing=0.8 um"], quick=True)
    assert what_is_not_shown(coarse) == (
        "the crater of a pulse is expected to be 550 nm deep, less than a particle of 800 nm: it "
        "is not shown; take a finer spacing"
    )
    assert what_is_not_shown(load_case("dlip-steel")) == ""


def test_quick_keeps_ten_cells():
    """A coarse case does not become a handful of particles, and stays valid."""
    case = load_case("stefan", ["domain.depth=1.2um"], quick=True)
    assert math.isclose(case.particles.spacing, 1.2e-7)
    moving = ["domain.width=8um", "laser.beam.period=8um", "particles.spacing=100nm"]
    coarse = quick_settings(load_case("texture-steel", moving))
    assert load_case("texture-steel", [*moving, *coarse]).particles.spacing > 300e-9
    graded = load_case("dlip-steel", ["particles.coarsest=20nm", "particles.fine_depth=10nm"])
    assert [setting.partition("=")[0] for setting in quick_settings(graded)] == [
        "particles.spacing",
        "particles.coarsest",
        "particles.fine_depth",
        "time.step",
    ]


def test_size_by_hand():
    """1-D: depth / spacing; 2-D uniform: times width / spacing; graded less than uniform."""
    case = load_case("stefan")
    assert math.isclose(estimate_count(case.domain, case.particles, case.geometry), 200)
    graded = load_case("dlip-steel")
    uniform = load_case("dlip-steel", ["particles.arrangement=uniform", "particles.ratio="])
    few = estimate_count(graded.domain, graded.particles, graded.geometry)
    many = estimate_count(uniform.domain, uniform.particles, uniform.geometry)
    assert math.isclose(many, 4.6e-6 / 8e-9 * 2.5e-6 / 8e-9)
    assert few < 0.2 * many
    assert in_words(1536 * 2**20) == "1.5 GiB"


def test_case_larger_than_the_machine_is_refused(monkeypatch):
    """With the estimate and the memory of the machine, before anything is allocated."""
    monkeypatch.setattr(size_module, "machine_memory", lambda: 2.0**20)
    with pytest.raises(CaseError, match=r"particles, .* MiB of memory, but this machine has 1 MiB"):
        refuse_if_too_large(load_case("dlip-steel"))
    monkeypatch.setattr(size_module, "machine_memory", lambda: math.inf)
    refuse_if_too_large(load_case("dlip-steel"))


def test_case_larger_than_the_graphics_card_is_refused(monkeypatch):
    """Where a card is to compute, with what it has left; the machine's memory counts too."""
    case = load_case("dlip-steel")
    monkeypatch.setattr(size_module, "machine_memory", lambda: 2.0**60)
    monkeypatch.setattr(cuda_device, "free_memory", lambda: 2.0**20)
    with pytest.raises(CaseError, match=r"of memory, but the graphics card has 1 MiB free"):
        refuse_if_too_large(case, "cuda")
    refuse_if_too_large(case)
    monkeypatch.setattr(cuda_device, "free_memory", lambda: 2.0**60)
    refuse_if_too_large(case, "cuda")


def test_kept_text_finds_the_files_of_the_case(tmp_path):
    """The case.toml of a run names an own metal by its whole path, so that it runs from there."""
    metal = material_file("copper").read_text(encoding="utf-8")
    (tmp_path / "own.toml").write_text(metal, encoding="utf-8")
    text = case_file("texture-steel").read_text(encoding="utf-8")
    file = tmp_path / "case.toml"
    file.write_text(re.sub(r"(?m)^material = .*", 'material = "own.toml"', text), encoding="utf-8")
    settings = ["laser.wavelength=532 nm", "laser.absorption.kind=surface"]
    case = load_case(file, settings)
    *kept, last = split_settings(case.text)[0]
    assert (kept, last) == (settings, f"material={tmp_path / 'own.toml'}")
    elsewhere = tmp_path / "run/case.toml"
    elsewhere.parent.mkdir()
    elsewhere.write_text(case.text, encoding="utf-8")
    assert load_case(elsewhere, [*kept, last]).hash() == case.hash()
    assert load_case(file, [*settings, "material=copper"]).material.name == "copper"
