"""Records of a made-up validation: when they are current, stale, confirmed, failed."""

import json

import pytest

from lasersph import validation
from lasersph.case import load_case
from lasersph.validation import records, sources

FILES = {
    "README.md": "# Does a number hold?\n",
    "case.toml": 'order = 1\ncase = "stefan"\ncount = 2\nvalue = 4.0\n[quick]\ncount = 1\n',
    "rows.toml": '[number]\nquantity = "number {k}"\nband = "1 %"\n[shown]\nquantity = "shown"\n',
    "reference.csv": "value\n4.0\n",
    "rows.py": """
from lasersph.validation.drawing import Panel, line

FACTOR = 1.0


def compare(study):
    study.case("time.end=4 ns")
    (reference,) = study.table()["value"]
    for k in range(study.plan.count):
        study.add("number", FACTOR * study.plan.value, reference, k=k)
    study.add("shown", 7.0)
    study.draw("numbers", Panel("x", "y", [line([0, 1], [0, 1])]))
""",
}


@pytest.fixture
def home(tmp_path, monkeypatch):
    """Folder of a validation "number"."""
    folder = tmp_path / "number"
    folder.mkdir()
    for name, text in FILES.items():
        (folder / name).write_text(text)
    monkeypatch.setattr("lasersph.validation.__path__", [*validation.__path__, str(tmp_path)])
    for module in ("registry", "study"):
        monkeypatch.setattr(f"lasersph.validation.{module}.HOME", tmp_path)
    of_package = sources._file
    file_of = {"lasersph.validation.number.rows": folder / "rows.py"}
    monkeypatch.setattr(sources, "_file", lambda m: file_of.get(m) or of_package(m))
    return folder


@pytest.fixture
def state(tmp_path, home):
    """State of the record in a folder; it is computed first."""
    records.make_record("number", tmp_path / "records", tmp_path / "runs")
    return lambda: records.state_of("number", tmp_path / "records")


def edit(file, old, new):
    """Change a text of the validation."""
    assert old in file.read_text()
    file.write_text(file.read_text().replace(old, new))


def change_module(monkeypatch):
    """Let the module that judges have another text."""
    of_text = sources._hash
    judges = "lasersph.validation.comparison"
    monkeypatch.setattr(sources, "_hash", lambda m: "other" if m == judges else of_text(m))
    return judges


def test_a_record(state, tmp_path):
    """All that is said of it is stored, and nothing is to be computed again."""
    found = state()
    assert (found.word, found.changes, found.is_out_of_date) == ("current", (), False)
    record = json.loads((tmp_path / "records" / "number.json").read_text())
    assert [row["computed"] for row in record["rows"]] == [4.0, 4.0, 7.0]
    assert [row["computed"] for row in record["short"]["rows"]] == [4.0, 7.0]
    made = record["computed"]
    assert {"date", "lasersph", "machine", "commit", "backend", "threads"} <= set(made)
    assert list(made["cases"]) == ['["stefan", "time.end=4 ns"]']
    assert record["seconds"] > 0.0
    assert (tmp_path / "records" / "number" / record["figures"][0]).is_file()
    assert records.state_of("number", tmp_path).word == "missing"


def test_words_of_bands_make_nothing_stale(state, home):
    """A reason that is written later is shown with the stored numbers."""
    edit(home / "rows.toml", "band", 'reason = "a guess"\nband')
    assert state().word == "current"
    assert state().record["rows"][0]["reason"] == "a guess"


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [("rows.toml", "1 %", "2 %"), ("case.toml", "count = 1", "count = 2"),
     ("reference.csv", "4.0", "4.01")],
)  # fmt: skip
def test_own_tables_are_computed_anew(state, home, tmp_path, file, old, new):
    """What a validation asks for is stale where it changed, and no shortened form confirms it."""
    edit(home / file, old, new)
    assert (state().word, state().changes) == ("stale", (f"own {file}",))
    found = records.confirm(state(), tmp_path / "records", tmp_path / "runs")
    assert found == [f"changed: own {file}"] and state().word == "stale"


def test_a_changed_module_is_confirmed(state, tmp_path, monkeypatch):
    """The shortened form gives the stored numbers again."""
    judges = change_module(monkeypatch)
    assert (state().word, state().changes) == ("stale", (judges,))
    assert judges in state().text
    assert records.confirm(state(), tmp_path / "records", tmp_path / "runs") == []
    assert state().word == "confirmed" and not state().is_out_of_date


def test_other_numbers_are_not_confirmed(state, home, tmp_path, monkeypatch):
    """A number that moved by 1e-6 is another one; one moved by 1e-12 is the same."""
    change_module(monkeypatch)
    where = "lasersph.validation.number.rows.FACTOR"
    monkeypatch.setattr(where, 1.0 + 1e-6)
    found = records.confirm(state(), tmp_path / "records", tmp_path / "runs")
    assert found == ["number 0"] and state().word == "stale"
    monkeypatch.setattr(where, 1.0 + 1e-12)
    assert records.confirm(state(), tmp_path / "records", tmp_path / "runs") == []


@pytest.mark.parametrize(
    ("setting", "change"),
    [
        ("time.step=3 ns", "case stefan"),
        ("material.density=2000 kg/m^3", "material aluminium-aa6014"),
    ],
)
def test_a_changed_case(state, monkeypatch, setting, change):
    """The case and its material are told apart."""
    monkeypatch.setattr(records, "load_case", lambda n, s: load_case(n, [*s, setting]))
    assert (state().word, state().changes) == ("stale", (change,))


def test_failed(state, home, tmp_path):
    """A number outside its band, and a validation that breaks off, are stored as failed."""
    edit(home / "case.toml", "4.0", "5.0")
    records.make_record("number", tmp_path / "records", tmp_path / "runs")
    assert state().word == "failed" and "2 of 2 judged not met" in state().text
    edit(home / "case.toml", "value", "other")
    records.make_record("number", tmp_path / "records", tmp_path / "runs")
    assert state().word == "failed" and "broke off: AttributeError" in state().text
    found = records.confirm(state(), tmp_path / "records", tmp_path / "runs")
    assert found == ["it has no shortened form"]
