"""The addresses of the page: what they answer, and that hostile ones lead nowhere."""

import json
import os
import re
import shutil

import pytest
from page_client import TOKEN, cards
from starlette.testclient import TestClient

from lasersph.output import open_run
from lasersph.output.folder_lock import FolderLock
from lasersph.web.folder_list import id_of
from lasersph.web.server import STATIC, Pages, make_app

COMPLETE = f"/api/run/{id_of('complete')}"


def test_list_tells_state_numbers_and_picture(browser):
    """Of a complete run its results, of a stopped one how far it came."""
    found = cards(browser)
    assert set(found) == {"complete", "series/stopped"}
    one = found["complete"]
    assert (one["state"], one["picture"], one["title"]) == (
        "complete",
        "temperature",
        "made-up steel",
    )
    words = {number["words"]: number["text"] for number in one["numbers"]}
    assert words["highest temperature"] == "3 273 K"
    other = found["series/stopped"]
    assert other["state"] == "stopped"
    assert other["time_s"] == pytest.approx(2e-7)
    assert len(other["curve"]) > 10


def test_state_follows_the_lock_of_the_folder(root, browser):
    """A run whose process holds the folder is running; after its end it is stopped."""
    lock = FolderLock(root / "series" / "stopped")
    assert cards(browser)["series/stopped"]["state"] == "running"
    lock.release()
    assert cards(browser)["series/stopped"]["state"] == "stopped"


def test_lock_of_a_dead_process_is_no_running_run(root, browser):
    """A killed process leaves its lock; after some beats it counts as dead."""
    folder = root / "series" / "stopped"
    lock = FolderLock(folder)
    text = (folder / ".lock").read_text()
    lock.release()
    owner = json.loads(text) | {"process": 2**22 + 1}
    (folder / ".lock").write_text(json.dumps(owner))
    os.utime(folder / ".lock", (1.0, 1.0))
    assert cards(browser)["series/stopped"]["state"] == "stopped"


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("resolved.json", b'{"case": '),
        ("resolved.json", b"[]"),
        ("resolved.json", b'{"case": {"time": {"end": null}}}'),
        ("resolved.json", b"\xff\xfe\x00"),
        ("summary.json", b"not JSON"),
        ("summary.json", b'{"case": 3}'),
        ("history.csv", b"\xff\xff\n1,2\n"),
    ],
)
def test_damaged_folder_spoils_its_own_card_only(root, browser, name, content):
    """Whatever lies in one folder, the others are listed, and its own page says what is wrong."""
    bad = shutil.copytree(root / "complete", root / "bad")
    (bad / name).write_bytes(content)
    found = cards(browser)
    assert found["complete"]["state"] == "complete"
    assert name == "history.csv" or found["bad"]["state"] == "damaged"
    answer = browser.get(f"/api/run/{id_of('bad')}")
    assert answer.status_code in (200, 422)
    assert answer.status_code == 200 or answer.json()["error"]


def test_folder_that_cannot_be_listed_spoils_nothing(root, browser):
    """As one of another user: here a file where a folder was when it was looked at."""
    (root / "odd").mkdir()
    (root / "odd" / "resolved.json").mkdir()
    found = cards(browser)
    assert found["odd"]["state"] == "damaged"
    assert found["complete"]["state"] == "complete"


def test_links_are_not_followed(root, browser, tmp_path):
    """Neither to a folder of runs elsewhere nor to a file inside of a run."""
    outside = shutil.copytree(root / "complete", tmp_path / "outside")
    (root / "linked").symlink_to(outside)
    assert "linked" not in cards(browser)
    assert browser.get(f"/api/run/{id_of('linked')}").status_code == 404
    secret = tmp_path / "secret.csv"
    secret.write_text("a secret\n")
    for name in ("history.csv", "run.log", "report.html", "figures/secret.png"):
        bad = shutil.copytree(root / "complete", root / "bad")
        (bad / name).unlink(missing_ok=True)
        (bad / name).symlink_to(secret)
        assert "link" in cards(browser)["bad"]["error"]
        for part in ("", "/history", "/log", "/report", "/figure/secret", "/particles"):
            answer = browser.get(f"/api/run/{id_of('bad')}{part}")
            assert answer.status_code == 422 and "secret\n" not in answer.text
        shutil.rmtree(bad)


def test_run_folder_that_becomes_a_link_is_refused(root, browser, tmp_path):
    """Between the list and the next request."""
    assert "complete" in cards(browser)
    (root / "complete").rename(tmp_path / "moved")
    (root / "complete").symlink_to(tmp_path / "moved")
    assert browser.get(COMPLETE).status_code == 422


@pytest.mark.parametrize(
    "path",
    [
        "/api/run/..",
        "/api/run/../../etc/passwd",
        "/api/run/%2e%2e/history",
        "/api/run/..%2f..%2fetc/history",
        "/api/run/%00",
        f"{COMPLETE}/figure/..%2f..%2frun.log",
        f"{COMPLETE}/figure/%2e%2e",
        f"{COMPLETE}/figure/temperature%00",
        f"{COMPLETE}/block/../../../summary.json",
        f"{COMPLETE}/block/%2e%2e%2fsummary.json",
        "/static/../server.py",
        "/static/server.py",
        "/static/%2e%2e%2faccess.py",
        "/static/uplot.js%00",
        "/etc/passwd",
        "/api/run/complete",
    ],
)
def test_paths_lead_nowhere(browser, path):
    """No address holds a path: each is found in a list or not at all."""
    answer = browser.get(path)
    assert answer.status_code in (400, 404)
    assert "root:" not in answer.text and "import" not in answer.text


@pytest.mark.parametrize(
    "change", [(2, "-1"), (3, "-1"), (3, "999999999999"), (2, "9" * 30), (4, "x")]
)
def test_blocks_that_do_not_exist_are_refused(browser, change):
    """Negative, huge, of another run: refused before anything is read."""
    index = browser.get(f"{COMPLETE}/particles").json()
    name = ["particles", "temperature", str(index["blocks"]["temperature"][3])]
    name += [str(index["counts"][3]), index["stamp"]]
    good = browser.get(f"{COMPLETE}/block/{'.'.join(name)}")
    assert good.status_code == 200 and len(good.content) == 4 * index["counts"][3]
    assert "immutable" in good.headers["cache-control"]
    name[change[0]] = change[1]
    assert browser.get(f"{COMPLETE}/block/{'.'.join(name)}").status_code in (400, 404)


@pytest.mark.parametrize("start", ["-5", "1", "x", "1e3", "9" * 40, "²"])
def test_places_of_the_history_that_do_not_exist_are_refused(browser, start):
    """A negative one gave a failure of the server once."""
    answer = browser.get(f"{COMPLETE}/history", params={"from": start})
    assert answer.status_code == 400 and answer.json()["error"]


def test_history_comes_in_parts(root, browser):
    """All rows, then those that are new."""
    path = root / "complete" / "history.csv"
    first = browser.get(f"{COMPLETE}/history")
    assert first.content == path.read_bytes()
    following = first.headers["x-next"]
    with path.open("ab") as stream:
        stream.write(b"1,2\n3,")
    more = browser.get(f"{COMPLETE}/history", params={"from": following})
    assert more.content == b"1,2\n"


def test_page_of_a_run(browser):
    """What a reader asks: verdict, figures with captions, case with what was changed, log."""
    found = browser.get(COMPLETE).json()
    assert found["verdict"].startswith("The metal reached")
    assert found["figures"][0]["name"] == "temperature"
    assert found["resolved"]["laser.pulse.kind"] == "gaussian"
    assert "made-up steel" in found["case_text"]
    assert browser.get(f"{COMPLETE}/figure/temperature").headers["content-type"] == "image/png"
    assert "made up" in browser.get(f"{COMPLETE}/log").text


def test_relief_of_a_run(root, browser):
    """Height over place, of half a period with its mirror image; none of a surface that is flat."""
    assert not browser.get(COMPLETE).json()["has_relief"]
    assert browser.get(f"{COMPLETE}/relief").status_code == 404
    file = root / "complete" / "surface.csv"
    file.write_text("x_m,height_m\n1e-7,-4e-8\n3e-7,2e-8\n")
    assert browser.get(COMPLETE).json()["has_relief"]
    assert browser.get(f"{COMPLETE}/relief").json() == {
        "x": [-3e-7, -1e-7, 1e-7, 3e-7],
        "height": [2e-8, -4e-8, -4e-8, 2e-8],
    }
    file.write_text("x_m,height_m\n1e-7\n")
    assert browser.get(f"{COMPLETE}/relief").status_code == 422


def test_results_and_keys_have_units(browser):
    """For a table of differences, and to tell keys in the units of light."""
    found = browser.get(COMPLETE).json()
    result = {one["key"]: one for one in found["results"]}["temperature_max_K"]
    assert result["value"] == pytest.approx(3273.0) and result["unit"] == "K"
    assert result["text"] == "3 273 K" and result["words"]
    assert found["units"]["laser.fluence"] == "J/m^2" and "title" not in found["units"]


def test_warnings_are_told_while_a_run_computes(root, browser):
    """Those that its events hold, on its card and on its page."""
    words = "4.0 cells per absorption length"
    assert cards(browser)["series/stopped"]["warnings"] == [words]
    page = f"/api/run/{id_of('series/stopped')}"
    assert browser.get(page).json()["warnings"] == [words]
    event = {"event": "warning", "time_s": 0.0, "step": 0, "message": "another"}
    with (root / "series" / "stopped" / "events.jsonl").open("a") as stream:
        stream.write(json.dumps(event) + "\n")
    assert cards(browser)["series/stopped"]["warnings"] == [words, "another"]
    assert browser.get(page).json()["warnings"] == [words, "another"]


def test_changes_of_the_case_file(root, browser):
    """The lines that a run writes above its case; the same value in other letters is no change."""
    path = root / "complete" / "case.toml"
    sets = '# --set laser.fluence=0.8 J/cm^2\n# --set time.end="200ns"\n# --set solver.skin=1\n'
    text = path.read_text()
    path.write_text(sets + text)
    assert browser.get(COMPLETE).json()["changes"] == [
        {"key": "laser.fluence", "was": "0.6 J/cm^2", "now": "0.8 J/cm^2"},
        {"key": "solver.skin", "was": "", "now": "1"},
    ]
    # what a sweep writes in SI is told in the unit of the case file
    sets = "# --set laser.fluence=8000.0 J/m^2\n# --set time.end=2e-07 s\n"
    path.write_text(f"{sets}# --set time.step=1e-10 s\n{text}")
    assert browser.get(COMPLETE).json()["changes"] == [
        {"key": "laser.fluence", "was": "0.6 J/cm^2", "now": "0.8 J/cm^2"},
        {"key": "time.step", "was": "", "now": "100 ps"},
    ]


def test_report_of_a_stranger_can_do_nothing(browser):
    """It is shown with an origin of its own and may not ask the server."""
    policy = browser.get(f"{COMPLETE}/report").headers["content-security-policy"]
    assert policy.startswith("sandbox allow-scripts;")
    assert "connect-src" not in policy and "default-src 'none'" in policy


def test_events_say_what_grew(root, browser):
    """The first event tells all; the stream ends when the folder is gone."""
    shutil.copytree(root / "complete", root / "gone")
    cards(browser)
    pages = Pages(root)
    pages.is_stopping = iter([False, True]).__next__
    app = TestClient(
        make_app(root, token=TOKEN, pages=pages),
        base_url="http://127.0.0.1",
        headers={"authorization": f"Bearer {TOKEN}"},
    )
    answer = app.get(f"{COMPLETE}/live")
    assert answer.headers["content-type"].startswith("text/event-stream")
    event = json.loads(answer.text.removeprefix("data: "))
    assert event["state"] == "complete"
    assert event["history"] == (root / "complete" / "history.csv").stat().st_size


def test_only_reading(browser):
    """Nothing can be changed, whatever the method."""
    for method in ("POST", "PUT", "DELETE", "PATCH"):
        assert browser.request(method, COMPLETE).status_code == 405
        assert browser.request(method, "/api/runs").status_code == 405


def test_page_names_no_other_server_and_no_absolute_address():
    """All of it works behind a proxy that strips a prefix, and without a network."""
    own = {name: data.decode() for name, data in STATIC.items()}
    assert {"index.html", "page.js", "page.css", "viewer.js", "uplot.js"} <= set(own)
    # all scripts come at once, not one round of requests after the other
    preloaded = set(re.findall(r'modulepreload" href="static/([^"]+)', own["index.html"]))
    scripts = {name for name in own if name.endswith(".js")}
    assert preloaded == scripts - {"page.js", "uplot.js"}
    for name, text in own.items():
        if name.startswith("uplot"):
            continue
        text = text.replace("http://www.w3.org/2000/svg", "")
        assert "http://" not in text and "https://" not in text, name
        assert not re.search(r"""["'`]/[\w.]|url\((?!#)""", text), name


def test_reading_writes_nothing(root, browser):
    """A folder of results is the same after it was looked at."""
    before = {path: path.stat().st_mtime_ns for path in sorted(root.rglob("*"))}
    cards(browser)
    for part in ("", "/history", "/log", "/particles", "/figure/temperature", "/report"):
        assert browser.get(COMPLETE + part).status_code == 200
    assert {path: path.stat().st_mtime_ns for path in sorted(root.rglob("*"))} == before
    assert open_run(root / "complete").is_complete
