"""The validations that run cases, shortened; in full with `pytest -m validate`."""

from pathlib import Path

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.validation import names, runs, validate
from lasersph.validation.dlip_thermal.finite_volumes import Columns

NOT_MET: dict[str, set[str]] = {
    "measured-spots": {"depth"},
    "two-temperature": {"skin", "explosion", "film", "damage"},
}
"""Kinds of rows that shortened forms do not meet, by validation; the page says why."""


LONG = {"two-temperature", "taylor-green", "dots-film", "pulsed-heating", "moving-recession",
        "gaussian-pulse", "measured-spots", "moving-film", "dlip-steel"}  # fmt: skip
"""Validations that take a minute or more when they are shortened, too; what `dlip-steel` judges is
judged of aluminum in a sixth of its time."""


def validations():
    """Their names; those that take long are asked for."""
    return [pytest.param(name, marks=pytest.mark.slow if name in LONG else ()) for name in names()]


@pytest.mark.parametrize("name", validations())
def test_short_form(name, short_validations):
    """Every validation, shortened: all judged numbers lie within their bands."""
    report = short_validations.report(name)
    assert report is not None, short_validations.text[-6000:]
    missed = [row for row in report["rows"] if row["verdict"] is False]
    assert {row["kind"] for row in missed} == NOT_MET.get(name, set()), missed
    assert report["passed"] or name in NOT_MET
    assert report["figures"]
    assert all(Path(figure).stat().st_size > 1000 for figure in report["figures"])


def test_columns_of_25_nm_give_the_widths_of_the_reference(study):
    """The difference between f_m > 0 and f_m = 1 in the reference is that of its columns."""
    found = 1e9 * np.array(Columns(load_case("dlip-steel"), 25e-9).widest())
    np.testing.assert_allclose(found, (2975, 2909, 2875), atol=1.0)
    wanted = study("dlip-thermal").table("sizes.csv")["steel_width"]
    np.testing.assert_allclose(found, wanted, atol=12.5)


SHORT = load_case("stefan", ["particles.spacing=2 um", "time.end=4 ns", "time.step=2 ns"])


def test_runs_are_kept(tmp_path):
    """A finished run is taken as it is, an interrupted one is finished."""
    first = runs.run_case(SHORT, tmp_path / "short")
    summary = first.path / "summary.json"
    before = summary.stat().st_mtime_ns
    runs.run_case(SHORT, tmp_path / "short")
    assert summary.stat().st_mtime_ns == before
    kept = summary.read_text()
    summary.unlink()
    again = runs.run_case(SHORT, tmp_path / "short")
    assert again.is_complete
    assert "temperature_max_K" in kept


@pytest.mark.parametrize("why", ["other case", "other sources"])
def test_runs_of_other_sources_or_cases_are_computed_anew(tmp_path, monkeypatch, why):
    """What another case or another version of the program computed is never judged."""
    first = runs.run_case(SHORT, tmp_path / "short")
    (first.path / "old.txt").write_text("of the first run")
    case = load_case("stefan", ["particles.spacing=2 um", "time.end=4 ns"])
    if why == "other sources":
        case = SHORT
        monkeypatch.setattr(runs.sources, "hashes", lambda _: {"a module": "edited"})
    second = runs.run_case(case, tmp_path / "short")
    assert second.path == first.path
    assert not (first.path / "old.txt").exists()


def test_a_folder_that_is_no_run_is_kept(tmp_path):
    """Somebody's files are not removed."""
    other = tmp_path / "runs" / "notes"
    other.mkdir(parents=True)
    (other / "notes.txt").write_text("mine")
    with pytest.raises(CaseError, match="not a run folder"):
        runs.run_case(SHORT, other)
    assert (other / "notes.txt").exists()


def test_threads_of_a_validation(tmp_path):
    """Runs use as many threads as asked for."""
    assert runs.run_case(SHORT, tmp_path / "one", threads=1).summary["threads"] == 1


def test_runs_of_backends_are_told_apart():
    """What one backend computed is not taken for the other's."""
    other = runs.fingerprint(SHORT, "cuda")
    assert other != runs.fingerprint(SHORT) and "backend cuda" in other


@pytest.mark.validate
@pytest.mark.parametrize("name", names())
def test_in_full(tmp_path, name):
    """Every validation as `lasersph validate` runs it; the melt pools take an hour each."""
    report = validate(name, tmp_path)
    assert report.passed, report.table()
