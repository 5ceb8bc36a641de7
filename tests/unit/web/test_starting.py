"""Runs that the page checks, starts, stops and resumes, and what it refuses."""

import os
import re

import pytest
from starlette.testclient import TestClient
from synthetic_run import make_run

from lasersph.case import Case, available_cases
from lasersph.input.schema import described
from lasersph.output.folder_lock import FolderLock
from lasersph.web.folder_list import id_of
from lasersph.web.form import form_of
from lasersph.web.server import Pages, make_app
from lasersph.web.starting import StartingPages

TOKEN = "a token of some length"


def browser_of(root, pages):
    """A browser that has the token."""
    return TestClient(
        make_app(root, token=TOKEN, pages=pages),
        base_url="http://127.0.0.1",
        headers={"authorization": f"Bearer {TOKEN}"},
        raise_server_exceptions=False,
    )


@pytest.fixture
def browser(tmp_path):
    """Of a server that may start runs in an empty folder."""
    return browser_of(tmp_path, StartingPages(tmp_path))


def asked(case="stefan", settings=(), name="new"):
    """What the form sends."""
    return {"case": case, "settings": list(settings), "name": name}


def test_without_leave_nothing_is_started(tmp_path):
    """The addresses are not there."""
    browser = browser_of(tmp_path, Pages(tmp_path))
    for path in ("/api/check", "/api/start", "/api/run/x/stop", "/api/run/x/resume"):
        assert browser.post(path, json=asked()).status_code in (404, 405)
    assert browser.get("/api/form/stefan").status_code == 404


def test_form_has_units_help_and_choices(browser):
    """From the schema, with the values as the case writes them."""
    fields = {one["key"]: one for one in browser.get("/api/form/dlip-steel").json()["fields"]}
    assert fields["laser.fluence"]["value"] == "0.6 J/cm^2"
    assert fields["laser.fluence"]["kind"] == "fluence"
    assert fields["laser.fluence_kind"]["choices"] == ["mean", "peak"]
    assert fields["solver.plateau"]["help"]
    assert fields["laser.wavelength"]["value"] == ""
    assert browser.get("/api/form/..").status_code == 404
    assert {"gaussian", "top-hat"} <= set(fields["laser.beam.kind"]["choices"])
    asked = browser.get("/api/form/dlip-steel", params={"set": "laser.beam.kind=gaussian"}).json()
    others = {one["key"]: one for one in asked["fields"]}
    assert not others["laser.beam.period"]["is_known"]
    assert others["laser.beam.radius_1e2"]["is_known"]
    assert browser.get("/api/form/dlip-steel", params={"set": "laser"}).status_code == 400
    probes = fields["probes"]["list"]
    assert [one["name"] for one in probes["columns"]] == ["name", "depth", "x", "y", "method"]
    assert probes["rows"][1] == ["minimum", "0 nm", "2.5 um", "", "even"]
    assert probes["columns"][1]["unit"] == "m" and probes["columns"][4]["choices"]
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
    for case in available_cases():
        for field in form_of(case)["fields"]:
            assert field["help"], (case, field["key"])
            has_unit = re.fullmatch(r"[-+]?[\d.]+(e[-+]?\d+)? +[a-zA-Z%].*", field["value"])
            assert not has_unit or field["unit"], (case, field["key"])
            for column in field.get("list", {}).get("columns", ()):
                assert column["help"] or not column["name"], (case, field["key"], column["name"])


def test_check_names_the_key_and_what_is_right(browser):
    """The words of `lasersph check`, and its forecast where all is right."""
    wrong = browser.post("/api/check", json=asked("dlip-steel", ["laser.fluence=3 kg"])).json()
    assert wrong["problems"][0]["key"] == "laser.fluence"
    assert "J/cm^2" in wrong["problems"][0]["text"]
    right = browser.post("/api/check", json=asked("dlip-steel")).json()
    assert right["problems"] == []
    assert dict(right["forecast"])["particles"] == "17110"


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
