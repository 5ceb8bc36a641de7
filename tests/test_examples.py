"""Every example, run with --quick, gives the numbers that its expected.toml states; the notebook
of the documentation runs."""

import json
import re
import tempfile
import tomllib
from functools import reduce
from pathlib import Path

import matplotlib
import matplotlib.pyplot
import numpy as np
import pytest

import lasersph
from lasersph.cli import main

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES = sorted((ROOT / "examples").glob("*/case.toml"))


@pytest.fixture
def few_forecasts(monkeypatch):
    """Of the runs of a plan the first and the last are forecast: each takes a second, and it is in
    reading the plan that a case refuses a point."""
    monkeypatch.setattr("lasersph.sweeps.forecast.SAMPLED", 2)


@pytest.mark.parametrize("case", EXAMPLES, ids=lambda case: case.parent.name)
def test_example_gives_expected_numbers(case, tmp_path):
    """Each number of summary.json lies within the stated relative tolerance of its source."""
    expected = tomllib.loads(case.with_name("expected.toml").read_text(encoding="utf-8"))
    result = lasersph.run(lasersph.load_case(case, quick=True), tmp_path / "out", threads=2)
    found = {
        name: reduce(lambda table, key: table[key], name.split("."), result.summary)
        for name in expected
    }
    wanted = {
        name: pytest.approx(entry["value"], rel=entry["relative"])
        for name, entry in expected.items()
    }
    assert expected
    assert all(entry["source"] for entry in expected.values())
    assert found == wanted
    assert result.summary["energy"]["imbalance_relative"] <= 1e-6


def test_every_example_explains_itself():
    """A case comes with its expected numbers and its page."""
    assert len(EXAMPLES) >= 5
    for case in EXAMPLES:
        assert case.with_name("expected.toml").exists()
        assert case.with_name("figure.png").exists()
        assert case.with_name("README.md").read_text(encoding="utf-8").startswith("# ")


@pytest.mark.usefixtures("few_forecasts")
def test_plan_of_a_process_map(capsys):
    """The plan of an example is forecast: every point is a case, and nothing is refused."""
    plan = ROOT / "examples" / "process-map-steel" / "plan.toml"
    assert main(["sweep", str(plan), "--dry-run"]) == 0
    said = capsys.readouterr().out
    assert re.search(r"^runs +40$", said, flags=re.MULTILINE)
    assert "refused" not in said
    assert plan.with_name("figure.png").exists()
    assert plan.with_name("README.md").read_text(encoding="utf-8").startswith("# ")


@pytest.mark.usefixtures("few_forecasts")
@pytest.mark.parametrize("name", ["plan", "aluminium", "sensitivity", "viscosity", "sulfur"])
def test_plans_beside_an_experiment(name, capsys):
    """Calibrations and sweeps of textures are forecast: every point is a case."""
    verb = "calibrate" if name in ("plan", "aluminium") else "sweep"
    plan = ROOT / "examples" / "texture-experiment" / f"{name}.toml"
    assert main([verb, str(plan), "--dry-run"]) == 0
    assert "refused" not in capsys.readouterr().out


@pytest.mark.usefixtures("few_forecasts")
@pytest.mark.parametrize(("metal", "fluence"), [("steel", "0.601"), ("aluminium", "1.016")])
def test_texture_of_a_spot(metal, fluence, capsys):
    """The cases have the fluence of their page at the center, and their cells are forecast."""
    case = ROOT / "examples" / "texture-of-a-spot" / f"{metal}.toml"
    assert main(["check", str(case)]) == 0
    assert f"{fluence} J/cm^2, mean over a period" in capsys.readouterr().out
    assert main(["texture", str(case), "--cells", "6", "--dry-run"]) == 0
    assert re.search(r"^runs +6$", capsys.readouterr().out, flags=re.MULTILINE)


@pytest.mark.slow
def test_texture_from_real_cells(tmp_path, capsys):
    """Six coarse cells make the spot; its own profile has the fluence of the case."""
    case, out = ROOT / "examples" / "texture-of-a-spot" / "steel.toml", tmp_path / "spot"
    coarse = ("particles.spacing=120 nm", "time.step=3 ns", "time.end=60 ns")
    coarse += ("laser.pulse.center=20 ns", "output.snapshots.interval=10 ns")
    settings = [word for one in coarse for word in ("--set", one)]
    command = ["texture", str(case), "--cells", "6", "--pixel", "250nm", *settings]
    assert main([*command, "--threads", "1", "--workers", "1", "--out", str(out)]) == 0
    content = json.loads((out / "texture.json").read_text())
    assert content["melt_depth_max_m"] == pytest.approx(266e-9, rel=0.15)  # of a cell at 16 nm
    assert 5e-9 < content["depth_max_m"] < 60e-9
    x, z = np.loadtxt(out / "profile.csv", delimiter=",", skiprows=1)[:, :2].T
    rows = "".join(f"{1e6 * a:.6g},{1e9 * b:.6g}\n" for a, b in zip(x, z, strict=True))
    (tmp_path / "line.csv").write_text("x [um],z [nm]\n" + rows)
    assert main(["compare", str(out), str(tmp_path / "line.csv")]) == 0
    found = json.loads((out / "compare-line" / "comparison.json").read_text())
    assert found["unknowns"]["fluence_factor"]["value"] == pytest.approx(1.0, abs=0.01)
    assert "deepest point" in capsys.readouterr().out


@pytest.mark.slow
def test_notebook_runs(tmp_path, monkeypatch):
    """The cells of "Read results in Python" run one after the other, with a coarser run."""
    matplotlib.use("Agg")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    page = (ROOT / "docs" / "tutorials" / "reading-results.md").read_text(encoding="utf-8")
    assert "spacing=32nm" in page
    page = page.replace("spacing=32nm", "spacing=100nm")
    cells = re.findall(r"^```\{code-cell\}.*?\n(.*?)^```", page, flags=re.MULTILINE | re.DOTALL)
    assert len(cells) > 5
    names: dict[str, object] = {}
    for cell in cells:
        exec(compile(cell, "reading-results.md", "exec"), names)
    matplotlib.pyplot.close("all")
    assert names["melt"]["depth_half_max_m"] > 2e-7
