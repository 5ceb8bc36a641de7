"""Two pulses of 10 ps on steel, the second on melt that has moved: books, hand-over, same bits."""

import numpy as np
import pytest
from reliability_runs import assert_same, stop_and_resume

import lasersph
from lasersph.case import load_case
from lasersph.simulation import run

TRAIN = (
    "laser.fluence=0.16 J/cm^2", "laser.pulse.count=2", "laser.pulse.period=0.8 ns",
    "particles.spacing=32 nm", "particles.coarsest=0.4 um", "domain.depth=1 um",
    "domain.width=2.5 um", "laser.beam.period=2.5 um", "time.end=0.95 ns",
    "output.snapshots={ interval = '0.5 ns' }", "output.checkpoint_every=25",
)  # fmt: skip


@pytest.fixture(scope="module")
def train(tmp_path_factory):
    """The run from its begin to its end."""
    folder = tmp_path_factory.mktemp("train") / "whole"
    run(load_case("texture-steel-10ps", TRAIN), folder, threads=2, warn=False)
    return folder


def test_electrons_come_back_on_melt_that_has_moved(train):
    """Electrons are hot twice; in between there is one temperature, and the surface moves."""
    history = lasersph.open_run(train).history
    time, lattice = history["time_s"], history["temperature_max_K"]
    apart = history["electrons.temperature_max_K"] - lattice
    between, second = (time > 0.6e-9) & (time < 0.79e-9), time > 0.81e-9
    assert np.max(apart[time < 1e-10]) > 1000.0 and np.max(apart[second]) > 1000.0
    assert np.max(np.abs(apart[between])) < 1e-6
    # it rests under the second light, and keeps its velocity
    speed = history["flow_speed_max_m_s"]
    rests = (time > 0.81e-9) & (time < 0.84e-9)
    assert np.ptp(speed[rests]) < 0.01 * np.max(speed[rests])
    assert np.min(speed[rests]) > 1.0
    # melt that flows, and a surface that is no plane any more when the second light comes
    assert np.max(history["flow_speed_max_m_s"][between]) > 1.0
    assert np.max(history["topography.peak_to_valley_m"][between]) > 1e-10


def test_books_of_the_train(train):
    """What is held and lost was absorbed: to rounding before anything flows, 1e-5 after."""
    history = lasersph.open_run(train).history
    time, missing = history["time_s"], np.abs(history["energy_imbalance_relative"])
    assert np.max(missing[time < 60e-12]) < 1e-12
    assert np.max(missing) < 1e-5


def test_stopped_under_the_second_pulse(train, tmp_path):
    """A resumed run ends with the same bits."""
    case = load_case("texture-steel-10ps", TRAIN)
    history = lasersph.open_run(train).history
    row = int(np.searchsorted(history["time_s"], 0.83e-9))
    steps = int(history["step"][row])
    stop_and_resume(case, tmp_path / "run", steps)
    assert_same(tmp_path / "run", train)
