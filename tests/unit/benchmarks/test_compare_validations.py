"""Comparison of what two backends validated."""

from compare_validations import compared


def result(computed, verdict=True, name="depth"):
    """A result with one validation of one row, 1 % around 200."""
    row = {"quantity": name, "published": None, "reference": 200.0, "computed": computed,
           "tolerance": 0.01, "verdict": verdict}  # fmt: skip
    return {"validations": {"melt": {"rows": [row]}}}


def test_a_tenth_of_the_tolerance():
    """0.1 of 1 % of 200 is 0.2: 0.1 apart is half of that, 0.4 apart is twice as much."""
    ((name, quantity, distance, is_well),) = compared(result(200.0), result(200.1))
    assert (name, quantity, round(distance, 6), is_well) == ("melt", "depth", 0.5, True)
    assert compared(result(200.0), result(200.4))[0][3] is False


def test_verdicts_and_missing_rows():
    """Another verdict is no agreement, nor is a row that only one has."""
    assert compared(result(202.0), result(202.0, verdict=False))[0][2:] == (0.0, False)
    assert compared(result(200.0), result(200.0, name="width"))[0][2:] == (float("inf"), False)
    assert compared(result(None), result(None))[0][2:] == (0.0, True)
