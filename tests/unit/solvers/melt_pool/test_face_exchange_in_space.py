"""Momentum that the faces of a block exchange: shares by hand, and what must balance."""

import numpy as np
import pytest
from flow_boxes import block_of, box, go, place_of

from lasersph.particles.ghosts import LOWER, UPPER

ENDS = {"x": ("left", "right"), "y": ("front", "back"), "z": ("bottom", "surface")}
SPACE = {"dimensions": 3, "shifting": 0.0, "viscosity": "explicit", "pressure_tolerance": 1e-12}


def shares_of(solver, **crossed):
    """Shares (d,) by face of the ghosts that have crossed these axes at these ends, and no tangent
    of a surface."""
    conditions, ghosts = solver.domain.conditions, solver.flow.block.ghosts
    types = ghosts.particles.ghost_types
    ends = np.array([crossed.get(axis, 0) for axis in "xyz"])
    found = (types.crossed == ends[:, None]).all(axis=0) & (types.crosses_surface == 0.0)
    (number,) = np.flatnonzero(found)
    shares = conditions.force_shares(types)
    found = {
        face: shares[end][axis, :, number].tolist()
        for axis, faces in enumerate(ENDS.values())
        for end, face in zip(("lower", "upper"), faces, strict=True)
    }
    return {face: values for face, values in found.items() if any(values)}


def test_shares_of_walls_and_planes_by_hand():
    """One wall has all; of two each what lies across it, and half of what lies along both; a plane
    of symmetry has a share only where it is alone."""
    solver = box(cells=8, flow={"left": "symmetry"}, **SPACE)
    block_of(solver)
    assert shares_of(solver) == {}
    assert shares_of(solver, z=LOWER) == {"bottom": [1.0, 1.0, 1.0]}
    assert shares_of(solver, y=UPPER, z=LOWER) == {
        "back": [0.5, 1.0, 0.0],
        "bottom": [0.5, 0.0, 1.0],
    }
    corner = shares_of(solver, x=UPPER, y=UPPER, z=LOWER)
    assert corner == {"right": [1.0, 0.0, 0.0], "back": [0.0, 1.0, 0.0], "bottom": [0.0, 0.0, 1.0]}
    assert shares_of(solver, x=LOWER) == {"left": [1.0, 1.0, 1.0]}
    assert shares_of(solver, x=LOWER, z=LOWER) == {"bottom": [1.0, 1.0, 1.0]}


def total_force(exchange):
    """Momentum that all faces have given to the liquid, along x, y and z [N s]."""
    total = []
    for axis, (low, high) in ENDS.items():
        along = sum(value for name, value in exchange.impulse.items() if name[-1] == axis)
        total.append(along + exchange.pressing[low] - exchange.pressing[high])
    return total


def test_walls_give_the_liquid_its_momentum():
    """Of all steps below a lid that has begun to move: forces of six walls and the momentum."""
    solver = box(cells=8, **SPACE)
    go(solver, 10)
    volume = solver.backend.to_host(solver.particles["volume"])
    momentum = solver.backend.to_host(solver.flow.velocity) @ volume  # the density is 1
    drag, pressing = solver.exchange.impulse, solver.exchange.pressing
    scale = drag["surface_x"]
    np.testing.assert_allclose(total_force(solver.exchange), momentum, atol=1e-9 * scale)
    # both sides of the lid's plane of symmetry feel the same, and each part matters
    assert drag["front_x"] == pytest.approx(drag["back_x"]) and drag["front_x"] > 1e-4 * scale
    assert pressing["right"] - pressing["left"] > 0.05 * scale
    numbers = solver.checkpoint_scalars()
    solver.exchange.restore(dict.fromkeys(numbers, 0.0))
    solver.exchange.restore(numbers)
    assert solver.exchange.pressing == pressing and solver.exchange.impulse == drag


def test_shear_between_two_walls():
    """Shear along y over a bottom that rests: eta du/dz on its square meter, nothing along x."""
    sides = dict.fromkeys(("left", "right", "front", "back"), "periodic")
    solver = box(cells=8, flow=sides, heat={"sides": "periodic"}, **SPACE)
    block, place = block_of(solver), place_of(solver)
    v = np.array([0.0 * place[2], place[2] + 1.0, 0.0 * place[2]])
    solver.backend.copy(solver.backend.asarray(v), solver.flow.viscous.velocity)
    solver.exchange.book_viscous_forces(block, solver.flow, 2.0)
    impulse = solver.exchange.impulse
    assert impulse.pop("bottom_y") == pytest.approx(-2.0 * 0.01)
    assert impulse.pop("surface_y") < 0.0
    assert not any(impulse.values())


def test_a_quarter_presses_as_the_whole():
    """Warm and cold sides: the walls of a quarter have half or a quarter of the forces."""
    sides = ("left", "right", "front", "back")
    warm = {f"{side}_temperature": 290.0 for side in sides}
    heat = warm | dict.fromkeys(sides, "fixed-temperature")
    settings = SPACE | {"gravity": 10.0, "tolerance": 1e-13, "viscosity": "implicit"}
    settings |= {"cells": 8, "material": {"expansion": 0.01}, "step": 0.05, "end": 10.0}
    whole = box(flow={}, heat=heat, **settings)
    part = {"left": "symmetry", "front": "symmetry"}
    held = {name: value for name, value in heat.items() if name[:4] in ("righ", "back")}
    quarter = box(flow=part, heat=held, domain={"extent": "quarter"}, **settings)
    for solver in (whole, quarter):
        go(solver, 4)
    assert quarter.particle_count == whole.particle_count // 4
    one, other = whole.exchange, quarter.exchange
    scale = abs(one.impulse["right_z"])
    assert scale > 0.0
    for name, share in (("right_z", 0.5), ("back_z", 0.5)):
        expected = share * one.impulse[name]
        assert other.impulse[name] == pytest.approx(expected, rel=1e-6), name
    for face, share in (("right", 0.5), ("bottom", 0.25), ("surface", 0.25)):
        expected = share * one.pressing[face]
        assert other.pressing[face] == pytest.approx(expected, abs=1e-6 * scale), face
