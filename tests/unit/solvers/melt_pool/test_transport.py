"""Transport between particles at rest: pairs by hand, and what a pool keeps."""

import numpy as np
import pytest
from flow_boxes import place_of
from law_runs import host, start_from
from spot_pools import half_ball, spot_pool

from lasersph.solvers.melt_pool.pressure_equation import Outcome, PressureEquation
from lasersph.solvers.melt_pool.transport import (
    TOLERANCE,
    after_transport,
    closed_flux,
    exchange_terms,
    exchanged_enthalpy,
    exchanged_velocity,
    extrapolated,
    flux_across,
    flux_and_slope_terms,
    gathering_and_slopes,
    middle_values,
    pair_flux,
    value_beyond,
)
from lasersph.solvers.step_control import NotConverged

G = np.array([0.0, -2.0])  # from i upward to j: kernels fall with distance
STILL, UP = np.zeros(2), np.array([0.0, 1.0])


U = np.array([[1.0, 3.0], [0.5, -2.0]]).T
PLACE, DISTANCE = np.array([[1.0, 0.0], [1.5, 0.0]]), np.array([0.2, 0.3])


def flux(pools):
    """Of a pair 2 m apart along z of a weight of 3 m^2/m, i above j, both moving up with 1 m/s."""
    return pair_flux(UP, UP, *pools, 3.0, 2.0 * UP)


def test_flux_of_a_pair():
    """A weight of 3 times the mean velocity down the 2 m to j; within a pool."""
    assert flux((1, 1)) == 3.0 * -1.0 * 2.0
    assert flux((1, 2)) == flux((0, 0)) == flux((1, 0)) == 0.0


def across(tangent, pools=(1, 1), pair=(0, 1)):
    """Flux of 7 m^3/s of a weight of 3 across a surface that moves, of those at 1 and 1.5 m, 0.2
    and 0.3 m below it, with velocities U."""
    return flux_across(7.0, *pools, 3.0, *pair, tangent, U.T, PLACE, DISTANCE)


def test_flux_across_a_surface_that_moves():
    """(u_i + u_j)(r_j - r_i) + (w_i - w_j)(d_i + d_j), the same from both sides but for its sign;
    none toward the image of an image, nor to another pool; others stay as they are."""
    there = across(1.0)
    assert there == pytest.approx(1.5 * (1.5 * 0.5 + 5.0 * 0.5))
    assert across(1.0, pair=(1, 0)) == pytest.approx(-there)
    assert across(2.0) == across(1.0, (1, 2)) == across(1.0, (0, 0)) == 0.0
    assert across(0.0) == 7.0


def test_what_gathers_in_a_ring():
    """What flows out and what its volume of 4 m grows by; slopes by C, of h within a pool only."""
    v_j, C = np.array([0.0, 1.5]), np.diag([1.0, -0.25])
    terms = flux_and_slope_terms(6.0, 1.0, 3.0, UP, v_j, 1, 1, G)
    gathered, grad_h, grad_v = gathering_and_slopes(*terms, -2.0, 4.0, C)
    assert gathered == -2.0
    assert grad_h == pytest.approx([0.0, 1.0])
    assert grad_v == pytest.approx(np.array([[0.0, 0.0], [0.0, 0.25]]))
    assert not flux_and_slope_terms(6.0, 1.0, 3.0, UP, v_j, 1, 2, G)[1].any()


def test_first_guess_follows_a_line():
    """phi of 3 after 2 is 4 next, and 3 is what it was."""
    assert extrapolated(3.0, 2.0) == (4.0, 3.0)


def test_potential_closes_a_flux():
    """2 m^3/s less a weight of three times a rise of one half."""
    assert closed_flux(2.0, 3.0, 1, 1, 1.0, 1.5) == 0.5
    assert closed_flux(0.0, 3.0, 1, 2, 1.0, 1.5) == 0.0


WAY = np.array([0.0, -1.0])  # from j down to i, one apart


def exchanged(gives, slope=0.0):
    """h that a pair one apart along z exchanges: 1 and 2; i below j."""
    rise = np.array([0.0, slope])
    return exchanged_enthalpy(gives, 1.0, 1.0, 2.0, 1.0, 2.0, rise, rise, WAY)


def test_melt_takes_along_what_it_comes_from():
    """Without slopes h of the giver; with the slope of both the middle; no more than either."""
    assert exchanged(1.0) == 1.0
    assert exchanged(0.0) == 2.0
    assert exchanged(1.0, slope=1.0) == exchanged(0.0, slope=1.0) == pytest.approx(1.5)
    assert exchanged(1.0, slope=9.0) == 2.0


def test_velocity_goes_on_by_the_slope_on_its_far_side():
    """Where a slope of 9/s lies between one at rest and one of 2 m/s a meter above, the far side
    rises by 2 * 9 - 2 = 16/s; by half of it along the half of the way, and beyond both."""
    steep = np.array([[0.0, 0.0], [0.0, 9.0]])
    below = exchanged_velocity(1.0, 1.0, STILL, 2.0 * UP, steep, steep, WAY)
    assert below == pytest.approx([0.0, 8.0])
    above = exchanged_velocity(0.0, 1.0, STILL, 2.0 * UP, steep, steep, WAY)
    assert above == pytest.approx([0.0, 2.0 - 8.0])


@pytest.mark.parametrize("gives", [0.0, 1.0])
def test_a_linear_velocity_is_that_of_the_middle(gives):
    """Of 0 and 2 m/s with their slope in both: 1 m/s."""
    even = np.array([[0.0, 0.0], [0.0, 2.0]])
    assert exchanged_velocity(gives, 1.0, STILL, 2.0 * UP, even, even, WAY) == pytest.approx(UP)


def both_sides(crossing=0.0):
    """h and v times flux of a pair, seen from i and from j."""
    T = np.array([[0.5, 0.1], [0.2, -0.5]])
    one, other = (1.0, np.array([1.0, 0.5]), np.array([0.3, 0.7])), (2.0, UP, np.array([0.1, 0.9]))
    way = np.array([0.4, -1.0])
    (h_i, v_i, g_i), (h_j, v_j, g_j) = one, other
    closed, back = (2.0, 3.0, 1, 1, 1.0, 1.5), (-2.0, 3.0, 1, 1, 1.5, 1.0)
    there = (h_i, h_j, h_i, h_j, v_i, v_j, g_i, g_j, T, 2 * T, way, way, STILL)
    here = (h_j, h_i, h_j, h_i, v_j, v_i, g_j, g_i, 2 * T, T, -way, STILL, way)
    return exchange_terms(*closed, *there, crossing), exchange_terms(*back, *here, crossing)


@pytest.mark.parametrize("crossing", [0.0, -1.0, 1.0])
def test_both_sides_of_a_pair_exchange_the_same(crossing):
    """Seen from j the flux has the other sign, and the values are those of i."""
    there, back = both_sides(crossing)
    assert there[0] == -back[0]
    assert there[1] == pytest.approx(-back[1], abs=0.0)


def test_exchange_is_by_the_closed_flux():
    """2 m^3/s less a weight of three times a rise of one half is a half: of h and v of the giver
    beyond a surface that bends."""
    there, _ = both_sides(crossing=1.0)
    assert there[0] == 0.5 * 1.0
    assert there[1] == pytest.approx(0.5 * np.array([1.0, 0.5]))


def test_enthalpy_beyond_a_wall_of_given_temperature():
    """That of the wall, 3, lies between 1 and 5; beyond another one it is mirrored."""
    assert value_beyond(1.0, 1.0, 3.0) == 5.0
    assert value_beyond(1.0, 0.0, 3.0) == 1.0


def middle(share, slope=0.0):
    """h of the middle of a step, that and v with what the flow carries: 10 after 8, 1 after 3 m/s
    upward, in a flow of 2 m/s upward for half a step of 0.5 s; slopes upward."""
    grad_h, grad_v = slope * UP, slope * np.diag([0.0, 1.0])
    return middle_values(10.0, 8.0, UP, 3.0 * UP, 2.0 * UP, grad_h, grad_v, share, 0.25)


def test_melt_of_the_middle_of_the_step():
    """Half of the change of the step before where both are as long: 10 after 8 goes on to 11."""
    h, carried, v = middle(0.5)
    assert h == carried == 11.0
    assert v == pytest.approx([0.0, 0.0])
    assert middle(0.0)[0] == 10.0


def test_what_the_flow_carries_in_half_a_step():
    """From half a meter below, where h is lower by 2 and v by 2 m/s."""
    h, carried, v = middle(0.0, slope=4.0)
    assert (h, carried) == (10.0, 8.0)
    assert v == pytest.approx([0.0, -1.0])


def test_pairs_across_planes_exchange_the_mean_velocity():
    """The middle of a profile that bends at a wall."""
    there, _ = both_sides(crossing=-1.0)
    assert there[1] == pytest.approx(0.5 * np.array([0.5, 0.75]))


def test_step_of_a_ring():
    """What has left, times the step over the volume; h of steps before changes alike."""
    total = (6.0, np.array([2.0, -4.0]))
    h, v, h_old, h_older = after_transport(*total, 10.0, UP, 9.0, 7.0, 2.0, 0.0, 4.0, 0.5)
    assert h == 10.0 - 1.5
    assert v == pytest.approx([-0.5, 2.0])
    assert (h_old, h_older) == (9.0 - 1.5, 7.0 - 1.5)


def test_step_of_a_ring_that_grows():
    """From 1 to 2 m^3, by what flows in: the same h and v fill more."""
    share = after_transport(-20.0, -2.0 * UP, 10.0, UP, 10.0, 10.0, 2.0, 0.5, 4.0, 0.5)
    assert share[0] == 10.0
    assert share[1] == pytest.approx(UP)


@pytest.fixture
def pool():
    """Half a ball of melt in (r, z), hot in its middle, and where its particles are."""
    _, solver = spot_pool(half_ball)
    return solver, place_of(solver)


def turn(solver, places):
    """Give the melt a velocity without divergence: out at the top, in below; advect nothing."""
    r, z = places
    v = np.array([r * (z + 4e-7), -(z * z + 8e-7 * z)]) * 1e13
    solver.time_step_limits()
    solver.flow.velocity[:] = solver.backend.asarray(v)
    solver.flow.stop_solid(solver.kinds)


def test_fluxes_close(pool):
    """What flows into a particle leaves it, and what one gives the other gets."""
    solver, places = pool
    turn(solver, places)
    solver.advect(1e-12)
    transport, block = solver.transport, solver.flow.block
    start = np.asarray(block.pairs.row_start).astype(int)
    i = np.repeat(np.arange(block.count), np.diff(start))
    j = np.asarray(block.without_ghosts().neighbor)[: start[-1]].astype(int)
    potential, pool = host(solver, "flux_potential"), np.asarray(solver.kinds.fluid)
    flux, g = (np.asarray(values)[: start[-1]] for values in (transport.flux, block.weights))
    pairs = zip(flux, g, pool[i], pool[j], potential[i], potential[j], strict=True)
    F = np.array([closed_flux(*pair) for pair in pairs])
    total = np.bincount(i, F, minlength=block.count)
    assert np.abs(F).max() > 0.0
    assert np.abs(total).max() < TOLERANCE * np.bincount(i, np.abs(F)).max()


def test_transport_keeps_heat_and_uniform_values(pool):
    """Heat of the whole revolution to rounding, no new extreme, and h that is the same stays so."""
    solver, places = pool
    turn(solver, places)
    h, m = host(solver, "enthalpy").copy(), host(solver, "mass")
    fluid = np.asarray(solver.kinds.fluid) > 0.0
    solver.advect(1e-8)
    after = host(solver, "enthalpy")
    assert np.abs(after - h).max() > 1e-3 * h.max()
    assert np.sum(m * after) == pytest.approx(np.sum(m * h), rel=1e-14)
    assert h[fluid].min() * (1 - 1e-9) <= after[fluid].min()
    assert after[fluid].max() <= h[fluid].max() * (1 + 1e-9)
    # the same everywhere
    start_from(solver, solver.body.curve.enthalpy_at(np.where(fluid, 2500.0, 1500.0)))
    turn(solver, places)
    before = host(solver, "enthalpy").copy()
    solver.advect(1e-8)
    assert host(solver, "enthalpy") == pytest.approx(before, rel=TOLERANCE)


def test_fluxes_without_a_balance_are_refused(monkeypatch):
    """They would bring new extremes: the step is halved instead."""
    solver = spot_pool(half_ball, spacing=1e-7, width=1.6e-6)[1]
    solver.step(1e-10)
    monkeypatch.setattr(PressureEquation, "solve", lambda *_, **__: Outcome(7, 0.5))
    line = "the balance of the fluxes is left with a residual of 5.0e-01 of its right-hand side"
    with pytest.raises(NotConverged, match=f"{line} after 7 iterations"):
        solver.advect(1e-10)
