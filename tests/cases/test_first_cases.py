# ruff: noqa: E501
"""First cases as people write them by hand: everything that is wrong is said in one round.

Each hint is one that the next round accepts: nothing is sent to a key that is refused there.
"""

import pytest

from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.materials import available_materials

OWN_TABLE_AND_WORDS_OF_OTHER_PROGRAMS = """\
# copper with a gaussian spot
[material]
name = "copper"
density = "8960 kg/m^3"
specific_heat = "385 J/(kg K)"
thermal_conductivity = "401 W/(m K)"
melting_temperature = "1357.77 K"
latent_heat_melting = "205 kJ/kg"

[laser]
wavelength = "1064 nm"
pulse_duration = "10 ns"
energy = "1 mJ"
spot_radius = "25 um"
profile = "gaussian"

[domain]
width = "100 um"
depth = "20 um"

[time]
end_time = "50 ns"
"""
OWN_TABLE_AND_WORDS_OF_OTHER_PROGRAMS_SAYS = """\
: particles: missing; write [particles] with spacing = "100 nm"
:5: material.specific_heat: unknown key; do you mean "heat_capacity"?
:6: material.thermal_conductivity: unknown key; do you mean "conductivity"?
:7: material.melting_temperature: unknown key; do you mean "material.melting.solidus"?
:8: material.latent_heat_melting: unknown key; do you mean "material.melting.latent_heat"?
:10: laser.pulse.kind: missing; write kind = "square"
:10: laser.absorption: missing; write absorption = { kind = "surface" }
:10: laser.reflectivity: material 'copper' has no reflectivity; write e.g. reflectivity = 0.9 in [laser]
:12: laser.pulse_duration: unknown key; do you mean "laser.pulse.duration"?
:13: laser.energy: unknown key; do you mean "pulse_energy"?
:14: laser.spot_radius: unknown key; do you mean "laser.beam.radius_1e2"?
:15: laser.profile: unknown key; do you mean "laser.beam.kind"?
:22: time.end_time: unknown key; do you mean "end"?
"""

NO_SUCH_METAL_WRONG_KINDS = """\
title = "zinc"
material = "zinc"
temperature = "300 K"

[laser]
fluence = 2.0
wavelength = "532 nm"
beam = { kind = "gaussian", radius = "20 um" }
pulse = { kind = "gaussian", duration = "10 ns" }
reflectivity = 0.6

[domain]
width = "100 um"
height = "20 um"

[solver]
type = "melt-pool"

[time]
end = "50 ns"
"""
NO_SUCH_METAL_WRONG_KINDS_SAYS = """\
: particles: missing; write [particles] with spacing = "100 nm"
:2: material: no material "zinc"; known: KNOWN; or describe it in the case: write [material] with density, heat_capacity and conductivity
:3: temperature: unknown key; do you mean "initial_temperature"?
:5: laser.absorption: missing; write absorption = { kind = "surface" }
:5: laser: fluence of a gaussian beam may be its mean or its peak (2 times the mean); write fluence_kind = "peak" or "mean"
:6: laser.fluence: 2.0 has no unit; write e.g. "0.6 J/cm^2"
:8: laser.beam.radius: unknown key; do you mean "radius_1e2"?
:9: laser.pulse.duration: unknown key; do you mean "fwhm"?
:9: laser.pulse.center: missing; write center = "30 ns"
:14: domain.height: unknown key; do you mean "depth"?
:17: solver.type: unknown key; do you mean "kind"?
"""

NO_QUOTES_NO_UNITS_WRONG_TABLES = """\
title = "copper spot"

[material]
density = 8960
heat_capacity = "385 J/kgK"
conductivity = "401 W/m/K"
melting = { temperature = "1358 K", latent_heat = "205 kJ/kg" }
vaporization = { temperature = "2835 K", latent_heat = "4.73 MJ/kg" }
optics = { reflectivity = 0.95, absorption_coefficient = "8e5 1/cm" }

[laser]
kind = "gaussian"
fluence = 5 J/cm2
waist = 20 um

[laser.pulse]
fwhm = "10 ns"

[domain]
size = ["100 um", "20 um"]
spacing = "100 nm"

[boundary]
bottom = "isothermal"

[solver]
kind = "conduction"
dimension = 3

[time]
end = "100 ns"
dt = "10 ps"
"""
NO_QUOTES_NO_UNITS_WRONG_TABLES_SAYS = """\
: particles: missing; write [particles] with spacing = "100 nm"
:4: material.density: 8960 has no unit; write e.g. "2700 kg/m^3"
:5: material.heat_capacity: unknown unit "kgK" in "385 J/kgK"; write e.g. "900 J/(kg K)"
:7: material.melting.temperature: unknown key; do you mean "solidus"?
:11: laser.absorption: missing; write absorption = { kind = "surface" }
:12: laser.kind: unknown key; do you mean "laser.beam.kind"?
:13: fluence: a number with a unit is text in TOML; write fluence = "5 J/cm2"
:14: waist: a number with a unit is text in TOML; write waist = "20 um"
:14: laser.waist: unknown key; do you mean "laser.beam.radius_1e2"?
:16: laser.pulse.kind: missing; write kind = "gaussian"
:16: laser.pulse.center: missing; write center = "30 ns"
:19: domain.depth: missing; write depth = "10 um"
:19: domain.width: missing for 3-D; write e.g. width = "5 um"
:20: domain.size: unknown key; write depth and width in [domain]
:21: domain.spacing: unknown key; do you mean "particles.spacing"?
:23: boundary: unknown key; do you mean "boundaries"?
:24: boundaries.bottom: must be "adiabatic" or "periodic" or "free" or "fixed-temperature" or "wall" or "prescribed-flux", got "isothermal"
:28: solver.dimension: unknown key; do you mean "dimensions"?
:32: time.dt: unknown key; do you mean "step"?
"""

TABLES_AT_THE_TOP = """\
title = "copper spot"

[material]
base = "zinc"

[beam]
kind = "gaussian"
radius_1e2 = "20 um"

[pulse]
kind = "square"
duration = "10 ns"

[domain]
depth = "10 um"

[particles]
spacing = "1 nm"

[solver]
kind = "ablation"

[time]
end = "100"
"""
TABLES_AT_THE_TOP_SAYS = """\
: laser.absorption: missing; write absorption = { kind = "surface" }
: laser: a laser needs one statement of its energy, got none; write e.g. pulse_energy = "10 uJ" (one of fluence, intensity, pulse_energy, power)
:3: material: no material "zinc"; known: KNOWN; or describe it in the case: write [material] with density, heat_capacity and conductivity
:6: beam: unknown key; do you mean "laser.beam"?
:10: pulse: unknown key; do you mean "laser.pulse"?
:14: domain.width: missing for 3-D; write e.g. width = "5 um"
:18: particles.spacing: about 2.5e+11 particles, 196 TiB of memory, more than lasersph can number; take a coarser spacing or a smaller domain
:20: solver.sound_speed: missing; write sound_speed = "1000 m/s"
:24: time.end: "100" has no unit; write e.g. "10 ns"
"""

A_MELT_POOL = """\
title = "melt pool"
material = "steel-304"
[laser]
fluence = "0.5 J/cm^2"
wavelength = "800 nm"
beam = { kind = "gaussian", radius_1e2 = "20 um", wavelength = "1064 nm"}
pulse = { kind = "gaussian", fwhm = "10 ns" }
absorption = { kind = "beer-lambert" }
[domain]
depth = "10 um"
[particles]
spacing = "100 nm"
[boundaries]
surface = "fixed-temperature"
[solver]
kind = "melt-pool"
dimensions = 1
[time]
end = "100 ns"
[ejection]
model = "enthalpy"
"""
A_MELT_POOL_SAYS = """\
:3: laser: fluence of a gaussian beam may be its mean or its peak (2 times the mean); write fluence_kind = "peak" or "mean"
:5: laser.wavelength: material 'steel-304' has optics at "1064 nm", "532 nm", "355 nm", not at "800 nm"; write e.g. wavelength = "1064 nm" in [laser], or reflectivity in [laser] and absorption_coefficient in [laser.absorption]
:6: laser.beam.wavelength: unknown key; leave it out: laser.wavelength is given
:7: laser.pulse.center: missing; write center = "30 ns"
:9: domain.width: missing for 2-D; write e.g. width = "5 um"
:13: boundaries.surface_temperature: is missing where surface = "fixed-temperature"; write e.g. surface_temperature = "1000 K"
:14: boundaries.surface: a laser heats the surface, "fixed-temperature" holds its temperature; remove one of the two
:17: solver.dimensions: must be 2 or 3, got 1: a column of liquid has nowhere to flow; write dimensions = 2, or kind = "conduction" for heat and melting alone
:20: solver.ejection: unknown key; belongs to kind = "ablation"
"""

CASES = {
    "own table and words of other programs": (
        OWN_TABLE_AND_WORDS_OF_OTHER_PROGRAMS,
        OWN_TABLE_AND_WORDS_OF_OTHER_PROGRAMS_SAYS,
    ),
    "no such metal, wrong kinds": (NO_SUCH_METAL_WRONG_KINDS, NO_SUCH_METAL_WRONG_KINDS_SAYS),
    "no quotes, no units, wrong tables": (
        NO_QUOTES_NO_UNITS_WRONG_TABLES,
        NO_QUOTES_NO_UNITS_WRONG_TABLES_SAYS,
    ),
    "tables at the top": (TABLES_AT_THE_TOP, TABLES_AT_THE_TOP_SAYS),
    "a melt pool": (A_MELT_POOL, A_MELT_POOL_SAYS),
}


@pytest.mark.parametrize("name", CASES)
def test_everything_in_one_round(name, tmp_path):
    """All lines of the refusal, with file, line, key, what is wrong and what to write."""
    text, says = CASES[name]
    says = says.replace("KNOWN", ", ".join(available_materials()))
    file = tmp_path / "case.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(CaseError) as error:
        load_case(file)
    assert str(error.value).replace(str(file), "").splitlines() == says.splitlines()


def test_what_is_said_is_enough(tmp_path):
    """The first file, corrected line by line as it is told, is right."""
    file = tmp_path / "case.toml"
    file.write_text(
        """
[material]
name = "copper"
density = "8960 kg/m^3"
heat_capacity = "385 J/(kg K)"
conductivity = "401 W/(m K)"
melting.solidus = "1357.77 K"
melting.latent_heat = "205 kJ/kg"

[laser]
pulse_energy = "1 mJ"
pulse = { kind = "square", duration = "10 ns" }
beam = { kind = "gaussian", radius_1e2 = "25 um" }
absorption = { kind = "surface" }
reflectivity = 0.9

[domain]
width = "100 um"
depth = "20 um"

[particles]
spacing = "100 nm"

[time]
end = "50 ns"
""",
        encoding="utf-8",
    )
    case = load_case(file)
    assert case.material.liquidus == case.material.solidus == 1357.77
