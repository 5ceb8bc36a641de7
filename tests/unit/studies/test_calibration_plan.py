"""Plans of calibrations: what they say, and every mistake in one line with its line number."""

import numpy as np
import pytest
from bad_plans import assert_mistake, written

from lasersph.input import QuantityError
from lasersph.studies.calibration_reading import read_calibration_plan
from lasersph.studies.measured_value import kind_of_number, read_measured

GOOD = """case = "dlip-steel"
[set]
"solver.kind" = "conduction"
[unknown]
factor = { scales = "laser.fluence", between = [0.7, 1.6] }
fwhm = { key = "laser.pulse.fwhm", between = ["8 ns", "12.5 ns"], known = "10 +- 0.5 ns" }
[[measured]]
set = { "laser.fluence" = "0.6 J/cm^2" }
values = { "melt.width_half_max_m" = "3.2 +- 0.1 um", "melt.depth_max_m" = "200 +- 20 nm" }
[[measured]]
set = { laser.fluence = "0.5 J/cm^2" }
values = { "melt.depth_max_m" = "150 nm +- 10 %" }
[runs]
first = 8
"""


def read(tmp_path, text):
    """The plan of a text."""
    return read_calibration_plan(written(tmp_path, text))


def test_plan(tmp_path):
    """Keys, bounds and values in SI; keys of the runs follow from the unknowns."""
    plan = read(tmp_path, GOOD)
    factor, fwhm = plan.unknowns
    assert (factor.low, factor.high, factor.known) == (0.7, 1.6, None)
    assert (fwhm.low, fwhm.high, fwhm.known.sd) == pytest.approx((8e-9, 12.5e-9, 0.5e-9))
    assert dict(plan.units) == {"laser.fluence": "J/m^2", "laser.pulse.fwhm": "s"}
    assert plan.conditions[1].values["melt.depth_max_m"].sd == pytest.approx(15e-9)
    inputs = plan.inputs(np.array([[1.1, 9e-9]]), plan.conditions[0])
    assert inputs == pytest.approx(np.array([[6600.0, 9e-9]]))
    low, high = plan.box()
    assert low == pytest.approx([3500.0, 8e-9])
    assert high == pytest.approx([9600.0, 12.5e-9])


def test_complement_and_the_case_s_own_number(tmp_path):
    """An absorptivity is 1 less the reflectivity; a factor scales what the case says itself."""
    (fwhm,) = (line for line in GOOD.splitlines() if line.startswith("fwhm"))
    absorptivity = 'absorptivity = { complements = "laser.reflectivity", between = [0.2, 0.5] }'
    text = GOOD.replace('set = { "laser.fluence" = "0.6 J/cm^2" }\n', "")
    text = text.replace(fwhm, absorptivity)
    plan = read(tmp_path, text)
    inputs = plan.inputs(np.array([[1.1, 0.3]]), plan.conditions[0])
    assert inputs == pytest.approx(np.array([[6600.0, 0.7]]))


@pytest.mark.parametrize(
    ("text", "kind", "value", "sd"),
    [
        ("3.2 +- 0.1 um", "length", 3.2e-6, 1e-7),
        ("200nm ± 20nm", "length", 2e-7, 2e-8),
        ("200 nm +- 5 %", "length", 2e-7, 1e-8),
        ("1700 +- 20 K", "temperature", 1700.0, 20.0),
        ("1.1 +/- 0.2", "", 1.1, 0.2),
        ("30 +- 2 %", "fraction", 0.3, 0.02),
    ],
)
def test_measured_values(text, kind, value, sd):
    """Value and standard error in SI; a unit may stand once, at the end."""
    found = read_measured(text, kind)
    assert (found.value, found.sd) == pytest.approx((value, sd))


@pytest.mark.parametrize("text", ["3.2 um", "3 +- 0 um", "a +- 1 um", "3 +- 1 J", "3 +- 1 +- 1 um"])
def test_bad_measured_values(text):
    """No error, an error of zero, no number, another unit."""
    with pytest.raises(QuantityError):
        read_measured(text, "length")


def test_kinds_of_numbers():
    """Units follow from what observers declare; names of probes are free."""
    assert kind_of_number("melt.depth_half_max_m") == "length"
    assert kind_of_number("temperature_max_K") == "temperature"
    with pytest.raises(QuantityError, match="depth_max_m"):
        kind_of_number("melt.depth_mx_m")


WRONG = {
    "unknown key": ("[runs]\nfirst = 8", "[runs]\nfirts = 8", 14, "firts"),
    "unknown key of the case": ("laser.pulse.fwhm", "laser.pulse.fwmh", 6, "fwmh"),
    "wrong kind of unit": ('["8 ns", "12.5 ns"]', '["8 nm", "12.5 nm"]', 6, "length"),
    "no unit": ('["8 ns", "12.5 ns"]', "[8, 12.5]", 6, "unit"),
    "range without width": ("[0.7, 1.6]", "[1.6, 1.6]", 5, "no width"),
    "prior of zero width": ("10 +- 0.5 ns", "10 +- 0 ns", 6, "above zero"),
    "prior outside": ("10 +- 0.5 ns", "20 +- 0.5 ns", 6, "outside"),
    "range that crosses a limit": (
        '["8 ns", "12.5 ns"]',
        '["-8 ns", "12.5 ns"]',
        6,
        "greater than",
    ),
    "two relations": (
        'scales = "laser.fluence"',
        'scales = "laser.fluence", key = "time.end"',
        5,
        "one of",
    ),
    "unknown twice": ('scales = "laser.fluence"', 'key = "laser.pulse.fwhm"', 6, "twice"),
    "unknown and set": ("[set]", '[set]\n"laser.pulse.fwhm" = "9 ns"', 7, "given in [set]"),
    "unknown and measured": (
        '"laser.fluence" = "0.6 J/cm^2"',
        '"laser.pulse.fwhm" = "9 ns"',
        8,
        "unknown (fwhm)",
    ),
    "no such number": ('"melt.width_half_max_m"', '"melt.width_hlf_max_m"', 9, "width_half"),
    "measured without error": ("3.2 +- 0.1 um", "3.2 um", 9, "standard error"),
    "measured in another unit": ("3.2 +- 0.1 um", "3.2 +- 0.1 ns", 9, "length"),
    "width below zero": ("3.2 +- 0.1 um", "-3.2 +- 0.1 um", 9, "below zero"),
    "one table for a list": (
        GOOD[GOOD.index("[[measured]]") : GOOD.index("[runs]")],
        '[measured]\nvalues = { "melt.depth_max_m" = "150 nm +- 10 %" }\n',
        7,
        "write [[measured]]",
    ),
    "unknown case": ("dlip-steel", "dlip-steal", 1, 'do you mean "dlip-steel"'),
    "factor on an unknown key": (
        'scales = "laser.fluence"',
        'scales = "laser.fluens"',
        5,
        "fluence",
    ),
    "too few runs": ("first = 8", "first = 3", 14, "an emulator of 2 keys needs 4 runs"),
    "more runs first than at most": ("first = 8", "first = 8\nmost = 6", 14, "more than most, 6"),
    "measured key twice": (
        'set = { laser.fluence = "0.5 J/cm^2" }',
        'set = { laser.fluence = "0.5 J/cm^2", "laser.fluence" = "0.6 J/cm^2" }',
        11,
        "given twice",
    ),
    "same key twice": (
        '"solver.kind" = "conduction"',
        '"solver.kind" = "conduction"\n"solver.kind" = "conduction"',
        4,
        "twice",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_mistakes_have_a_line(tmp_path, name):
    """Each mistake is said with file and line."""
    old, new, line, words = WRONG[name]
    assert old in GOOD
    assert_mistake(read_calibration_plan, tmp_path, GOOD.replace(old, new, 1), line, words)


def test_fewer_data_than_unknowns(tmp_path):
    """What is known beforehand counts as a datum."""
    text = GOOD.partition("[[measured]]")[0] + (
        '[[measured]]\nvalues = { "melt.depth_max_m" = "200 +- 20 nm" }\n'
    )
    assert len(read(tmp_path, text).unknowns) == 2
    text = text.replace(', known = "10 +- 0.5 ns"', "")
    assert_mistake(read_calibration_plan, tmp_path, text, 4, "2 unknowns need")
