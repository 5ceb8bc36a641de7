"""Flow in a cavity under a free surface, against finite differences by another program.

A square box with walls at rest; its flat surface is warm in the middle, mean + dT cos(2 pi
x/width), so that eta du/dz = dgamma/dT dT/dx pulls it to both sides. Speeds count in S width with
the largest shear S = |dgamma/dT| dT 2 pi / (width eta). The largest error lies where the surface
meets a wall and shrinks with the spacing: 7.5, 6.1, 4.0 % of the largest speed at 16, 32, 48 a
side.
"""

import numpy as np
import pytest
from cavity_differences import Cavity, extrapolated

from lasersph.case import load_case
from lasersph.observers.box_sections import Box, center_lines
from lasersph.output import open_run
from lasersph.simulation import run

SIDE, ETA, RHO = 1e-6, 7e-3, 6863.0
COUNT = 24
SETTINGS = (
    f"domain.width={SIDE} m", f"domain.depth={SIDE} m", "domain.extent=full",
    "solver.flow.left=no-slip", "solver.flow.right=no-slip", "time.step=5 ns", "time.end=0.4 us",
)  # fmt: skip


def differences(reynolds):
    """u, w over S width at the nodes of 48 cells a side, from 48 and 96."""

    def solved(count):
        x = np.linspace(-0.5, 0.5, count + 1)
        return Cavity(count, reynolds, np.sin(2.0 * np.pi * x)).solve().velocity()

    return extrapolated(solved(96), solved(48))


@pytest.mark.parametrize(
    ("reynolds", "scatter"), [(1.0, 0.05), pytest.param(200.0, 0.07, marks=pytest.mark.slow)]
)
def test_thermocapillary_cavity(tmp_path, reynolds, scatter):
    """w on the horizontal center line within 3 %, u of the surface but for some scatter (RMS)."""
    speed = reynolds * ETA / (RHO * SIDE)
    slope = speed * ETA / (2.0 * np.pi)
    case = load_case("marangoni-layer", [
        *SETTINGS, f"particles.spacing={SIDE / COUNT!r} m",
        f'boundaries.surface_temperature_wave={{amplitude="1 K", period="{SIDE} m"}}',
        f"material.surface_tension_slope={-slope!r} N/(m K)",
    ])  # fmt: skip
    run(case, tmp_path / "run", threads=1)
    one = open_run(tmp_path / "run")
    last = one.snapshots[-1]
    u, w = differences(reynolds)
    scale = np.abs(u).max()
    nodes = np.linspace(0.0, 1.0, 49)
    box = Box(-0.5 * SIDE, 0.5 * SIDE, -SIDE, 0.0)
    found = center_lines(last["position"], last["velocity"] / speed, box, nodes)
    assert found.u == pytest.approx(0.0, abs=0.03 * scale)
    assert found.w[2:-2] == pytest.approx(w[2:-2, 24], abs=0.03 * scale)
    cells = np.flatnonzero(last["surface"])
    x = last["position"][0, cells] / SIDE + 0.5
    error = last["surface_velocity"][cells] / speed - np.interp(x, nodes, u[:, -1])
    assert np.sqrt(np.mean(error**2)) < scatter * scale
