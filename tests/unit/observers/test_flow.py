"""What observers see of a flow, worked by hand on made-up velocities."""

import json
from dataclasses import replace

import numpy as np
import pytest
import synthetic_flow
import synthetic_run
from synthetic_flow import FASTEST, LAYER, SLOPE, VISCOSITY, liquid_rows, pool_flow
from synthetic_run import NM, PERIOD

from lasersph.observers import flow_observers, snapshot_fields
from lasersph.observers.flow_speed import FlowSpeed
from lasersph.observers.melt_pool import MeltPool
from lasersph.observers.snapshots import UNITS
from lasersph.observers.surface_pressure import SurfacePressure
from lasersph.observers.surface_speed import SurfaceSpeed, mean_along, zero_of


@pytest.fixture(scope="module")
def view():
    return pool_flow(liquid_rows(80), inner=0.0)


def test_speed_and_kinetic_energy():
    """The fastest particle, and half rho V v^2 over two moving ones."""
    still = pool_flow(liquid_rows(2), inner=0.0)
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
    view = pool_flow(liquid_rows(4), inner=0.0)
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
    view = replace(liquid_rows(1), surface=np.arange(500))
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
    of_electrons = {"electron_temperature", "electron_energy"}
    assert set(fields) == set(UNITS) - of_ablation - of_electrons
    assert fields["velocity"].shape == view.position.shape
    assert fields["speed"] == pytest.approx(np.hypot(*fields["velocity"]), rel=1e-6)
    gradient = fields["surface_gradient"]
    assert gradient[view.flow.surface] == pytest.approx(view.flow.surface_gradient, rel=1e-6)
    assert not np.any(np.delete(gradient, view.flow.surface))
