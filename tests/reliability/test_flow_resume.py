"""Runs that flow, stopped or killed anywhere: resumed, they end with the same bits.

A steel pool under a flat surface of some 30 particles lives from step 65 to 185 of some 205.
"""

import numpy as np
import pytest
from flow_boxes import box_case
from reliability_runs import assert_same, kill_after, small_case

from lasersph.case import load_case
from lasersph.output import open_run
from lasersph.output.checkpoint import candidates, load
from lasersph.simulation import run
from lasersph.simulation.time_loop import Stopped

POOL = ("solver.kind=melt-pool", "particles.spacing=64nm", "time.end=100ns")
MOVING = (
    "solver.kind=melt-pool",
    "solver.flow.surface=moving",
    "material.base=steel-304-demuth",
    "material.surface_tension=1.6 N/m",
    "particles.fine_depth=1.5um",
    "laser.fluence=2 J/cm^2",
    "laser.pulse.center=25ns",
    "time.end=60ns",
    "output.snapshots.interval=2ns",
)
BESIDE = ("particles.spacing=64nm", "particles.fine_width=3.4um", "domain.width=20um",
          "particles.coarsest=3um", "time.step=200ps", "time.end=28ns")  # fmt: skip
HEAT = {"left": "fixed-temperature", "left_temperature": 310.0, "right": "fixed-temperature"}


def stop_at(case, folder, steps, **options):
    """Start or resume a run and stop it after so many further steps, with a checkpoint."""
    left = iter(range(steps, -1, -1))
    next(left)
    with pytest.raises(Stopped):
        run(case, folder, resume=True, should_stop=lambda: next(left) == 0, **options)


def last_state(folder):
    """Arrays and numbers of the last checkpoint."""
    checkpoint = load(max(candidates(folder / "checkpoint")))
    return dict(checkpoint.arrays), checkpoint.scalars["solver"]


def assert_same_state(folder, reference):
    """The last checkpoints hold the same bits."""
    (arrays, numbers), (expected, expected_numbers) = last_state(folder), last_state(reference)
    assert numbers == expected_numbers
    for name, values in expected.items():
        assert np.array_equal(arrays[name], values), name


@pytest.fixture(scope="module")
def pool(tmp_path_factory):
    """Folder of a pool's run that nobody interrupted."""
    folder = tmp_path_factory.mktemp("pool") / "run"
    summary = run(small_case(*POOL), folder, threads=1).summary
    assert summary["flow"]["speed_max_m_s"] > 1.0
    return folder


def test_pool_killed_in_the_middle_of_melting(tmp_path, pool):
    """Killed while the pool grows, stopped while it shrinks and when it is gone: the same bits."""
    folder, case = tmp_path / "run", small_case(*POOL)
    kill_after(folder, 95, 0.005, *POOL)
    last = load(max(candidates(folder / "checkpoint")))
    assert last.step >= 90
    assert np.abs(last.arrays["velocity"]).max() > 0.1
    stop_at(case, folder, 160 - last.step, threads=1)
    assert np.abs(last_state(folder)[0]["velocity"]).max() > 0.0
    stop_at(case, folder, 30, threads=1)
    ended = last_state(folder)[0]
    assert np.all(ended["velocity"] == 0.0)
    start = open_run(folder).snapshots[0]["position"]
    assert np.abs(ended["position"] - start).max() > 1e-9
    run(case, folder, resume=True, threads=2)
    assert_same_state(folder, pool)
    assert_same(folder, pool, but=("threads",))


def lines_of(folder):
    """Times and lines of a surface that moves."""
    return [(step["time"], step["position"].tobytes()) for step in open_run(folder).surface]


def test_pool_killed_while_its_surface_moves(tmp_path):
    """Killed anywhere, the file of the surface can be read and holds what an uninterrupted run
    wrote; resumed and ended, all of it."""
    case, folder, whole = small_case(*MOVING), tmp_path / "run", tmp_path / "whole"
    summary = run(case, whole, threads=1).summary
    assert summary["topography"]["peak_to_valley_m"] > 1e-9
    kill_after(folder, summary["steps"] - 35, 0.005, *MOVING)
    heights = load(max(candidates(folder / "checkpoint"))).arrays["surface_height"]
    assert np.ptp(heights) > 1e-9
    found, expected = lines_of(folder), lines_of(whole)
    assert 10 < len(found) < len(expected)
    assert found == expected[: len(found)]
    run(case, folder, resume=True, threads=1)
    assert_same_state(folder, whole)
    assert_same(folder, whole)


def test_box_stopped_twice(tmp_path):
    """A box with walls that move and hold temperatures, stopped after odd numbers of steps."""
    case = box_case(heat=HEAT, material={"expansion": "0.01 1/K"}, gravity=10.0, end=0.9, step=0.05)
    folders = tmp_path / "whole", tmp_path / "parts"
    run(case, folders[0], threads=1)
    for steps in (7, 12):
        stop_at(case, folders[1], steps, threads=1)
    run(case, folders[1], resume=True, threads=1)
    assert_same(folders[1], folders[0])


def test_steady_box(tmp_path):
    """A run that ends because it is steady ends at the same step when it was stopped before."""
    thick = {"kinematic_viscosity": "0.2 m^2/s"}
    case = box_case(end=50.0, step=1.0, steady=0.2, cells=8, material=thick)
    folders = tmp_path / "whole", tmp_path / "parts"
    summary = run(case, folders[0], threads=1).summary
    assert summary["is_steady"] and summary["time_s"] < 50.0
    stop_at(case, folders[1], summary["steps"] - 3, threads=1)
    run(case, folders[1], resume=True, threads=1)
    assert_same(folders[1], folders[0])


@pytest.mark.slow
@pytest.mark.parametrize("geometry", ["planar", "axisymmetric"])
def test_pool_beside_coarse_columns(geometry, tmp_path):
    """Stopped while the pool flows and resumed on two threads: the same bits as on one."""
    case = load_case("spot-steel", (*BESIDE, f"solver.geometry={geometry}"))
    whole = run(case, tmp_path / "whole", threads=1).summary
    assert whole["flow"]["speed_max_m_s"] > 0.5
    stop_at(case, tmp_path / "run", 115, threads=2)
    assert np.abs(last_state(tmp_path / "run")[0]["velocity"]).max() > 0.0
    run(case, tmp_path / "run", resume=True, threads=2)
    assert_same_state(tmp_path / "run", tmp_path / "whole")
