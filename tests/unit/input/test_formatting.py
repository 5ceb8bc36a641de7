"""Numbers with units, for people."""

import pytest

from lasersph.input import (
    KINDS,
    format_duration,
    format_number,
    format_quantity,
    format_with_error,
    parse_quantity,
)


@pytest.mark.parametrize(
    ("value", "unit", "plain", "typographic"),
    [
        (8e-9, "m", "8 nm", "8 nm"),
        (2.7712e-7, "m", "277.1 nm", "277.1 nm"),
        (9.999999e-7, "m", "1 um", "1 µm"),
        (-1.5e-9, "m", "-1.5 nm", "-1.5 nm"),
        (9.834e-10, "m", "0.9834 nm", "0.9834 nm"),
        (0.0, "m", "0 m", "0 m"),
        (-7e-22, "m", "0 m", "0 m"),
        (4.626e-8, "s", "46.26 ns", "46.26 ns"),
        (5e-16, "s", "0.5 fs", "0.5 fs"),
        (2.194e-1, "s", "219.4 ms", "219.4 ms"),
        (1234.0, "s", "1234 s", "1 234 s"),
        (298.15, "K", "298.1 K", "298.1 K"),
        (3273.0, "K", "3273 K", "3 273 K"),
        (4.669e11, "K/s", "4.669e+11 K/s", "4.669·10¹¹ K/s"),
        (0.00666, "J/m", "0.00666 J/m", "0.00666 J/m"),
        (12.0, "J/m^2", "12 J/m^2", "12 J/m²"),
        (101325.0, "Pa", "101.3 kPa", "101.3 kPa"),
        (3.2e-13, "m^2", "0.32 um^2", "0.32 µm²"),
        (1.2e-17, "m^3", "12 um^3", "12 µm³"),
        (12.34, "deg", "12.34 deg", "12.34 °"),
        (0.5, "", "0.5", "0.5"),
        (None, "m", "–", "–"),
        (float("nan"), "K", "–", "–"),
    ],
)
def test_a_unit_fits_the_size_of_its_number(value, unit, plain, typographic):
    """Prefixes for units of one symbol, powers of ten for others, a dash for nothing."""
    assert format_quantity(value, unit) == plain
    assert format_quantity(value, unit, typographic=True) == typographic


@pytest.mark.parametrize("kind", ["length", "time", "energy", "pressure", "fluence", "intensity"])
@pytest.mark.parametrize("value", [3.97e-9, 0.2194, 54321.5, 9.6e15])
def test_plain_text_reads_back(kind, value):
    """What a message says can be written into a case file."""
    assert parse_quantity(format_quantity(value, KINDS[kind].unit, 12), kind) == pytest.approx(
        value
    )


def test_numbers_and_durations():
    """Whole numbers keep their digits; durations are said as on a clock."""
    assert format_number(1829) == "1829"
    assert format_number(1e-12, typographic=True) == "1·10⁻¹²"
    assert [format_duration(s) for s in (42, 185, 7800)] == ["42 s", "3 min 05 s", "2 h 10 min"]


@pytest.mark.parametrize(
    ("value", "error", "unit", "text"),
    [
        (9.8e-6, 1e-7, "m", "9.80 ± 0.10 µm"),
        (1330.734, 2.8263, "K", "1 330.7 ± 2.8 K"),
        (288.46e-9, 32e-9, "m", "288 ± 32 nm"),
        (2.59143e11, 1.3704e10, "K/s", "(2.59 ± 0.14)·10¹¹ K/s"),
        (-15128.8, 401.0, "J", "-15.13 ± 0.40 kJ"),
        (1e-9, 1.25e-9, "s", "1.0 ± 1.2 ns"),
        (0.0, 3e-9, "m", "0.0 ± 3.0 nm"),
        (2.59785e-13, 3.0956e-14, "m^2", "0.260 ± 0.031 µm²"),
        (1e-6, 0.0, "s", "1 µs"),
        (1e-6, None, "s", "1 µs"),
    ],
)
def test_value_and_error_share_unit_and_decimals(value, error, unit, text):
    """Two digits of the error, as many decimals of the value; a certain value stands alone."""
    assert format_with_error(value, error, unit, typographic=True) == text
