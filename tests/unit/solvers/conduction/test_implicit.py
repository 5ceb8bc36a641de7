"""First guess, forcing and bookkeeping of the implicit step."""

import numpy as np
import pytest
from law_runs import go, host, solver_of

from lasersph.solvers.conduction.implicit import FORCING, close_balance, initial_guess, linearize

# c = 1000 J/(kg K), k = 20 W/(m K), melting at 500 K with 2e5 J/kg, T_0 = 300 K
H = np.array([0.0, 2e5, 4e5, 6e5])
T = np.array([300.0, 500.0, 500.0, 700.0])
P = np.array([0.0, 4000.0, 4000.0, 8000.0])


def test_guess_is_a_parabola_of_the_potential():
    """P = 100, 400, 900 W/m at equal steps goes on with 1600; the excess is left out."""
    h_older, h_old, h = (value / 0.02 for value in (100.0, 400.0, 900.0))
    found = initial_guess(h + 7.0, 7.0, h_old, h_older, 0, 1.0, 2.0, -1.0, H, P)
    assert found == pytest.approx((1600.0 / 0.02, 1600.0, 0.02))


def test_guess_on_a_plateau_is_a_line_of_the_enthalpy():
    """3.0e5, then 3.2e5 J/kg: 3.6e5 after a step twice as long."""
    found = initial_guess(3.2e5, 0.0, 3.0e5, 2.9e5, 1, 2.0, 9.0, -9.0, H, P)
    assert found == pytest.approx((3.6e5, 4000.0, 0.0))


def test_linearize_by_hand():
    """C = (m + s dq dT/dh) dh/dP = (2 + 0.5 * 4 * 0.001) / 0.02; nothing on the plateau."""
    assert linearize(1e5, 0.02, 2.0, 4.0, 0.5, H, T) == pytest.approx((100.1, 1.0))
    assert linearize(3e5, 0.0, 2.0, 4.0, 0.5, H, T) == (1.0, 0.0)


def test_settle_by_hand():
    """r / m = 3 is added and remembered; 2 (13 - 7) J are stored."""
    assert close_balance(10.0, 6.0, 2.0, 7.0, 1.0, 5.0) == (13.0, 3.0, 6.0, 5.0)


def test_few_iterations_where_heat_flows_smoothly():
    """After the pulse three iterations close the balance to 1e-8, since the guess is that good."""
    _, solver = solver_of(
        "dlip-steel", "solver.kind=conduction", "particles.spacing=100nm", "time.end=60ns"
    )
    go(solver, 5.9e-8)
    assert FORCING[0] <= solver.scheme.forcing <= FORCING[1]
    assert solver.iterations["newton"] <= 3
    assert np.abs(host(solver, "enthalpy_excess")).max() <= 1e-5 * host(solver, "enthalpy").max()


def test_restored_solver_repeats_the_bits():
    """A solver given the arrays and numbers of another takes the same next steps."""
    solvers = [
        solver_of("dlip-steel", "solver.kind=conduction", "particles.spacing=200nm")[1]
        for _ in range(2)
    ]
    first, second = solvers
    go(first, 4.6e-8)
    arrays = {name: host(first, name) for name in first.fields}
    second.restore(arrays, first.checkpoint_scalars())
    for solver in solvers:
        go(solver, 4.65e-8)
    assert first.checkpoint_scalars() == second.checkpoint_scalars()
    assert all(np.array_equal(host(first, name), host(second, name)) for name in first.fields)
