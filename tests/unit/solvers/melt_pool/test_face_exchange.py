"""Heat and momentum that faces exchange: pairs by hand, slabs, and what must balance."""

import numpy as np
import pytest
from flow_boxes import block_of, box, go, jittered, start_from

from lasersph.solvers.melt_pool.face_exchange import (
    FaceExchange,
    force_of_row,
    heat_of_pair,
    heat_of_particle,
    pressure_force,
    viscous_force,
)

E_X = np.array([1.0, 0.0])
WARM = {"left": "fixed-temperature", "left_temperature": 310.0}
COLD = {"right": "fixed-temperature", "right_temperature": 290.0}
CONDUCTIVITY, SPACING = 0.01, 0.1


def test_heat_of_three_particles_by_hand():
    """A particle 1 before a face at x = 0 and its ghosts 1 and 3 beyond it, P_w - P_i = 7:
    g (n_i + n_j) / n_i (P_w - P_i) = 0.5 * 2 * 7 + 0.25 * 4 * 7; with a flux 2 q g n_j; nothing of
    another face."""
    pair = {
        "P_w_j": 10.0,
        "T_w_j": 0.0,
        "normal_j": E_X,
        "plane_j": 0.0,
        "x_i": -E_X,
        "min_distance": 0.1,
        "heat_face_j": 2.0,
    }
    ghosts = [{"g_ij": 0.5, "x_j": 1.0 * E_X}, {"g_ij": 0.25, "x_j": 3.0 * E_X}]
    for kinds, expected in (
        ({"dirichlet_j": 1.0, "flux_j": 0.0}, 14.0),
        ({"dirichlet_j": 0.0, "flux_j": 4.0}, 10.0),
    ):
        for face, heat in ((2.0, expected), (1.0, 0.0)):
            sums = np.sum([heat_of_pair(**pair, **kinds, **g, face=face) for g in ghosts], axis=0)
            assert heat_of_particle(3.0, *sums) == heat


def shares(**given):
    """Shares of the lower and the upper face of each axis, of the types 0, no ghost, and 1."""
    none = np.zeros((2, 2))
    ends = {end: [none, np.array(given.get(end, none))] for end in ("lower", "upper")}
    return {**ends, "ones": np.ones(2), "ghost_type_j": 1}


def test_viscous_force_by_hand():
    """g (v_j - v_i) on the left, on the surface, and in a corner of both across each of them."""
    pair = {"g_ij": 0.5, "v_i": np.array([1.0, 2.0]), "v_j": np.array([5.0, 8.0])}
    left = viscous_force(**pair, **shares(lower=[[1.0, 1.0], [0.0, 0.0]]))
    np.testing.assert_array_equal(left, [[[2.0, 3.0], [0.0, 0.0]], np.zeros((2, 2))])
    surface = viscous_force(**pair, **shares(upper=[[0.0, 0.0], [1.0, 1.0]]))
    np.testing.assert_array_equal(surface, [np.zeros((2, 2)), [[0.0, 0.0], [2.0, 3.0]]])
    corner = {"lower": [[1.0, 0.0], [0.0, 0.0]], "upper": [[0.0, 0.0], [0.0, 1.0]]}
    found = viscous_force(**pair, **shares(**corner))
    np.testing.assert_array_equal(found, [[[2.0, 0.0], [0.0, 0.0]], [[0.0, 0.0], [0.0, 3.0]]])
    assert not np.any(viscous_force(**pair, **shares(**corner) | {"ghost_type_j": 0}))


def test_pressure_by_hand():
    """V (p_i + p_j) G_ij on the face of a ghost with C = 1."""
    one, G = np.eye(2), np.array([-0.5, 7.0])  # of a particle before its ghost on the left
    pair = {"p_i": 3.0, "p_j": 3.0, "C_i": one, "C_j": one, "G_ij": G}
    terms = pressure_force(**pair, **shares(lower=[[1.0, 1.0], [0.0, 0.0]]))
    lower, upper = force_of_row(*terms, V=2.0)
    np.testing.assert_array_equal(lower, [[-6.0, 84.0], [0.0, 0.0]])
    assert not np.any(upper)


def exchange_of(solver):
    """An exchange with the faces in which nothing is booked yet."""
    potential = solver.particles["potential"]
    conditions = solver.domain.conditions
    return FaceExchange(
        solver.backend, solver.body.count, potential, conditions, books_pressing=True
    )


def linear(solver, place):
    """Let the solver have the linear temperature between the two walls; heat capacity is 1."""
    start_from(solver, -20.0 * place[0])


@pytest.mark.parametrize("share", [0.0, 0.2])
def test_slab_between_two_dirichlet_faces(share):
    """k dT / L times the height enters at the left and leaves at the right, nothing elsewhere."""
    solver = box(flow={}, heat=WARM | COLD)
    place = jittered(solver, share)
    block = block_of(solver, place)
    linear(solver, place)
    exchange = exchange_of(solver)
    exchange.find_walls(block)
    exchange.book_heat(block, 2.0)
    expected = 2.0 * CONDUCTIVITY * 20.0
    # the weights of disordered particles conduct with an error that vanishes on the lattice
    assert exchange.heat["left"] == pytest.approx(expected, rel=1e-9 + 0.3 * share)
    assert exchange.heat["right"] == pytest.approx(-expected, rel=1e-9 + 0.3 * share)
    assert exchange.heat["bottom"] == exchange.heat["surface"] == 0.0


def test_prescribed_flux_enters():
    """q times the length of the face."""
    solver = box(flow={}, heat={"bottom": "prescribed-flux", "bottom_flux": 7.0})
    exchange, block = exchange_of(solver), block_of(solver)
    exchange.find_walls(block)
    exchange.book_heat(block, 2.0)
    assert exchange.heat["bottom"] == pytest.approx(14.0)
    assert exchange.heat["left"] == exchange.heat["surface"] == 0.0


def test_shear_between_two_walls():
    """Couette's flow: eta U / H on the lid, as much against it at the bottom, none at sides."""
    sides = {side: "periodic" for side in ("left", "right")}
    solver = box(
        flow={**sides, "surface": {"kind": "moving-wall", "velocity": 1.0}},
        heat={"sides": "periodic"},
    )
    block = block_of(solver)
    place = solver.backend.to_host(solver.position)
    v = np.array([1.0 + place[1], 0.0 * place[1]])
    solver.backend.copy(solver.backend.asarray(v), solver.flow.viscous.velocity)
    exchange = exchange_of(solver)
    exchange.book_viscous_forces(block, solver.flow, 2.0)
    expected = 2.0 * 0.01
    assert exchange.impulse["surface"] == pytest.approx(expected)
    assert exchange.impulse["bottom"] == pytest.approx(-expected)
    assert exchange.impulse["left"] == exchange.impulse["right"] == 0.0


def test_booked_heat_is_what_the_body_gains():
    """Of all steps of a flow the heat over the faces sums up to the heat that is stored."""
    solver = box(flow={}, heat=WARM | COLD, material={"expansion": 0.01}, end=100.0)
    go(solver, 30)
    mass, h = (solver.backend.to_host(solver.particles[name]) for name in ("mass", "enthalpy"))
    stored = mass @ h  # h is 0 at the start
    heat = solver.exchange.heat
    assert solver.flow.largest_speed > 0.01
    assert sum(heat.values()) == pytest.approx(stored, abs=1e-9 * heat["left"])
    # were the ghosts of one face left out, it would not
    assert sum(heat.values()) - heat["right"] != pytest.approx(stored, rel=0.01)
    assert heat["bottom"] == heat["surface"] == 0.0
    numbers = solver.checkpoint_scalars()
    solver.exchange.restore(dict.fromkeys(numbers, 0.0))
    solver.exchange.restore(numbers)
    assert solver.exchange.heat == heat


def test_walls_give_the_liquid_its_momentum():
    """Of all steps the forces of the four walls sum up to the momentum of the liquid.

    Below a lid that has just begun to move drag and pressure are of one size. Without shifting and
    gravity nothing else changes the momentum, but for the residual of the viscous step.
    """
    solver = box(cells=12, shifting=0.0, viscosity="explicit")
    go(solver, 20)
    volume = solver.backend.to_host(solver.particles["volume"])
    momentum = solver.backend.to_host(solver.flow.velocity) @ volume  # the density is 1
    drag, pressing = solver.exchange.impulse, solver.exchange.pressing
    along = drag["bottom"] + drag["surface"] + pressing["left"] - pressing["right"]
    across = drag["left"] + drag["right"] + pressing["bottom"] - pressing["surface"]
    scale = drag["surface"]
    assert pressing["right"] - pressing["left"] > 0.05 * scale
    np.testing.assert_allclose((along, across), momentum, atol=1e-9 * scale)
    # where one wall is left out, they do not
    assert along + pressing["right"] != pytest.approx(momentum[0], abs=0.01 * scale)
    numbers = solver.checkpoint_scalars()
    solver.exchange.restore(dict.fromkeys(numbers, 0.0))
    solver.exchange.restore(numbers)
    assert solver.exchange.pressing == pressing


def test_an_even_pressure_presses_evenly():
    """p times the length of each wall on a lattice; nothing once p_0 is taken off."""
    solver = box(flow={})
    block, exchange = block_of(solver), exchange_of(solver)
    p = solver.backend.asarray(np.full(block.ghosts.size, 7.0))
    C = block.ghosts.extend_tensor(block.correction)
    for lowest, expected in ((0.0, 14.0), (-7.0, 0.0)):
        exchange.pressing = dict.fromkeys(exchange.pressing, 0.0)
        projection = solver.flow.projection
        projection.gradient_fields = {"p": p, "G_ij": block.gradient, "C": C}
        projection.lowest = lowest
        exchange.book_pressure(block, solver.flow, 2.0)
        assert list(exchange.pressing.values()) == pytest.approx([expected] * 4, abs=1e-9)
