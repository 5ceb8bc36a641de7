"""Steps in which only what leaves moves: by hand, and against those that compute all motion."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.case import load_case
from lasersph.particles.kinds import EJECTED, INTERIOR, LEAVING
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.ablation.equations import advance_vapor, pair_heat
from lasersph.solvers.ablation.rates import Moving
from lasersph.solvers.step_control import binding_limit

PUBLISHED = ("particles.spacing=0.2 um", "domain.depth=6 um", "solver.ejection.model=published",
             "solver.ejection.preset=timeline", "time.end=2 ns")  # fmt: skip
OWN = ("particles.spacing=0.2 um", "domain.depth=6 um", "time.end=8 ns")


def test_position_and_enthalpy():
    """Leaving particles move by v dt, all are heated by dh dt."""
    x, v = np.array([0.0, 1.0]), np.array([0.0, 400.0])
    for kind, z in ((INTERIOR, 1.0), (LEAVING, 1.2), (EJECTED, 1.0)):
        place, h = advance_vapor(x, v, 10.0, kind, 4.0, 5e-4)
        np.testing.assert_allclose(place, [0.0, z])
        assert h == pytest.approx(10.002)


def test_heat_of_a_pair():
    """V_i V_j 4 k_i k_j / (k_i + k_j) (T_i - T_j) dW / r, times the factor."""
    found = pair_heat(300.0, 400.0, 2.0, 6.0, 0.5, 0.25, 2.0, -3.0, 1.1)
    assert found == pytest.approx(1.1 * 0.125 * 6.0 * (-100.0) * (-1.5))


def test_same_as_with_all_motion():
    """Where no force acts on what is condensed, the general step gives the same, to rounding."""

    def let_all_move(solver):
        solver._what_moves = lambda *_: Moving.ALL

    refuse_difference(PUBLISHED, let_all_move)


@pytest.mark.parametrize("settings", [PUBLISHED, OWN])
def test_same_as_with_conductivities_that_differ(settings):
    """Aluminum of one conductivity: the rates of any metal give the same, to rounding."""

    def let_conductivities_differ(solver):
        assert solver.body.conducts_alike
        solver.body.conducts_alike = False

    refuse_difference(settings, let_conductivities_differ)


def refuse_difference(settings, change):
    """Assert that a run is the same with a solver that is changed."""
    found = []
    for is_changed in (False, True):
        case = load_case("ablation-depth", list(settings))
        solver = recipe_of(case).build(compute.cpu(threads=1))
        if is_changed:
            change(solver)
        while solver.state.time < case.time.end * (1.0 - 1e-12):
            solver.step(binding_limit(solver.time_step_limits())[1])
        found.append(solver)
    plain, changed = found
    assert plain.state.ejecta.number == changed.state.ejecta.number > 0
    for name in ("temperature", "position"):
        values = [s.backend.to_host(s.particles[name]) for s in found]
        np.testing.assert_allclose(*values, rtol=1e-11, atol=1e-20)
