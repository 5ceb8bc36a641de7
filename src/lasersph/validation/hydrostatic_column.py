"""A column of water at rest over wall particles: its pressure, and that it stays.

The case `hydrostatic-column` for 10 s, 31 times sqrt(depth / g), in 2-D and 1-D. Compared at every
snapshot: a line through the pressures of all particles over their depths against rho g, the root of
the mean square of all particles' deviations, and how the pressure at the bottom changes from the
first half of the run to the second.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lasersph.case import load_case
from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, at_most, shown

TITLE = "Water at rest: hydrostatic pressure that does not drift"
SOURCE = "P = rho g depth"
TOLERANCE = 0.02
"""Of the pressure at the bottom."""
DRIFT = 0.005
"""Of the pressure at the bottom, over 10 s."""
QUICK = ("time.end=1 s", "output.snapshots.interval=0.1 s")


@dataclass(frozen=True)
class Column:
    """Numbers of a run at its snapshots (k,), over the exact pressure at the bottom.

    Attributes:
        slope: dP/d(depth) over rho g. bottom: pressure of the fitted line at the bottom. spread:
            root of the mean square of the particles' deviations from rho g depth.
    """

    one: Run
    times: np.ndarray
    slope: np.ndarray
    bottom: np.ndarray
    spread: np.ndarray


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """10 s in 2-D and 1-D; `quick`: 1 s in 2-D."""
    settings = QUICK if quick else ()
    columns = {
        f"{dimension}-D": measured(
            computed("hydrostatic-column", [f"solver.dimensions={dimension}", *settings], out_dir,
                     f"{dimension}d")
        )
        for dimension in ((2,) if quick else (2, 1))
    }  # fmt: skip
    rows: list[Row] = []
    for name, found in columns.items():
        rows += rows_of(name, found)
    return Report("hydrostatic-column", TITLE, tuple(rows), (draw(out_dir, columns),), (), quick)


def weight() -> tuple[float, float]:
    """rho g [Pa/m] and the depth [m] of the case."""
    case = load_case("hydrostatic-column")
    if case.solver.kind != "ablation":
        raise ValueError("the case hydrostatic-column does not move")
    return case.material.density_reference * case.solver.gravity, case.domain.depth


def measured(one: Run) -> Column:
    """Lines through the pressures of each snapshot."""
    gradient, depth = weight()
    found = []
    for snapshot in one.snapshots:
        below, pressure = -snapshot["position"][-1], snapshot["pressure"]
        slope, offset = np.polyfit(below, pressure, 1)
        spread = np.sqrt(np.mean((pressure - gradient * below) ** 2))
        found.append((slope / gradient, (offset + slope * depth), spread))
    slope, bottom, spread = np.array(found).T
    scale = gradient * depth
    return Column(one, one.snapshots.times, slope, bottom / scale, spread / scale)


def rows_of(name: str, found: Column) -> list[Row]:
    """Judged numbers of one run, the worst over all snapshots."""
    half = found.times.size // 2
    drift = abs(float(np.mean(found.bottom[half:]) - np.mean(found.bottom[1:half])))
    speed = found.one.summary["motion"]["speed_max_m_s"]
    return [
        at_most(f"{name}: slope of the pressure, largest deviation from rho g", "%",
                100.0 * float(np.max(np.abs(found.slope - 1.0))), 100.0 * TOLERANCE,
                source=SOURCE),
        at_most(f"{name}: pressure at the bottom, largest deviation", "%",
                100.0 * float(np.max(np.abs(found.bottom - 1.0))), 100.0 * TOLERANCE,
                source=SOURCE),
        at_most(f"{name}: root of the mean square of all particles' deviations over the bottom's "
                "pressure", "%", 100.0 * float(np.max(found.spread)), 100.0 * TOLERANCE,
                source=SOURCE),
        at_most(f"{name}: drift of the pressure at the bottom, second half against first", "%",
                100.0 * drift, 100.0 * DRIFT, source="nothing changes"),
        shown(f"{name}: largest speed at the end", "m/s", speed, reference=0.0),
    ]  # fmt: skip


def draw(out_dir: Path, columns: dict[str, Column]) -> Path:
    """(a) pressure over depth at the end, (b) pressure at the bottom over time."""
    gradient, depth = weight()
    figure, axes = style.new_figure(1, 2, height=3.4)
    axes[0].plot([0.0, depth], [0.0, 1e-3 * gradient * depth], color=style.GRAY, label="rho g z")
    for k, (name, found) in enumerate(columns.items()):
        last = found.one.snapshots[-1]
        axes[0].plot(-last["position"][-1], 1e-3 * last["pressure"], "o^"[k], markersize=3,
                     color=style.COLORS[k], label=name)  # fmt: skip
        axes[1].plot(found.times, found.bottom, color=style.COLORS[k], label=name)
    axes[1].axhspan(1.0 - TOLERANCE, 1.0 + TOLERANCE, color=style.GRAY, alpha=0.2)
    style.label(axes[0], "depth [m]", "pressure [kPa]", title="(a) at the end")
    style.label(axes[1], "time [s]", "pressure at the bottom / exact [1]", title="(b)")
    style.legend(axes[0])
    return style.save(figure, out_dir / "hydrostatic-column.png")
