"""Units in which a plan gives its numbers, for its answers."""

import pytest

from lasersph.input.shown_unit import shown_unit, units_written

PLAN = """
[set]
"particles.spacing" = "24 nm"
[vary]
"laser.fluence" = ["400 mJ/cm^2", "0.7 J/cm^2"]
"laser.pulse.fwhm" = { from = "5 ns", to = "20 ns", count = 3 }
"laser.spot.diameter" = [1e-5]
initial_temperature = ["20 degC"]
[unknowns.slope]
key = "material.surface_tension.slope"
between = ["-0.4 mN/(m K)", "0.1 mN/(m K)"]
"""
UNITS = {
    "laser.fluence": "J/m^2",
    "laser.pulse.fwhm": "s",
    "laser.spot.diameter": "m",
    "initial_temperature": "K",
    "laser.intensity": "W/m^2",
    "material.surface_tension.slope": "N/(m K)",
}


@pytest.mark.parametrize(
    ("key", "value", "text"),
    [
        ("laser.fluence", 4406.25, "440.6 mJ/cm^2"),
        ("laser.pulse.fwhm", 8.05e-9, "8.05 ns"),
        ("laser.spot.diameter", 1e-5, "1e-05 m"),
        ("initial_temperature", 293.15, "20 degC"),
        ("laser.intensity", 1e10, "1e+06 W/cm^2"),
        ("material.surface_tension.slope", -1e-4, "-0.1 mN/(m K)"),
    ],
)
def test_units_of_a_plan(key, value, text):
    """As the first value of a key is written; SI, or per square centimeter, without."""
    assert units_written(PLAN, UNITS)[key].text(value) == text


def test_numbers_come_back_as_they_were_written():
    """0.7 J/cm2 is 7000 J/m2 and 0.7 again, not 0.7000000000000001."""
    unit = shown_unit("J/m^2")
    for value in (0.1, 0.3, 0.7, 0.440625):
        assert unit.number(value * 1e4) == value
