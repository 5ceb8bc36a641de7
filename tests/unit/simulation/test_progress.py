"""The time that remains, from spans of known cost and from a recorded run, without a clock."""

import pytest

from lasersph.case import load_case
from lasersph.simulation.forecast import spans_of
from lasersph.simulation.progress import LEAST_STEPS, RemainingTime, Span
from lasersph.simulation.recipes import recipe_of

SPANS = (Span("light", 10.0, 10.0), Span("flow", 20.0, 90.0), Span("cooling", 100.0, 20.0))

STEEL = (
    (0.2, 0.0), (26.0, 0.36), (29.47, 0.47), (31.5, 0.67), (33.6, 0.9), (35.65, 1.15), (37.7, 1.41),
    (39.8, 1.67), (41.85, 1.92), (43.9, 2.15), (44.95, 2.3), (46.0, 2.52), (47.0, 3.81),
    (49.1, 4.83), (51.15, 5.87), (53.2, 7.0), (55.3, 8.17), (57.34, 9.25), (59.22, 10.37),
    (60.98, 11.5), (63.0, 12.58), (65.05, 13.66), (67.15, 14.73), (69.2, 15.71), (71.23, 16.64),
    (73.3, 17.6), (75.35, 18.58), (77.4, 19.37), (79.5, 19.75), (81.55, 20.0), (83.86, 20.25),
    (86.68, 20.52), (90.09, 20.75), (94.23, 20.95), (99.51, 21.18), (105.68, 21.4),
    (113.03, 21.65), (122.0, 21.94), (132.92, 22.22), (145.73, 22.53), (161.34, 22.91),
    (179.07, 23.36), (200.0, 23.86),
)  # fmt: skip
"""Simulated [ns] and processor time [s] of dlip-steel at 16 nm: flow takes most of it."""


def test_costs_as_expected():
    """Steps that cost what was expected: the remaining time is that of the forecast."""
    remaining = RemainingTime(SPANS)
    assert remaining.work_done(10.0) == pytest.approx(10.0 / 120.0)
    assert remaining.work_done(15.0) == pytest.approx(55.0 / 120.0)
    told = [remaining.step_to(0.5 * step, 0.5 * step) for step in range(21)]
    assert told[:LEAST_STEPS] == [None] * LEAST_STEPS
    assert told[-1] == pytest.approx(110.0)


def test_machine_of_another_speed():
    """Kinds of spans that were not met yet are as much slower as those that were."""
    remaining = RemainingTime(SPANS)
    told = [remaining.step_to(0.5 * step, 1.5 * step) for step in range(11)]
    assert told[-1] == pytest.approx(3.0 * 115.0)


def test_each_kind_corrects_itself():
    """Flow that costs a tenth of what was expected; light stays as dear as it was."""
    remaining, wall, told = RemainingTime(SPANS), 0.0, None
    for step in range(1, 31):
        wall += 0.5 if step <= 20 else 0.45
        told = remaining.step_to(0.5 * step, wall)
    assert told == pytest.approx(0.1 * 45.0 + 20.0 * (10.0 + 4.5) / (10.0 + 45.0), rel=0.05)


def test_compiling_is_no_measure():
    """A step of a minute among those of half a second counts as five of them."""
    remaining, wall, told = RemainingTime(SPANS), 0.0, None
    for step in range(1, 16):
        wall += 60.0 if step == 10 else 0.5
        told = remaining.step_to(0.5 * step, wall)
    assert told == pytest.approx((15.0 + 4.0) / 15.0 * 112.5, rel=0.05)


def test_recorded_run_of_steel():
    """After a tenth of the work, before anything flows, the estimate is within a factor of 1.5."""
    recipe = recipe_of(load_case("dlip-steel", ["particles.spacing=16nm"]))
    remaining, whole = RemainingTime(spans_of(recipe, recipe.step_forecast(), 1)), STEEL[-1][1]
    ratios = {}
    for time, wall in STEEL:
        left = remaining.step_to(1e-9 * time, wall)
        if left is not None:
            ratios[wall / whole] = left / (whole - wall) if wall < whole else 1.0
    early = [ratio for share, ratio in ratios.items() if 0.05 < share < 0.5]
    assert len(early) > 10
    assert all(1.0 / 1.5 < ratio < 1.5 for ratio in early)
    assert all(0.4 < ratio < 2.0 for ratio in ratios.values())
