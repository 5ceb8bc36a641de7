"""The last pulse of a train, read like a run of its own."""

import numpy as np
import pytest
import synthetic_run

from lasersph.output import open_run
from lasersph.output.last_pulse import PulseOfRun, last_pulse, starts_after_pauses
from lasersph.output.pulse_starts import starts_of_pulses
from lasersph.plots.pulses import pulses_compared, pulses_of


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return open_run(synthetic_run.make_run(tmp_path_factory.mktemp("pulses") / "run"))


def test_a_run_without_pauses_is_its_own_last_pulse(run):
    """Nothing is left out, and there is nothing to compare."""
    assert last_pulse(run) is run
    assert pulses_compared(run) is None


def test_times_and_energies_count_from_the_pulse(run, monkeypatch):
    """All that lies before the last pause is gone from history and snapshots."""
    start = float(run.snapshots.times[3])
    pauses = [{"event": "pause", "time_s": time} for time in (0.5 * start, start)]
    monkeypatch.setattr(type(run), "events", pauses)
    run = open_run(run.path)
    found, since = last_pulse(run), run.history["time_s"] >= start * (1.0 - 1e-12)
    assert starts_after_pauses(run) == [0.5 * start, start]
    assert found.history["time_s"] == pytest.approx(run.history["time_s"][since] - start, abs=1e-15)
    whole, part = (one.history["energy_absorbed_J"] for one in (run, found))
    assert part[0] == 0.0
    assert part[-1] == pytest.approx(whole[-1] - whole[since][0])
    assert len(found.snapshots) == len(run.snapshots) - 3
    assert found.snapshots.times[0] == found.snapshots[0]["time"] == 0.0
    assert np.array_equal(found.snapshots[-1]["temperature"], run.snapshots[-1]["temperature"])
    assert last_pulse(found).history["time_s"].size == np.count_nonzero(since)
    assert list(pulses_of(run)) == [1, 2, 3]
    assert pulses_of(run)[2].history["time_s"].max() < 0.5 * start
    figure = pulses_compared(run)
    assert figure is not None
    assert [line.get_label() for line in figure.axes[0].lines[:3]] == [
        "pulse 1", "pulse 2", "pulse 3",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("pulse", "starts"),
    [
        ({"count": 1, "period": None}, []),
        ({"count": 3, "period": 1e-3}, [0.0, 1e-3, 2e-3]),
        ({"count": 9, "period": None, "repetition_rate": 1000.0}, [0.0, 1e-3, 2e-3]),
    ],
)
def test_pulses_of_a_case_that_begin_within_it(pulse, starts):
    """Also of a run that has not come to them yet; of a single pulse or without light none."""
    time = {"end": 2.0002e-3}
    assert starts_of_pulses({"laser": {"pulse": pulse}, "time": time}) == pytest.approx(starts)
    assert starts_of_pulses({"laser": None, "time": time}) == []


def test_a_series_is_the_field_of_each_step(run):
    """Positions and fields of all steps from one opening of the file, as in the steps; of a pulse
    those of its steps."""
    found = PulseOfRun(run, float(run.snapshots.times[3]))
    for steps in (run.snapshots, found.snapshots):
        for name in ("position", "temperature"):
            series = steps.series(name)
            assert len(series) == len(steps)
            assert all(np.array_equal(a, step[name]) for a, step in zip(series, steps, strict=True))
    with pytest.raises(KeyError):
        run.snapshots.series("hardness")
