"""`lasersph validate`: verdicts, exit codes, records."""

import json
import re
from pathlib import Path
from types import SimpleNamespace

import pytest
from command_line import said

from lasersph.cli import main

pytestmark = pytest.mark.usefixtures("in_empty_folder")


class FakeReport:
    """A validation result with a verdict."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.passed = name == "good"

    def table(self) -> str:
        """The text printed."""
        return f"table of {self.name}"

    def as_dict(self) -> dict:
        """The content of the JSON file."""
        return {"name": self.name, "passed": self.passed}


def test_validate(monkeypatch, capsys):
    """Tables and JSON of every validation; exit code 1 where one did not pass."""
    folders = []

    def fake(name, folder, *, quick, threads, backend):
        folders.append((str(folder), quick, threads, backend))
        return FakeReport(name)

    for place in ("lasersph.validation.names", "lasersph.validation.registry.names"):
        monkeypatch.setattr(place, lambda: ("good", "bad"))
    monkeypatch.setattr("lasersph.validation.titles", lambda: {"good": "A?", "bad": "B?"})
    monkeypatch.setattr("lasersph.validation.validate", fake)
    assert said(capsys, "validate", "--list") == "good  A?\nbad   B?\n"
    assert "1 of 1 passed" in said(capsys, "validate", "good", "good", "--quick")
    assert folders == [("runs/validation/short/good", True, None, "cpu")]
    for form in ([], ["--quick"]):
        assert main(["validate", *form]) == 2
        assert re.search(r"2 (shortened )?validations.*give names", capsys.readouterr().err)
    assert len(folders) == 1
    text = said(
        capsys, "validate", "--all", "--json", "all.json", "--out", "v", "--threads", "1", code=1
    )
    assert "table of bad" in text and "not passed: bad" in text
    assert folders[1:] == [("v/good", False, 1, "cpu"), ("v/bad", False, 1, "cpu")]
    content = json.loads(Path("all.json").read_text())
    assert content["passed"] is False and content["schema_version"] == 1
    assert content["backend"] == "cpu"
    assert list(content["validations"]) == ["good", "bad"]
    assert main(["validate", "goood"]) == 2
    assert 'do you mean "good"' in capsys.readouterr().err
    assert main(["validate", "good", "--json", "none/all.json"]) == 1
    assert "cannot write none/all.json" in capsys.readouterr().err


def test_records_of_validations(monkeypatch, capsys):
    """What is out of date is computed or confirmed, nothing else; exit code 1 while any is."""
    words = {"kernels": "current", "stefan": "stale", "sound-wave": "missing"}
    done = []

    def state(name, folder):
        record = None if words[name] == "missing" else {"passed": True}
        changes = ("case stefan",) if words[name] == "stale" else ()
        return SimpleNamespace(
            name=name, word=words[name], text="", record=record, changes=changes,
            is_out_of_date=record is None or bool(changes),
        )  # fmt: skip

    def make(name, folder, out, *, threads, backend):
        done.append((name, str(folder), str(out)))
        words[name] = "current"

    monkeypatch.setattr("lasersph.validation.names", lambda: tuple(words))
    monkeypatch.setattr("lasersph.validation.records.state_of", state)
    monkeypatch.setattr("lasersph.validation.records.make_record", make)
    monkeypatch.setattr("lasersph.validation.records.confirm", lambda *_, threads: ["front"])
    text = said(capsys, "validate", "--status", code=1)
    assert text.splitlines()[3].split() == ["stefan", "stale"]
    text = said(capsys, "validate", "--confirm", "--record", "r", code=1)
    assert "stefan: not confirmed: front" in text and "kernels: " not in text
    said(capsys, "validate", "--all", "--record", "r")
    assert done == [(n, "r", "runs/validation") for n in ("stefan", "sound-wave")]
    assert said(capsys, "validate", "--status")
    for wrong in (["kernels", "--all"], ["--status", "--quick"], ["--status", "--confirm"]):
        assert main(["validate", *wrong]) == 2
