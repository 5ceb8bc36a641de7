"""Quantities: spelling of units, kinds against dimensions, limits of numbers."""

import math
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lasersph.input import KINDS, QuantityError, parse_quantity
from lasersph.input.units import UnitError, dimension, parse_unit

READ = [
    ("0.6 J/cm2", "fluence", 6000.0),
    ("0.6 J/cm^2", "fluence", 6000.0),
    ("0.6J/cm**2", "fluence", 6000.0),
    ("0.6 J/cm\u00b2", "fluence", 6000.0),
    ("0.6 J cm^-2", "fluence", 6000.0),
    ("0.6 J\u00b7cm\u207b\u00b2", "fluence", 6000.0),
    ("600 mJ/cm2", "fluence", 6000.0),
    ("9.6e11 W/m2", "intensity", 9.6e11),
    ("96 MW/cm^2", "intensity", 9.6e11),
    ("3.97nm", "length", 3.97e-9),
    ("5 um", "length", 5e-6),
    ("5 \u00b5m", "length", 5e-6),
    ("5 \u03bcm", "length", 5e-6),
    (".5 mm", "length", 5e-4),
    ("-1. um", "length", -1e-6),
    ("\u22121 um", "length", -1e-6),
    ("+2e-9 m", "length", 2e-9),
    ("1 inch", "length", 0.0254),
    ("10 ns", "time", 1e-8),
    ("298.15 K", "temperature", 298.15),
    ("20 degC", "temperature", 293.15),
    ("20 \u00b0C", "temperature", 293.15),
    ("32 degF", "temperature", 273.15),
    ("5 K", "temperature_difference", 5.0),
    ("167 W/(m K)", "conductivity", 167.0),
    ("167 W/m/K", "conductivity", 167.0),
    ("1.67 W/(cm degC)", "conductivity", 167.0),
    ("0.9 kJ/(kg K)", "specific_heat", 900.0),
    ("0.9 J/g/K", "specific_heat", 900.0),
    ("2.7 g/cm^3", "density", 2700.0),
    ("397 kJ/kg", "specific_energy", 397e3),
    ("9.58e7 1/m", "absorption_coefficient", 9.58e7),
    ("9.58e7 /m", "absorption_coefficient", 9.58e7),
    ("9.58e5 cm^-1", "absorption_coefficient", 9.58e7),
    ("0.87 N/m", "surface_tension", 0.87),
    ("0.87 J/m^2", "surface_tension", 0.87),
    ("-0.43 mN/(m K)", "surface_tension_slope", -4.3e-4),
    ("-166 kJ/mol", "molar_energy", -166e3),
    ("1.3e-8 kmol/m^2", "surface_concentration", 1.3e-5),
    ("71 mrad", "angle", 0.071),
    ("180 deg", "angle", math.pi),
    ("25 %", "fraction", 0.25),
    ("0.25", "fraction", 0.25),
    ("1 bar", "pressure", 1e5),
    ("1 atm", "pressure", 101325.0),
    ("55.85 g/mol", "molar_mass", 0.05585),
    ("20 W/(m^2 K)", "heat_transfer_coefficient", 20.0),
    ("10 kHz", "frequency", 1e4),
    ("0 m", "length", 0.0),
]


@pytest.mark.parametrize(("text", "kind", "value"), READ, ids=[text for text, *_ in READ])
def test_reads_the_nearest_float(text, kind, value):
    """Every spelling gives exactly the float nearest to its SI value."""
    assert parse_quantity(text, kind) == value


REFUSED = [
    ("0.6 N/m", "fluence", '"0.6 N/m" is a surface tension, not a fluence'),
    ("0.6 J", "fluence", '"0.6 J" is an energy, not a fluence'),
    ("0.6 kg/s^2", "fluence", '"0.6 kg/s^2" is a surface tension, not a fluence'),
    ("2 N m", "energy", "has another dimension, not an energy"),
    ("5 J/m^3", "pressure", "not a pressure"),
    ("1 m^2/s^2", "specific_energy", "not a specific energy"),
    ("3 rad/s", "frequency", "not a frequency"),
    ("5 %", "angle", "is a fraction, not an angle"),
    ("8", "length", '"8" has no unit; write e.g. "8 nm"'),
    ("", "length", "does not start with a number"),
    ("nan m", "length", "does not start with a number"),
    ("inf m", "length", "does not start with a number"),
    ("0,6 J/cm2", "fluence", 'the number in "0,6 J/cm2" cannot be read'),
    ("1.2.3 m", "length", "the number in"),
    ("8 NM", "length", 'unknown unit "NM" (do you mean "nm"?)'),
    ("20 C", "temperature", 'unknown unit "C" (do you mean "degC"?)'),
    ("20 degC", "temperature_difference", "is a temperature, not a difference"),
    ("5 glorp", "length", 'unknown unit "glorp"'),
    ("5 m^0.5", "length", 'the unit "m^0.5" cannot be read'),
    ("5 m^99", "length", "cannot be read"),
    ("5 (m", "length", 'misses a ")"'),
    ("5 m)", "length", 'has a ")" too many'),
    ("5 m//s", "velocity", "cannot be read"),
    ("9**9**9 m", "length", "cannot be read"),
    ("1e999 m", "length", "outside the range of floating-point numbers"),
    ("1e308 km", "length", "outside the range of floating-point numbers"),
    ("1e-400 m", "length", "outside the range of floating-point numbers"),
    ("1e9999999999 m", "length", 'the number in "1e9999999999 m" cannot be read'),
    ("1 " + "m " * 200, "length", "longer than 60 characters"),
]


@pytest.mark.parametrize(("text", "kind", "message"), REFUSED, ids=[r[0][:20] for r in REFUSED])
def test_refuses_with_a_clear_message(text, kind, message):
    """Wrong kinds, missing units and odd numbers say what is wrong and give an example."""
    with pytest.raises(QuantityError) as error:
        parse_quantity(text, kind)
    assert message in str(error.value)


@given(st.text(max_size=40))
def test_any_text_is_read_or_refused(text):
    """No text raises anything but QuantityError, whatever its characters."""
    for kind in ("length", "fraction", "temperature"):
        try:
            assert math.isfinite(parse_quantity(text, kind))
        except QuantityError as error:
            assert str(error)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_float_in_si_units_survives(value):
    """repr of a float with the SI unit reads back as the same bits."""
    assert parse_quantity(f"{value!r} m", "length") == value


@pytest.mark.parametrize("kind", KINDS.values(), ids=lambda kind: kind.name)
def test_examples_are_of_their_kind(kind):
    """The example in each message is itself accepted, and so is the SI unit."""
    assert math.isfinite(parse_quantity(kind.example, kind.name))
    if kind.unit != "1":
        assert parse_quantity(f"1 {kind.unit}", kind.name) == 1.0


def test_common_units_need_no_pint():
    """The table answers alone: pint is not imported for the units of the shipped cases."""
    code = (
        "import sys; from lasersph.input import parse_quantity as q;"
        "q('0.6 J/cm^2', 'fluence'); q('20 degC', 'temperature');"
        "assert 'pint' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_unit_algebra_by_hand():
    """kJ/(kg K): factor 1e3, dimension m^2 s^-2 K^-1; a/b/c equals a/(b c)."""
    unit = parse_unit("kJ/(kg K)")
    assert unit.factor == 1000
    assert unit.dimension == dimension(m=2, s=-2, K=-1)
    assert parse_unit("W/m/K").dimension == parse_unit("W/(m K)").dimension
    assert parse_unit("(m/s)^2").dimension == dimension(m=2, s=-2)
    with pytest.raises(UnitError, match="no unit"):
        parse_unit(" ")
