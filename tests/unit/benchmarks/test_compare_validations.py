"""Comparison of what two backends, or two versions of the program, validated."""

import math

import pytest
from compare_validations import differences


def result(*computed, verdict=True, name="depth", tolerance=2.0):
    """A result with one validation of rows around 200 with a tolerance of 2."""
    common = {"quantity": name, "published": None, "reference": 200.0, "tolerance": tolerance}
    rows = [common | {"computed": value, "verdict": verdict} for value in computed]
    return {"validations": {"melt": {"rows": rows}}}


def test_a_tenth_of_the_tolerance():
    """0.1 of 2 is 0.2: 0.1 apart is half of that, 0.4 apart is twice as much."""
    (row,) = differences(result(200.0), result(200.1))
    assert (row.validation, row.quantity, row.agrees) == ("melt", "depth", True)
    assert row.size == pytest.approx(0.5)
    (row,) = differences(result(200.0), result(200.4))
    assert row.size == pytest.approx(2.0) and not row.agrees


def test_round_off():
    """Another sum order agrees to 1e-9, a changed formula does not; 0 is measured by its band."""
    assert differences(result(200.0), result(200.0 + 1e-10), 1e-9)[0].agrees
    assert not differences(result(200.0), result(200.001), 1e-9)[0].agrees
    zero = {"reference": 0.0}
    ours, theirs = result(1e-12, tolerance=1e-3), result(3e-12, tolerance=1e-3)
    for one in (ours, theirs):
        one["validations"]["melt"]["rows"][0] |= zero
    assert differences(ours, theirs, 1e-8)[0].agrees
    assert math.isinf(differences(result(200.0), result(None), 1e-9)[0].size)


def test_verdicts_and_missing_rows():
    """Another verdict is no agreement, nor is a row that only one has."""
    (row,) = differences(result(202.0), result(202.0, verdict=False))
    assert row.size == 0.0 and not row.agrees
    assert [row.agrees for row in differences(result(202.0), result(202.0, name="width"))] == [
        False,
        False,
    ]
    assert differences(result(None), result(None))[0].agrees
    assert len(differences(result(1.0, 2.0), result(1.0, 2.0))) == 2
