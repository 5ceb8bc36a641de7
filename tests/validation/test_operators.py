"""The validations of operators, and that a validation can fail."""

import json

import numpy as np
import pytest

from lasersph import compute
from lasersph.input import CaseError
from lasersph.sph import gradient
from lasersph.sph.kernels import kernel
from lasersph.validation import Report, kernel_correction, kernels, names, titles, validate
from lasersph.validation.verdict import at_most, judged, shown


@pytest.mark.parametrize("name", ["kernels", "kernel-correction"])
def test_operators(tmp_path, name):
    """Every judged number lies within its tolerance, and the figures are drawn."""
    report = validate(name, tmp_path, quick=True)
    assert report.passed, report.table()
    assert report.figures
    assert all(path.stat().st_size > 1000 for path in report.figures)
    assert json.loads(json.dumps(report.as_dict(), allow_nan=False))["passed"] is True


def test_reductions_by_plain_sums():
    """Schwaiger without Gamma in NumPy alone: the errors fall by 26.94 (1/x) to 50.63 % (x)."""
    x, dx, h = kernel_correction.LINE, 0.25, 0.375
    r = x[:, None] - x
    q = np.abs(r) / h
    slope = np.where(q < 1.0, -3.0 * q + 2.25 * q**2, np.where(q < 2.0, -0.75 * (2 - q) ** 2, 0.0))
    gradient = slope * (2.0 / 3.0) / h**2 * np.sign(r)
    over_r = np.divide(gradient, r, out=np.zeros_like(r), where=r != 0.0)
    found = {}
    for function in kernel_correction.FUNCTIONS:
        f, exact = function.value(x), function.second(x)
        plain = np.sum(2.0 * dx * (f[:, None] - f) * over_r, axis=1)
        first = np.sum(dx * (f - f[:, None]) * gradient, axis=1)
        better = plain - 2.0 * first * np.sum(dx * gradient, axis=1)
        found[function.name] = 100.0 * (
            1.0 - np.linalg.norm(better - exact) / np.linalg.norm(plain - exact)
        )
    assert min(found.values()) == found["1/x"] == pytest.approx(26.9428, abs=1e-4)
    assert max(found.values()) == found["x"] == pytest.approx(50.6309, abs=1e-4)


def test_a_wrong_pair_of_operators_is_noticed(monkeypatch):
    """With the difference gradient for the symmetric one the defect is far from rounding."""
    monkeypatch.setattr(kernels, "symmetric_gradient", gradient.difference_gradient)
    defect = kernels.skew_defect(compute.cpu(threads=2), kernel("quintic-spline", 2))
    assert defect > 1e-3


def test_names_and_titles():
    """Every listed validation can be imported and says what it asks; a wrong name is refused."""
    assert set(titles()) == set(names())
    with pytest.raises(CaseError, match="kernels"):
        validate("kernal", ".")


def test_verdicts():
    """NaN, None and values outside the tolerance fail; shown numbers do not count."""
    good = judged("T", "K", 300.4, 300.0, 0.5)
    assert good.verdict is True
    for bad in (judged("T", "K", 300.6, 300.0, 0.5), judged("T", "K", None, 300.0, 0.5),
                at_most("T", "K", np.nan, 1.0)):  # fmt: skip
        assert bad.verdict is False
        assert not Report("r", "", (good, bad)).passed
    info = shown("T", "K", np.nan, published="about 1")
    assert Report("r", "", (good, info)).passed
    assert not Report("r", "", (info,)).passed
    assert Report("r", "", (good, info)).as_dict()["rows"][1]["computed"] is None


def test_table():
    """One line a number, and the verdict at the end."""
    text = Report("r", "why", (judged("T", "K", 3.0, 1.0, 0.5, published="about 1"),)).table()
    assert "FAILED" in text
    assert "about 1" in text
    assert text.endswith("r FAILED: 1 of 1 judged, 1 numbers")
