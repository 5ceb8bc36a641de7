"""What the validations of ablation take from runs, and the rows that need no run."""

from types import SimpleNamespace

import numpy as np
import pytest
import synthetic_ablation

from lasersph.output import open_run
from lasersph.validation import ablation_aluminium, ablation_depth, quasi_1d_heating
from lasersph.validation.ablation_depth import Column
from lasersph.validation.ablation_front import ablate


@pytest.fixture(scope="module")
def spot(tmp_path_factory):
    """A made-up crater in 3-D."""
    return open_run(synthetic_ablation.make_run(tmp_path_factory.mktemp("spot") / "run", 3))


def test_stefan_solution_of_the_case():
    """The metal and the reflectivity of the shipped case are those of the reference."""
    found = ablation_depth.stefan(10, 10)
    assert found.depth == pytest.approx(ablate(2.5e12, 10e-9).depth, rel=1e-6)
    (row,) = ablation_depth.reference_rows({(10, 10): found})
    assert row.verdict and row.published == 0.6


def test_column_in_any_dimension():
    """A depth, and the volume over the area of the column, in micrometers."""
    crater = {"depth_m": 4e-7, "vaporized_volume_max_m3": 5e-7 * 1.6e-6**2}
    case = {"domain": {"width": 1.6e-6}, "solver": {"dimensions": 3}}
    found = Column.of(SimpleNamespace(summary={"crater": crater}, case=case))
    assert (found.whole, found.smooth) == pytest.approx((0.4, 0.5))


def test_depths_are_judged_by_layers():
    """One layer too shallow passes, one and a half fail; errors must fall with the spacing."""
    exact = {(10, 10): SimpleNamespace(depth=0.5e-6)}
    columns = {(10, 10, 0.2): Column(0.4, 0.5), (10, 10, 0.1): Column(0.35, 0.52)}
    rows = ablation_depth.depth_rows(exact, columns, (0.2, 0.1))
    assert [row.verdict for row in rows] == [True, False]
    smooth, falls = ablation_depth.convergence_rows(exact, columns, (0.2, 0.1), quick=False)
    assert smooth.verdict is False
    assert falls.computed == pytest.approx(1.5) and falls.verdict is False


def test_runs_of_the_published_rule():
    """Every fluence at the coarsest spacing, 10 J/cm2 at all."""
    chosen = ablation_depth.published_choice({(10, 10): None, (6, 25): None}, (0.2, 0.1))
    assert chosen == [(10, 10, 0.2), (6, 25, 0.2), (10, 10, 0.1)]


def test_numbers_without_a_run():
    """Eq. (5) and the light in metal and vapor."""
    rows = [*ablation_aluminium.pressure_rows(), *ablation_aluminium.estimate_rows()]
    assert all(row.verdict is not False for row in rows)
    assert sum(row.verdict is True for row in rows) == 5


def test_rows_of_a_spot(spot):
    """A symmetric crater that keeps its energy passes; its sizes are shown."""
    assert ablation_aluminium.asymmetry(spot) < 1e-12
    rows = ablation_aluminium.spot_rows("made-up", spot)
    assert [row.verdict for row in rows[:2]] == [True, True]
    assert rows[2].computed == pytest.approx(0.8)


def test_row_of_a_time_that_never_came():
    """A particle that did not leave fails its row and stops nothing."""
    assert ablation_aluminium.nanoseconds(None) is None
    assert ablation_aluminium.nanoseconds(1.25e-9) == pytest.approx(1.25)


def test_rod_with_and_without_walls():
    """The rod has its published width; without walls a few columns stand for it."""
    walled = quasi_1d_heating.sides(quasi_1d_heating.WALLED, 0.5)
    assert "boundaries.sides=wall" in walled
    assert "domain.width=2.0 um" in quasi_1d_heating.sides(quasi_1d_heating.OPEN, 0.5)


def test_mean_over_the_surface():
    """Only the first layer of a snapshot counts."""
    step = {"temperature": np.array([1.0, 3.0, 50.0]), "surface": np.array([1, 1, 0])}
    run = SimpleNamespace(snapshots=SimpleNamespace(nearest=lambda time: step))
    assert quasi_1d_heating.over_surface(run, 0.0) == 2.0
