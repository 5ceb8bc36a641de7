"""What observers see of a flow, worked by hand on made-up velocities."""

import json
from dataclasses import replace

import numpy as np
import pytest
import synthetic_flow
import synthetic_run
from synthetic_flow import FASTEST, LAYER, SLOPE, VISCOSITY, pool_flow
from synthetic_run import NM, NS, PERIOD

from lasersph.observers import View, flow_observers, snapshot_fields
from lasersph.observers.flow_extrema import FlowExtrema, centers_of_tops, surface_extrema
from lasersph.observers.flow_speed import FlowSpeed
from lasersph.observers.melt_pool import MeltPool
from lasersph.observers.snapshots import UNITS
from lasersph.observers.surface_pressure import SurfacePressure
from lasersph.observers.surface_speed import SurfaceSpeed, mean_along, zero_of


def rows(*heights, spacing=5 * NM):
    """A body of half a period, all liquid: columns of `spacing`, as many rows; (view)."""
    count = round(0.5 * PERIOD / spacing)
    x = (np.arange(count) + 0.5) * spacing
    z = -(np.arange(heights[0]) + 0.5) * spacing
    grid = np.array([g.ravel() for g in np.meshgrid(x, z)])
    n = grid.shape[1]
    temperature = 2000.0 + 1000.0 * np.cos(2 * np.pi * grid[0] / PERIOD)
    return View(
        time=57 * NS,
        step=1,
        time_step=0.1 * NS,
        position=grid,
        width=np.full((2, n), spacing),
        volume=np.full(n, spacing**2),
        mass=np.full(n, spacing**2),
        temperature=temperature,
        enthalpy=temperature,
        melt_fraction=np.ones(n),
        vapor_fraction=np.zeros(n),
        surface=np.arange(count),
        symmetry_factor=2,
        iterations={"pressure": 7},
        vaporization=2990.0,
    )


@pytest.fixture(scope="module")
def view():
    return pool_flow(rows(80), inner=0.0)


def test_speed_and_kinetic_energy():
    """The fastest particle, and half rho V v^2 over two moving ones."""
    still = pool_flow(rows(2), inner=0.0)
    velocity = np.zeros_like(still.flow.velocity)
    velocity[:, 3], velocity[:, 8] = (3.0, -4.0), (0.0, 2.0)
    view = replace(still, flow=replace(still.flow, velocity=velocity, divergence_rms=1e6))
    row = FlowSpeed(2).observe(view)
    assert row["flow_speed_max_m_s"] == 5.0
    area, density = (5 * NM) ** 2, synthetic_flow.DENSITY
    assert row["flow_kinetic_energy_J"] == pytest.approx(0.5 * density * area * 29.0)
    assert row["flow_divergence_relative"] == pytest.approx(1e6 * 5 * NM / 5.0)


def test_mean_speeds_by_hand(view):
    """Root mean square of what flows; mean of |u| over the liquid surface, whatever one does."""
    flows = view.flow.flows
    velocity = np.where(flows, np.array([[3.0], [4.0]]), 0.0)
    still = replace(view, flow=replace(view.flow, velocity=velocity))
    assert FlowSpeed(2).observe(still)["flow_speed_rms_m_s"] == pytest.approx(5.0)
    wet = flows[view.flow.surface]
    speed = np.where(wet, -2.0, 0.0)
    speed[np.flatnonzero(wet)[0]] = -2.0 - 0.01 * np.count_nonzero(wet)
    row = SurfaceSpeed().observe(replace(view, flow=replace(view.flow, surface_velocity=speed)))
    assert row["flow_surface_speed_mean_m_s"] == pytest.approx(2.01)


def test_a_particle_that_joins_the_surface_moves_no_mean():
    """Mean of |x| over -1 ... 1 with 40 particles, and with five more where |x| is nearly 1."""
    x = (np.arange(40) + 0.5) / 20.0 - 1.0
    all_of = np.ones(45, bool)
    assert mean_along(x, np.abs(x), all_of[:40]) == pytest.approx(0.5, abs=1e-3)
    more = np.append(x, x[-6:-1] + 0.01)
    assert np.mean(np.abs(more)) > 0.53
    assert mean_along(more, np.abs(more), all_of) == pytest.approx(0.5, abs=1e-2)
    assert mean_along(x[:1], np.full(1, 3.0), all_of[:1]) == 3.0


def test_surface_peak_and_what_lies_below(view):
    """u = U (1 - d/delta) exp(-d/delta) below the peak at a quarter period: delta and U return."""
    observer = SurfaceSpeed()
    row = observer.observe(view)
    assert row["flow_surface_speed_max_m_s"] == pytest.approx(FASTEST, rel=1e-4)
    assert row["flow_surface_speed_max_x_m"] == pytest.approx(PERIOD / 4, abs=5 * NM)
    row_depth = 2.5 * NM
    expected = FASTEST * (1 - row_depth / LAYER) * np.exp(-row_depth / LAYER)
    assert row["flow_row_speed_max_m_s"] == pytest.approx(expected, rel=1e-4)
    below = 5 * NM
    expected = FASTEST * (1 - below / LAYER) * np.exp(-below / LAYER)
    assert row["flow_below_speed_m_s"] == pytest.approx(expected, rel=1e-3)
    assert row["flow_layer_thickness_m"] == pytest.approx(LAYER, abs=0.5 * NM)
    assert row["flow_return_speed_m_s"] == pytest.approx(FASTEST * np.exp(-2.0), rel=2e-3)


def test_estimate_of_the_speed(view):
    """Eqs. (79), (80) with the mean gradient 2 dT / (P/2) = 4000 K / P of the cosine."""
    observer = SurfaceSpeed()
    row = observer.observe(view)
    gradient = 4000.0 / PERIOD
    assert row["flow_gradient_mean_K_m"] == pytest.approx(gradient, rel=1e-3)
    speed = row["flow_layer_thickness_m"] / VISCOSITY * abs(SLOPE) * row["flow_gradient_mean_K_m"]
    estimate = observer.summary()["flow"]["estimate"]
    assert estimate["speed_m_s"] == pytest.approx(speed)
    assert estimate["time_s"] == pytest.approx(0.5 * PERIOD / speed)


def test_layer_down_to_the_bottom():
    """Where nothing flows back, the layer reaches half a spacing below the lowest particle."""
    view = pool_flow(rows(4), inner=0.0)
    assert SurfaceSpeed().observe(view)["flow_layer_thickness_m"] == pytest.approx(20 * NM)


def test_zero_between_samples():
    """Linear between the last positive and the first negative value."""
    depth = np.array([0.0, 1.0, 2.0, 3.0])
    assert zero_of(depth, np.array([3.0, 1.0, -1.0, 2.0])) == pytest.approx(1.5)
    assert zero_of(depth, np.ones(4)) == 3.0


def test_left_side_of_a_full_period(view):
    """A peak at x < 0 counts as one at x > 0; its return flow is that of its own side."""
    mirrored = replace(
        view,
        position=view.position * np.array([[-1.0], [1.0]]),
        flow=replace(
            view.flow,
            velocity=view.flow.velocity * np.array([[-1.0], [1.0]]),
            surface=view.flow.surface[::-1],
            surface_velocity=-view.flow.surface_velocity[::-1],
            surface_gradient=-view.flow.surface_gradient[::-1],
        ),
    )
    row, image = SurfaceSpeed().observe(view), SurfaceSpeed().observe(mirrored)
    x = row.pop("flow_surface_speed_max_x_m")
    assert image.pop("flow_surface_speed_max_x_m") == pytest.approx(-x, abs=6 * NM)
    assert image == pytest.approx(row, rel=1e-4)


def test_two_extrema_are_told_apart():
    """The inner one lies closer to x = 0; without a second one it is absent."""
    body = rows(2)
    (only,) = surface_extrema(pool_flow(body, inner=0.0))
    assert only[1] == pytest.approx(PERIOD / 4, abs=5 * NM)
    inner, outer = surface_extrema(pool_flow(body, inner=1.0))
    assert inner[1] == pytest.approx(400 * NM, abs=60 * NM)
    assert inner[0] > outer[0]
    assert outer[1] == pytest.approx(PERIOD / 4, abs=5 * NM)


def test_place_does_not_jump_between_maxima_of_one_top():
    """Two maxima, the second one falling behind by less than a twentieth: the place goes over."""
    place = np.arange(9.0)
    places = []
    for second in (1.02, 1.01, 1.0, 0.99, 0.98, 0.96, 0.94):
        speed = np.array([0.0, 0.5, 1.0, 0.98, 0.97, 0.98, second, 0.5, 0.0])
        peak = np.array([int(np.argmax(speed))])
        places.append(float(centers_of_tops(place, speed, peak, 0.05)[0]))
    assert places[2] == pytest.approx(4.0)
    assert np.all(np.diff(places) < 0.0) and np.min(np.diff(places)) > -1.0
    assert places[-1] < 3.5


def test_tops_end_at_the_valleys_between_them():
    """Two maxima that count: each has its own center."""
    speed = np.array([0.0, 1.0, 0.5, 0.2, 0.5, 1.0, 0.0])
    found = centers_of_tops(np.arange(7.0), speed, np.array([1, 5]), 0.05)
    assert found.tolist() == [1.0, 5.0]


def test_noise_is_no_extremum():
    """Fluctuations below a twentieth of the largest speed are not counted."""
    view = pool_flow(rows(2), inner=0.0)
    noise = 0.04 * FASTEST * np.random.default_rng(1).uniform(-0.5, 0.5, 500)
    noisy = replace(view.flow, surface_velocity=view.flow.surface_velocity + noise)
    assert len(surface_extrema(replace(view, flow=noisy))) == 1


def test_edge_of_the_spreading_liquid_is_no_extremum():
    """A speed that rises up to the last molten particle, but for a maximum further in."""
    view = maxima_at((600,), (2.0,))
    x = view.position[0, view.flow.surface]
    rising = view.flow.surface_velocity + np.where(x > 1000 * NM, 1.5, 0.0)
    flows = view.flow.flows & (view.position[0] < 1020 * NM)
    two_maxima = replace(view, flow=replace(view.flow, surface_velocity=rising, flows=flows))
    assert len(surface_extrema(two_maxima)) == 2
    (only,) = surface_extrema(two_maxima, margin=4.0)
    assert only[1] == pytest.approx(600 * NM, abs=3 * NM)


def test_extrema_in_time():
    """One, two, and the inner one alone: it keeps its name, and the times are counted."""
    body, observer = rows(2), FlowExtrema()
    heights = (0.0, 0.5, 1.5, 1.5, 0.0)
    for step, height in enumerate(heights):
        view = pool_flow(body, inner=height)
        observer.observe(replace(view, time=step * NS, time_step=1 * NS))
    found = observer.summary()["flow"]["extrema"]
    assert found["coexist_lasted_s"] == pytest.approx(3 * NS)
    assert (found["coexist_start_s"], found["coexist_end_s"]) == (1 * NS, 3 * NS)
    assert found["inner_exceeds_lasted_s"] == pytest.approx(2 * NS)
    assert found["inner_speed_max_m_s"] > found["outer_speed_max_m_s"]


def maxima_at(x, speeds, hottest=3000.0):
    """A view with maxima of |u| at places x [nm], at most `hottest` [K]; T_v is 2990 K."""
    view = pool_flow(rows(2), inner=0.0)
    place = view.position[0, view.flow.surface]
    u = sum(speed * np.exp(-(((place - x) / (60 * NM)) ** 2))
            for x, speed in zip(np.array(x) * NM, speeds, strict=True))  # fmt: skip
    flow = replace(view.flow, surface_velocity=u)
    return replace(view, flow=flow, temperature=np.minimum(view.temperature, hottest))


def test_a_second_extremum_before_anything_boils_is_none():
    """The larger one, then the one that goes on, is the outer one; the other is left out."""
    observer = FlowExtrema()
    seen = ((700, 300), (2.0, 1.0)), ((700, 300), (2.0, 3.0)), ((300,), (2.0,))
    names = ("flow_outer_x_m", "flow_inner_x_m")
    for (places, speeds), expected in zip(seen, (700, 700, 300), strict=True):
        row = observer.observe(maxima_at(places, speeds, hottest=2900.0))
        assert [row[name] for name in names] == pytest.approx([expected * NM, 0.0], abs=20 * NM)


def test_a_second_extremum_further_out_is_none():
    """An inner one lies closer to x = 0 than the outer one that it joins, and may outlive it."""
    observer = FlowExtrema()
    seen = (
        ((500,), (500, None)),
        ((500, 1000), (500, None)),
        ((200, 500), (500, 200)),
        ((200,), (None, 200)),
        ((200, 600), (600, 200)),
    )
    for places, expected in seen:
        row = observer.observe(maxima_at(places, [2.0] * len(places)))
        found = [row["flow_outer_x_m"], row["flow_inner_x_m"]]
        assert found == pytest.approx([NM * (x or 0.0) for x in expected], abs=20 * NM)


def test_inner_extremum_that_remains_alone():
    """When the outer one vanishes, the remaining one is still the inner one."""
    body, observer = rows(2), FlowExtrema()
    observer.observe(pool_flow(body, inner=1.5))
    view = pool_flow(body, inner=1.5)
    x = body.position[0, view.flow.surface]
    alone = np.where(x < 600 * NM, view.flow.surface_velocity, 0.0)
    row = observer.observe(replace(view, flow=replace(view.flow, surface_velocity=alone)))
    assert row["flow_outer_speed_m_s"] == 0.0
    assert row["flow_inner_speed_m_s"] > FASTEST


def test_lid_pressure_beside_the_recoil_pressure(view):
    """The surface pressure is largest at the edge, the recoil pressure where it is hot."""
    observer = SurfacePressure()
    row = observer.observe(view)
    x = 0.5 * PERIOD - 2.5 * NM
    assert row["lid_pressure_max_Pa"] == pytest.approx(1e5, rel=1e-4)
    assert row["lid_pressure_min_Pa"] == pytest.approx(-1e5, rel=1e-4)
    lid = observer.summary()["lid"]
    assert lid["pressure_max_x_m"] == pytest.approx(x)
    assert lid["recoil_at_pressure_max_Pa"] == pytest.approx(view.flow.recoil_pressure[-1])
    assert lid["recoil_max_Pa"] == pytest.approx(view.flow.recoil_pressure[0])


@pytest.mark.parametrize("share", [1.0, 0.1])
def test_lid_pressure_counts_an_impulse_by_its_size(view, share):
    """A pressure 2e5 Pa higher for a step, or ten times that for a tenth of one, adds 2e5 / 10."""
    observer, step = SurfacePressure(), 1e-11
    flow = replace(view.flow, full_step=step)
    before = observer.observe(replace(view, flow=flow))["lid_pressure_max_Pa"]
    pushed = replace(flow, surface_pressure=flow.surface_pressure + 2e5 / share)
    row = observer.observe(replace(view, flow=pushed, time=view.time + share * step))
    rise = row["lid_pressure_max_Pa"] - before
    assert rise == pytest.approx(2e5 / 10, rel=0.06)
    assert observer.summary()["lid"]["pressure_max_Pa"] == row["lid_pressure_max_Pa"]


def test_pool_width_of_moved_particles():
    """Cells meet half way between their particles: a pool of three, whose neighbors came closer."""
    view = replace(rows(1), surface=np.arange(500))
    x = view.position.copy()
    x[0, :4] = np.array([2.0, 8.0, 11.0, 16.0]) * NM
    fraction = np.where(np.arange(500) < 3, 1.0, 0.0)
    moved = replace(view, position=x, melt_fraction=fraction)
    assert MeltPool(2).observe(moved)["melt_width_m"] == pytest.approx(2 * 13.5 * NM)


def test_everything_survives_a_checkpoint():
    """A run cut in the middle and resumed through JSON ends with the same summary and rows."""
    views = list(synthetic_flow.pool_views())[15:33]
    whole, first = flow_observers(2), flow_observers(2)
    wanted = [whole.observe(view) for view in views]
    for view in views[:9]:
        first.observe(view)
    second = flow_observers(2)
    second.restore(json.loads(json.dumps(first.state())))
    assert [second.observe(view) for view in views[9:]] == wanted[9:]
    assert second.summary() == whole.summary()
    assert set(wanted[0]) == set(whole.columns)


def test_nothing_flows_yet():
    """Before the melt every number is 0, and the summary says so without failing."""
    position, width = synthetic_run.lattice(2)
    view = pool_flow(synthetic_run.view_at(0.0, 0, position, width))
    observers = flow_observers(2)
    row = observers.observe(view)
    assert row.pop("flow_spacing_min_m") > 0.0
    assert not any(value for name, value in row.items() if name.startswith(("flow_", "lid_")))
    summary = observers.summary()
    assert summary["flow"]["start_s"] is None
    assert summary["flow"]["speed_max_m_s"] == 0.0
    assert summary["flow"]["speed_max_at_s"] is None
    assert "lid" not in summary


def test_snapshots_hold_the_flow(view):
    """Velocity as a vector, fields of the surface on its particles, each with a unit."""
    fields = snapshot_fields(view)
    of_ablation = {"density", "vapor_pressure", "normal", "stage"}
    assert set(fields) == set(UNITS) - of_ablation
    assert fields["velocity"].shape == view.position.shape
    assert fields["speed"] == pytest.approx(np.hypot(*fields["velocity"]), rel=1e-6)
    gradient = fields["surface_gradient"]
    assert gradient[view.flow.surface] == pytest.approx(view.flow.surface_gradient, rel=1e-6)
    assert not np.any(np.delete(gradient, view.flow.surface))
