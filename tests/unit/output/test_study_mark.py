"""The mark that runs of a threshold belong together."""

import json

import pytest

from lasersph import studies
from lasersph.cli import main
from lasersph.output import OutputError
from lasersph.output.study_mark import STUDY, StudyMark, read_mark

MARK = StudyMark("threshold", "threshold of dlip-steel to melt", "laser.fluence", "J/m^2")


def test_written_and_read(tmp_path):
    """The same mark; none in another folder; a damaged one is one line."""
    MARK.write(tmp_path / "study")
    assert read_mark(tmp_path / "study") == MARK
    assert read_mark(tmp_path) is None
    (tmp_path / "study" / STUDY).write_text("{}")
    with pytest.raises(OutputError, match="it misses 'kind'"):
        read_mark(tmp_path / "study")


def test_what_changed_in_a_run(tmp_path):
    """The key of the study with the value of the run, in field units."""
    content = {"case": {"laser": {"fluence": 4406.25}}}
    (tmp_path / "resolved.json").write_text(json.dumps(content))
    assert MARK.changed(tmp_path) == "fluence 0.4406 J/cm²"
    (tmp_path / "resolved.json").write_text('{"case": {"laser": null}}')
    assert MARK.changed(tmp_path) == ""


def test_threshold_marks_its_folder(tmp_path, monkeypatch):
    """Before its first run, so that a page can show it as one study from the beginning."""

    def look(case, of, folder, **options):
        assert read_mark(folder) == MARK
        raise ValueError("looked at")

    monkeypatch.setattr(studies, "threshold", look)
    assert main(["threshold", "dlip-steel", "--of", "melt", "--out", str(tmp_path / "t")]) != 0
    assert read_mark(tmp_path / "t") == MARK
