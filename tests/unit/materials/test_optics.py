"""Optics by wavelength: R and alpha of n and k, which light chooses what, mistakes in one line."""

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.materials import NoOptics, load_material

METAL = """name = "metal"
density = { value = "2000 kg/m^3", source = "x" }
heat_capacity = { value = "500 J/(kg K)", source = "x" }
conductivity = { value = "100 W/(m K)", source = "x" }
"""
SPECTRAL = """
[optics.by_wavelength."1064 nm"]
refractive_index = 3.0
extinction_coefficient = 4.0
source = "y"
[optics.by_wavelength."532 nm"]
reflectivity = { solid = { value = 0.6, source = "z" }, liquid = { value = 0.5, source = "z" } }
absorption_coefficient = "8e7 1/m"
source = "z"
"""
SINGLE = """
[optics]
wavelength = "355 nm"
absorption_coefficient = "1e8 1/m"
source = "y"
reflectivity = { value = 0.4, source = "y" }
"""
CASE = """
material = "metal.toml"
initial_temperature = "300 K"
domain = { depth = "3 um" }
particles = { spacing = "0.1 um" }
time = { end = "0.1 ns" }
solver = { dimensions = 1 }
[laser]
fluence = "1 J/cm^2"
pulse = { kind = "square", duration = "10 ns" }
absorption = { kind = "beer-lambert" }
"""


def metal(folder, optics=SPECTRAL):
    """The metal with that optics, read from a file."""
    file = folder / "metal.toml"
    file.write_text(METAL + optics, encoding="utf-8")
    return load_material(file)


def case(folder, *settings, optics=SPECTRAL):
    """A case of the metal."""
    metal(folder, optics)
    (folder / "case.toml").write_text(CASE, encoding="utf-8")
    return load_case(folder / "case.toml", settings)


def light_of(case):
    """Reflectivity of the cold surface and absorption coefficient [1/m]."""
    R = case.laser.reflectivity_table(case.material, 300.0, 400.0)[1][0]
    return float(R), case.laser.absorption_coefficient(case.material)


def test_numbers_of_n_and_k(tmp_path):
    """n = 3, k = 4: R = (4 + 16) / (16 + 16), alpha = 4 pi 4 / 1064 nm, by hand."""
    optics = metal(tmp_path).in_light(1064e-9).optics
    assert float(optics.reflectivity.at(300.0)) == pytest.approx(0.625)
    assert optics.absorption_coefficient == pytest.approx(16.0 * np.pi / 1064e-9)
    assert optics.wavelength == 1064e-9
    assert optics.reflectivity.source == "n = 3, k = 4 of y"


def test_light_of_a_case_chooses(tmp_path):
    """Each wavelength has its numbers; 1070 nm is the same light as 1064 nm, at its own alpha."""
    alpha = 16.0 * np.pi
    assert light_of(case(tmp_path, "laser.wavelength=532 nm")) == (0.6, 8e7)
    assert light_of(case(tmp_path, "laser.wavelength=1070 nm")) == pytest.approx(
        (0.625, alpha / 1070e-9)
    )
    waves = [
        "laser.beam.kind=interference",
        "laser.beam.wavelength=532 nm",
        "laser.beam.angle=0.1 rad",
    ]
    wide = ["solver.dimensions=2", "domain.width=5 um", "boundaries.left=fixed-temperature"]
    right = ["boundaries.left_temperature=300 K", "boundaries.right=fixed-temperature"]
    right += ["boundaries.right_temperature=300 K"]
    assert light_of(case(tmp_path, *waves, *wide, *right)) == (0.6, 8e7)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ([], 'has optics at "1064 nm", "532 nm"; write e.g. wavelength = "1064 nm" in [laser]'),
        (["laser.wavelength=1030 nm"], 'has optics at "1064 nm", "532 nm", not at "1030 nm"; '),
    ],
)
def test_light_without_optics_is_refused_once(settings, words, tmp_path):
    """One line at laser.wavelength that names those there are, for R and alpha together."""
    with pytest.raises(CaseError) as caught:
        case(tmp_path, *settings)
    said = str(caught.value)
    assert "laser.wavelength: material 'metal' " + words in said
    assert "\n" not in said


def test_numbers_given_by_the_laser_need_no_wavelength(tmp_path):
    """Reflectivity and absorption of [laser] go before everything else."""
    own = ["laser.reflectivity=0.9", "laser.absorption.absorption_coefficient=2e7 1/m"]
    assert light_of(case(tmp_path, *own)) == (0.9, 2e7)
    assert light_of(case(tmp_path, *own, "laser.wavelength=800 nm")) == (0.9, 2e7)


def test_one_wavelength_as_before(tmp_path):
    """A metal with optics at one wavelength: taken unless the laser names another light."""
    assert light_of(case(tmp_path, optics=SINGLE)) == (0.4, 1e8)
    assert light_of(case(tmp_path, "laser.wavelength=355 nm", optics=SINGLE)) == (0.4, 1e8)
    with pytest.raises(CaseError, match='has optics at "355 nm", not at "532 nm"'):
        case(tmp_path, "laser.wavelength=532 nm", optics=SINGLE)
    everywhere = SINGLE.replace('wavelength = "355 nm"', "")
    assert light_of(case(tmp_path, "laser.wavelength=532 nm", optics=everywhere)) == (0.4, 1e8)


def test_beside_the_numbers_at_one_wavelength(tmp_path):
    """Tables add wavelengths to the one of [optics], which stays that of a case that names none."""
    both = SINGLE + SPECTRAL
    assert light_of(case(tmp_path, optics=both)) == (0.4, 1e8)
    assert light_of(case(tmp_path, "laser.wavelength=532 nm", optics=both)) == (0.6, 8e7)
    assert metal(tmp_path, both).optics.wavelengths() == [1064e-9, 532e-9, 355e-9]


def test_numbers_changed_in_the_case(tmp_path):
    """A reflectivity or a table written into the case goes before those of the file."""
    infrared = "laser.wavelength=1064 nm"
    R, alpha = light_of(case(tmp_path, infrared, "material.optics.reflectivity=0.1"))
    assert (R, alpha) == (0.1, pytest.approx(16.0 * np.pi / 1064e-9))
    green = 'material.optics.by_wavelength={ "515 nm" = { reflectivity = { value = 0.2 } } }'
    absorption = "laser.absorption={ kind = 'surface' }"
    changed = case(tmp_path, green, "laser.wavelength=515 nm", absorption)
    assert light_of(changed) == (0.2, np.inf)
    assert len(changed.material.optics.by_wavelength) == 3


def test_files_without_tables_keep_their_content():
    """Cases of before are told apart by the same hash: no new key where nothing new is said."""
    shipped = load_case("dlip-steel")
    assert "by_wavelength" not in str(shipped.resolved())
    assert "wavelength" not in shipped.resolved()["laser"]


def test_two_wavelengths_of_one_laser(tmp_path):
    """The laser's and that of its interfering waves cannot differ."""
    waves = [
        "laser.beam.kind=interference",
        "laser.beam.wavelength=532 nm",
        "laser.beam.angle=0.1 rad",
    ]
    with pytest.raises(
        CaseError, match=r"laser\.wavelength: is .* but .*laser\.beam\.wavelength, is .*m; leave"
    ):
        case(tmp_path, *waves, "laser.wavelength=1064 nm")


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ('"1064 nm"', '"1064 J"', 6, "names no wavelength"),
        ('"1064 nm"', '"530 nm"', 10, 'is the light of "530 nm" already; leave one of the two out'),
        ('"1064 nm"', '"-2 nm"', 6, "must be positive"),
        ("refractive_index = 3.0\n", "", 6, "go together; give both"),
        ("= 4.0", "= -4.0", 8, "must be greater than 0, got -4.0"),
        ("extinction_", "absorption_", 8, "absorption_coefficient"),
        ('source = "y"', "", 6, "source: missing"),
        ("value = 0.6", "value = 1.6", None, "532 nm.reflectivity.solid must lie between 0 and 1"),
    ],
)
def test_mistakes_are_refused(old, new, line, words, tmp_path):
    """File, line and key of what is wrong, and what would be right."""
    with pytest.raises(CaseError) as caught:
        metal(tmp_path, SPECTRAL.replace(old, new, 1))
    said = str(caught.value)
    assert words in said
    assert line is None or f"metal.toml:{line}: " in said


def test_a_metal_asked_for_other_light_from_python(tmp_path):
    """The same words, as an error of its own kind."""
    with pytest.raises(NoOptics, match="material 'metal' has optics at"):
        metal(tmp_path).in_light(2e-6)
    assert metal(tmp_path, "").in_light(2e-6).optics is None
