"""The validations that run cases, shortened; in full with `pytest -m validate`."""

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.input import CaseError
from lasersph.validation import (
    Report,
    gaussian_pulse,
    names,
    pulsed_heating,
    runs,
    stefan,
    validate,
)
from lasersph.validation.dlip_columns import Columns
from lasersph.validation.dlip_numbers import table_rows
from lasersph.validation.dlip_reference import METALS


def test_stefan(tmp_path):
    """The front within 1 % of Neumann's, and closer at half the spacing."""
    report = stefan.run(tmp_path, quick=True)
    assert report.passed, report.table()


def test_pulsed_heating(tmp_path):
    """Particle 1 within 0.5 K at two spacings in 1-D and one in 3-D; the exact solution."""
    light = pulsed_heating.Light()
    rows = pulsed_heating.exact_rows(pulsed_heating.Light(pulsed_heating.PRINTED_DIFFUSIVITY))
    for dimension, spacings in ((1, (1.0, 0.5)), (3, (1.0,))):
        found = {d: pulsed_heating.single(tmp_path, dimension, d) for d in spacings}
        rows += pulsed_heating.spacing_rows(light, dimension, found)
    report = Report("pulsed-heating", "", tuple(rows))
    assert report.passed, report.table()


def test_time_steps(tmp_path):
    """0.5 ns stays bounded, 1 ns diverges, as published."""
    found = {step: pulsed_heating.with_fixed_step(tmp_path, step) for step in (0.5, 1.0)}
    assert pulsed_heating.is_bounded(found[0.5])
    assert not pulsed_heating.is_bounded(found[1.0])


def test_gaussian_pulse(tmp_path, monkeypatch):
    """The uniform beam within 0.3 % of the rise."""
    one = {"steel 1-D": ("dlip-steel", [*gaussian_pulse.QUICK["steel 1-D"][1], "time.end=46 ns"])}
    monkeypatch.setattr(gaussian_pulse, "QUICK", one)
    report = gaussian_pulse.run(tmp_path, quick=True)
    assert report.passed, report.table()


@pytest.mark.parametrize("label", METALS)
def test_tables_of_the_paper(label):
    """Tables 4 and 5 from the shipped materials."""
    rows = table_rows(label, METALS[label], quick=True)
    assert Report(label, "", tuple(rows)).passed, Report(label, "", tuple(rows)).table()


def test_columns_of_25_nm_give_the_widths_of_the_reference():
    """The spread between f_m > 0 and f_m = 1 in the reference is that of its columns."""
    metal = METALS["steel"]
    found = 1e9 * np.array(Columns(load_case(metal.case), 25e-9).widest())
    np.testing.assert_allclose(found, (2975, 2909, 2875), atol=1.0)
    np.testing.assert_allclose(found, metal.widths, atol=12.5)


SHORT = ["particles.spacing=2 um", "time.end=4 ns", "time.step=2 ns"]


def test_runs_are_kept(tmp_path):
    """A finished run is taken as it is, an interrupted one is finished."""
    first = runs.computed("stefan", SHORT, tmp_path, "short")
    summary = first.path / "summary.json"
    before = summary.stat().st_mtime_ns
    runs.computed("stefan", SHORT, tmp_path, "short")
    assert summary.stat().st_mtime_ns == before
    kept = summary.read_text()
    summary.unlink()
    again = runs.computed("stefan", SHORT, tmp_path, "short")
    assert again.is_complete
    assert "temperature_max_K" in kept


@pytest.mark.parametrize("why", ["other case", "other sources"])
def test_runs_of_other_sources_or_cases_are_computed_anew(tmp_path, monkeypatch, why):
    """What another case or another version of the program computed is never judged."""
    first = runs.computed("stefan", SHORT, tmp_path, "short")
    (first.path / "old.txt").write_text("of the first run")
    settings = SHORT[:2] if why == "other case" else SHORT
    if why == "other sources":
        monkeypatch.setattr(runs, "_sources", lambda: "edited")
    second = runs.computed("stefan", settings, tmp_path, "short")
    assert second.path == first.path
    assert not (first.path / "old.txt").exists()


def test_a_folder_that_is_no_run_is_kept(tmp_path):
    """Somebody's files are not removed."""
    other = tmp_path / "runs" / "notes"
    other.mkdir(parents=True)
    (other / "notes.txt").write_text("mine")
    with pytest.raises(CaseError, match="not a run folder"):
        runs.computed("stefan", SHORT, tmp_path, "notes")
    assert (other / "notes.txt").exists()


def test_threads_of_a_validation(tmp_path):
    """Runs use as many threads as asked for."""
    with runs.computing(1):
        assert runs.computed("stefan", SHORT, tmp_path, "one").summary["threads"] == 1


def test_runs_of_backends_are_told_apart():
    """What one backend computed is not taken for the other's."""
    case = load_case("stefan", SHORT)
    with runs.computing(None, "cuda"):
        other = runs.fingerprint(case)
    assert other != runs.fingerprint(case) and "backend cuda" in other


@pytest.mark.validate
@pytest.mark.parametrize("name", names())
def test_in_full(tmp_path, name):
    """Every validation as `lasersph validate` runs it; hours for dlip-thermal."""
    report = validate(name, tmp_path)
    assert report.passed, report.table()
