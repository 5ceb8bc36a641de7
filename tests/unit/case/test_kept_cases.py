"""Cases kept in run folders: with the settings and the files that they were started with."""

from pathlib import Path

import pytest

from lasersph.case import load_case
from lasersph.input.document import split_settings


def test_run_folder_stands_for_its_case(tmp_path):
    """The folder of a run is a case: with the settings of the run, under its own name; settings
    given beside them win, and what is kept again has them all once."""
    settings = ["laser.fluence=0.7 J/cm^2", "time.end=90 ns"]
    case = load_case("dlip-steel", settings)
    folder = tmp_path / "steel-7"
    folder.mkdir()
    (folder / "case.toml").write_text(case.text, encoding="utf-8")
    again = load_case(folder)
    assert (again.hash(), again.text, again.name) == (case.hash(), case.text, "steel-7")
    later = load_case(folder, ["time.end=100 ns"])
    assert later.time.end == pytest.approx(100e-9)
    assert split_settings(later.text)[0] == [*settings, "time.end=100 ns"]
    assert load_case(folder / "case.toml").time.end != again.time.end  # the file as it was given


def test_files_of_settings_lie_where_the_command_runs(tmp_path, monkeypatch):
    """A table of powers named by --set counts from here, as a material does, inside a table, too;
    the kept case finds it from anywhere."""
    monkeypatch.chdir(tmp_path)
    Path("power.csv").write_text("t,power\n0,0\n1e-8,1\n2e-8,1\n3e-8,0\n", encoding="utf-8")
    inside = "laser.pulse={ kind = 'tabulated', path = 'power.csv' }"
    case = load_case("spot-steel", [inside])
    assert f"laser.pulse.path={tmp_path / 'power.csv'}" in split_settings(case.text)[0]
    (tmp_path / "run").mkdir()
    Path("run/case.toml").write_text(case.text, encoding="utf-8")
    monkeypatch.chdir("/")
    assert load_case(tmp_path / "run").hash() == case.hash()
