"""Two particles exchanging heat, followed by hand through one step of each scheme."""

import numpy as np
import pytest
from two_particles import (
    COLD,
    HOT,
    SPACING,
    constants,
    enthalpy_of,
    set_enthalpy,
    solver_of,
    temperature_of,
)

STEP = 2e-12


def heated(scheme, **settings):
    """Solver with the upper particle at HOT; its mass, capacity and rate lambda = g k / (m c)."""
    solver = solver_of(scheme=scheme, **settings)
    density, capacity, k, g = constants(solver)
    set_enthalpy(solver, np.array([capacity * (HOT - COLD), 0.0]))
    mass = density * SPACING
    return solver, mass, capacity, g * k / (mass * capacity)


def test_weight_by_hand():
    """W'(s = 1/3) of the cubic spline: 4/3 / l^2 (24 (1/6)^2 - 6 (2/3)^2) = -8/3 / l^2."""
    solver = solver_of()
    g = constants(solver)[3]
    assert g == pytest.approx(2.0 * SPACING * 8.0 / 3.0 / (3.0 * SPACING) ** 2, rel=1e-12)
    pairs = solver.body.pairs
    assert np.asarray(pairs.weights) == pytest.approx([g, g], rel=1e-12)
    assert np.asarray(pairs.total) == pytest.approx([g, g], rel=1e-12)


@pytest.mark.parametrize("iteration", ["newton", "published"])
def test_implicit(iteration):
    """The difference shrinks by 1 / (1 + 2 dt lambda), the mean stays."""
    solver, _, capacity, rate = heated("implicit", iteration=iteration)
    assert temperature_of(solver) == pytest.approx([HOT, COLD])
    assert solver.step(STEP) == STEP
    half = 0.5 * (HOT - COLD) / (1.0 + 2.0 * STEP * rate)
    mean = 0.5 * (HOT + COLD)
    assert temperature_of(solver) == pytest.approx([mean + half, mean - half], abs=1e-5)
    assert enthalpy_of(solver).sum() == pytest.approx(capacity * (HOT - COLD), rel=1e-12)
    assert solver.state.time == solver.state.time_step == STEP


def test_explicit():
    """The midpoint rule: the difference shrinks by 1 - x + x^2 / 2 with x = 2 dt lambda."""
    solver, _mass, capacity, rate = heated("explicit")
    solver.step(STEP)
    x = 2.0 * STEP * rate
    half = 0.5 * (HOT - COLD) * (1.0 - x + 0.5 * x * x)
    mean = 0.5 * (HOT + COLD)
    assert temperature_of(solver) == pytest.approx([mean + half, mean - half], rel=1e-9)
    assert enthalpy_of(solver).sum() == pytest.approx(capacity * (HOT - COLD), rel=1e-12)


def test_stable_step():
    """Two particles: lambda_max = 2 g k / (m c), so that 1 / (g k / (m c)) is the exact limit."""
    solver, _mass, _capacity, rate = heated("explicit")
    assert solver.scheme.stable_step() == pytest.approx(1.0 / rate, rel=1e-9)


def test_largest_change_is_recorded():
    """The largest change of temperature of a step steers the next one."""
    solver, *_ = heated("implicit")
    before = temperature_of(solver)
    solver.step(STEP)
    change = np.abs(temperature_of(solver) - before).max()
    assert solver.state.temperature_change == pytest.approx(change, rel=1e-12)


def test_a_state_restored_continues_to_the_bit():
    """Fields and checkpoint scalars are all that a step reads."""
    first, *_ = heated("implicit")
    first.step(STEP)
    second = solver_of()
    second.restore(
        {name: np.array(a) for name, a in first.fields.items()}, first.checkpoint_scalars()
    )
    for solver in (first, second):
        solver.step(3 * STEP)
        solver.step(STEP)
    assert np.array_equal(enthalpy_of(first), enthalpy_of(second))
    assert first.checkpoint_scalars() == second.checkpoint_scalars()
    assert first.time_step_limits() == second.time_step_limits()
