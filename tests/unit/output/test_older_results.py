"""Runs of the format before amounts were those of the whole are read as those of today."""

import json
import shutil

import numpy as np
import pytest
from synthetic_run import make_run

from lasersph import compare_runs, open_run
from lasersph.cli.results import info
from lasersph.output.older_results import note_on_older, read_uncertainty
from lasersph.studies.maps import count_of_older
from lasersph.sweeps.table import Row, Table

AMOUNTS = ("energy_", "melt_volume")
HALVED = {"melt": ("volume_max_m3",), "energy": ("absorbed_J", "stored_J", "lost_J", "latent_J")}


def made_older(folder):
    """Write a finished run as the earlier format had it: amounts of the half."""
    for name in ("summary.json", "resolved.json"):
        content = json.loads((folder / name).read_text())
        content["schema_version"] = 1
        content.pop("mirror_images", None)
        for section, keys in HALVED.items():
            for key in keys if section in content else ():
                content[section][key] *= 0.5
        (folder / name).write_text(json.dumps(content))
    head, *rows = (folder / "history.csv").read_text().splitlines()
    columns = head.split(",")
    halved = [name.startswith(AMOUNTS) and name.endswith(("_J", "_m3")) for name in columns]
    lines = [
        ",".join(repr(0.5 * float(value)) if is_amount else value
                 for value, is_amount in zip(row.split(","), halved, strict=True))
        for row in rows
    ]  # fmt: skip
    (folder / "history.csv").write_text("\n".join([head, *lines, ""]))
    return folder


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """The same run in today's format and in the earlier one."""
    folder = tmp_path_factory.mktemp("formats")
    return make_run(folder / "today"), made_older(make_run(folder / "older"))


def test_amounts_of_a_half_are_doubled(runs):
    """In summary and history; sizes, temperatures and shares stay as they are."""
    today, older = (open_run(folder) for folder in runs)
    for section, keys in HALVED.items():
        for key in keys:
            assert older.summary[section][key] == today.summary[section][key]
    for key in ("depth_max_m", "width_max_m"):
        assert older.summary["melt"][key] == today.summary["melt"][key]
    imbalance = today.summary["energy"]["imbalance_relative"]
    assert older.summary["energy"]["imbalance_relative"] == imbalance
    assert (older.summary["schema_version"], older.summary["mirror_images"]) == (2, 2)
    for name, column in today.history.items():
        assert np.array_equal(older.history[name], column), name


def test_readers_say_so_in_one_line(runs, capsys):
    """`info` and `compare` of the older run; today's says nothing."""
    today, older = runs
    info(older)
    said = capsys.readouterr().out
    assert said.count("note: ") == 1 and "times 2, those of the whole" in said
    info(today)
    assert "note: " not in capsys.readouterr().out
    text = str(compare_runs(today, older))
    assert text.count("note: ") == 1 and "times 2" in text
    assert not compare_runs(today, today).notes


def test_a_quarter_by_its_crater_and_a_whole(runs, tmp_path):
    """A crater says how often it was computed; what was computed whole is left alone."""
    folder = made_older(make_run(tmp_path / "quarter"))
    summary = json.loads((folder / "summary.json").read_text())
    summary["crater"] = {"mirror_images": 4, "volume_m3": 1.0, "volume_unit": "m^3", "width_m": 1.0}
    (folder / "summary.json").write_text(json.dumps(summary))
    crater = open_run(folder).summary["crater"]
    assert crater == {**summary["crater"], "volume_m3": 4.0}
    assert "quarter" in note_on_older(folder)
    resolved = json.loads((folder / "resolved.json").read_text())
    resolved["case"]["domain"]["extent"] = "full"
    del summary["crater"]
    (folder / "summary.json").write_text(json.dumps(summary))
    (folder / "resolved.json").write_text(json.dumps(resolved))
    assert open_run(folder).summary["energy"] == summary["energy"]
    assert note_on_older(folder) is None


def test_errors_of_amounts_are_doubled(runs):
    """With value and parts; orders and the errors of sizes stay."""
    _, older = runs
    entry = {
        "value": 3.0, "error": 1.0, "numerical": None, "from_inputs": 0.5, "order": 1.5,
        "values": [3.0, 2.0], "inputs": {"k": {"up": 0.1, "standard": 0.2, "is_linear": True}},
    }  # fmt: skip
    numbers = {"melt.volume_max_m3": entry, "melt.depth_max_m": entry}
    content = {"schema_version": 1, "numbers": numbers}
    (older / "uncertainty.json").write_text(json.dumps(content))
    found = read_uncertainty(older)["numbers"]
    (older / "uncertainty.json").unlink()
    assert found["melt.depth_max_m"] == entry
    assert found["melt.volume_max_m3"] == {
        "value": 6.0, "error": 2.0, "numerical": None, "from_inputs": 1.0, "order": 1.5,
        "values": [6.0, 4.0], "inputs": {"k": {"up": 0.2, "standard": 0.4, "is_linear": True}},
    }  # fmt: skip


def test_maps_count_runs_of_the_earlier_format(runs, tmp_path):
    """Those alone whose amounts are multiplied, and that are complete."""
    today, older = runs
    shutil.copytree(today, tmp_path / "runs/a")
    shutil.copytree(older, tmp_path / "runs/b")
    rows = tuple(Row(name, "complete", {}) for name in ("a", "b"))
    table = Table(tmp_path, (*rows, Row("c", "missing", {})), {}, ())
    assert count_of_older(table) == 1
