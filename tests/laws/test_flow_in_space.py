"""Flow in three dimensions below a flat surface: what must not change, and what must not appear.

Boxes of 8 particles a side below a surface that tension drives, between warm and cold walls.
"""

import numpy as np
import pytest
from flow_boxes import box, box_case, go, host_fields

from lasersph import compute
from lasersph.simulation.recipes import recipe_of

STEPS = 4
MATERIAL = {"expansion": "0.01 1/K", "surface_tension_slope": "-5e-2 N/(m K)"}
EXACT = {"dimensions": 3, "gravity": 10.0, "pressure_tolerance": 1e-12, "tolerance": 1e-13}
"""What a solution is off by follows the lattice of its grids, and is left out here."""
WALLS = {"bottom": "no-slip", "surface": "flat"}
SIDES = ("left", "right", "front", "back")


def space(*, warm=(), cold=(), flow=None, domain=None, backend=None, **settings):
    """Box of unit liquid with sides held at 310 K and 290 K."""
    heat = {side: "fixed-temperature" for side in (*warm, *cold)}
    heat |= {f"{side}_temperature": 310.0 for side in warm}
    heat |= {f"{side}_temperature": 290.0 for side in cold}
    chosen = {"flow": WALLS if flow is None else flow, "heat": heat, "material": MATERIAL}
    case = box_case(cells=8, end=10.0, step=0.05, domain=domain, **EXACT, **chosen, **settings)
    return recipe_of(case).build(backend or compute.cpu(threads=1))


def in_order(solver, axes=(0, 1, 2)):
    """Fields of the particles, the axes of vectors permuted, in the order of the first lattice."""
    fields = host_fields(solver)
    start = solver.body.filling.position[:, : solver.particle_count][list(axes)]
    order = np.lexsort(np.round(start / solver.domain.spacing, 3))
    found = {}
    for name in ("position", "velocity"):
        found[name] = fields[name][list(axes)][:, order]
    found |= {name: fields[name][order] for name in ("enthalpy", "pressure", "temperature")}
    return found


def assert_alike(one, other, tolerance):
    """The same fields, as parts of their largest values."""
    for name, values in one.items():
        size = np.abs(values).max()
        assert other[name] == pytest.approx(values, rel=0.0, abs=tolerance * size), name


def test_turned_by_a_right_angle():
    """Warm and cold along y in place of x: the same flow with both axes exchanged."""
    along_x, along_y = space(warm=["left"], cold=["right"]), space(warm=["front"], cold=["back"])
    for solver in (along_x, along_y):
        go(solver, STEPS)
    assert along_x.flow.largest_speed > 0.01
    assert_alike(in_order(along_x), in_order(along_y, axes=(1, 0, 2)), 1e-10)


def test_uniform_along_y():
    """What is the same at all y stays so, and nothing moves along y."""
    flow = WALLS | {"front": "periodic", "back": "periodic"}
    solver = box(
        backend=compute.cpu(threads=1),
        **{"cells": 8, "end": 10.0, "step": 0.05},
        **EXACT,
        flow=flow,
        heat={
            "left": "fixed-temperature", "left_temperature": 310.0, "front": "periodic",
            "right": "fixed-temperature", "right_temperature": 290.0, "back": "periodic",
        },
        material=MATERIAL,
    )  # fmt: skip
    go(solver, STEPS)
    fields = host_fields(solver)
    v, T = fields["velocity"], fields["temperature"]
    speed = np.abs(v).max()
    assert speed > 0.01
    assert np.abs(v[1]).max() < 1e-12 * speed
    # layers of 8 x 8, y fastest
    for values in (*v[[0, 2]], T):
        rows = values.reshape(8, 8, 8)
        assert np.ptp(rows, axis=2).max() < 1e-12 * np.abs(values).max()


def test_a_quarter_is_a_part_of_the_whole():
    """Cold walls all around: what flows at x > 0 and y > 0 is the quarter with two mirrors."""
    whole = space(cold=SIDES)
    part = {"left": "symmetry", "front": "symmetry"}
    quarter = space(cold=("right", "back"), flow=WALLS | part, domain={"extent": "quarter"})
    for solver in (whole, quarter):
        go(solver, STEPS)
    assert whole.flow.largest_speed > 0.01
    assert quarter.particle_count == whole.particle_count // 4
    found, expected = in_order(quarter), in_order(whole)
    x, y, _ = whole.body.filling.position[:, : whole.particle_count]
    start = whole.body.filling.position[:, : whole.particle_count]
    order = np.lexsort(np.round(start / whole.domain.spacing, 3))
    inside = ((x > 0.0) & (y > 0.0))[order]
    part = {name: values[..., inside] for name, values in expected.items()}
    # a pressure is known but for a constant, which is that of mean 0 in both
    assert_alike(part, found, 1e-7)


def test_heat_that_enters_is_heat_that_is_there():
    """What the six sides have let in is what the particles hold."""
    solver = space(warm=["left", "front"], cold=["back"])
    go(solver, STEPS)
    fields = host_fields(solver)
    held = float(np.sum(fields["mass"] * fields["enthalpy"]))
    booked = solver.exchange.heat
    assert booked["left"] > 0.0 > booked["back"] and booked["surface"] == 0.0
    assert held == pytest.approx(sum(booked.values()), rel=1e-9, abs=0.0)


def test_same_bits():
    """Of any number of threads, and where NumPy cannot touch the arrays."""
    solvers = [
        space(warm=["left"], cold=["back"], backend=backend)
        for backend in (compute.cpu(threads=1), compute.cpu(threads=2), compute.strict(threads=1))
    ]
    for solver in solvers:
        go(solver, STEPS)
    first, *others = solvers
    for other in others:
        assert other.checkpoint_scalars() == first.checkpoint_scalars()
        fields = host_fields(other)
        for name, values in host_fields(first).items():
            assert np.array_equal(values, fields[name]), name


def test_goes_on_from_a_checkpoint_with_the_same_bits():
    """State and numbers of a step carry the flow on as if nothing had happened."""
    one, other = (space(warm=["left"], cold=["back"]) for _ in range(2))
    go(one, STEPS)
    arrays = {name: one.backend.to_host(array).copy() for name, array in one.fields.items()}
    other.restore(arrays, one.checkpoint_scalars())
    for solver in (one, other):
        go(solver, 2)
    fields = host_fields(other)
    for name in ("position", "velocity", "enthalpy", "pressure", "settled_jump"):
        assert np.array_equal(host_fields(one)[name], fields[name]), name
