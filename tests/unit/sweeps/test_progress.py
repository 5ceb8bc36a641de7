"""How far many runs are, told from events and a clock that the test turns."""

import pytest
from sweep_runs import PretendingEngine

from lasersph.sweeps import Event, build_plan, make_runs
from lasersph.sweeps.progress import SweepProgress


def test_remaining_time(tmp_path, monkeypatch):
    """Four runs of 10 s by two workers, the first of which is half done when it is met."""
    clock = [0.0]
    monkeypatch.setattr("lasersph.sweeps.progress.time.monotonic", lambda: clock[0])
    values = [f"{fluence} J/m^2" for fluence in (1000, 2000, 3000, 4000)]
    plan = build_plan("dlip-steel", {"laser.fluence": values})
    table = make_runs(
        plan.points(),
        tmp_path,
        plan.study,
        engine=PretendingEngine(),
        should_stop=lambda: True,
    )
    progress, (first, second, third, _) = SweepProgress(), table.runs

    def at(seconds, run, kind, work_done=0.0):
        clock[0] = seconds
        return progress.step(Event(run, kind, work_done=work_done), table)

    assert at(0.0, first, "progress", 0.5).remaining_s is None
    at(0.0, second, "progress", 0.0)
    status = at(5.0, second, "progress", 0.5)
    assert (status.running, status.complete, status.total) == (2, 0, 4)
    assert status.work_done == pytest.approx((0.5 + 0.5) / 4)
    assert status.remaining_s == pytest.approx(3.0 * 10.0 / 2)
    at(5.0, first, "complete")
    at(10.0, second, "complete")
    status = at(10.0, third, "progress", 0.0)
    assert (status.running, status.complete) == (1, 2)
    assert status.remaining_s == pytest.approx(2.0 * 10.0 / 1)
    status = at(11.0, third, "failed")
    assert (status.running, status.complete, status.failed) == (0, 2, 1)
    assert status.work_done == pytest.approx(3 / 4) and status.remaining_s is None
    status = at(12.0, table.runs[3], "wrong")
    assert (status.failed, status.refused) == (1, 1) and status.work_done == 1.0
