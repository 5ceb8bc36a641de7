"""Temperatures, energy budget, steps, vaporization, snapshots, and all observers together."""

import json
from dataclasses import replace

import numpy as np
import pytest
import synthetic_flow
import synthetic_run

from lasersph.observers import (
    EnergyBudget,
    Steps,
    SurfaceTemperature,
    Vaporization,
    heat_observers,
    snapshot_fields,
)
from lasersph.observers.energy_budget import NUMERICAL
from lasersph.observers.peak import Peak
from lasersph.output.settings import Probe, SnapshotPlan, SnapshotSchedule


@pytest.fixture(scope="module")
def views():
    position, width = synthetic_run.lattice(2)
    return [
        synthetic_run.view_at(float(t), k, position, width)
        for k, t in enumerate(synthetic_run.times())
    ]


def test_surface_temperatures(views):
    """The largest, the surface's range, and the cell closest to x = 0."""
    row = SurfaceTemperature().observe(views[60])
    view = views[60]
    assert row["temperature_max_K"] == view.temperature.max()
    assert row["temperature_surface_min_K"] == view.temperature[view.surface].min()
    assert row["temperature_at_maximum_K"] == view.temperature[0]


def test_rates_and_corner_temperatures(views):
    """Fastest heating and cooling between two steps; T_s, T_l, T_v for the figures."""
    observer = SurfaceTemperature()
    for time, temperature in ((0.0, 300.0), (2.0, 700.0), (3.0, 600.0)):
        observer.observe(
            replace(
                views[0], time=time, temperature=np.full(views[0].temperature.size, temperature)
            )
        )
    summary = observer.summary()
    assert summary["surface"]["heating_rate_max_K_s"] == 200.0
    assert summary["surface"]["cooling_rate_max_K_s"] == 100.0
    assert (summary["temperature_max_K"], summary["temperature_max_at_s"]) == (700.0, 2.0)
    assert summary["material"]["vaporization_K"] == synthetic_run.BOILING


BOOKED = {"incident": 10.0, "reflected": 4.0, "transmitted": 2.0, "absorbed": 4.0}
BOOKED |= {"lost": 0.5, "removed": 0.4, "discarded": 0.1, "newton_residual": 7.0}


def seen(view, energy, stored):
    """A later view whose particles hold `stored` [J/m]."""
    count = view.enthalpy.size
    mass, h = np.full(count, 2.0), np.full(count, 0.5 * stored / count)
    return replace(view, step=1, energy=energy, mass=mass, enthalpy=h)


def test_energy_budget_by_hand(views):
    """10 in, 4 reflected, 2 transmitted, 3 stored, 0.5 lost, 0.4 removed, 0.1 discarded closes; 2
    stored does not, and the summary keeps that. Latent heat is a part of the stored."""
    budget = EnergyBudget(2)
    row = budget.observe(seen(views[0], BOOKED, 3.0))
    assert row["energy_stored_J"] == pytest.approx(3.0)
    assert row["energy_imbalance_relative"] == pytest.approx(0.0, abs=1e-15)
    budget.observe(seen(views[0], BOOKED, 2.0))
    last = replace(seen(views[0], BOOKED, 3.0), latent_heats=(0.1, 0.0))
    last = replace(last, melt_fraction=np.ones(last.mass.size))
    assert budget.observe(last)["energy_latent_J"] == pytest.approx(0.1 * last.mass.sum())
    energy = budget.summary()["energy"]
    assert energy["unit"] == "J/m"
    assert energy["imbalance_relative"] == pytest.approx(0.25)
    assert EnergyBudget(1).summary()["energy"]["unit"] == "J/m^2"


@pytest.mark.parametrize(("name", "sign"), [("shifting", 1.0), ("ejection_work", 1.0)])
def test_numerics_have_numbers_of_their_own(views, name, sign):
    """What the numerics are booked to have added explains what is stored beyond the rest."""
    row = EnergyBudget(2).observe(seen(views[0], BOOKED | {name: 0.3}, 3.0 + sign * 0.3))
    assert row["energy_imbalance_relative"] == pytest.approx(0.0, abs=1e-15)
    assert row[f"energy_{name}_J"] == 0.3


@pytest.mark.parametrize("name", NUMERICAL)
def test_numerics_that_cancel_are_seen(views, name):
    """0.1, -0.3 and 0.2 J, one after the other: 0.2 at the end, 0.3 at most, at the second."""
    budget = EnergyBudget(2)
    for step, value in enumerate((0.1, -0.3, 0.2)):
        view = seen(views[0], BOOKED | {name: value}, 3.0)
        budget.observe(replace(view, time=float(step)))
    energy = budget.summary()["energy"]
    assert (energy[f"{name}_J"], energy[f"{name}_max_J"]) == (0.2, 0.3)
    assert energy[f"{name}_max_at_s"] == 1.0


def test_energy_budget_without_light(views):
    """Heat that enters through a boundary is the scale where there is no light; what the particles
    held at the start does not count as stored."""
    budget = EnergyBudget(1)
    row = budget.observe(seen(views[0], {"lost": -10.0}, 8.0))
    assert row["energy_imbalance_relative"] == pytest.approx(0.2)
    budget = EnergyBudget(1)
    budget.observe(replace(seen(views[0], {}, 100.0), step=0))
    row = budget.observe(seen(views[0], {"lost": -10.0}, 110.0))
    assert row["energy_stored_J"] == pytest.approx(10.0)
    assert row["energy_imbalance_relative"] == pytest.approx(0.0, abs=1e-14)


def test_kinetic_energy_counts_under_light(views):
    """What moves under light has taken its energy from there; a box has it from its walls."""
    view = synthetic_flow.box_view(speed=3.0)
    for light, counts in (({"incident": 1.0, "absorbed": 1.0}, 1.0), ({"lost": -1.0}, 0.0)):
        row = EnergyBudget(2).observe(seen(view, light, 1.0))
        assert row["energy_kinetic_J"] > 0.0
        expected = counts * row["energy_kinetic_J"]
        assert row["energy_imbalance_relative"] == pytest.approx(expected, abs=1e-15)


def test_steps_count_limits_and_iterations(views):
    """The initial view is no step; limits and iterations are counted."""
    steps = Steps(("newton",))
    for view in views:
        steps.observe(view)
    summary = steps.summary()
    assert summary["steps"] == len(views) - 1
    assert summary["iterations"] == {"newton": 3 * (len(views) - 1)}
    assert sum(summary["time_step"]["limits"].values()) == len(views) - 1
    assert summary["time_step"]["min_s"] == 0.25e-9


def test_vaporization_times_and_depth(views):
    """First and last time at T_v; lower face of the deepest cell that holds vapor."""
    observer = Vaporization()
    held, depth = [], 0.0
    for view in views:
        observer.observe(view)
        hot = view.vapor_fraction > 0.0
        if hot.any():
            held.append(view.time)
            depth = max(depth, np.max(0.5 * view.width[1, hot] - view.position[1, hot]))
    summary = observer.summary()["vaporization"]
    assert summary["start_s"] == held[0]
    assert summary["end_s"] == held[-1]
    assert summary["depth_any_max_m"] == depth
    assert summary["depth_max_m"] == 0.0
    cold = Vaporization()
    cold.observe(views[0])
    assert cold.summary() == {}


def test_evaporated_thickness(views):
    """The largest thickness that evaporated from a surface cell, and the mean over the surface: in
    a section (r, z) over rings, whose outer ones are larger."""
    observer = Vaporization()
    thickness = np.linspace(0.0, 3e-9, views[0].surface.size)
    row = observer.observe(replace(views[0], evaporated=thickness))
    assert row["evaporated_max_m"] == 3e-9
    assert row["evaporated_mean_m"] == pytest.approx(1.5e-9)
    rings = np.arange(thickness.size) + 0.5
    share = rings / rings.sum()
    row = observer.observe(replace(views[0], evaporated=thickness, column_share=share))
    assert row["evaporated_mean_m"] == pytest.approx(float(share @ thickness))
    assert row["evaporated_mean_m"] > 1.9e-9
    found = observer.summary()["vaporization"]
    assert found["evaporated_thickness_max_m"] == 3e-9
    # it only grows, so that a time of its largest value would be that of the last trace of vapor
    assert "evaporated_thickness_max_at_s" not in found


def test_peak_takes_the_middle_of_its_stand():
    """A largest value that stands from 1 to 3 is reached at 2; rounding does not end its stand."""
    peak = Peak()
    for time, value in enumerate([1.0, 2.0, 2.0 * (1 - 1e-15), 2.0, 1.5]):
        peak.update(value, float(time))
    assert (peak.value, peak.first, peak.time) == (2.0, 1.0, 2.0)
    # one cell less for a while still counts; a second pulse as large does not move the time
    for time, value in ((5.0, 1.9), (6.0, 2.0)):
        peak.update(value, time)
    assert peak.time == 3.5
    for time, value in ((7.0, 0.0), (99.0, 2.0)):
        peak.update(value, time)
    assert peak.time == 3.5


def test_snapshot_times():
    """Multiples of the interval, listed times, start and end, once each."""
    schedule = SnapshotSchedule(SnapshotPlan(interval=0.1, times=(0.25, 0.3, 9.0)), 0.5)
    assert schedule.times == pytest.approx([0.0, 0.1, 0.2, 0.25, 0.3, 0.4, 0.5])
    assert schedule.due(0.0)
    assert not schedule.due(0.05)
    assert schedule.next_time == pytest.approx(0.1)
    assert schedule.due(0.27)
    assert schedule.next_time == pytest.approx(0.3)
    again = SnapshotSchedule(SnapshotPlan(interval=0.1, times=(0.25,)), 0.5)
    again.restore(schedule.state(), 0.27)
    assert again.written == schedule.written
    assert again.due(0.5)
    assert again.next_time == float("inf")
    assert len(SnapshotSchedule(SnapshotPlan(), 1.0).times) == 41


def test_too_many_snapshots_are_refused():
    """An absurd interval is met before anything runs."""
    with pytest.raises(ValueError, match="too many"):
        SnapshotSchedule(SnapshotPlan(interval=1e-18), 1.0)


def test_snapshot_fields(views):
    """Single precision, surface cells marked."""
    fields = snapshot_fields(views[50])
    assert fields["temperature"].dtype == np.float32
    assert fields["surface"].sum() == views[50].surface.size
    assert fields["width"].shape == views[50].width.shape


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_together_and_through_a_checkpoint(dimension):
    """One row with every column; a state that passes through JSON changes nothing."""
    position, width = synthetic_run.lattice(dimension)
    all_views = [
        synthetic_run.view_at(float(t), k, position, width)
        for k, t in enumerate(synthetic_run.times()[::4])
    ]

    def observers():
        return heat_observers(dimension, probes=(Probe(name="a"),), iterations=("newton",))

    whole, first, second = observers(), observers(), observers()
    for view in all_views:
        assert tuple(whole.observe(view)) == whole.columns
    for view in all_views[:25]:
        first.observe(view)
    second.restore(json.loads(json.dumps(first.state())))
    for view in all_views[25:]:
        second.observe(view)
    assert second.summary() == whole.summary()
    assert json.loads(json.dumps(whole.summary())) == whole.summary()
    melt = whole.summary()["melt"]
    assert melt["depth_max_m"] > 0.0
    assert (melt["width_max_m"] is None) == (dimension == 1)
