"""Case files of schema version 1: the same cases as today's, with one line that says what moved."""

from pathlib import Path

import pytest

from lasersph.case import load_case
from lasersph.cli import main
from lasersph.input import CaseError

FOLDER = Path(__file__).parent / "version-1"
MOVED = {
    "lid-driven-cavity": "flow is solver.flow, time.steady is solver.steady",
    "ablation-aluminium": "ejection is solver.ejection",
    "dam-break": "vessel is solver.vessel, motion is solver.motion",
    "sound-wave": "motion is solver.motion",
}

SINCE = {
    "lid-driven-cavity": ("solver.frame=", "solver.shifting=0.01", "particles.support_ratio=3.1")
}
"""What shipped cases ask for otherwise since then, as it was."""


@pytest.mark.parametrize("name", MOVED)
def test_the_same_case(name):
    """Equal in every key to the shipped one, and said what moved; today's file says nothing."""
    since = SINCE.get(name, ())
    old, new = load_case(FOLDER / f"{name}.toml"), load_case(name, since)
    assert old.hash() == new.hash()
    assert old.conversion_note == f"read as schema version 2: {MOVED[name]}"
    assert new.conversion_note == ""


def test_check_says_it_once(capsys):
    """One line beside what `check` prints."""
    assert main(["check", str(FOLDER / "sound-wave.toml")]) == 0
    said = capsys.readouterr().err.splitlines()
    assert said == ["note: read as schema version 2: motion is solver.motion"]


def test_settings_by_their_old_names():
    """`--set` understands both names, in files of both versions, and removes as well."""
    for file in ("lid-driven-cavity", FOLDER / "lid-driven-cavity.toml"):
        case = load_case(file, ["flow.surface.velocity=2 m/s", "time.steady="])
        assert case.flow is not None and case.flow.surface.velocity == 2.0
        assert case.solver.steady is None
        assert "flow.surface.velocity is solver.flow.surface.velocity" in case.conversion_note


def test_mistakes_have_the_line_of_the_file(tmp_path):
    """A wrong value in a table that moved is found where it stands; new files are strict."""
    text = (FOLDER / "sound-wave.toml").read_text(encoding="utf-8")
    file = tmp_path / "case.toml"
    file.write_text(text.replace('"1 m/s"', '"1 m"'), encoding="utf-8")
    with pytest.raises(CaseError, match=r"case.toml:26: solver.motion.amplitude: "):
        load_case(file)
    file.write_text(text.replace("schema_version = 1", "schema_version = 2"), encoding="utf-8")
    with pytest.raises(CaseError, match=r'motion: unknown key; do you mean "solver.motion"'):
        load_case(file)


def test_a_key_of_another_name(tmp_path):
    """`solver.sleep` is `solver.active_region`, in a file of version 1 and with `--set`."""
    old = FOLDER / "ablation-aluminium.toml"
    file = tmp_path / "case.toml"
    text = old.read_text(encoding="utf-8")
    file.write_text(text.replace('kind = "ablation"', 'kind = "ablation"\nsleep = false'), "utf-8")
    for case in (load_case(file), load_case("ablation-aluminium", ["solver.sleep=false"])):
        assert not case.solver.active_region
        assert "solver.sleep is solver.active_region" in case.conversion_note
