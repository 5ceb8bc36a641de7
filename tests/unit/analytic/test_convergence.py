"""Order, Richardson value and GCI on sequences with a known limit."""

import math

import pytest

from lasersph.analytic import convergence


def results(spacings, order=2.0, limit=3.0, factor=5.0):
    """f = limit + factor * d^order."""
    return [limit + factor * d**order for d in spacings]


@pytest.mark.parametrize("order", [0.7, 1.12, 2.0])
@pytest.mark.parametrize("spacings", [(0.25, 0.5, 1.0), (0.2, 0.31, 0.9)])
def test_order_and_limit_are_found_for_any_ratio(order, spacings):
    """Exact power laws give their order and limit back, equal ratios or not."""
    found = convergence.assess(results(spacings, order), spacings)
    assert found.kind == "converging"
    assert found.order == pytest.approx(order, rel=1e-9)
    assert found.extrapolated == pytest.approx(3.0, rel=1e-9)


def test_numbers_of_the_paper():
    """Eqs. 36 and 37: eps = -0.0086 and p = 1.12 at r = 2 give about 0.9 % with F_s = 1.25."""
    assert convergence.grid_convergence_index(-0.0086, 2.0, 1.12) == pytest.approx(
        0.00916, abs=1e-5
    )
    assert convergence.relative_error(4517.4, 4556.57) == pytest.approx(-0.0086, abs=1e-4)


def test_gci_bounds_the_error():
    """With F_s = 1.25 the index is 1.25 times the true relative error of a pure power law."""
    found = convergence.assess(results((0.1, 0.2, 0.4)), (0.1, 0.2, 0.4))
    value = results((0.1,))[0]
    assert found.gci == pytest.approx(1.25 * (value - 3.0) / value, rel=1e-9)


def test_order_of_spacings_does_not_matter():
    """Coarse first or fine first, with a fourth, coarser result ignored."""
    spacings = (1.0, 0.25, 0.5, 2.0)
    assert convergence.assess(results(spacings), spacings).order == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("values", "kind"),
    [
        ([1.0, 1.1, 1.05], "oscillating"),
        ([1.0, 2.0, 2.5], "diverging"),
        ([1.0, 1.0, 2.0], "stepped"),
        ([1.0, 2.0, 2.0], "stepped"),
        ([0.1 + 0.2, 0.3, 0.3], "exact"),
        ([0.0, 0.0, 0.0], "exact"),
    ],
)
def test_what_does_not_converge_is_called_so(values, kind):
    """No order, no extrapolated value for sequences that do not converge."""
    found = convergence.assess(values, (0.25, 0.5, 1.0))
    assert found.kind == kind
    assert math.isnan(found.order)


@pytest.mark.parametrize(
    ("values", "uncertainty"),
    [
        ((3.05, 3.2, 3.8), 1.25 * 0.15 / 3),  # order 2: 3 + 5 d^2, r^p - 1 = 3
        ((3.5, 4.0, 5.0), 1.25 * 0.5 / 1),  # order 1: 3 + 5 d
        ((1.0, 1.1, 0.7), 1.25 * 0.1 / 3),  # oscillating, changes 0.1 and -0.4: order 2
        ((1.0, 1.1, 2.7), 1.25 * 0.1 / 3),  # order 4, taken as 2
        ((1.0, 2.0, 2.5), 3.0 * 1.0 / (2**0.5 - 1)),  # diverging
        ((1.0, 1.2, 1.1), 3.0 * 0.2 / (2**0.5 - 1)),  # oscillating and growing
        ((1.0, 2.0, 3.01), 3.0 * 1.0 / (2**0.5 - 1)),  # order 0.014, no worse than no order
        ((1.0, 1.0, 1.3), 0.3),  # stepped: the largest difference
        ((2.0, 2.0, 2.0), 0.0),
    ],
)
def test_uncertainty_by_hand(values, uncertainty):
    """Grid convergence index of three results whose spacings double, in their unit."""
    found = convergence.assess(values, (0.1, 0.2, 0.4))
    assert found.uncertainty == pytest.approx(uncertainty, rel=1e-9)
    assert found.gci == pytest.approx(uncertainty / values[0], rel=1e-9)


def test_oscillation_at_unequal_ratios():
    """r21 = 2, r32 = 3 and order 1: the changes are as r21 (r32 + 1)/(r21 + 1) = 8/3."""
    found = convergence.assess((1.0, 1.3, 0.5), (0.1, 0.2, 0.6))
    assert found.kind == "oscillating"
    assert found.uncertainty == pytest.approx(1.25 * 0.3)


def test_wrong_input_is_refused():
    """Two values, or equal spacings."""
    with pytest.raises(ValueError, match="three"):
        convergence.observed_order([1.0, 2.0], [1.0, 2.0])
    with pytest.raises(ValueError, match="grow"):
        convergence.observed_order([1.0, 2.0, 3.0], [1.0, 1.0, 2.0])
