"""Cells of a round spot, from stream functions that are known."""

from dataclasses import replace

import numpy as np
import pytest
from synthetic_flow import box_view

from lasersph.observers.flow_cells import FlowCells

R = H = 1e-3
TURNOVER = 2e-9
"""Largest value of the stream function [m^3/s]."""


def view_of(waves, count=80):
    """psi = TURNOVER 16 (r/R)^2 (1 - r/R)^2 sin(waves pi z'/H), z' downward: cells from the top."""
    view = box_view(count=count, size=H)
    r, depth = view.position[0], -view.position[1]
    s, phase = r / R, waves * np.pi * depth / H
    # w = 1/(2 pi r) dpsi/dr, u = -1/(2 pi r) dpsi/dz
    scale = 16.0 * TURNOVER / (2.0 * np.pi * r)
    w = scale * (2.0 * s * (1.0 - s) ** 2 - 2.0 * s**2 * (1.0 - s)) / R * np.sin(phase)
    u = scale * s**2 * (1.0 - s) ** 2 * (waves * np.pi / H) * np.cos(phase)
    volume = 2.0 * np.pi * r * np.prod(view.width, axis=0)
    return replace(view, volume=volume, flow=replace(view.flow, velocity=np.array([u, w])))


def test_one_cell_outward_at_its_top():
    """It turns the largest value of the stream function, in the rows where sin >= 0.1."""
    view = view_of(1)
    assert view.flow.velocity[0, view.surface].max() > 0.0
    observer = FlowCells()
    row = observer.observe(view)
    assert row["flow_outward_turnover_m3_s"] == pytest.approx(TURNOVER, rel=1e-3, abs=0.0)
    expected = H * (1.0 - 2.0 * np.arcsin(0.1) / np.pi)
    assert row["flow_outward_height_m"] == pytest.approx(expected, abs=2.0 * H / 80)
    assert row["flow_inward_turnover_m3_s"] == row["flow_inward_height_m"] == 0.0
    again = FlowCells()
    again.restore(observer.state())
    assert again.summary() == observer.summary()


def test_cells_above_each_other():
    """Outward at the surface, inward below: each half as high; turned, the names change places."""
    view = view_of(2)
    row = FlowCells().observe(view)
    half = 0.5 * H * (1.0 - 2.0 * np.arcsin(0.1) / np.pi)
    for name in ("outward", "inward"):
        assert row[f"flow_{name}_turnover_m3_s"] == pytest.approx(TURNOVER, rel=2e-3, abs=0.0)
        assert row[f"flow_{name}_height_m"] == pytest.approx(half, abs=2.0 * H / 80)
    single = view_of(1)
    turned = replace(single.flow, velocity=-single.flow.velocity)
    row = FlowCells().observe(replace(single, flow=turned))
    assert row["flow_inward_turnover_m3_s"] == pytest.approx(TURNOVER, rel=1e-3, abs=0.0)
    assert row["flow_outward_turnover_m3_s"] == 0.0


def test_nothing_flows():
    """No cell, and nothing in the summary."""
    view = view_of(1)
    still = replace(view.flow, flows=np.zeros(view.temperature.size, bool))
    observer = FlowCells()
    assert set(observer.observe(replace(view, flow=still)).values()) == {0.0}
    assert observer.summary() == {}
