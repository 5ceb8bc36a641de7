"""Runs that the page checks, starts, stops and resumes, and what it refuses."""

import os
import re

import pytest
from own_case import OWN_CASE
from page_client import browser_of
from reliability_runs import wait_for
from synthetic_run import CASE_TEXT, make_run

from lasersph.case import Case, available_cases
from lasersph.input.schema import described
from lasersph.output.folder_lock import FolderLock
from lasersph.web.case_source import CaseSource
from lasersph.web.folder_list import id_of
from lasersph.web.form import form_of
from lasersph.web.server import Pages
from lasersph.web.starting import StartingPages


def wait_for_the_end(folder):
    """Until a run that was started is complete."""
    wait_for((folder / "report.html").exists)


@pytest.fixture
def browser(tmp_path):
    """Of a server that may start runs in an empty folder."""
    return browser_of(tmp_path, StartingPages(tmp_path))


def fields_of(browser, content):
    """Fields of a form by key."""
    return {one["key"]: one for one in browser.post("/api/form", json=content).json()["fields"]}


def asked(case="stefan", settings=(), name="new"):
    """What the form sends."""
    return {"case": case, "settings": list(settings), "name": name}


def test_without_leave_nothing_is_started(tmp_path):
    """The addresses are not there."""
    browser = browser_of(tmp_path, Pages(tmp_path))
    for path in ("/api/check", "/api/start", "/api/run/x/stop", "/api/run/x/resume"):
        assert browser.post(path, json=asked()).status_code in (404, 405)
    assert browser.post("/api/form", json=asked()).status_code in (404, 405)


def test_form_has_units_help_and_choices(browser):
    """From the schema, with the values as the case writes them."""
    fields = fields_of(browser, {"case": "dlip-steel"})
    assert fields["laser.fluence"]["value"] == "0.6 J/cm^2"
    assert fields["laser.fluence"]["kind"] == "fluence"
    assert fields["laser.fluence_kind"]["choices"] == ["mean", "peak"]
    assert fields["solver.plateau"]["help"]
    assert fields["laser.wavelength"]["value"] == ""
    assert browser.post("/api/form", json={"case": ".."}).status_code == 404
    assert {"gaussian", "top-hat"} <= set(fields["laser.beam.kind"]["choices"])
    wanted = {"case": "dlip-steel", "settings": ["laser.beam.kind=gaussian"]}
    others = fields_of(browser, wanted)
    assert others["laser.beam.period"]["is_left"]
    assert not others["laser.beam.radius_1e2"]["is_left"]
    assert others["laser.beam.kind"]["given"] == "interference"
    assert browser.post("/api/form", json=wanted | {"settings": ["laser"]}).status_code == 400
    probes = fields["probes"]["list"]
    assert [one["name"] for one in probes["columns"]] == ["name", "depth", "x", "y", "method"]
    assert probes["rows"][1] == ["minimum", "0 nm", "2.5 um", "", "even"]
    assert probes["columns"][1]["unit"] == "nm" and probes["columns"][4]["choices"]
    assert probes["given"] == probes["rows"]
    shapes = {key: one["list"]["shape"] for key, one in fields.items() if "list" in one}
    assert shapes["laser.position"] == "row" and shapes["output.snapshots.times"] == "values"
    assert not fields["output.snapshots.times"]["list"]["rows"]
    # what a kind means is what its table says
    assert fields["laser.beam.kind"]["help"].startswith("n-wave interference")
    assert "2 r^2/w^2" in others["laser.beam.kind"]["help"]


def test_every_key_of_a_case_has_its_help_and_its_unit():
    """Of all kinds of its tables; what a shipped case writes with a unit is shown with one."""
    schema = Case.model_json_schema()
    definitions = schema["$defs"]
    for name, part in [("Case", schema), *definitions.items()]:
        about, meanings = described(part)
        for key, value in part.get("properties", {}).items():
            is_told = meanings.get(key) or value.get("description")
            tables = re.findall(r"#/\$defs/(\w+)", str(value))
            is_told = is_told or any(described(definitions[one])[0] for one in tables)
            assert is_told or ("const" in value and about) or key == "schema_version", (name, key)
    for case, path in available_cases().items():
        for field in form_of(CaseSource(path, case))["fields"]:
            assert field["help"], (case, field["key"])
            has_unit = re.fullmatch(r"[-+]?[\d.]+(e[-+]?\d+)? +[a-zA-Z%].*", field["value"])
            assert not has_unit or field["unit"], (case, field["key"])
            for column in field.get("list", {}).get("columns", ()):
                assert column["help"] or not column["name"], (case, field["key"], column["name"])


def test_units_are_those_of_the_case(browser):
    """As it writes them; of a key that is not given those of others of its kind."""
    fields = fields_of(browser, {"case": "dlip-steel"})
    assert fields["laser.fluence"]["unit"] == "J/cm^2"
    assert fields["time.end"]["unit"] == fields["output.snapshots.interval"]["unit"] == "ns"
    assert fields["laser.wavelength"]["value"] == ""
    assert fields["laser.wavelength"]["unit"] == "um"  # as of the period
    text = CASE_TEXT.replace('"0.6 J/cm^2"', '"6 kJ/m^2"')
    assert fields_of(browser, {"text": text})["laser.fluence"]["unit"] == "kJ/m^2"


def test_check_names_the_key_and_what_is_right(browser):
    """The words of `lasersph check`, and its forecast where all is right."""
    wrong = browser.post("/api/check", json=asked("dlip-steel", ["laser.fluence=3 kg"])).json()
    assert wrong["problems"][0]["key"] == "laser.fluence"
    assert "J/cm^2" in wrong["problems"][0]["text"]
    right = browser.post("/api/check", json=asked("dlip-steel")).json()
    assert right["problems"] == []
    assert dict(right["forecast"])["particles"] == "17110"
    assert "this machine has" in dict(right["forecast"])["memory"]


def test_case_that_is_too_coarse_for_its_flow_is_not_started(browser):
    """As `lasersph run` without --anyway."""
    coarse = asked("spot-weld", ["particles.spacing=12 um"])
    (problem,) = browser.post("/api/check", json=coarse).json()["problems"]
    assert problem["key"] == "particles.spacing" and "will be off" in problem["text"]


def test_case_that_is_too_large_is_not_started(browser, tmp_path):
    """Refused before it runs, in the words of `lasersph check`."""
    finer = asked("dlip-steel", ["particles.spacing=0.1 nm"])
    (problem,) = browser.post("/api/check", json=finer).json()["problems"]
    assert problem["key"] == "particles.spacing" and "this machine has" in problem["text"]
    assert "lasersph run --anyway" in problem["text"]  # what a terminal can still do
    answer = browser.post("/api/start", json=finer)
    assert answer.status_code == 400 and "this machine has" in answer.json()["error"]
    assert not any(tmp_path.iterdir())


def test_own_case_below_the_folder(browser, tmp_path):
    """By its path; a mistake is told with its line."""
    (tmp_path / "cases").mkdir()
    (tmp_path / "cases" / "mine.toml").write_text(OWN_CASE)
    found = browser.post("/api/form", json={"file": "cases/mine.toml"}).json()
    assert found["name"] == "mine" and found["settings"] == []
    fields = {one["key"]: one for one in found["fields"]}
    assert fields["particles.spacing"]["value"] == "40 nm"
    wrong = OWN_CASE.replace('"40 nm"', '"40 kg"').replace("[time]", '[time]\nstopp = "1 ns"')
    (tmp_path / "cases" / "mine.toml").write_text(wrong)
    problems = browser.post("/api/check", json={"file": "cases/mine.toml"}).json()["problems"]
    lines = wrong.splitlines()
    assert {one["key"] for one in problems} >= {"particles.spacing", "time.stopp"}
    for one in problems:
        assert one["key"].split(".")[-1] in lines[one["line"] - 1]
    # a key that no case has stays in the form until somebody takes it out
    fields = fields_of(browser, {"file": "cases/mine.toml"})
    assert not fields["time.stopp"]["is_left"] and fields["time.stopp"]["value"] == "1 ns"


@pytest.mark.parametrize(
    "name",
    [
        "../outside.toml",
        "/etc/hostname",
        "cases/../../outside.toml",
        "linked.toml",
        "linked/outside.toml",
        "a\x00.toml",
        "notes.txt",
        "missing.toml",
        "",
        ".",
        "x" * 5000,
    ],
)
def test_files_lead_nowhere_else(tmp_path, name):
    """Nothing beside case files below the folder is read, not even told to be there."""
    (tmp_path / "outside.toml").write_text("secret = 1\n")
    root = tmp_path / "runs"
    root.mkdir()
    (root / "notes.txt").write_text("secret")
    (root / "linked.toml").symlink_to(tmp_path / "outside.toml")
    (root / "linked").symlink_to(tmp_path)
    browser = browser_of(root, StartingPages(root))
    for path in ("/api/form", "/api/check", "/api/start"):
        answer = browser.post(path, json={"file": name, "name": "new"})
        assert answer.status_code == 400
        assert "\n" not in answer.json()["error"] and "secret" not in answer.text


def test_text_of_a_case_is_refused_in_one_line_or_started(browser, tmp_path):
    """Text that is no case says its line; one that is right is an ordinary run."""
    for text, words in [
        ('title = "mine"\n[laser\n', "line 2: "),
        ('case = "dlip-steel"\n[vary]\n', "a plan for many runs, not a case"),
        ("\x00", "line 1: "),
    ]:
        error = browser.post("/api/form", json={"text": text}).json()["error"]
        assert words in error and "\n" not in error and "tmp" not in error
    assert browser.post("/api/form", json={"text": "x" * 70_000}).status_code == 413
    answer = browser.post("/api/start", json={"text": OWN_CASE, "name": "mine", "settings": []})
    folder = tmp_path / "mine"
    assert answer.json()["id"] == id_of("mine") and (folder / "case.toml").read_text() == OWN_CASE
    wait_for_the_end(folder)
    again = browser.post("/api/form", json={"run": id_of("mine")}).json()
    assert again["name"] == "mine" and again["settings"] == []


def test_text_with_a_metal_of_its_own_asks_for_the_whole_path(browser, tmp_path):
    """The server has the text alone: no file lies beside it."""
    text = re.sub(r"(?m)^material = .*", 'material = "own.toml"', OWN_CASE)
    found = browser.post("/api/check", json={"text": text, "settings": []}).json()
    (problem,) = found["problems"]
    assert problem["text"] == "own.toml: no such file here: write its whole path"


def test_run_again_begins_with_what_was_changed(browser, tmp_path):
    """The case file of a run with its overrides; they stand once in the case.toml of the next."""
    begun = asked(settings=["time.end=20 ns"], name="first")
    assert browser.post("/api/start", json=begun).status_code == 200
    wait_for_the_end(tmp_path / "first")
    first = {"run": id_of("first")}
    found = browser.post("/api/form", json=first).json()
    assert found["settings"] == ["time.end=20 ns"]
    end = next(one for one in found["fields"] if one["key"] == "time.end")
    assert (end["value"], end["given"]) == ("20 ns", "1 us")
    assert browser.post("/api/check", json=first).json()["problems"] == []
    answer = browser.post(
        "/api/start", json=first | {"settings": ["time.end=10 ns"], "name": "second"}
    )
    assert answer.status_code == 200
    wait_for_the_end(tmp_path / "second")
    text = (tmp_path / "second" / "case.toml").read_text()
    assert text.count("# --set") == 1 and text.startswith("# --set time.end=10 ns\n")
    chips = browser.get(f"/api/run/{id_of('second')}").json()["changes"]
    assert chips == [{"key": "time.end", "was": "1 us", "now": "10 ns"}]


def test_run_without_a_case_file_says_so(browser, tmp_path):
    """As those of a study; and of a folder that holds a link nothing is read."""
    folder = make_run(tmp_path / "run")
    (folder / "case.toml").write_text("# Built in Python: all values are in resolved.json.\n")
    answer = browser.post("/api/form", json={"run": id_of("run")})
    assert answer.status_code == 422 and "has no case file" in answer.json()["error"]
    (folder / "case.toml").unlink()
    (folder / "case.toml").symlink_to("/etc/hostname")
    answer = browser.post("/api/form", json={"run": id_of("run")})
    assert answer.status_code == 422 and "link" in answer.json()["error"]
    assert browser.post("/api/form", json={"run": "0" * 12}).status_code == 404
    assert (
        browser.post("/api/form", json={"run": id_of("run"), "text": OWN_CASE}).status_code == 400
    )


@pytest.mark.parametrize(
    "name", ["..", "../new", "a/b", "", ".hidden", "-x", "a" * 65, "a\x00", "taken"]
)
def test_names_lead_nowhere_else(browser, tmp_path, name):
    """A new folder below the folder of runs, or none."""
    (tmp_path / "taken").mkdir()
    answer = browser.post("/api/start", json=asked(name=name))
    assert answer.status_code == 400 and answer.json()["error"]
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


@pytest.mark.parametrize(
    "content",
    [[], "x", {}, {"case": 3}, asked(settings=[1]), asked(settings=["a=1"] * 201), asked(case="x")],
)
def test_odd_requests_are_refused(browser, tmp_path, content):
    """No failure of the server, nothing started."""
    for path in ("/api/check", "/api/start"):
        assert browser.post(path, json=content).status_code in (400, 404)
    assert not any(tmp_path.iterdir())


def test_wrong_case_is_not_started(browser, tmp_path):
    """It says why."""
    answer = browser.post("/api/start", json=asked(settings=["particles.spacing=-1 um"]))
    assert answer.status_code == 400 and answer.json()["error"]
    assert not any(tmp_path.iterdir())


def test_only_a_process_that_computes_is_stopped(browser, tmp_path):
    """No other process gets a signal, whatever the file of the lock says."""
    folder = make_run(tmp_path / "run", complete=False)
    path = f"/api/run/{id_of('run')}"
    assert browser.post(f"{path}/stop").status_code == 422
    (folder / ".lock").write_text(f'{{"process": {os.getppid()}, "machine": "another"}}')
    answer = browser.post(f"{path}/stop")
    assert answer.status_code == 422 and "stop it there" in answer.json()["error"]
    for number in (-1, 0, 1, '"7"'):
        (folder / ".lock").write_text(f'{{"process": {number}, "machine": "another"}}')
        assert browser.post(f"{path}/stop").status_code == 422


def test_computed_run_is_not_resumed(browser, tmp_path):
    """One process at a time."""
    folder = make_run(tmp_path / "run", complete=False)
    lock = FolderLock(folder)
    answer = browser.post(f"/api/run/{id_of('run')}/resume")
    lock.release()
    assert answer.status_code == 422 and "computed already" in answer.json()["error"]


def test_run_that_cannot_be_resumed_says_why(browser, tmp_path):
    """The words of the command."""
    make_run(tmp_path / "run", complete=False)
    answer = browser.post(f"/api/run/{id_of('run')}/resume")
    assert answer.status_code == 422 and "lasersph:" in answer.json()["error"]
