"""Steps of a small pool: what they leave alone, how they fail, and how they go on afterwards."""

from itertools import pairwise

import numpy as np
import pytest
from flow_boxes import (
    PERIODIC,
    PERIODIC_HEAT,
    box,
    go,
    host_fields,
    matrix_of,
    pool,
    pool_case,
    start_from,
)

from lasersph import compute
from lasersph.case import load_case
from lasersph.compute.search import EscapedParticle
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import RETRIES, NotConverged
from lasersph.surface.columns import lies_at_surface
from lasersph.surface.flat_surface import ImposedTemperature
from lasersph.surface.surface import settle

LIFE = 45
"""Steps after which the small pool is solid."""


def small_pool(*settings):
    """Fifteen molten particles, colder to the right, in cold steel; solid again after 15 ns."""

    def molten(x, z):
        return (x < 6e-7) & (z > -4e-7)

    return pool(molten, "time.step=200ps", *settings, cold=300.0, slope=-5e8)


@pytest.fixture(scope="module")
def life():
    """States of the small pool at the start and after each step, until it is solid."""
    solver = small_pool()
    states = [(host_fields(solver), solver.checkpoint_scalars())]
    for _ in range(LIFE):
        go(solver, 1)
        states.append((host_fields(solver), solver.checkpoint_scalars()))
    assert solver.fluid_count == 0.0
    return states


def restored(state):
    """Small pool that goes on from a state."""
    solver = small_pool()
    solver.restore(*state)
    return solver


def test_uppermost_row_by_hand():
    """Squares of 2 x 2 and cubes of 0.5, thinner ones that have evaporated, and coarse ones far
    below."""
    assert lies_at_surface(1.0, 4.0, 2.0, 2.0) == 1.0
    assert lies_at_surface(3.0, 4.0, 2.0, 2.0) == 0.0
    assert lies_at_surface(0.5, 2.0, 2.0, 2.0) == 1.0
    assert lies_at_surface(1.5, 2.0, 2.0, 2.0) == 0.0
    assert lies_at_surface(30.0, 100.0, 2.0, 2.0) == 0.0
    assert lies_at_surface(0.25, 0.125, 0.5, 0.25) == 1.0
    assert lies_at_surface(0.75, 0.125, 0.5, 0.25) == 0.0
    assert lies_at_surface(0.35, 0.0625, 0.5, 0.25) == 0.0


def failing(solver, name, error, times):
    """Let a method of `solver`, or of an object in it ("flow.project"), raise the first times."""
    owner, _, method = name.rpartition(".")
    found = getattr(solver, owner) if owner else solver
    right, left = getattr(found, method), [times]

    def wrong(*arguments, **options):
        answer = right(*arguments, **options)
        if left[0] > 0:
            left[0] -= 1
            raise error
        return answer

    setattr(found, method, wrong)
    return left


def assert_same(one, other):
    """All that survives a step has the same bits."""
    assert one.checkpoint_scalars() == other.checkpoint_scalars()
    fields = host_fields(other)
    for name, values in host_fields(one).items():
        assert np.array_equal(values, fields[name]), name


def test_solid_never_moves(life):
    """Particles that do not flow keep their places, those that have frozen as well."""
    seen = 0
    for (before, _), (after, _) in pairwise(life):
        rests = before["melt_fraction"] < 1.0 - 1e-9
        assert np.array_equal(before["position"][:, rests], after["position"][:, rests])
        assert np.all(after["velocity"][:, rests] == 0.0)
        seen += not rests.all()
    assert seen > 20
    first, last = life[0][0], life[-1][0]
    assert np.abs(last["position"] - first["position"]).max() > 5e-9
    assert np.all(last["velocity"] == 0.0)


def test_energy_stays(life):
    """Without light the energy stored is that of the start, to rounding, while melt flows."""
    solver = small_pool()
    mass = solver.backend.to_host(solver.particles["mass"])
    energies = [mass @ fields["enthalpy"] for fields, _ in life]
    assert energies == pytest.approx([energies[0]] * len(energies), rel=1e-12)


def test_pairs_stay_symmetric():
    """Rows that are renewed fit those that are not, in every step of a pool that comes and goes."""
    solver = small_pool()
    for _ in range(LIFE // 5):
        go(solver, 5)
        pairs, count = solver.body.pairs, solver.body.count
        g = matrix_of(solver.backend, pairs.neighbors, pairs.weights, count)
        assert np.abs(g - g.T).max() < 1e-9 * g.max()
        assert solver.backend.to_host(pairs.total) == pytest.approx(g.sum(axis=1), rel=1e-12)


def test_first_pairs_need_no_memory_of_their_own():
    """Rows that moved lie behind those that multigrid starts from, which stay as they were."""
    solver, untouched = small_pool(), small_pool()
    go(solver, 15)
    pairs, first = solver.body.pairs, untouched.body.pairs
    assert pairs.weights.size > first.weights.size
    there, (neighbors, weights) = pairs.neighbors, pairs.first
    assert np.shares_memory(neighbors.neighbor, there.neighbor)
    assert np.shares_memory(weights, pairs.weights)
    assert np.array_equal(neighbors.neighbor, first.neighbors.neighbor)
    assert np.array_equal(weights, first.weights)


def test_restored_solver_repeats_the_bits(life):
    """From any moment: before, during and after the flow."""
    for moment in (0, 1, 9, 14, 15, 27, 36, 40, 41, 42, 43):
        again = restored(life[moment])
        go(again, 2)
        fields, numbers = life[moment + 2]
        assert again.checkpoint_scalars() == numbers, moment
        for name, values in host_fields(again).items():
            assert np.array_equal(values, fields[name]), (moment, name)


@pytest.mark.parametrize("at", [0, 14, 41])
@pytest.mark.parametrize(
    ("name", "error"),
    [
        ("flow.project", NotConverged("the pressure equation")),
        ("heat.attempt", NotConverged("the heat balance")),
        ("advect", EscapedParticle("particle 3")),
    ],
)
def test_failed_step_is_retried_with_half(life, at, name, error):
    """As if the smaller step had been taken at once, to the bit, and so are the steps after it."""
    first, second = restored(life[at]), restored(life[at])
    step = min(first.time_step_limits().values())
    left = failing(first, name, error, 2)
    taken = first.step(step)
    assert (left[0] == 0) == (taken == 0.25 * step)
    assert second.step(taken, taken if left[0] == 0 else None) == taken
    assert_same(first, second)
    go(first, 2)
    go(second, 2)
    assert_same(first, second)


def test_step_that_always_fails(life):
    """Halved eight times, then told; the state is as before and later steps have the same bits."""
    first, second = restored(life[5]), restored(life[5])
    before = host_fields(first), first.checkpoint_scalars()
    left = failing(first, "flow.correct", NotConverged("no ghost_type"), RETRIES + 1)
    with pytest.raises(NotConverged, match="no ghost_type"):
        first.step(1e-11)
    assert left == [0]
    assert first.checkpoint_scalars() == before[1]
    for name, values in host_fields(first).items():
        assert np.array_equal(values, before[0][name]), name
    go(first, 2)
    go(second, 2)
    assert_same(first, second)


def test_step_far_too_long():
    """A step in which particles would leave is halved until they do not."""
    solver = box(end=100.0)
    go(solver, 3)
    step = 2.0 / solver.flow.largest_speed
    taken = solver.step(step, step)
    assert taken < step
    assert solver.state.time_step == taken
    for name, values in host_fields(solver).items():
        assert np.isfinite(values).all(), name


def test_pressure_that_is_not_solved(life):
    """A residual far above the tolerance fails the step with a line that tells it."""
    solver = restored(life[5])
    go(solver, 1)
    solver.flow.projection.equation.max_iterations = 0
    with pytest.raises(NotConverged, match=r"residual of .* after 0 iterations"):
        solver.step(1e-11)


@pytest.mark.parametrize(
    "settings",
    [
        ("solver.pressure=published",),
        ("solver.viscosity=explicit",),
        ("solver.marangoni=false",),
    ],
)
def test_variants(settings):
    """Other ways to the same flow agree within 10 %; without surface tension there is none."""
    reference, other = small_pool(), small_pool(*settings)
    for solver in (reference, other):
        while solver.state.time < 1e-9:
            solver.step(5e-11)
    if "false" in settings[0]:
        assert other.flow.largest_speed < 1e-6
    else:
        assert other.flow.largest_speed == pytest.approx(reference.flow.largest_speed, rel=0.1)


def test_limits_by_name(life):
    """Flow adds its limits to those of heat, and only while something flows."""
    solver = restored(life[5])
    assert {"advection", "force", "viscosity", "light", "end"} <= set(solver.time_step_limits())
    published = small_pool("solver.step_limits=published")
    go(published, 2)
    assert {"heat", "advection"} <= set(published.time_step_limits())
    solver = restored(life[-1])
    assert not {"advection", "viscosity"} & set(solver.time_step_limits())


@pytest.mark.parametrize("viscosity", ["implicit", "explicit"])
def test_acceleration_is_that_of_all_forces(viscosity):
    """Without any pressure: buoyancy alone lifts by beta (T - T_l) g, viscosity alone slows a shear
    wave by nu k^2 U; the limit follows by hand."""
    lifted = box(flow=PERIODIC, heat=PERIODIC_HEAT, material={"expansion": "0.1 1/K"},
                 viscosity=viscosity)  # fmt: skip
    warm = host_fields(lifted)["enthalpy"] + 5.0  # c_p is 1 J/(kg K), T_l the initial temperature
    start_from(lifted, warm)
    lifted.step(1e-4)
    assert lifted.flow.largest_acceleration == pytest.approx(0.1 * 5.0 * 9.81, rel=1e-9)

    slowed = box(flow=PERIODIC, heat=PERIODIC_HEAT, cells=40, viscosity=viscosity)
    k, (_, z) = 2.0 * np.pi, host_fields(slowed)["position"]
    slowed.flow.set_initial_velocity(np.stack([0.7 * np.sin(k * z), 0.0 * z]))
    slowed.step(1e-5)
    assert slowed.flow.largest_acceleration == pytest.approx(0.01 * k**2 * 0.7, rel=0.01)
    limit = slowed.time_step_limits()["force"]
    support = slowed.domain.support
    assert limit == 0.25 * (support / slowed.flow.largest_acceleration) ** 0.5


def stirred_layer(step, fold):
    """Largest pressure [Pa] in the step after the wave of temperature on a flowing layer of steel
    has grown by a factor, and before."""
    case = load_case("marangoni-layer", ["particles.spacing=100nm"])
    solver = recipe_of(case).build(compute.cpu(threads=1))
    for _ in range(12):
        solver.step(2e-9)
    found = []
    for factor in (1.0, fold):
        wave = case.boundaries.surface_temperature_wave
        wave = wave.model_copy(update={"amplitude": factor * wave.amplitude})
        solver.domain.surface.given = ImposedTemperature(1727.0, wave)
        solver.step(step)
        pressure = solver.flow.pressure
        found.append(np.abs(solver.backend.to_host(pressure)).max())
    return found


def test_pressure_of_a_changed_stress_does_not_grow_as_the_step_shrinks():
    """The divergence of what lies beyond the surface follows the stress within l^2 / nu, 138 ns
    here: with steps of 2 and 0.25 ns the change asks for pressures of one size."""
    (before, after), (_, short) = stirred_layer(2e-9, 1.5), stirred_layer(2.5e-10, 1.5)
    assert before < after
    assert short < 1.5 * after
    assert settle(4.0, 8.0, 1.0, 0.75) == 5.0
    assert settle(4.0, 8.0, 2.0, 0.5) == 7.0  # twice as viscous, twice as fast
    assert settle(0.0, 8.0, 1.0, 0.75) == 8.0


def test_iterations_and_checkpoint_scalars():
    """What is reported of a step."""
    solver = box()
    go(solver, 2)
    assert set(solver.iterations) == {"newton", "linear", "pressure", "viscosity"}
    assert solver.iterations["pressure"] > 0
    assert 0.0 < solver.spacing_min < 0.1
    assert solver.flow.divergence[0] < solver.flow.divergence[1]


def test_speed_without_bound(life):
    """A particle that crosses its support in less than 1e-9 of the time to compute ends the run."""
    solver = restored(life[5])
    crossing = solver.domain.support / solver.flow.largest_speed
    solver.flow.largest_speed *= 0.9e9 * crossing / solver.heat.time_settings.end
    before = host_fields(solver)
    solver.step(1e-15)
    solver.restore(before, life[5][1])
    solver.flow.largest_speed *= 1.1e9 * crossing / solver.heat.time_settings.end
    with pytest.raises(NotConverged, match=r"unstable: .* m/s"):
        solver.step(1e-15)
    for name, values in host_fields(solver).items():
        assert np.array_equal(values, before[name]), name


def test_a_view_changes_nothing():
    """What observers are shown is read: marks of the surface are those of the last positions."""
    solver = small_pool()
    go(solver, 3)
    surface, host = solver.domain.surface, solver.backend.to_host
    depth = -host(solver.position)[1]
    assert np.array_equal(host(surface.depth), depth)
    marks = host(surface.at_surface).copy()
    recipe_of(pool_case()).view(solver, 3, "light")
    assert np.array_equal(host(surface.at_surface), marks)
    assert np.array_equal(marks > 0.0, depth < solver.domain.spacing)
