"""Flows between two planes, started from rest, against the exact transients."""

from functools import partial

import numpy as np
import pytest
from flow_boxes import box, place_of, start_from
from law_runs import go

from lasersph.analytic.plane_flows import couette, poiseuille

NU = 0.01
TIMES = (2.0, 10.0, 25.0)
"""[s]: nu t / gap^2 = 0.02, 0.1 and 0.25."""


def assert_follows(solver, exact, axis, offset, largest):
    """Velocity along `axis` within 1 % of the largest of the steady flow (RMS), little across.

    Mirrored beyond a wall the profile bends; the divergence of sheared rows sees 0.2 % of that.
    """
    for time in TIMES:
        go(solver, time)
        velocity = solver.backend.to_host(solver.flow.velocity)
        error = velocity[axis] - exact(offset + place_of(solver)[1 - axis], time)
        assert np.sqrt(np.mean(error**2)) < 0.01 * largest
        assert np.abs(velocity[1 - axis]).max() < 3e-3 * largest


@pytest.mark.parametrize("kind", ["implicit", "explicit"])
def test_wall_that_begins_to_move(kind):
    """Couette's flow below a wall of 0.1 m/s."""
    sides = {"left": "periodic", "right": "periodic",
             "surface": {"kind": "moving-wall", "velocity": 0.1}}  # fmt: skip
    solver = box(flow=sides, heat={"sides": "periodic"}, cells=16, width=0.625, end=30.0,
                 step=0.1, viscosity=kind)  # fmt: skip
    exact = partial(couette, gap=1.0, speed=0.1, viscosity=NU)
    assert_follows(solver, exact, 0, 1.0, 0.1)


def test_force_that_begins_to_act():
    """Poiseuille's flow between upright walls, lifted by the warmth of all of the liquid."""
    open_ends = {"bottom": "periodic", "surface": "periodic"}
    solver = box(flow=open_ends, heat=open_ends, cells=16, depth=0.625, end=30.0, step=0.1,
                 gravity=1.0, material={"expansion": "0.001 1/K"})  # fmt: skip
    start_from(solver, np.full(solver.body.count, 10.0))
    exact = partial(poiseuille, gap=1.0, force=0.01, viscosity=NU)
    assert_follows(solver, exact, 1, 0.5, 0.125)
