"""Shift and adjustment: exact on linear fields, within the neighbors' range, no energy lost."""

import numpy as np
import pytest
from flow_boxes import PERIODIC, PERIODIC_HEAT, block_of, box, jittered, place_of, start_from

from lasersph.solvers.melt_pool.particle_shifting import (
    CLOSEST,
    LARGEST,
    ParticleShifting,
    adjust_velocity,
    balance_change,
    clip_to_range,
    confine,
    enthalpy_change,
    enthalpy_terms,
    ghost_enthalpy,
    phase_of,
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
    terms = velocity_terms(v, high, 2.0, np.array([-1.0, 0.0]), 1.0, -0.5)
    assert terms[0].tolist() == [[2.0, 0.0], [0.2, 0.0]]
    assert terms[1].tolist() == terms[2].tolist() == high.tolist()


def test_kinds():
    """At rest, melt, melt on the plateau."""
    assert (phase_of(0.0, 0.0), phase_of(1.0, 0.0), phase_of(1.0, 0.5)) == (0.0, 1.0, 2.0)


def test_no_exchange_across_kinds():
    """A neighbor of another kind counts as one of the same enthalpy: no slope, no range."""
    x_ij = np.array([-1.0, 0.0])
    same = enthalpy_terms(1.0, 3.0, 1.0, 1.0, 2.0, x_ij, 1.0, -0.5)
    assert same[0].tolist() == [2.0, 0.0] and same[1:] == (3.0, 3.0)
    other = enthalpy_terms(1.0, 3.0, 1.0, 2.0, 2.0, x_ij, 1.0, -0.5)
    assert other[0].tolist() == [0.0, 0.0] and other[1:] == (1.0, 1.0)


def test_enthalpy_by_hand():
    """Change within the range, gain and loss of m = 3."""
    slope, shifted = np.array([10.0, 0.0]), np.array([0.1, 0.0])
    assert enthalpy_change(slope, 0.0, 9.0, 5.0, 3.0, ONE, shifted) == (1.0, 3.0, 0.0)
    assert enthalpy_change(slope, 0.0, 5.5, 5.0, 3.0, ONE, shifted) == (0.5, 1.5, 0.0)
    assert enthalpy_change(-slope, 0.0, 9.0, 5.0, 3.0, ONE, shifted) == (-1.0, 0.0, 3.0)


def test_balanced():
    """Gains and losses are scaled each by its own factor."""
    assert (balance_change(5.0, 1.0, 0.5, 1.0), balance_change(5.0, -1.0, 0.5, 1.0)) == (5.5, 4.0)


def test_enthalpy_beyond_a_dirichlet_face():
    """Odd about the wall's: 2 * 7 - 5; else the source's."""
    assert (ghost_enthalpy(5.0, 1.0, 7.0), ghost_enthalpy(5.0, 0.0, 7.0)) == (9.0, 5.0)


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
    solver.adjust()
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
    expected = np.maximum(place[0] - 0.04, -0.5 + CLOSEST * 0.1)
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


def test_adjusted_enthalpy_follows_the_field():
    """h changes by its slope times the shift, but for the extrema, which do not grow."""
    solver = box(flow=PERIODIC, heat=PERIODIC_HEAT, cells=12)
    place = place_of(solver)
    shift = np.zeros_like(place)
    shift[0] = 0.005 * np.sin(2.0 * np.pi * place[0])
    h = 10.0 * np.sin(2.0 * np.pi * place[0])
    _, found = shift_particles(solver, place, shift, h=h)
    slope = 20.0 * np.pi * np.cos(2.0 * np.pi * place[0])
    top = np.isclose(np.abs(h), np.abs(h).max())
    assert (found - h)[~top] == pytest.approx((slope * shift[0])[~top], abs=0.02)
    assert np.abs(found).max() <= np.abs(h).max()


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
        shifting.adjust_enthalpy(
            block, solver.kinds, enthalpy, backend.asarray(0.5 * on_plateau),
            solver.particles["mass"], solver.flow.correction,
        )  # fmt: skip
        found = backend.to_host(enthalpy)
        assert not np.array_equal(found, h)
        assert (found[~hot].max() <= 1.0 and found[hot].min() >= 99.0) == is_kept


def test_largest_shift():
    """However far the particles are out of order, none is moved by more than a tenth."""
    solver = box(shifting=0.5)
    place = jittered(solver, 0.45)
    block = block_of(solver, place)
    nothing = solver.backend.zeros(solver.body.count)
    solver.shifting.shift(block, solver.kinds, nothing, 1.0, 1.0)
    size = np.linalg.norm(solver.backend.to_host(solver.shifting.displacement), axis=0)
    assert size.max() == pytest.approx(LARGEST * 0.1)


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
    solver.shift(1.0)
    solver.adjust()
    expected = place.copy()
    expected[1, 3] = -CLOSEST * 0.1
    assert place_of(solver) == pytest.approx(
        np.clip(expected, [[-0.47], [-0.97]], [[0.47], [-0.03]])
    )
    assert np.array_equal(backend.to_host(solver.flow.velocity), v)
    assert np.array_equal(backend.to_host(solver.particles["enthalpy"]), h)


def test_shifting_needs_no_block_to_move(backend):
    """Positions alone: two particles in a periodic strip."""
    shifting = ParticleShifting(backend, 2, 0.04, 0.1, ((0.0, 1.0), (-1.0, 0.0)), (1.0, 0.0))
    position = backend.asarray([[1.05, 0.5], [-0.5, 0.2]])

    class Flowing:
        fluid = backend.asarray([1.0, 1.0])

    shifting.move(position, Flowing)
    assert backend.to_host(position) == pytest.approx(np.array([[0.05, 0.5], [-0.5, -0.03]]))
