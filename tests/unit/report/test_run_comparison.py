"""Two runs side by side: settings, numbers with their differences, figures, a page."""

import json

import numpy as np
import pytest
import synthetic_flow
import synthetic_run

import lasersph
from lasersph.cli import main
from lasersph.cli.measured import _run_of
from lasersph.output import OutputError, open_run
from lasersph.output.particle_file import ParticleFile
from lasersph.plots.comparison import figures_of_two
from lasersph.report.run_comparison import _difference, _settings_of


@pytest.fixture
def two(tmp_path):
    """Two heat runs of one case; the second got twice the fluence, and its melt twice as deep."""
    first = synthetic_run.make_run(tmp_path / "first")
    second = synthetic_run.make_run(tmp_path / "second")
    case = second / "case.toml"
    case.write_text("# --set laser.fluence=8000.0 J/m^2\n" + case.read_text(), encoding="utf-8")
    summary = json.loads((second / "summary.json").read_text())
    summary["melt"]["depth_max_m"] *= 2.0
    (second / "summary.json").write_text(json.dumps(summary))
    return first, second


def test_numbers_and_settings(two):
    """A difference is told with its sign and in percent, none as the same."""
    found = lasersph.compare_runs(*two)
    assert [row[0] for row in found.settings] == ["laser.fluence"]
    assert found.settings[0][2] == "0.8 J/cm^2"
    rows = {words: cells for words, *cells in found.rows}
    depth = rows["largest depth of completely fluid metal (f_m = 1)"]
    assert depth[2].startswith("+") and depth[2].endswith("(+100 %)")
    assert rows["largest temperature"][2] == "the same"
    first, second = found.numbers["melt.depth_max_m"]
    assert second == 2.0 * first


def test_command(two, tmp_path, capsys):
    """A table, a page with the figures; a folder that is no run is one line."""
    assert main(["compare", str(two[0]), str(two[1])]) == 0
    said = capsys.readouterr().out
    assert "(+100 %)" in said and "0.8 J/cm^2" in said
    folder = two[0] / "compare-second"
    assert {file.name for file in folder.iterdir()} >= {
        "comparison.html",
        "comparison.json",
        "melt.png",
        "temperature.png",
    }
    page = (folder / "comparison.html").read_text(encoding="utf-8")
    assert "+100 %" in page and page.count("data:image/png") == 2
    (tmp_path / "empty").mkdir()
    assert main(["compare", str(two[0]), str(tmp_path / "empty")]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    with pytest.raises(OutputError, match="is not a run folder"):
        lasersph.compare_runs(two[0], tmp_path / "empty")


def test_runs_of_different_length_share_their_axis(tmp_path):
    """One unit of time for both: a run of 200 ns ends at 0.2 us beside one of 2 us."""
    runs = [open_run(synthetic_run.make_run(tmp_path / name)) for name in ("short", "long")]
    head, *rows = (runs[1].path / "history.csv").read_text().splitlines()
    assert head.startswith("time_s,")
    longer = [
        f"{10.0 * float(time)!r},{rest}" for time, rest in (row.split(",", 1) for row in rows)
    ]
    (runs[1].path / "history.csv").write_text("\n".join([head, *longer, ""]))
    axes = figures_of_two([open_run(run.path) for run in runs], ["a", "b"])["temperature"].axes[0]
    ends = [float(line.get_xdata()[-1]) for line in axes.lines[:2]]
    np.testing.assert_allclose(ends, [0.2, 2.0])
    assert axes.get_xlim() == (0.0, ends[1]) and axes.get_xlabel() == "time [µs]"


def test_trains_show_their_last_pulse(tmp_path):
    """A train is drawn since its last pause, its times from there; a pause is no curve."""
    single, train = (synthetic_run.make_run(tmp_path / name) for name in ("single", "train"))
    with (train / "events.jsonl").open("a") as events:
        events.write('{"event": "pause", "time_s": 1e-7}\n')
    drawn = figures_of_two([open_run(single), open_run(train)], ["a", "b"])["temperature"]
    ends = [float(line.get_xdata()[-1]) for line in drawn.axes[0].lines[:2]]
    np.testing.assert_allclose(ends, [200.0, 100.0])


def test_settings_and_large_differences_in_words():
    """Tables read as in a case file; a percentage that nobody reads is left out."""
    assert _settings_of('[[probes]]\nname = "top"\ndepth = "0 nm"\n') == {
        "probes": '{name = "top", depth = "0 nm"}'
    }
    assert _difference(5e-8, 2e-3, "s") == "+2 ms"
    assert _difference(1.0, 11.0, "K") == "+10 K (+1000 %)"


def test_profile_of_a_run_leads_to_its_folder(two, tmp_path):
    """A run of half a period writes half a profile: the other half is in its folder alone."""
    assert str(two[0]) in _run_of(two[0] / "surface.csv")
    assert _run_of(tmp_path / "measured.csv") == ""


def test_reliefs(tmp_path):
    """Both surfaces at their ends, and the second less the first at the same places."""
    runs = []
    x = 1e-7 * np.arange(20)
    for name, depth in (("a", 20e-9), ("b", 50e-9)):
        run = open_run(synthetic_flow.make_pool_run(tmp_path / name))
        file = ParticleFile(run.path / "surface.vtkhdf", "Lines")
        for time in run.snapshots.times:
            file.append(float(time), np.array([x, -depth * np.cos(x / 1e-7)]), {})
        runs.append(run)
    above, below = figures_of_two(runs, ["a", "b"])["relief"].axes
    assert len(above.lines) == 2 and above.get_ylabel() == "height [nm]"
    np.testing.assert_allclose(np.max(np.abs(below.lines[0].get_ydata())), 30.0, rtol=1e-5)
