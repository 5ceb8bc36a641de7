"""The addresses of sweeps, studies, maps and calibrations."""

import json

import pytest
from page_client import cards
from synthetic_run import make_run
from synthetic_sweep import grid_points, made_up_depth, made_up_sweep

from lasersph.output.folder_lock import FolderLock
from lasersph.output.study_mark import StudyMark
from lasersph.web.folder_list import id_of


def test_page_of_a_sweep(root, browser):
    """Runs of a sweep have no cards; its page has their numbers and addresses."""
    made_up_sweep(root / "map", grid_points(), failed=(2,))
    sweeps = browser.get("/api/runs").json()["sweeps"]
    assert [one["name"] for one in sweeps] == ["map"]
    assert sweeps[0]["counts"] == {"complete": 23, "failed": 1}
    points = sweeps[0]["points"]
    assert points[0][:2] == [0.0, 0.0] and points[2][2] is None and points[-1][:2] == [1.0, 1.0]
    assert points[-4] == [1.0, 0.0, 1.0]  # the shortest pulse of the largest fluence melts deepest
    assert not any(name.startswith("map") for name in cards(browser))
    found = browser.get(f"/api/sweep/{id_of('map')}").json()
    assert found["units"] == {"laser.fluence": "J/m^2", "laser.pulse.fwhm": "s"}
    row = found["rows"][5]
    assert row["numbers"]["melt.depth_max_m"] > 0.0
    assert row["id"] == id_of(f"map/runs/{row['run']}")
    failed = found["rows"][2]
    assert (failed["status"], failed["reason"], failed["id"]) == ("failed", "no step converges", "")
    assert browser.get(f"/api/run/{id_of('map')}").status_code == 404
    assert browser.get(f"/api/sweep/{id_of('complete')}").status_code == 404


def test_what_a_page_shows_first_can_be_chosen(root, browser):
    """A number that the plan of a sweep does not list as well, with its words."""
    made_up_sweep(root / "map", grid_points())
    content = json.loads((root / "map" / "points.json").read_text())
    content["columns"] = ["temperature_max_K"]
    (root / "map" / "points.json").write_text(json.dumps(content))
    found = browser.get(f"/api/sweep/{id_of('map')}").json()
    assert found["main"][0] == "melt.depth_max_m"
    assert set(found["main"]) <= set(found["columns"]) and found["words"]["melt.depth_max_m"]


def test_a_marked_folder_is_a_study(root, browser):
    """Whatever its runs are called, and while only one of them has begun."""
    StudyMark("threshold", "threshold of steel to melt", "laser.fluence", "J/m^2").write(root / "m")
    make_run(root / "m" / "first", fluence=6000.0)
    (card,) = (one for one in browser.get("/api/runs").json()["sweeps"] if one["name"] == "m")
    assert (card["study"], card["title"]) == ("threshold", "threshold of steel to melt")
    assert card["spans"] == [{"key": "laser.fluence", "unit": "J/m^2", "ends": [6000.0, 6000.0]}]
    make_run(root / "m" / "second", fluence=3000.0)
    (root / "m" / "study.json").write_text("{")
    assert "m" not in {one["name"] for one in browser.get("/api/runs").json()["sweeps"]}


def test_runs_of_a_study_are_one_card(root, browser):
    """A threshold, a convergence: with what varies, and where it lies; their page has the runs."""
    for fluence in (6000.0, 2250.0, 4406.25):
        make_run(root / "thr" / f"fluence-{fluence:g}", fluence=fluence)
    make_run(root / "thr" / "fluence-3000", fluence=3000.0, complete=False)
    make_run(root / "many" / "spacing-64nm")
    make_run(root / "mine" / "fluence-6000")
    make_run(root / "mine" / "own")
    lock = FolderLock(root / "thr" / "fluence-3000")
    content = browser.get("/api/runs").json()
    names = ["complete", "mine/fluence-6000", "mine/own", "series/stopped"]
    assert sorted(one["name"] for one in content["runs"]) == names
    found = {one["name"]: one for one in content["sweeps"]}
    assert set(found) == {"thr", "many"} and found["many"]["study"] == "converge"
    card = found["thr"]
    assert (card["study"], card["title"]) == ("threshold", "threshold, made-up steel")
    assert card["spans"] == [{"key": "laser.fluence", "unit": "J/m^2", "ends": [2250.0, 6000.0]}]
    assert (card["state"], card["counts"]) == ("running", {"complete": 3, "running": 1})
    details = browser.get(f"/api/sweep/{id_of('thr')}").json()
    assert [one["settings"]["laser.fluence"] for one in details["rows"]] == [
        2250.0,
        3000.0,
        4406.25,
        6000.0,
    ]
    assert [one["status"] for one in details["rows"]].count("running") == 1
    assert browser.get(f"/api/run/{details['rows'][0]['id']}").json()["sweep"] == id_of("thr")
    assert "points" in browser.get(f"/api/sweep/{id_of('thr')}/map").json()["refused"]
    lock.release()
    (root / "thr" / "fluence-3000" / "resolved.json").write_text("{")
    damaged = {one["name"]: one for one in browser.get("/api/runs").json()["sweeps"]}["thr"]
    assert damaged["state"] == "damaged" and "thr" in damaged["error"]


def test_map_of_a_sweep(root, browser):
    """The field of `lasersph map`, nothing beside a run without a result; or why there is none."""
    made_up_sweep(root / "map", grid_points(), failed=(2,))
    address = f"/api/sweep/{id_of('map')}/map"
    keys = {"x": "laser.fluence", "y": "laser.pulse.fwhm"}
    shown = browser.get(address, params=keys | {"show": "melt.depth_max_m"}).json()
    assert [len(axis["grid"]) for axis in shown["axes"]] == [161, 161]
    assert [axis["is_logarithmic"] for axis in shown["axes"]] == [False, True]
    cold, hot = shown["field"][-1][0], shown["field"][0][-1]
    assert cold is None and hot == pytest.approx(made_up_depth(1.2e4, 1e-9), rel=1e-3)
    assert set(shown["lines"]) == set(shown["bands"]) == {"melts", "boils"}
    assert any("boiling" in text and "between" in text for text in shown["onsets"])
    for asked, words in (
        (keys | {"show": "melt.depht_max_m"}, "do you mean"),
        (keys | {"y": "laser.fluence", "show": "melt.depth_max_m"}, "over all that varies"),
        ({"x": "laser.fluence", "show": "melt.depth_max_m"}, "over all that varies"),
        ({}, "over all that varies"),
    ):
        assert words in browser.get(address, params=asked).json()["refused"]
    assert browser.get(f"/api/sweep/{id_of('complete')}/map").status_code == 404


def test_page_of_a_calibration(root, browser):
    """The answer with a histogram of the posterior, weighted."""
    made_up_sweep(root / "map", grid_points())
    (root / "map" / "calibration.json").write_text('{"unknowns": {"factor": {"mean": 1.5}}}')
    (root / "map" / "posterior.csv").write_text("factor,weight\n1.0,1.0\n2.0,3.0\n")
    found = browser.get(f"/api/sweep/{id_of('map')}").json()["calibration"]
    density = found["posterior"]["factor"]["density"]
    assert density[-1] == pytest.approx(3.0 * density[0])
    lines = ("0.1,1.0,1.0", "0.1,2.0,1.0", "0.2,2.0,2.0")
    rows = "".join(f"{one}\n" for one in ("share,factor,weight", *lines))
    (root / "map" / "posterior.csv").write_text(rows)
    found = browser.get(f"/api/sweep/{id_of('map')}").json()["calibration"]
    assert found["pairs"] == {"share factor": [[0.5, 0.0], [0.5, 1.0]]}
    assert found["posterior"]["share"]["edges"] == pytest.approx([0.05, 0.15, 0.25])
    (root / "map" / "posterior.csv").write_text("factor,weight\n1.0,x\n")
    assert browser.get(f"/api/sweep/{id_of('map')}").status_code == 422


def test_damaged_sweep_spoils_its_own_card_only(root, browser):
    """The others are listed."""
    made_up_sweep(root / "map", grid_points())
    (root / "map" / "points.json").write_text("[]")
    content = browser.get("/api/runs").json()
    assert content["sweeps"][0]["state"] == "damaged"
    assert len(content["runs"]) == 2
