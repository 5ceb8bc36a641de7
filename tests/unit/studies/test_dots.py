"""Textures of dots: cells from runs in 3-D, tables over fluence, maps of spots, comparisons."""

from __future__ import annotations

import json
from types import SimpleNamespace

import numpy as np
import pytest
from synthetic_dot import DEPTH, FASTEST, PERIOD, SHARES, make_dot_run
from texture_cells import AMBIENT, HIGHEST, LEAST, spot

from lasersph.case import load_case
from lasersph.output import OutputError, open_run
from lasersph.output.height_map import HeightMap
from lasersph.output.image_file import write_maps
from lasersph.studies.texture.cells import UNITS, Cell
from lasersph.studies.texture.compare import compare
from lasersph.studies.texture.dot_cells import read_any_cell
from lasersph.studies.texture.dots import DotTable, table_of
from lasersph.studies.texture.make import answer, period_of_pattern, read_table, spot_of
from lasersph.studies.texture.relief import Relief, read_relief, repeating_relief
from lasersph.studies.texture.spot import NoTexture, texture_maps

K = 2.0 * np.pi / PERIOD
NM = 1e-9


def pit(fluence, x, y):
    """A pit at each dot with a slope of its own along x and along y [m], deeper with the fluence
    above what melts."""
    above = np.maximum(np.asarray(fluence, float) - LEAST, 0.0) / (HIGHEST - LEAST)
    return -40 * NM * above**2 * (np.cos(K * x) + 0.2 * np.sin(K * x)) * np.cos(K * y)


def dots(cells=12, columns=48):
    """Cells evenly in fluence, from that which does not melt yet."""
    fluence = np.linspace(LEAST, HIGHEST, cells)
    x = (np.arange(columns) + 0.5) * PERIOD / columns
    grid = fluence[:, None, None], x[None, :, None], x[None, None, :]
    above = np.maximum(grid[0] - LEAST, 0.0) / HIGHEST * np.ones((1, columns, columns))
    values = {
        "height": pit(*grid),
        "melt_depth": 1e-6 * above,
        "temperature": AMBIENT + 0.3 * grid[0] + np.zeros((1, columns, columns)),
        "speed": 10.0 * above,
    }
    return DotTable(fluence, x, PERIOD, values, AMBIENT, x)


@pytest.mark.parametrize("extent", list(SHARES))
def test_cell_of_a_run(tmp_path, extent):
    """Heights, depths, temperature and speed over a whole period from 0, of any part of it."""
    run = open_run(make_dot_run(tmp_path / "run", extent=extent))
    cell = read_any_cell(run, PERIOD)
    assert cell.y is not None and cell.x.size == cell.y.size == 40
    assert np.all(np.diff(cell.x) > 0.0) and 0.0 < cell.x[0] < cell.x[-1] < PERIOD
    pattern = np.cos(K * cell.x)[:, None] * np.cos(K * cell.y)
    assert cell.values["height"] == pytest.approx(-DEPTH * pattern, rel=1e-9, abs=1e-20)
    assert np.max(cell.values["temperature"]) == pytest.approx(2700.0, rel=0.02)
    assert np.max(cell.values["speed"]) == pytest.approx(FASTEST, rel=0.02)
    # two rows of 125 nm: molten below the dots, not at all between them
    assert cell.values["melt_depth"][0, 0] > 125 * NM
    assert cell.values["melt_depth"][20, 0] == 0.0
    with pytest.raises(OutputError, match="wide, not one period of 3e-06 m"):
        read_any_cell(run, 3e-6)


def test_table_of_dots():
    """Places and fluences between those of cells; the dark has no relief; brighter is refused."""
    table = dots()
    fluence, x, y = 4321.0, np.array([0.3e-6, -1.1e-6, 7.7e-6]), np.array([0.2e-6, 3e-6, -9e-6])
    assert table.at("height", fluence, x, y) == pytest.approx(pit(fluence, x, y), abs=0.3 * NM)
    assert table.at("height", fluence, x + PERIOD, y - 3 * PERIOD) == pytest.approx(
        table.at("height", fluence, x, y), abs=1e-20
    )
    # next to the seam the first column counts, not the last one
    seam = table.at("height", HIGHEST, 0.49 * PERIOD / 48, 0.0)
    assert seam == pytest.approx(table.values["height"][-1, 0, 0], abs=0.05 * NM)
    assert np.all(table.at("temperature", 0.0, x, y) == AMBIENT)
    with pytest.raises(ValueError, match="exceeds that of all cells"):
        table.at("height", 1.1 * HIGHEST, x, y)
    errors = table.leave_one_out("height")
    assert errors.shape == (10,) and 0.0 < errors.max() < 2 * NM
    coarse = dots(6).leave_one_out("height").max()
    assert coarse > 2.0 * errors.max()


def test_maps_of_a_spot():
    """Each pixel has its local fluence and phase; nothing where nothing melts."""
    light = spot(30e-6)
    maps = texture_maps(light, dots(24), PERIOD / 20)
    fluence = light.at(maps.x[None, :], maps.y[:, None])
    expected = pit(fluence, maps.x[None, :], maps.y[:, None])
    assert maps.fields["height"] == pytest.approx(expected, abs=0.8 * NM)
    assert np.all(maps.fields["height"][fluence < 0.9 * LEAST] == 0.0)
    assert set(maps.fields) == {*UNITS, "fluence"}


def test_same_table_from_runs(tmp_path, monkeypatch):
    """Complete cells of a folder become a table of dots; cells of another spacing do not."""
    rows = []
    for name, fluence, columns in (("a", 3000.0, 40), ("b", 4000.0, 40), ("c", 5000.0, 40)):
        make_dot_run(tmp_path / "runs" / name, columns=columns, fluence=fluence)
        settings = {"laser.fluence": fluence}
        rows.append(SimpleNamespace(status="complete", run=name, settings=settings))
        case = tmp_path / "runs" / name / "resolved.json"
        content = json.loads(case.read_text())
        content["case"]["initial_temperature"] = AMBIENT
        case.write_text(json.dumps(content))
    table = SimpleNamespace(rows=rows)
    monkeypatch.setattr("lasersph.studies.texture.make.Table.read", lambda folder: table)
    found = read_table(tmp_path, PERIOD)
    assert isinstance(found, DotTable) and found.values["height"].shape == (3, 40, 40)
    assert found.period_y == pytest.approx(PERIOD)
    cells = [(f, read_any_cell(open_run(tmp_path / "runs" / n), PERIOD)) for n, f in (("a", 1.0),)]
    other = read_any_cell(open_run(make_dot_run(tmp_path / "coarse", columns=20)), PERIOD)
    with pytest.raises(ValueError, match="the same columns"):
        table_of([*cells, (2.0, other), (3.0, other)], PERIOD, AMBIENT)


def measured(relief, turn=0.05, shift=(0.7e-6, -0.9e-6), width=14e-6, noise=0.3 * NM):
    """A map of a relief, turned and shifted, with noise and a tilt."""
    x = np.linspace(-0.5 * width, 0.5 * width, 140)
    c, s = np.cos(turn), np.sin(turn)
    u, v = x[None, :] - shift[0], x[:, None] - shift[1]
    z = relief.at(c * u + s * v, c * v - s * u, 1.0)
    z = z + noise * np.random.default_rng(1).standard_normal(z.shape) + 1e-4 * x
    return HeightMap(x, x, z)


def test_compare_dots_that_repeat():
    """Shift along both axes, turn and scale of a map of a field of dots are found again."""
    table = dots()
    one = 1.0 + np.cos(K * table.x)
    height = -15 * NM * one[:, None] * one * (1.0 + 0.3 * np.sin(K * table.x)[:, None])
    cell = Cell(table.x, {"height": height}, True, table.y)
    relief = repeating_relief(cell, PERIOD)
    found = compare(relief, measured(relief))
    assert found.values["rotation_rad"] == pytest.approx(0.05, abs=1e-3)
    assert found.values["lateral_scale"] == pytest.approx(1.0, abs=2e-3)
    # shifts are the same but for whole periods along the axes of the turned pattern
    dx, dy = found.values["shift_x_m"] - 0.7e-6, found.values["shift_y_m"] + 0.9e-6
    c, s = np.cos(0.05), np.sin(0.05)
    for off in (c * dx + s * dy, c * dy - s * dx):
        assert abs(off / PERIOD - round(off / PERIOD)) < 0.01
    assert np.sqrt(np.mean(found.residual**2)) == pytest.approx(0.3 * NM, rel=0.1)


def test_relief_of_a_run_and_of_a_texture(tmp_path):
    """`read_relief` of a run of dots repeats; that of a texture has its spot and its cells."""
    run = read_relief(make_dot_run(tmp_path / "run"))
    assert isinstance(run, Relief) and run.period_y == pytest.approx(PERIOD)
    assert run.at(np.zeros(1), np.zeros(1), 1.0)[0] == pytest.approx(-DEPTH, rel=0.02)
    table, light = dots(), spot(30e-6)
    maps = texture_maps(light, table, PERIOD / 20)
    case = SimpleNamespace(name="dots", title="dots", time=SimpleNamespace(end=1e-7))
    plan = SimpleNamespace(case=case, spot=light, period=PERIOD, pulses=1, shift=0.0)
    content = answer(plan, table, maps, PERIOD / 20)
    assert content["areal_parameters"]["Sz"] > 60 * NM
    folder = tmp_path / "texture"
    folder.mkdir()
    (folder / "texture.json").write_text(json.dumps(content))
    write_maps(folder / "maps.vtkhdf", maps)
    found = read_relief(folder)
    x = np.array([0.4e-6, 5.2e-6])
    expected = pit(light.at(x, 0.3e-6 + 0.0 * x), x, 0.3e-6)
    assert found.at(x, 0.3e-6 + 0.0 * x, 1.0) == pytest.approx(expected, abs=1.5 * NM)


def test_cases_that_are_no_textures():
    """Dots need 3-D and one period along y; lines need 2-D."""
    lines = load_case("texture-steel")
    assert period_of_pattern(lines) == pytest.approx(5.05e-6)
    four = {"kind": "interference", "beams": 4, "period": 5e-6}
    beam = type(lines.laser.beam).model_validate(four)
    laser = SimpleNamespace(beam=beam)
    domain = SimpleNamespace(width=5e-6, breadth=4e-6)
    case = SimpleNamespace(
        laser=laser, solver=SimpleNamespace(dimensions=2), surface_moves=True, domain=domain
    )
    with pytest.raises(NoTexture, match=r"solver\.dimensions = 3"):
        period_of_pattern(case)
    case.solver.dimensions = 3
    with pytest.raises(NoTexture, match=r'domain\.breadth = "5 um", not 4 um'):
        period_of_pattern(case)
    case.domain.breadth = None
    assert period_of_pattern(case) == pytest.approx(5e-6)
    with pytest.raises(NoTexture, match="no spot"):
        spot_of(SimpleNamespace(**vars(case) | {"laser": SimpleNamespace(beam=beam, spot=None)}))
