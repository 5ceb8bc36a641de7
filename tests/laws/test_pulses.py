"""Several pulses on one relief: as runs that begin on the relief of the one before."""

import json

import numpy as np
import pytest
from flow_boxes import places_of, pool_case
from reliability_runs import assert_same
from scipy.sparse import csr_matrix

from lasersph import compute, load_case
from lasersph.simulation import run
from lasersph.simulation.recipes import recipe_of
from lasersph.simulation.time_loop import Stopped

SETTINGS = (
    "solver.flow.surface=moving",
    "material.base=steel-304-demuth",
    "material.surface_tension=1.6 N/m",
    "particles.spacing=125nm",
    "particles.fine_depth=1.5um",
    "laser.fluence=2 J/cm^2",
    "laser.pulse.center=25ns",
    "time.step=1ns",
    "time.cooling=0.05",
    "time.temperature_change=400K",
    "output.snapshots.interval=50ns",
)
END = 2e-7
PERIOD = 5e-7
TWO = (
    f"laser.pulse.period={PERIOD}s",
    "laser.pulse.count=2",
    f"time.end={PERIOD + END}s",
)


def relief(folder):
    """Heights of surface.csv [m]."""
    return np.loadtxt(folder / "surface.csv", delimiter=",", skiprows=1)[:, 1]


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Folder of one pulse, of two, and of one on the relief of the first; summary of the two."""
    folder = tmp_path_factory.mktemp("pulses")
    one, two, again = (folder / name for name in ("one", "two", "again"))
    run(pool_case(*SETTINGS, f"time.end={END}s"), one, threads=1)
    summary = run(pool_case(*SETTINGS, *TWO), two, threads=1).summary
    start = f"solver.flow.initial_surface.path={one / 'surface.csv'}"
    run(pool_case(*SETTINGS, start, f"time.end={END}s"), again, threads=1)
    return one, two, again, summary


def test_second_pulse_is_one_on_the_relief_of_the_first(runs):
    """Within rounding of times and of the file; and the second pulse changes the relief."""
    one, two, again, _ = runs
    height = np.ptp(relief(two))
    assert height > 1e-8
    assert np.abs(relief(two) - relief(again)).max() < 1e-5 * height
    assert np.abs(relief(two) - relief(one)).max() > 1e-2 * height


def test_half_a_period_is_half_of_the_whole(runs, tmp_path):
    """A whole period is symmetric, and its half that of the run of one half."""
    one, _, _, _ = runs
    case = pool_case(*SETTINGS, f"time.end={END}s", "domain.extent=full")
    run(case, tmp_path / "full", threads=1)
    full, half = relief(tmp_path / "full"), relief(one)
    depth = -half.min()
    assert np.abs(full - full[::-1]).max() < 1e-3 * depth
    assert np.abs(full[half.size :] - half).max() < 1e-3 * depth


def test_heat_of_the_pause_is_booked(runs):
    """What the pause takes away is said in the budget and where it happened."""
    one, two, _, summary = runs
    energy = summary["energy"]
    events = [json.loads(line) for line in (two / "events.jsonl").read_text().splitlines()]
    (pause,) = (event for event in events if event["event"] == "pause")
    assert pause["heat_removed_J"] == energy["pauses_J"]
    assert 0.45 * energy["absorbed_J"] < energy["pauses_J"] < 0.55 * energy["absorbed_J"]
    assert pause["time_s"] == PERIOD
    (height,) = summary["topography"]["after_pulses_m"]
    assert height == pytest.approx(np.ptp(relief(one)), rel=0.05)  # of parabolas, of columns
    assert abs(pause["volume_added_m3"]) < 1e-9 * 1.5e-6 * 2.5e-6
    assert energy["imbalance_relative"] < 1e-4


def test_stopped_and_resumed_over_the_pause(runs, tmp_path):
    """Stopped in the step after the pause: the same bits at the end."""
    _, two, _, _ = runs
    events = [json.loads(line) for line in (two / "events.jsonl").read_text().splitlines()]
    steps = next(event["step"] for event in events if event["event"] == "pause")
    left = iter([False] * steps + [True])
    case = pool_case(*SETTINGS, *TWO)
    with pytest.raises(Stopped):
        run(case, tmp_path / "parts", threads=1, should_stop=lambda: next(left))
    run(case, tmp_path / "parts", threads=1, resume=True)
    assert_same(two, tmp_path / "parts")


def test_heat_may_be_spread(tmp_path):
    """Then none is taken away, and the second pulse begins in a warm body."""
    case = pool_case(*SETTINGS, *TWO, "time.pause=spread", f"time.end={PERIOD + 6e-8}s")
    energy = run(case, tmp_path / "spread", threads=1).summary["energy"]
    assert abs(energy["pauses_J"]) < 1e-12 * energy["absorbed_J"]
    assert energy["imbalance_relative"] < 1e-4


@pytest.mark.parametrize(
    "amplitude, period", [("20nm", "5.05um"), ("60nm", "631.25nm"), ("49.2nm", "315.625nm")]
)
def test_pairs_below_a_relief_are_symmetric(amplitude, period):
    """Laid out below a relief, each particle conducts to its neighbor what that one conducts to it,
    in graded layers and under slopes of 0.6 and 0.98 too."""
    wave = {"amplitude": amplitude, "period": period}
    settings = [f"solver.flow.initial_surface.{key}={value}" for key, value in wave.items()]
    case = load_case("texture-steel", ("particles.spacing=32nm", *settings))
    body = recipe_of(case).build(backend := compute.cpu(threads=1)).body
    row, place = places_of(backend, body.pairs.neighbors)
    neighbor, g = (
        np.asarray(one)[place] for one in (body.pairs.neighbors.neighbor, body.pairs.weights)
    )
    weights = csr_matrix((g, (row, neighbor)), 2 * (body.count,))
    assert abs(weights - weights.T).max() < 1e-9 * weights.max()
