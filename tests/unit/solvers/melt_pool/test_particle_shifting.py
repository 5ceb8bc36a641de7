"""Shift and adjustment: exact on linear fields, within the neighbors' range, no energy lost."""

import numpy as np
import pytest
from flow_boxes import PERIODIC, PERIODIC_HEAT, block_of, box, jittered, place_of, start_from

from lasersph.boundaries import Boundaries
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.particle_shifting import (
    MAX_SHIFT,
    MIN_FACE_DISTANCE,
    ParticleShifting,
    adjust_velocity,
    allowed_shares,
    clip_to_range,
    confine,
    exchange,
    exchange_terms,
    limited_exchange,
    phase_of,
    range_enthalpy,
    shifted_position,
    velocity_terms,
)

E_X, E_Z = np.array([1.0, 0.0]), np.array([0.0, 1.0])
ONE = np.eye(2)


def test_bounded():
    """Within low, high and the old value, which may lie outside of the neighbors' range."""
    assert clip_to_range(5.0, 1.0, 0.0, 2.0) == 2.0
    assert clip_to_range(-5.0, 1.0, 0.0, 2.0) == 0.0
    assert clip_to_range(1.5, 1.0, 0.0, 2.0) == 1.5
    assert clip_to_range(5.0, 3.0, 0.0, 2.0) == 3.0


def test_velocity_by_hand():
    """grad v . shift = (2, 0) x 0.1 along x, clipped by the neighbors component by component."""
    gradient = np.array([[2.0, 0.0], [5.0, 0.0]])
    v, shifted = np.array([1.0, 0.0]), np.array([0.1, 0.0])
    low, high = np.array([0.0, -0.2]), np.array([3.0, 0.2])
    found = adjust_velocity(gradient, low, high, v, ONE, shifted)
    assert found == pytest.approx([1.2, 0.2])
    terms = velocity_terms(v, high, E_X)
    assert terms[0].tolist() == [[2.0, 0.0], [0.2, 0.0]]
    assert terms[1].tolist() == terms[2].tolist() == high.tolist()


def test_kinds():
    """At rest, melt, melt on the plateau."""
    assert (phase_of(0.0, 0.0), phase_of(1.0, 0.0), phase_of(1.0, 0.5)) == (0.0, 1.0, 2.0)


PAIR = {"G_ij": E_X}
ALIKE = {"phase_i": 1.0, "phase_j": 1.0, "dirichlet_j": 0.0}


def exchange_of(h_i, h_j, shift_i, shift_j, **kinds):
    """Exchange of two particles a unit apart, i to the left of j: V grad W = 1."""
    fields = {"h_i": h_i, "h_j": h_j, "shift_i": shift_i, "shift_j": shift_j}
    return exchange(**fields, **PAIR, **(ALIKE | kinds))


def test_exchange_by_hand():
    """2 J/kg apart, pushed apart by 0.3: i, the colder one, loses 0.6, and j gains it."""
    assert exchange_of(1.0, 3.0, -0.1 * E_X, 0.2 * E_X) == pytest.approx(-0.6)
    assert exchange_of(1.0, 3.0, 0.1 * E_X, -0.2 * E_X) == pytest.approx(0.6)
    assert exchange_of(1.0, 3.0, 0.1 * E_Z, -0.2 * E_Z) == 0.0


def test_a_common_shift_exchanges_nothing():
    """Particles that are moved together keep their heat."""
    assert exchange_of(1.0, 3.0, 0.2 * E_X, 0.2 * E_X) == 0.0


def test_no_exchange_across_kinds():
    """A neighbor of another phase counts as one of the same enthalpy; a wall gives its range."""
    apart = -0.1 * E_X, 0.2 * E_X
    assert exchange_of(1.0, 3.0, *apart, phase_j=2.0) == 0.0
    assert exchange_of(1.0, 3.0, *apart, dirichlet_j=1.0) == 0.0
    pair = {"h_i": 1.0, "h_j": 3.0, "shift_i": apart[0], "shift_j": apart[1]} | PAIR
    assert exchange_terms(**pair, **ALIKE) == pytest.approx((0.0, 0.6, 3.0, 3.0))
    assert exchange_terms(**pair, **(ALIKE | {"phase_j": 2.0}))[2:] == (1.0, 1.0)
    assert exchange_terms(**pair, **(ALIKE | {"dirichlet_j": 1.0})) == (0.0, 0.0, 3.0, 3.0)


def test_shares_by_hand():
    """Room of 1 above and 2 below for gains of 4 and losses of 1; none outside of the range."""
    assert allowed_shares(4.0, 1.0, 3.0, 6.0, 5.0) == (0.25, 1.0)
    assert allowed_shares(4.0, 1.0, 5.5, 6.0, 5.0) == (0.25, 0.0)
    assert allowed_shares(0.0, 0.0, 5.5, 4.0, 5.0) == (1.0, 1.0)


def test_limited_by_both_particles():
    """A gain by the room of i above and of j below, a loss by the others."""
    pair = {"h_i": 1.0, "shift_i": -0.1 * E_X, "shift_j": 0.2 * E_X} | PAIR | ALIKE
    shares = {"up_i": 0.1, "down_i": 0.2, "up_j": 0.3, "down_j": 0.4}
    assert limited_exchange(h_j=3.0, **pair, **shares) == pytest.approx(-0.6 * 0.2)
    assert limited_exchange(h_j=-1.0, **pair, **shares) == pytest.approx(0.6 * 0.1)


def test_range_beyond_a_dirichlet_face():
    """The wall's enthalpy; else the source's."""
    assert (range_enthalpy(5.0, 1.0, 7.0), range_enthalpy(5.0, 0.0, 7.0)) == (7.0, 5.0)


def test_places():
    """Kept `gap` inside of sides; moved by one period where there is one."""
    assert confine(-0.1, 0.0, 1.0, 0.0, 0.03) == 0.03
    assert confine(1.1, 0.0, 1.0, 0.0, 0.03) == 0.97
    assert confine(-0.1, 0.0, 1.0, 1.0, 0.03) == pytest.approx(0.9)
    assert confine(1.0, 0.0, 1.0, 1.0, 0.03) == 0.0
    assert confine(0.01, 0.0, 1.0, 1.0, 0.03) == 0.01


def test_settled():
    """Fluid is kept inside, solid is where it is."""
    box_ = {"low": np.zeros(2), "high": np.ones(2), "width": np.array([1.0, 0.0]), "gap": 0.03}
    x, shifted = np.array([0.99, 0.99]), np.array([0.02, 0.02])
    assert shifted_position(x, shifted, 1.0, **box_) == pytest.approx([0.01, 0.97])
    assert shifted_position(x, 0.0 * x, 0.0, **box_) == pytest.approx(x)


def shift_particles(solver, place, shift, *, v=None, h=None):
    """The solver's own adjustment at `place` for given shifts; returns v and h."""
    block = block_of(solver, place)
    shifting, backend = solver.shifting, solver.backend
    backend.copy(backend.asarray(shift), shifting.displacement)
    if v is not None:
        backend.copy(backend.asarray(v), solver.flow.velocity)
    if h is not None:
        start_from(solver, h)
    shifting.adjust(solver.flow, solver.kinds, solver.particles)
    assert block is solver.flow.block
    return backend.to_host(solver.flow.velocity), backend.to_host(solver.particles["enthalpy"])


@pytest.mark.parametrize("share", [0.0, 0.2])
def test_velocity_is_exact_on_linear_fields(share):
    """v + grad v . shift inside, on lattice and disorder, where the neighbors' range allows it."""
    solver = box(cells=12)
    place = jittered(solver, share)
    shift = np.random.default_rng(6).uniform(-0.004, 0.004, place.shape)
    A = np.array([[1.0, 2.0], [-3.0, -1.0]])
    found, _ = shift_particles(solver, place, shift, v=A @ place)
    inside = (np.abs(place - [[0.0], [-0.5]]) < 0.5 - 4.0 / 12).all(axis=0)
    assert inside.sum() >= 4
    assert found[:, inside] == pytest.approx((A @ (place + shift))[:, inside], abs=1e-12)


def test_positions_settle():
    """Shifted, and not closer to a wall than three tenths of a spacing."""
    solver = box()
    place = place_of(solver)
    shift = np.zeros_like(place)
    shift[0] = -0.04
    shift_particles(solver, place, shift)
    expected = np.maximum(place[0] - 0.04, -0.5 + MIN_FACE_DISTANCE * 0.1)
    assert place_of(solver)[0] == pytest.approx(expected)


@pytest.mark.parametrize("periodic", [False, True])
def test_energy_of_the_adjustment(periodic):
    """m h sums up to the same, to rounding, and no h leaves the range that was there."""
    settings = {"flow": PERIODIC, "heat": PERIODIC_HEAT} if periodic else {}
    solver = box(**settings)
    place = jittered(solver)
    shift = np.random.default_rng(6).uniform(-0.01, 0.01, place.shape)
    h = 10.0 * np.cos(7.0 * place[0]) * np.sin(5.0 * place[1])
    _, found = shift_particles(solver, place, shift, h=h)
    mass = solver.backend.to_host(solver.particles["mass"])
    assert np.abs(found - h).max() > 0.1
    assert mass @ found == pytest.approx(mass @ h, abs=1e-13 * (mass @ np.abs(h)))
    assert found.max() <= h.max() and found.min() >= h.min()


@pytest.mark.parametrize("same", [True, False])
def test_adjusted_enthalpy_follows_the_field(same):
    """A particle shifted alone takes h at its new place; shifted with all others it keeps its h."""
    solver = box(flow=PERIODIC, heat=PERIODIC_HEAT, cells=20)
    place = place_of(solver)
    h = 10.0 * np.sin(2.0 * np.pi * place[0])
    alone = int(np.argmin(np.hypot(place[0] - 0.025, place[1] + 0.475)))
    shift = np.zeros_like(place)
    shift[0, slice(None) if same else alone] = 0.005
    _, found = shift_particles(solver, place, shift, h=h)
    slope = 20.0 * np.pi * np.cos(2.0 * np.pi * place[0, alone])
    expected = 0.0 if same else 0.005 * slope
    assert found[alone] - h[alone] == pytest.approx(expected, rel=0.05, abs=1e-12)


def test_plateau_keeps_its_enthalpies():
    """Melt and melt on the plateau exchange nothing: each stays within its own range."""
    solver = box()
    place = place_of(solver)
    backend, count = solver.backend, solver.body.count
    block = block_of(solver)
    shift = np.random.default_rng(6).uniform(-0.01, 0.01, place.shape)
    hot = place[0] > 0.0
    h = np.where(hot, 100.0, 1.0) + place[1]
    shifting = solver.shifting
    backend.copy(backend.asarray(shift), shifting.displacement)
    for on_plateau, is_kept in ((hot, True), (np.zeros(count), False)):
        enthalpy = backend.asarray(h)
        m = solver.particles["mass"]
        plateau = backend.asarray(0.5 * on_plateau)
        added = shifting.adjust_enthalpy(block, solver.kinds, enthalpy, plateau, m)
        found = backend.to_host(enthalpy)
        assert not np.array_equal(found, h)
        assert added == pytest.approx(0.0, abs=1e-12)
        assert (found[~hot].max() <= 1.0 and found[hot].min() >= 99.0) == is_kept


def test_largest_shift():
    """However far the particles are out of order, none is moved by more than a tenth."""
    solver = box(shifting=0.5)
    place = jittered(solver, 0.45)
    block = block_of(solver, place)
    nothing = solver.backend.zeros(solver.body.count)
    solver.shifting.shift(block, solver.kinds, solver.position, nothing, 0.5)
    size = np.linalg.norm(solver.backend.to_host(solver.shifting.displacement), axis=0)
    assert size.max() == pytest.approx(MAX_SHIFT * 0.1)


def test_without_shifting():
    """C = 0: nothing moves, nothing is adjusted, and walls still keep particles inside."""
    solver = box(shifting=0.0)
    place = jittered(solver)
    place[1, 3] = 0.001
    v, h = np.ones_like(place), np.arange(100.0)
    start_from(solver, h)
    backend = solver.backend
    backend.copy(backend.asarray(v), solver.flow.velocity)
    block_of(solver, place)
    solver.rearrange(1.0)
    expected = place.copy()
    expected[1, 3] = -MIN_FACE_DISTANCE * 0.1
    assert place_of(solver) == pytest.approx(
        np.clip(expected, [[-0.47], [-0.97]], [[0.47], [-0.03]])
    )
    assert np.array_equal(backend.to_host(solver.flow.velocity), v)
    assert np.array_equal(backend.to_host(solver.particles["enthalpy"]), h)


def test_shifting_needs_no_block_to_move(backend):
    """Positions alone: two particles in a periodic strip."""

    class Strip:
        spacing, support, bounds = 0.1, 0.31, ((0.0, 1.0), (-1.0, 0.0))
        conditions = FaceConditions(bounds, Boundaries(sides="periodic"), None, 300.0)

    shifting = ParticleShifting(backend, 2, 0.04, Strip)
    position = backend.asarray([[1.05, 0.5], [-0.5, 0.2]])

    class Flowing:
        fluid = backend.asarray([1.0, 1.0])

    shifting.move(position, Flowing)
    assert backend.to_host(position) == pytest.approx(np.array([[0.05, 0.5], [-0.5, -0.03]]))
