"""Steps that fail are halved, and every solver has the members that the time loop uses."""

import pytest

from lasersph.compute.search import EscapedParticle
from lasersph.solvers.ablation.solver import Ablation
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.melt_pool.solver import MeltPool
from lasersph.solvers.step_control import RETRIES, NotConverged, Solver, retry_step


def test_half_a_step_follows_a_failure():
    """Failures are undone; the step that succeeds is also the one from which the next may grow."""
    seen, undone = [], []

    def attempt(step, unclipped_step):
        seen.append((step, unclipped_step))
        if len(seen) < 3:
            raise EscapedParticle("particle 3")

    assert retry_step(attempt, 8.0, 9.0, undo=lambda: undone.append(1)) == 2.0
    assert seen == [(8.0, 9.0), (4.0, 4.0), (2.0, 2.0)]
    assert len(undone) == 2


def test_the_shortest_step_fails():
    """After the 256th part of a step its reason is told, whatever failed."""
    steps = []

    def attempt(step, _unclipped_step):
        steps.append(step)
        raise EscapedParticle("particle 3")

    with pytest.raises(NotConverged, match="particle 3"):
        retry_step(attempt, 1.0)
    assert steps[-1] == 2.0**-RETRIES


@pytest.mark.parametrize("solver", [Conduction, MeltPool, Ablation])
def test_members_of_a_solver(solver):
    """Those of the protocol; `backend` and `state` may be set when a solver is built."""
    members = {name for name in vars(Solver) if not name.startswith("_")}
    assert members >= {"fields", "restore", "step", "time_step_limits", "is_steady"}
    assert members - set(dir(solver)) <= {"backend", "state"}
