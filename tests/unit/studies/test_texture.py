"""The texture of a spot: interpolation between cells, the maps, the files, what is refused."""

import json

import numpy as np
import pytest
import synthetic_flow
import synthetic_run
from scipy.optimize import brentq
from sweep_runs import PretendingEngine
from texture_cells import (
    AMBIENT,
    COARSE,
    HIGHEST,
    LEAST,
    PERIOD,
    half_width,
    pools,
    relief,
    spot,
    table,
)

import lasersph
from lasersph.cli import main
from lasersph.output import OutputError, open_run
from lasersph.output.image_file import read_maps
from lasersph.output.particle_file import ParticleFile
from lasersph.output.surface_files.read import read_surface
from lasersph.plots.texture import texture_figure
from lasersph.studies.texture import make
from lasersph.studies.texture.cells import depth_below, read_cell
from lasersph.studies.texture.make import plan_texture
from lasersph.studies.texture.spot import NoTexture, half_sizes, texture_maps
from lasersph.studies.texture.table import CellTable
from lasersph.sweeps import Table


def test_table_between_cells():
    """Any fluence and any place: within 0.2 % of the closed form, across the end of the period too,
    and a surface without light below the lowest cell."""
    fluence = np.array([2700.0, 4321.0, 5999.0])[:, None]
    x = np.linspace(-2.0 * PERIOD, 3.0 * PERIOD, 701)[None, :]
    found = table().at("height", fluence, x)
    assert np.abs(found - relief(fluence, x)).max() < 0.002 * np.abs(relief(fluence, x)).max()
    assert table().at("temperature", [0.0], [0.0]) == pytest.approx(AMBIENT)
    assert table().at("height", [0.5 * LEAST], [0.0]) == 0.0


def test_table_refuses_what_no_cell_covers():
    """A fluence above that of the highest cell is not extrapolated."""
    with pytest.raises(ValueError, match="exceeds that of all cells"):
        table().at("height", [1.01 * HIGHEST], [0.0])
    with pytest.raises(ValueError, match="three cells"):
        CellTable(np.array([1.0, 2.0]), np.array([0.0]), PERIOD, {}, AMBIENT)


def test_cells_left_out():
    """The error by leaving cells out is above the true one, and falls with more cells."""
    few, many = (table(n).leave_one_out("height").max() for n in (8, 24))
    fluence, x = np.linspace(LEAST, HIGHEST, 301)[:, None], table().x[None, :]
    true = np.abs(table(8).profiles("height", fluence[:, 0]) - relief(fluence, x)).max()
    assert true < few
    assert many < 0.3 * few


def test_edges_of_lines():
    """Eight cells tell heights to 1 % of the largest where edges move by columns from one to the
    next; at each place of the period alone they err by 8 %."""
    from scipy.interpolate import PchipInterpolator

    cells = table(8, relief=pools)
    fluence = np.linspace(LEAST, HIGHEST, 301)
    true = pools(fluence[:, None], cells.x[None, :])
    by_place = PchipInterpolator(cells.fluence, cells.values["height"])(fluence)
    assert np.abs(cells.profiles("height", fluence) - true).max() < 0.01 * 40e-9
    assert np.abs(by_place - true).max() > 0.08 * 40e-9


def test_lines_of_a_spot():
    """A line is the cell that is as bright as it at its brightest, between edges at their fluence;
    its volume stays zero. At the end of a top hat the slope of the fluence says nothing."""
    local, cells = spot(40e-6), table(24, 400, pools)
    x = 2.0 * PERIOD + np.linspace(-0.5, 0.5, 4001)[:-1] * PERIOD

    def edge(side):
        off = brentq(lambda d: half_width(local.at(2.0 * PERIOD + side * d)) - d, 0.0, 2.4e-6)
        return 2.0 * PERIOD + side * off

    a, b = edge(-1.0), edge(1.0)
    assert 2.0 * PERIOD - a > 1.1 * (b - 2.0 * PERIOD)  # the fluence falls outward
    near = 2.0 * PERIOD + np.linspace(-0.1, 0.1, 2001) * PERIOD
    own = float(np.max(local.at(near) * np.cos(np.pi * near / PERIOD) ** 2))
    assert own > 1.005 * local.at(2.0 * PERIOD)
    inside = (x - 0.5 * (a + b)) * half_width(own) / (0.5 * (b - a))
    expected = np.where((x > a) & (x < b), pools(own, inside), 0.0)
    found = cells.lines["height"].across(local.at, x, 0.0)
    assert np.abs(found - expected).max() < 0.01 * np.abs(expected).max()
    assert abs(found.mean()) < 1e-3 * np.abs(expected).mean()
    assert found.max() - cells.at("height", local.at(x), x).max() < -0.03 * found.max()
    line = np.array([PERIOD])
    ends = cells.lines["height"]._brightest(lambda x, y: 5000.0 * (x <= line), line, np.zeros(1))
    assert ends == pytest.approx(5000.0)


def test_maps_of_a_spot():
    """Each pixel is the cell of its fluence and phase; the map ends where nothing melts."""
    found = texture_maps(spot(), table(), 0.25e-6)
    x, y = np.meshgrid(found.x, found.y)
    expected = relief(spot().at(x, y), x)
    assert np.abs(found.fields["height"] - expected).max() < 0.003 * np.abs(expected).max()
    assert not found.fields["melt_depth"][0].any() and not found.fields["melt_depth"][:, -1].any()
    assert found.fields["melt_depth"][found.y.size // 2, found.x.size // 2] > 0.0
    np.testing.assert_allclose(found.x, -found.x[::-1], atol=1e-18)


def test_pulses_moved_apart():
    """Two spots that melt nothing in common leave both reliefs, the second with its own phase."""
    found = texture_maps(spot(20e-6), table(), 0.2e-6, pulses=2, shift=41.5e-6)
    height = found.fields["height"][found.y.size // 2]
    local = spot(20e-6)
    expected = relief(local.at(found.x), found.x)
    expected += relief(local.at(found.x - 41.5e-6), found.x - 41.5e-6)
    assert np.abs(height - expected).max() < 0.003 * np.abs(expected).max()


def test_pulses_that_melt_the_same_place():
    """Cells of one pulse do not know the relief of the pulse before: refused with the place."""
    with pytest.raises(NoTexture, match=r"pulse 2 melts what an earlier one has molten, first at"):
        texture_maps(spot(), table(), 1e-6, pulses=2, shift=10e-6)


def test_too_many_pixels_and_too_little_light():
    """Each is one line that says what would do."""
    with pytest.raises(NoTexture, match="write --pixel"):
        texture_maps(spot(), table(), 1e-9)
    dark = CellTable(
        *(getattr(table(), n) for n in ("fluence", "x", "period")),
        {n: 0.0 * one for n, one in table().values.items()},
        AMBIENT,
    )
    with pytest.raises(NoTexture, match="there is no texture"):
        texture_maps(spot(), dark, 1e-6)


def test_area_of_a_tilted_spot():
    """All that melts of an ellipse along a diagonal lies on the maps, its corners as well."""

    class Tilted:
        diameter = 50e-6

        def at(self, x, y):
            return HIGHEST * np.exp(-(((x + y) / 50e-6) ** 2) - ((x - y) / 8e-6) ** 2)

    end = 0.5 * 50e-6 * np.sqrt(np.log(HIGHEST / LEAST))  # of what melts, on the diagonal
    assert min(half_sizes(Tilted(), table())) > end
    assert max(half_sizes(Tilted(), table())) < end + 2.0 * PERIOD


def test_depth_between_two_rows():
    """Of two columns of three rows one has molten to the second: half way between melt fraction and
    temperature; the other has not."""
    position = np.array([[0.5, 0.5, 0.5, 1.5, 1.5, 1.5], [-0.5, -1.5, -2.5, -0.5, -1.5, -2.5]])
    first = {"position": position, "width": np.ones((2, 6))}
    melted = np.array([1.0, 1.0, 0.25, 0.2, 0.0, 0.0])
    hottest = np.array([2000.0, 1800.0, 1600.0, 1600.0, 1000.0, 500.0])
    found = depth_below(np.array([0, 0, 0, 1, 1, 1]), 2, first, melted, hottest, 1700.0)
    share = 0.5 * (0.5 / 0.75 + 0.5)
    assert found == pytest.approx([1.5 + share, 0.0])


TRAIN = ("laser.pulse.count=2", "laser.pulse.period=0.5 us", "time.end=0.6 us")
REFUSED = {
    "no spot": (["laser.spot="], "has no spot"),
    "flat": (["solver.flow.surface=flat"], "does not move"),
    "whole": (["laser.spot.extent=whole", "domain.extent=full"], 'write extent = "cell"'),
    "too dark": (["laser.fluence=0.05 J/cm^2"], "melt nothing"),
    "two periods": (["domain.width=10 um"], "a cell is one period wide"),
    "pulses that melt the same place": (
        [*TRAIN, "laser.spot.shift=10 um"],
        'write laser.spot.shift = "26 um", or leave the spot at one place',
    ),
    "pulses that find the heat of others": (
        [*TRAIN, "laser.spot.shift=60 um", "time.pause=compute"],
        'time.pause is "compute", and a pulse finds the heat of those before',
    ),
    "lines and spot moved": (
        [
            "laser.spot.shift=20 um",
            "laser.beam.shift=1 um",
            *TRAIN,
            "domain.extent=full",
            "boundaries.sides=periodic",
        ],
        "cells of one pulse know neither",
    ),
}


@pytest.mark.parametrize(("settings", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_refused(tmp_path, monkeypatch, capsys, settings, message):
    """One line, exit code 2, nothing written."""
    monkeypatch.chdir(tmp_path)
    given = [word for one in (*COARSE, *settings) for word in ("--set", one)]
    assert main(["texture", "dlip-steel", "--out", "t", *given]) == 2
    said = capsys.readouterr().err.splitlines()
    assert len(said) == 1 and message in said[0]
    assert not list(tmp_path.iterdir())


@pytest.fixture(scope="module")
def plan():
    """The plan of a coarse texture of six cells, as a call of Python makes it."""
    return plan_texture("dlip-steel", settings_of_a_spot(), 6)


def settings_of_a_spot(**more):
    """Settings of a coarse texture."""
    settings = dict(one.split("=", 1) for one in COARSE[:-1])
    return {**settings, "laser.spot": {"diameter": "50 um", "definition": "1/e^2", **more}}


def test_cells_of_moved_pulses(monkeypatch):
    """They are those of one pulse, however long the pause between pulses lasts."""
    monkeypatch.setattr(make, "cell_fluences", lambda *_: (4000.0,))
    pulses = {"laser.pulse.count": 3, "laser.pulse.period": "1 ms", "time.end": "2.00009 ms"}
    for pause in ({}, {"time.pause": "remove"}):
        moved = plan_texture("dlip-steel", settings_of_a_spot(shift="60 um") | pulses | pause)
        one = plan_texture("dlip-steel", settings_of_a_spot())
        assert (moved.pulses, moved.shift) == (3, pytest.approx(60e-6))
        assert [p.hash for p in moved.cells.points()] == [p.hash for p in one.cells.points()]


def test_plan(plan):
    """Cells rise from just below what melts to the center; they are a sweep without the spot."""
    fluences = plan.cells.choices["laser.fluence"]
    assert len(fluences) == 6 and fluences[-1] == 6000.0
    assert 1800.0 < fluences[0] < 2500.0
    cases = [point.case for point in plan.cells.points()]
    assert all(case is not None and case.laser.spot is None for case in cases)
    assert plan.cells.study.title == "sweep of dlip-steel over laser.fluence"


def test_files(plan, tmp_path, monkeypatch):
    """Maps, heights, profile, numbers and a figure that say the same."""
    monkeypatch.setattr(make, "read_table", lambda folder, period: table())
    content = make.assemble(plan, tmp_path, 0.5e-6)
    assert content == json.loads((tmp_path / "texture.json").read_text())
    maps = read_maps(tmp_path / "maps.vtkhdf")
    height = read_surface(tmp_path / "height.x3p")
    assert np.abs(height.z - maps.fields["height"]).max() < 1e-6 * np.abs(height.z).max()
    assert content["depth_max_m"] == pytest.approx(-height.z.min())
    assert content["areal_parameters"]["Sz"] == pytest.approx(np.ptp(height.z), rel=1e-3)
    assert content["interpolation_error"]["height"]["largest"] < 1e-9
    line = np.loadtxt(tmp_path / "profile.csv", delimiter=",", skiprows=1)
    assert line[:, 1] == pytest.approx(maps.fields["height"][maps.y.size // 2], abs=1e-14)
    figure = texture_figure(maps, content)
    assert any("ISO 25178" in axes.get_title(loc="left") for axes in figure.axes)
    assert figure.axes[0].get_xlabel() == "x [µm]"


def test_from_python(tmp_path, monkeypatch):
    """`lasersph.texture` makes the cells, then all files; the same call again makes none. A cell
    that fails leaves no texture and is named."""
    monkeypatch.setattr(make, "read_table", lambda folder, period: table())
    settings = settings_of_a_spot()
    failing = PretendingEngine(fails=(HIGHEST,))
    with pytest.raises(OutputError, match=r"not all cells are complete, .*no step converges"):
        lasersph.texture("dlip-steel", tmp_path / "none", set=settings, cells=6, engine=failing)
    assert not (tmp_path / "none/texture.json").exists()
    engine, out = PretendingEngine(), tmp_path / "spot"
    for _ in range(2):
        content = lasersph.texture(
            "dlip-steel", out, set=settings, cells=6, pixel=1e-6, engine=engine
        )
        assert content == json.loads((out / "texture.json").read_text())
    assert len(engine.made) == 6
    assert content["depth_max_m"] == pytest.approx(-relief(HIGHEST, 0.0), rel=1e-3)
    assert {"texture.png", "profile.csv", "maps.vtkhdf"} <= {file.name for file in out.iterdir()}


def test_shared_runs(plan, tmp_path):
    """Complete runs of equal cases are linked, others are not; a folder without runs is refused."""
    points = plan.cells.points()
    for number, point in enumerate(points[:2]):
        run = tmp_path / "sweep/runs" / f"000{number}-{point.hash}"
        run.mkdir(parents=True)
        (run / "resolved.json").write_text("{}")
    (run / "summary.json").write_text("{}")
    for count in (1, 0):
        assert make.link_runs(plan.cells, tmp_path / "t/cells", [tmp_path / "sweep"]) == count
    (linked,) = (tmp_path / "t/cells/runs").iterdir()
    assert linked.is_symlink() and linked.name.endswith(points[1].hash)
    rows = Table.read(tmp_path / "t/cells").rows  # a sweep that goes on from here
    assert [row.run for row in rows if row.status == "complete"] == [linked.name]
    with pytest.raises(OutputError, match="no runs to share"):
        make.link_runs(plan.cells, tmp_path / "t/cells", [tmp_path / "none"])


def test_cell_of_a_run(tmp_path):
    """Half a period is mirrored; the surface is that of the last line; the pool is the deepest."""
    run = open_run(synthetic_flow.make_pool_run(tmp_path / "run"))
    x = (np.arange(60) + 0.5) * 0.5 * synthetic_run.PERIOD / 60
    z = relief(HIGHEST, x)
    for time in run.snapshots.times:
        ParticleFile(run.path / "surface.vtkhdf", "Lines").append(float(time), np.array([x, z]), {})
    cell = read_cell(run, synthetic_run.PERIOD)
    assert cell.values["height"] == pytest.approx(relief(HIGHEST, cell.x), abs=1e-20)
    assert cell.values["height"] == pytest.approx(cell.values["height"][::-1], abs=1e-20)
    assert cell.values["temperature"].argmax() in (0, cell.x.size - 1)
    assert cell.values["speed"].max() > 1.0
    assert cell.values["melt_depth"].max() == pytest.approx(
        run.summary["melt"]["depth_half_max_m"], rel=0.2
    )
    with pytest.raises(OutputError, match="not one period"):
        read_cell(run, 3.0 * synthetic_run.PERIOD)
