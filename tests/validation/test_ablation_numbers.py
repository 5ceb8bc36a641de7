"""What the validations of ablation take from runs, and the rows that need no run."""

from types import SimpleNamespace

import numpy as np
import pytest
import synthetic_ablation

from lasersph.output import open_run
from lasersph.validation.ablation_aluminium import rows as ablation_aluminium
from lasersph.validation.ablation_column import rows as ablation_column
from lasersph.validation.ablation_depth import rows as ablation_depth
from lasersph.validation.ablation_depth.front import ablate
from lasersph.validation.ablation_depth.rows import Column
from lasersph.validation.quasi_1d_heating import rows as quasi_1d_heating


@pytest.fixture(scope="module")
def spot(tmp_path_factory):
    """A made-up crater in 3-D."""
    return open_run(synthetic_ablation.make_run(tmp_path_factory.mktemp("spot") / "run", 3))


def test_stefan_solution_of_the_case(study):
    """The metal and the reflectivity of the shipped case are those of the reference."""
    one = study("ablation-depth")
    found = ablation_depth.stefan(one, 10, 10)
    assert found.depth == pytest.approx(ablate(2.5e12, 10e-9).depth, rel=1e-6)
    ablation_depth.add_stefan(one, {(10, 10): found})
    (row,) = one.rows
    assert row.verdict and row.published == 0.6


def test_column_in_any_dimension():
    """A depth, and the volume over the area of the column, in micrometers."""
    crater = {"depth_m": 4e-7, "vaporized_volume_max_m3": 5e-7 * 1.6e-6**2}
    case = {"domain": {"width": 1.6e-6}, "solver": {"dimensions": 3}}
    found = Column.of(SimpleNamespace(summary={"crater": crater}, case=case))
    assert (found.whole, found.smooth) == pytest.approx((0.4, 0.5))


def test_depths_are_judged_by_layers(study):
    """One layer too shallow passes, one and a half fail; errors must fall with the spacing."""
    exact = {(10, 10): SimpleNamespace(depth=0.5e-6)}
    columns = {(10, 10, 0.2): Column(0.4, 0.5), (10, 10, 0.1): Column(0.35, 0.52)}
    one = study("ablation-depth")
    one.plan.spacings = (0.2, 0.1)
    ablation_depth.add_depths(one, exact, columns)
    *layers, smooth, falls = one.rows
    assert [row.verdict for row in layers] == [True, False]
    assert smooth.verdict is False
    assert falls.computed == pytest.approx(1.5) and falls.verdict is False


def test_runs_of_the_published_rule(study):
    """Every fluence at the coarsest spacing, 10 J/cm2 at all."""
    one = study("ablation-depth", quick=True)
    chosen = ablation_depth.published_choice(one, [(10, 10), (6, 25)])
    assert chosen == [((10, 10), 0.2), ((6, 25), 0.2), ((10, 10), 0.1)]


def test_numbers_without_a_run(study):
    """Eq. (5) and the light in metal and vapor."""
    one = study("ablation-column")
    ablation_column.add_estimates(one)
    assert all(row.verdict is not False for row in one.rows)
    assert sum(row.verdict is True for row in one.rows) == 6


def test_rows_of_a_spot(study, spot):
    """A crater that keeps its energy passes; its sizes are shown; it is symmetric."""
    assert ablation_aluminium.asymmetry(spot) < 1e-12
    one = study("ablation-aluminium")
    kept = spot.summary | {"energy": {"imbalance_relative": 1e-9}}
    one.add_group("spot", SimpleNamespace(summary=kept), name="made-up")
    balance, depth, *_ = one.rows
    assert balance.verdict is True
    assert depth.computed == pytest.approx(0.8) and depth.verdict is None


def test_row_of_a_time_that_never_came(study):
    """A particle that did not leave fails its row and stops nothing."""
    one = study("ablation-column")
    never = {"melted_at_s": None, "left_at_s": 1.25e-9}
    one.add_group("column", SimpleNamespace(summary={"traces": {"center": never}}))
    verdicts = {row.quantity.split()[-2]: row.verdict for row in one.rows[:3]}
    assert verdicts == {"melted": False, "boiled": False, "left": True}


def test_rod_with_and_without_walls(study):
    """The rod has its published width; without walls a few columns stand for it."""
    one = study("quasi-1d-heating")
    assert "boundaries.sides=wall" in quasi_1d_heating.sides(one, quasi_1d_heating.WALLED)
    assert "domain.width=2.0 um" in quasi_1d_heating.sides(one, quasi_1d_heating.OPEN)


def test_first_layer_of_a_snapshot():
    """Only the first layer counts."""
    step = {"temperature": np.array([1.0, 3.0, 50.0]), "surface": np.array([1, 1, 0])}
    run = SimpleNamespace(snapshots=SimpleNamespace(nearest=lambda time: step))
    assert quasi_1d_heating.at_surface(run, 0.0).tolist() == [1.0, 3.0]
