"""Any fluence runs to finite numbers and a closed balance, or is refused with a reason."""

import math

import pytest
from moving_matter import HEATED_BLOCK

from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.simulation import run

COLUMN = (*HEATED_BLOCK, "domain.depth=4 um", "particles.spacing=0.2 um", "time.end=1 ns")


def numbers(found):
    """All numbers of a nested summary."""
    if isinstance(found, dict):
        found = list(found.values())
    if isinstance(found, list):
        return [value for part in found for value in numbers(part)]
    return [found] if isinstance(found, float) else []


@pytest.mark.parametrize("model", ["enthalpy", "published"])
@pytest.mark.parametrize("fluence", [1e-6, 1.0, 1000.0])
def test_any_fluence(tmp_path, model, fluence):
    """From nothing at all to a column that is gone before the pulse ends; the published rule keeps
    some of it."""
    settings = (*COLUMN, f"laser.fluence={fluence} J/cm^2", f"ejection={{model='{model}'}}")
    one = run(load_case("sound-wave", settings), tmp_path / "run", threads=1)
    assert all(math.isfinite(value) for value in numbers(one.summary))
    assert one.summary["energy"]["imbalance_relative"] < 1e-9
    is_gone = one.summary["crater"]["depth_m"] == pytest.approx(4e-6)
    assert is_gone == (fluence == 1000.0 and model == "enthalpy")
    assert (one.summary["energy"]["transmitted_J"] > 0.0) == is_gone


def test_no_fluence_is_refused():
    """Light of no energy is no light."""
    with pytest.raises(CaseError, match=r"laser\.fluence: must be greater than 0"):
        load_case("sound-wave", (*COLUMN, "laser.fluence=0 J/cm^2"))
