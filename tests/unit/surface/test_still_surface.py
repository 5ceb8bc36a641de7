"""Tops that stay where they are, the time rules and the gradients that surfaces bring."""

import numpy as np
import pytest
from flow_boxes import PERIODIC, PERIODIC_HEAT, box

from lasersph import compute
from lasersph.surface.pressure_gradient import DifferenceGradient, SymmetricGradient
from lasersph.surface.surface import PressureCondition, Surface, settle
from lasersph.surface.time_rule import Midpoint, WholeStep


@pytest.fixture
def backend():
    """One thread."""
    return compute.cpu(threads=1)


def test_a_box_without_a_surface_asks_nothing_of_a_step():
    """No condition, jump, limit, state or mark."""
    solver = box()
    surface, host = solver.domain.surface, solver.backend.to_host
    assert type(surface) is Surface
    assert surface.pressure == PressureCondition()
    assert surface.time_step_limits() == {} and surface.validity_error() == ""
    assert surface.state.kept == {} and surface.checkpoint_scalars() == {}
    assert not host(surface.at_surface).any() and not host(surface.velocity_jump).any()
    assert surface.length_ratio() is None


SYMMETRIC = dict.fromkeys(PERIODIC, "symmetry")


@pytest.mark.parametrize(
    "flow, heat, kind",
    [
        (SYMMETRIC, {}, DifferenceGradient),
        (PERIODIC, PERIODIC_HEAT, SymmetricGradient),
        (SYMMETRIC | {"bottom": "free-slip"}, {}, SymmetricGradient),
        (SYMMETRIC | {"surface": "no-slip"}, {}, SymmetricGradient),
        (SYMMETRIC | {"surface": "free-surface"}, {}, SymmetricGradient),
    ],
)
def test_gradient_of_a_box(flow, heat, kind):
    """Of differences between planes of symmetry alone, where no force onto a wall is booked."""
    solver = box(flow=flow, heat=heat, marangoni=False)
    assert type(solver.domain.surface.pressure_gradient) is kind
    assert solver.exchange.books_pressing == (kind is SymmetricGradient)


def test_depth_below_the_top(backend):
    """Top - z, whatever x."""
    surface = Surface(backend, 2, 0.5)
    place, out = backend.asarray(np.array([[3.0, -7.0], [0.25, -2.0]])), backend.zeros(2)
    surface.find_depth(place, out)
    assert backend.to_host(out).tolist() == [0.25, 2.5]


def test_jump_settles():
    """At once where there was none; else by the part 1 - rest^m of the difference."""
    assert settle(0.0, 3.0, 1.0, 0.9) == 3.0
    assert settle(1.0, 3.0, 1.0, 0.75) == pytest.approx(1.5)
    assert settle(1.0, 3.0, 2.0, 0.5) == pytest.approx(2.5)


def test_time_rules(backend):
    """The end of a step as it is; from its middle on by as much again."""
    before = backend.asarray(np.array([[1.0], [0.0]]))
    for rule, share, expected in ((WholeStep(), 1.0, [3.0, -2.0]), (Midpoint(), 0.5, [5.0, -4.0])):
        v = backend.asarray(np.array([[3.0], [-2.0]]))
        rule.finish(backend, v, before)
        assert backend.to_host(v)[:, 0].tolist() == expected and rule.share == share


def test_gradients():
    """Equal pressures: the symmetric one pushes as kernel sums differ, that of differences not."""
    identity, G = np.eye(2), np.array([0.5, 0.25])
    symmetric, differences = SymmetricGradient(), DifferenceGradient()
    assert symmetric.term(2.0, 2.0, identity, identity, G).tolist() == [2.0, 1.0]
    assert differences.term(2.0, 2.0, identity, identity, G).tolist() == [0.0, 0.0]
    assert differences.term(2.0, 4.0, identity, identity, G).tolist() == [1.0, 0.5]
    assert symmetric.is_symmetric and not differences.is_symmetric
