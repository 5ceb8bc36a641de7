"""The validations of operators, and that a validation can fail."""

from pathlib import Path

import numpy as np
import pytest

from lasersph import compute
from lasersph.input import CaseError
from lasersph.sph import gradient
from lasersph.sph.kernels import kernel
from lasersph.validation import Report, names, titles, validate
from lasersph.validation.comparison import Comparison, number_at, read_comparisons
from lasersph.validation.kernel_correction import rows as kernel_correction
from lasersph.validation.kernels import rows as kernels
from lasersph.validation.study import Study, home_of


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


@pytest.mark.parametrize("name", names())
def test_what_a_validation_says(name):
    """A question, its source, what is compared and why within these bands; then what was changed
    for it, what is not met, and what single changes show of a difference."""
    text = (home_of(name) / "README.md").read_text(encoding="utf-8")
    heads = [line for line in text.splitlines() if line.startswith("## ")]
    assert heads[:4] == ["## Source", "## Question", "## Quantities", "## Bands"]
    more = ("## Parameters", "## Not met", "## Single changes")
    assert heads[4:] == [head for head in more if head in heads]


def test_every_band_has_its_reason():
    """`reason` in rows.toml of every kind of row that can fail."""
    bare = [
        f"{name}: {kind.name}"
        for name in names()
        for kind in Study(name, Path()).comparisons.values()
        if kind.is_judged and not kind.reason
    ]
    assert not bare


def test_verdicts():
    """NaN, None and values outside the band fail; shown numbers do not count."""
    kind = Comparison("T", "K", band=0.5)
    good = kind.row(300.4, 300.0)
    assert good.verdict is True
    for bad in (kind.row(300.6, 300.0), kind.row(None, 300.0), kind.row(np.nan)):
        assert bad.verdict is False
        assert not Report("r", "", (good, bad)).passed
    info = Comparison("T", "K").row(np.nan, published="about 1")
    assert Report("r", "", (good, info)).passed
    assert not Report("r", "", (info,)).passed
    assert Report("r", "", (good, info)).as_dict()["rows"][1]["computed"] is None


def test_bands():
    """In the unit or in percent of the reference; another one and a share where runs are short."""
    kind = Comparison("u at {x}", "m/s", band="2 %", quick=0.5, source="of {x}")
    row = kind.row(1.0, -10.0, words={"x": 3})
    assert (row.quantity, row.source, row.tolerance) == ("u at 3", "of 3", pytest.approx(0.2))
    assert kind.row(1.0, 1.0, quick=True, share=3.0, words={"x": 3}).tolerance == 1.5
    assert kind.row(1.0, 1.0, judge=False, words={"x": 3}).verdict is None
    assert Comparison("error", band=1e-3).row(2e-3).reference == 0.0
    assert Comparison(claim="it grows").row(True).computed == "holds"


def test_own_references_judge_nothing():
    """Another result of ours is shown with its distance, and does not count."""
    kind = Comparison("width", "nm", band=8.0, own=True, changed="was 5 nm until May")
    row = kind.row(20.0, 10.0)
    assert (row.verdict, row.tolerance, row.judgement) == (None, 8.0, "own")
    assert not kind.is_judged and not Report("r", "", (row,)).passed
    assert "- changed: was 5 nm until May" in Report("r", "", (row, row)).table()


def test_words_for_all_rows(tmp_path):
    """Source, reason and what was changed hold for every row that names no other."""
    file = tmp_path / "rows.toml"
    file.write_text('reason = "all"\n[a]\nquantity = "a"\nband = 1\n[b]\nquantity = "b"\n'
                    'band = 1\nreason = "own"\n')  # fmt: skip
    kinds = read_comparisons([file])
    row = kinds["a"].row(1.0, 1.0)
    assert (row.reason, row.kind, kinds["b"].reason) == ("all", "a", "own")


def test_number_of_a_summary():
    """A path into the summary, in another unit; None where something is missing."""
    summary = {"flow": {"extrema": {"inner_lasted_s": 2e-9, "outer": None}}}
    assert number_at(summary, "flow.extrema.inner_lasted_s", 1e9) == pytest.approx(2.0)
    assert number_at(summary, "flow.extrema.outer") is None
    assert number_at(summary, "melt.width_max_m") is None


def test_wrong_keys_of_rows(tmp_path):
    """A key that there is not is refused when rows.toml is read, not passed over."""
    file = tmp_path / "rows.toml"
    file.write_text('[front]\nquantity = "front"\ntolerance = 1.0\n')
    with pytest.raises(ValueError, match=r"\[front\]"):
        read_comparisons([file])


def test_table():
    """One line a number, and the verdict at the end."""
    row = Comparison("T", "K", band=0.5, published="about 1").row(3.0, 1.0)
    text = Report("r", "why", (row,)).table()
    assert "FAILED" in text
    assert "about 1" in text
    assert text.endswith("r FAILED: 1 of 1 judged, 1 numbers")
