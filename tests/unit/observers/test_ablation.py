"""Crater, ejecta and traces, counted by hand on made-up craters."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import synthetic_ablation
from synthetic_ablation import DX, NS, UM

from lasersph.observers import (
    Crater,
    Ejecta,
    Traces,
    ablation_observers,
    crater_shape,
    snapshot_fields,
)
from lasersph.observers.ejecta import Range
from lasersph.output.settings import Trace


def columns(count, width=1.0):
    """Centers of count x count columns around the origin, (2, count^2)."""
    nodes = (np.arange(count) + 0.5 - 0.5 * count) * width
    x, y = np.meshgrid(nodes, nodes, indexing="ij")
    return np.array([x.ravel(), y.ravel()])


def test_flat_surface_is_no_crater():
    """Without a recess all sizes are 0, also where the surface has risen."""
    shape = crater_shape(columns(4), 1.0, np.full(16, 0.2), np.zeros(2), 10.0)
    assert (shape.depth, shape.depth_max, shape.width, shape.volume) == (0.0, 0.0, 0.0, 0.0)


def test_square_hole():
    """A hole of 2 x 2 columns, 3 deep: vertical walls, width 2, volume 12."""
    center = columns(4)
    top = np.where(np.max(np.abs(center), axis=0) < 1.0, -3.0, 0.0)
    shape = crater_shape(center, 1.0, top, np.zeros(2), 10.0)
    assert shape.depth == shape.depth_mean == shape.depth_max == 3.0
    assert shape.width == 2.0
    assert shape.volume == 12.0
    assert shape.taper == 0.0
    assert shape.diameter == pytest.approx(2.0 * np.sqrt(4.0 / np.pi))


def test_steps_make_a_taper():
    """In 2-D a step of one column at half depth on each side: tan(taper) = 1 / (0.8 4)."""
    center = (np.arange(8) - 3.5)[None, :]
    top = -np.array([0.0, 0.0, 2.0, 4.0, 4.0, 2.0, 0.0, 0.0])
    shape = crater_shape(center, 1.0, top, np.zeros(1), 10.0)
    assert shape.width == shape.diameter == 4.0
    assert shape.depth_mean == 3.0
    assert np.tan(shape.taper) == pytest.approx(1.0 / 3.2)


def test_one_column():
    """In 1-D a crater has a depth and a volume per area, no width."""
    shape = crater_shape(np.zeros((0, 1)), DX, np.array([-3 * DX]), np.zeros(0), UM)
    assert shape.depth == shape.volume == pytest.approx(3 * DX)
    assert (shape.width, shape.taper) == (0.0, 0.0)


def test_quarter_of_a_spot():
    """A beam on the corner: volume, widths and diameters are those of the whole crater."""
    whole, quarter = columns(8), columns(4) + 2.0
    shapes = [
        crater_shape(center, 1.0, np.where(np.hypot(*center) < 3.0, -2.0, 0.0), np.zeros(2), 9.0)
        for center in (whole, quarter)
    ]
    assert shapes[1].mirror_images == 4
    assert shapes[1].width == shapes[0].width == 6.0
    assert shapes[1].diameter == pytest.approx(shapes[0].diameter)
    assert shapes[1].volume == shapes[0].volume


def test_hole_through_the_body():
    """A column without matter counts with the depth of the body."""
    top = np.where(np.arange(16) == 5, np.nan, 0.0)
    assert crater_shape(columns(4), 1.0, top, np.zeros(2), 10.0).depth_max == 10.0


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_crater_of_a_run(dimension):
    """Volume from the columns and from what left agree; depth and width are whole cells."""
    crater = Crater(dimension)
    for view in synthetic_ablation.views(dimension):
        row = crater.observe(view)
    assert set(row) == {column.key for column in crater.columns}
    found = crater.summary()["crater"]
    assert found["depth_m"] == pytest.approx(4 * DX)
    assert found["removed_volume_m3"] == pytest.approx(found["volume_m3"])
    assert found["width_m"] == (None if dimension == 1 else pytest.approx(4 * UM))


def test_depth_of_each_pulse():
    """Two pulses: what was deep when the second began belongs to the first."""
    crater = Crater(1, pulse_starts=(0.0, 5 * NS))
    for view in synthetic_ablation.views(1):
        crater.observe(view)
    assert crater.summary()["crater"]["depth_of_pulse_m"] == pytest.approx([2 * DX, 2 * DX])


def test_share_of_the_heat_of_vaporization():
    """A half vaporized surface particle counts by half in the vaporized volume."""
    view = synthetic_ablation.view_at(5 * NS, 10, 1)
    fraction = view.vapor_fraction.copy()
    fraction[view.surface] = 0.5
    crater = Crater(1)
    row = crater.observe(replace(view, vapor_fraction=fraction))
    assert row["crater_removed_volume_m"] == pytest.approx(2 * DX)
    assert row["crater_vaporized_volume_m"] == pytest.approx(2.5 * DX)


def test_ejecta_count_once():
    """Every particle counts once, with its values at leaving, though it is seen many times."""
    ejecta = Ejecta(2)
    for view in synthetic_ablation.views(2):
        ejecta.observe(view)
    found = ejecta.summary()["ejecta"]
    assert ejecta.ranges["speed"].count == found["count"] == 68
    assert found["speed_mean_m_s"] == found["speed_min_m_s"] == 400.0
    assert found["angle_max_deg"] == 0.0
    assert found["start_s"] == pytest.approx(3 * NS)
    assert found["mass_kg"] == pytest.approx(68 * 2705.0 * DX**2)


def test_range_of_groups():
    """Mean and extrema over groups; nothing before the first value."""
    values = Range()
    assert values.entries("speed", "m/s")["speed_mean_m_s"] is None
    values.add(np.array([1.0, 2.0]))
    values.add(np.array([6.0]))
    assert (values.mean, values.smallest, values.largest) == (3.0, 1.0, 6.0)


def test_trace_of_a_particle():
    """The third particle from the top boils, leaves at 7 ns and flies with 400 m/s."""
    traces = Traces((Trace(name="third", depth=0.5 * UM),))
    for view in synthetic_ablation.views(1):
        row = traces.observe(view)
    found = traces.summary()["traces"]["third"]
    assert found["start_m"] == pytest.approx([-2.5 * DX])
    assert found["left_at_s"] == pytest.approx(7 * NS)
    assert found["boiled_at_s"] <= found["left_at_s"]
    assert found["acceleration_m_s2"] == pytest.approx(400.0 / (0.5 * NS))
    assert row["trace_third_speed_m_s"] == 400.0
    assert row["trace_third_stage"] == 2.0


def test_trace_beyond_the_view():
    """A particle that a view leaves out keeps its last values."""
    traces = Traces((Trace(name="deep", depth=2.9 * UM),))
    traces.observe(synthetic_ablation.view_at(0.0, 0, 1))
    view = synthetic_ablation.view_at(2 * NS, 4, 1)
    short = replace(view, temperature=view.temperature[:5], position=view.position[:, :5])
    assert traces.observe(short)["trace_deep_temperature_K"] == 300.0


def test_two_traces_of_one_name():
    """Names must differ, since they name columns."""
    with pytest.raises(ValueError, match="same name"):
        Traces((Trace(name="a"), Trace(name="a", depth=UM)))


def test_resumed_in_the_middle():
    """Restored at 6 ns, all observers end with the same summary."""
    traces = (Trace(name="center"),)
    whole, first, second = (
        ablation_observers(2, traces=traces, axis=(0.0, 0.0), pulse_starts=(0.0,)) for _ in range(3)
    )
    for view in synthetic_ablation.views(2):
        whole.observe(view)
        if view.time <= 6 * NS:
            first.observe(view)
            second.restore(first.state())
        else:
            second.observe(view)
    assert second.summary() == whole.summary()


def test_snapshot_holds_ejecta():
    """Snapshots hold velocity, stage and vapor pressure of every particle."""
    fields = snapshot_fields(synthetic_ablation.view_at(5 * NS, 10, 2))
    assert fields["stage"].dtype == np.uint8
    assert fields["velocity"].shape == (2, 450)
    assert {"speed", "pressure", "density", "vapor_pressure", "normal"} <= set(fields)
