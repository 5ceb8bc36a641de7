"""Heat and drag of the walls of a box, and its Nusselt numbers, from sums that are known."""

import json
from dataclasses import replace

import numpy as np
import pytest
from synthetic_flow import box_view, cube_view

from lasersph.observers.view import of_whole
from lasersph.observers.wall_exchange import EVERY, WallExchange, rates
from lasersph.particles.faces import PLANE

SIZE = 1e-3
CONDUCTION = 2.0 * 20.0 / SIZE
"""k dT / L of `box_view` [W/m^2]; 40 W/m over a side."""


def observe(view, times):
    """Observer of the box at these times, each a look at all that is looked at now and then."""
    observer = WallExchange()
    for k, time in enumerate(times):
        seen = box_view(time=time, step=k * EVERY)
        flow = replace(view.flow, wall_heat=seen.flow.wall_heat)
        flow = replace(flow, wall_impulse=seen.flow.wall_impulse)
        flow = replace(flow, wall_pressing=seen.flow.wall_pressing)
        row = observer.observe(replace(seen, time_step=1e-5 if k else 0.0, flow=flow))
    return observer, row


def test_conduction_has_the_nusselt_number_one():
    """40 W/m in at the left and out at the right, as by conduction at rest: all numbers are 1."""
    still = box_view(speed=0.0)
    observer, row = observe(still, [0.0, 1e-5, 2e-5])
    heat = observer.summary()["box"]["heat"]
    assert heat["between"] == "left and right"
    assert heat["flux_left_W_m2"] == pytest.approx(CONDUCTION)
    assert heat["flux_right_W_m2"] == pytest.approx(-CONDUCTION)
    assert heat["flux_bottom_W_m2"] == heat["flux_surface_W_m2"] == 0.0
    for name in ("left", "right"):
        assert heat[f"nusselt_{name}"] == row[f"box_nusselt_{name}"] == pytest.approx(1.0)
    assert row["box_nusselt_mean"] == 1.0
    assert "nusselt_bottom" not in heat
    assert heat["temperature_bottom_K"] == pytest.approx(300.0)


@pytest.mark.parametrize("warm", ["left", "right"])
def test_domain_averaged_number_by_hand(warm):
    """u = 3 m/s where h - <h> = 1 J/kg and -3 where it is -1: 1 + rho 3 / (k dT / L)."""
    view = box_view()
    sign = np.where(view.position[1] > -0.5 * SIZE, 1.0, -1.0)
    u = sign * (3.0 if warm == "left" else -3.0)
    given = {"left": 310.0, "right": 290.0} if warm == "left" else {"left": 290.0, "right": 310.0}
    flow = replace(view.flow, velocity=np.array([u, 0.0 * u]), wall_temperature=given)
    seen = replace(view, enthalpy=7.0 + sign, flow=flow)
    assert WallExchange().observe(seen)["box_nusselt_mean"] == pytest.approx(1.0 + 3.0 / CONDUCTION)


def test_means_over_the_last_quarter():
    """40 W/m until 6 us, 80 W/m from there to 8 us: the summary has 80, the drag likewise."""
    observer = WallExchange()
    for k, time in enumerate((0.0, 2e-6, 6e-6, 7e-6, 8e-6)):
        seen = box_view(time=time, step=k * EVERY)
        left = 40.0 * time + max(40.0 * (time - 6e-6), 0.0)
        flow = replace(seen.flow, wall_heat={**seen.flow.wall_heat, "left": left})
        observer.observe(replace(seen, flow=flow))
    found = observer.summary()["box"]
    assert found["walls"]["from_s"] == 6e-6
    assert found["heat"]["nusselt_left"] == pytest.approx(2.0)
    assert found["heat"]["nusselt_right"] == pytest.approx(1.0)
    assert found["walls"]["drag_left_N_m"] == pytest.approx(-3.0)
    assert found["walls"]["drag_bottom_N_m"] == pytest.approx(1.0)
    assert found["walls"]["pressing_left_N_m"] == pytest.approx(5.0)
    assert found["walls"]["pressing_surface_N_m"] == pytest.approx(-1.0)


def test_forces_that_nobody_knows_are_left_out():
    """Where nothing is booked across the faces the summary has the drag alone."""
    seen = box_view(time=1e-6, step=EVERY)
    observer = WallExchange()
    observer.observe(replace(seen, flow=replace(seen.flow, wall_pressing={})))
    walls = observer.summary()["box"]["walls"]
    assert set(walls) == {"from_s", *(f"drag_{side}_N_m" for side in PLANE)}


def test_nusselt_number_only_where_heat_crosses():
    """Of sides with a flux as well, but not of adiabatic ones, however much they differ."""
    view = box_view()
    for crossed, names in (
        (("left", "right"), {"nusselt_left", "nusselt_right", "nusselt_mean"}),
        (("left", "surface"), set()),
        ((), set()),
    ):
        flow = replace(view.flow, wall_temperature={}, conducting_sides=crossed)
        observer, row = observe(replace(view, flow=flow), [0.0, 1e-5])
        heat = observer.summary()["box"]["heat"]
        assert {key for key in heat if key.startswith("nusselt")} == names
        assert ("between" in heat) == bool(names) == bool(row["box_nusselt_mean"])
        assert heat["temperature_left_K"] == pytest.approx(310.0)


def test_without_temperature_difference_there_is_no_heat():
    """An isothermal box: no Nusselt numbers, zeros in the history; walls still drag."""
    view = box_view()
    flow = replace(view.flow, wall_temperature={})
    observer = WallExchange()
    row = observer.observe(replace(view, temperature=np.full(1600, 300.0), flow=flow))
    assert row["box_nusselt_left"] == row["box_nusselt_mean"] == 0.0
    found = observer.summary()["box"]
    assert "heat" not in found and set(found["walls"]) > {"drag_left_N_m", "from_s"}


def test_state_survives():
    """A restored observer goes on to the same summary."""
    observer, _ = observe(box_view(), [0.0, 1e-5, 2e-5])
    resumed = WallExchange()
    resumed.restore(json.loads(json.dumps(observer.state())))
    view = box_view(time=3e-5, step=3 * EVERY)
    assert resumed.observe(view) == observer.observe(view)
    assert resumed.summary() == observer.summary()


def test_rates():
    """Changes over the time between; nothing between equal times."""
    start, end = {"time": 1.0, "heat": 3.0}, {"time": 3.0, "heat": 7.0}
    assert rates(start, end)["heat"] == 2.0
    assert rates(end, end)["heat"] == 0.0


def test_half_a_box_gives_heat_through_level_sides_of_the_whole():
    """Heat through bottom and surface doubles, that of an upright side and the fluxes stay."""
    heat = {"left": 0.0, "right": 3.0, "bottom": 5.0, "surface": -8.0}
    observers = WallExchange(), WallExchange()
    rows = []
    for observer, images in zip(observers, (1, 2), strict=True):
        for k, time in enumerate((0.0, 1e-5, 2e-5)):
            seen = box_view(time=time, step=k * EVERY)
            entered = {side: 1e5 * time * value for side, value in heat.items()}
            view = replace(seen, flow=replace(seen.flow, wall_heat=entered))
            row = observer.observe(of_whole(view, images))
        rows.append(row)
    half, whole = rows
    assert whole["box_heat_bottom_J"] == 2.0 * half["box_heat_bottom_J"]
    assert whole["box_heat_surface_J"] == 2.0 * half["box_heat_surface_J"]
    assert whole["box_heat_right_J"] == half["box_heat_right_J"]
    fluxes = [observer.summary()["box"]["heat"] for observer in observers]
    for side in heat:
        assert fluxes[1][f"flux_{side}_W_m2"] == pytest.approx(fluxes[0][f"flux_{side}_W_m2"])


def test_a_block_has_forces_along_two_axes_of_each_side():
    """Means of what is booked by side and axis, in N; nothing in N/m."""
    view = cube_view()
    observer = WallExchange(3)
    for k, time in enumerate((0.0, 1e-5, 2e-5)):
        impulse = {"surface_x": 3.0 * time, "back_z": -2.0 * time}
        flow = replace(view.flow, wall_impulse=impulse, wall_pressing={"front": 5.0 * time})
        row = observer.observe(replace(view, time=time, step=k * EVERY, flow=flow))
    walls = observer.summary()["box"]["walls"]
    assert walls["drag_surface_x_N"] == pytest.approx(3.0) == row["box_drag_surface_x_N"]
    assert walls["drag_back_z_N"] == pytest.approx(-2.0)
    assert walls["pressing_front_N"] == pytest.approx(5.0)
    assert walls["drag_left_y_N"] == 0.0
    # two along each of six sides and one across, with the time from which on they are means
    assert len(walls) == 19
