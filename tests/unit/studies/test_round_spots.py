"""Measured profiles and maps of one round spot beside a section (r, z), and as targets."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import synthetic_flow

from lasersph import compare as compare_with
from lasersph import load_case
from lasersph.cli import main
from lasersph.output import OutputError, open_run
from lasersph.output.atomic import replace_json
from lasersph.output.height_map import HeightMap
from lasersph.output.particle_file import ParticleFile
from lasersph.particles.geometry import Geometry
from lasersph.studies.calibration import calibrate_with
from lasersph.studies.calibration_answer import answer
from lasersph.studies.calibration_reading import read_calibration_plan
from lasersph.studies.calibration_target import ProfileEntry, ProfileTarget, read_target
from lasersph.studies.texture.compare import compare
from lasersph.studies.texture.measurement import NoComparison
from lasersph.studies.texture.relief import read_relief
from lasersph.studies.texture.round_relief import RoundRelief, mean_over_angle

NM, UM = 1e-9, 1e-6


def height(r, depth=200 * NM, shape=1.0):
    """A dimple with its rim [m]."""
    rim = 60 * NM * shape * np.exp(-(((r - 2.2 * UM) / (0.4 * UM)) ** 2))
    return rim - depth * np.exp(-((r / (1.2 * UM)) ** 2))


def round_spot(**more):
    """Our relief, as a run leaves it: 160 columns of 50 nm."""
    r = (np.arange(160) + 0.5) * 50 * NM
    return RoundRelief("spot", r, height(r, **more))


def measurement(seed=0, scale=1.01, rows=1, **more):
    """A profile through the middle of 12 um, or a map, tilted, moved, stretched, 3 nm of noise."""
    random = np.random.default_rng(seed)
    x = np.linspace(-6 * UM, 6 * UM, 240 if rows == 1 else 120)
    y = np.zeros(1) if rows == 1 else np.linspace(-5 * UM, 5 * UM, rows)
    X, Y = np.meshgrid(x, y)
    away = np.hypot(X - 0.7 * UM, Y + 0.4 * UM) if rows > 1 else np.abs(X - 0.7 * UM)
    z = height(away / scale, **more) + 2e-3 * X + 1e-3 * Y + 3 * NM * random.normal(size=X.shape)
    return HeightMap(x - x[0], y - y[0], z)


def test_profile_through_the_middle():
    """Place and lateral scale come back; a round spot has neither an angle nor a fluence."""
    found = compare(round_spot(), measurement())
    assert set(found.values) == {"shift_x_m", "lateral_scale"}
    assert abs(found.values["lateral_scale"] - 1.01) < 3.0 * found.errors["lateral_scale"] < 0.02
    assert found.values["shift_x_m"] == pytest.approx(0.7 * UM, abs=20 * NM)
    assert np.sqrt(np.mean(found.residual**2)) == pytest.approx(3 * NM, rel=0.15)
    assert found.height_factor[0] == pytest.approx(1.0, abs=0.01)


def test_map_about_its_center(tmp_path):
    """Of a map the center is found in both directions, and its mean over the angle has the profile
    with less noise than a point; what scatters on a ring is the noise."""
    surface = measurement(rows=100)
    found = compare(round_spot(), surface)
    assert set(found.values) == {"shift_x_m", "lateral_scale", "shift_y_m"}
    assert found.values["shift_x_m"] == pytest.approx(0.7 * UM, abs=10 * NM)
    assert found.values["shift_y_m"] == pytest.approx(-0.4 * UM, abs=10 * NM)
    folder = section_run(tmp_path)
    file = surface.write(tmp_path / "map.sdf")
    beside = compare_with(folder, file)
    rings = {name: np.array(values) for name, values in beside.content["over_r"].items()}
    inner = rings["r_m"] < 4 * UM
    error = (rings["measured_m"] - height(rings["r_m"]))[inner]
    assert np.sqrt(np.mean(error**2)) < 1.5 * NM
    assert np.median(rings["spread_m"][inner]) == pytest.approx(3 * NM, rel=0.15)
    figures = beside.figures()
    assert figures["comparison"].axes[1].get_xlabel().startswith("r [")
    assert set(figures) == {"comparison", "comparison-maps"}


def section_run(folder, heights=height):
    """A run of a section whose surface has moved."""
    run = open_run(synthetic_flow.make_pool_run(folder / "run"))
    content = run.resolved
    content["case"]["solver"]["geometry"] = "axisymmetric"
    content["case"]["domain"] = {"extent": "full"}
    replace_json(run.path / "resolved.json", content)
    r = (np.arange(160) + 0.5) * 50 * NM
    for time in run.snapshots.times if heights is not None else ():
        lines = ParticleFile(run.path / "surface.vtkhdf", "Lines")
        lines.append(float(time), np.array([r, heights(r)]), {})
    return run.path


def test_command(tmp_path, capsys):
    """`compare` of a run and a profile writes its page; a surface that stayed flat is refused."""
    folder = section_run(tmp_path)
    file = measurement().write(tmp_path / "line.csv")
    assert main(["compare", str(folder), str(file)]) == 0
    assert "lateral scale" in capsys.readouterr().out
    content = json.loads((folder / "compare-line/comparison.json").read_text())
    assert content["difference"]["rms_m"] == pytest.approx(3 * NM, rel=0.15)
    assert len(content["over_r"]["r_m"]) == len(content["over_r"]["measured_m"])
    with pytest.raises(OutputError, match="no surface that moved"):
        read_relief(section_run(tmp_path / "flat", None))


def test_refusals():
    """A measurement shorter than the spot, or too coarse for it; a spot without relief."""
    ours = round_spot()
    assert ours.period == pytest.approx(5.35 * UM, abs=0.05 * UM)  # where the rim is 13 nm high
    x = np.linspace(0.0, 4 * UM, 100)
    with pytest.raises(NoComparison, match="shorter than the spot"):
        compare(ours, HeightMap(x, np.zeros(1), height(x)[None]))
    x = np.linspace(-6 * UM, 6 * UM, 12)
    with pytest.raises(NoComparison, match="do not show the spot"):
        compare(ours, HeightMap(x, np.zeros(1), height(np.abs(x))[None]))
    assert RoundRelief("flat", ours.r, 0.0 * ours.r).is_flat


def test_mean_over_angle():
    """Four points on two rings, by hand."""
    x, y = np.array([1.0, 0.0, -3.0, 0.0]), np.array([0.0, -1.0, 0.0, 3.0])
    r, mean, spread = mean_over_angle(x, y, np.array([[2.0, 4.0, 5.0, 5.0]]), 0.8)
    assert r.tolist() == [1.0, 3.0]
    assert mean.tolist() == [3.0, 5.0] and spread.tolist() == [1.0, 0.0]


def test_target_of_a_section(tmp_path):
    """Its size is that of the light; a case without a relief of a spot is refused in one line."""
    measurement().write(tmp_path / "line.csv")
    entry = ProfileEntry(file="line.csv")
    laser = load_case("spot-steel").laser
    section = SimpleNamespace(laser=laser, geometry=Geometry(2, True), surface_moves=True)
    target = read_target(entry, tmp_path, section)
    assert target.is_round and target.error == pytest.approx(3 * NM, rel=0.15)
    assert target.period == pytest.approx(2.0 * np.sqrt(laser.area / np.pi))
    for other in ({"surface_moves": False}, {"laser": None}):
        with pytest.raises(NoComparison, match="leaves no relief of a spot"):
            read_target(entry, tmp_path, SimpleNamespace(**{**vars(section), **other}))


def test_hidden_depth_is_calibrated(tmp_path):
    """A factor on the fluence that deepens the dimple and raises the rim comes back from a profile
    and from a map of one spot."""
    for rows in (1, 40):
        surface = measurement(rows=rows, depth=0.93 * 200 * NM, shape=0.93**2)
        target = ProfileTarget("spot", surface, 5 * UM, 3 * NM, 0.03, is_round=True)
        measurement().write(tmp_path / "line.csv")
        (tmp_path / "plan.toml").write_text(
            'case = "dlip-steel"\n[set]\n"solver.flow.surface" = "moving"\n'
            '"material.base" = "steel-304"\n"particles.spacing" = "100 nm"\n'
            '[unknown]\nfactor = { scales = "laser.fluence", between = [0.7, 1.3] }\n'
            '[[measured]]\nset = { "laser.fluence" = "0.45 J/cm^2" }\n'
            'profile = { file = "line.csv", error = "3 nm" }\n[runs]\nfirst = 6\nmost = 12\n'
        )
        plan = read_calibration_plan(tmp_path / "plan.toml")
        conditions = tuple(replace(one, profile=target) for one in plan.conditions)

        def reliefs(points):
            factors = [one["laser.fluence"] / 4500.0 for one in points]
            return [round_spot(depth=200 * NM * one, shape=one**2) for one in factors]

        found = calibrate_with(
            replace(plan, conditions=conditions),
            lambda points: [{} for _ in points],
            reliefs=reliefs,
        )
        one = answer(found)["unknowns"]["factor"]
        assert one["low_95"] < 0.93 < one["high_95"] and one["sd"] < 0.02
