"""Pressure under the flat surface of a melt pool, beside that of the return flow in its wedge.

The surface of a pool is kept flat, and its stress tau drives the melt outward; at the edge, where
the pool ends in a wedge of depth h, the same volume has to flow back. Without a net flux, the
momentum of the layer says h dp/dx = tau - tau_b with the stress tau_b of the bottom. Deep melt,
whose bottom is at rest, has tau_b = 0; a film so thin that viscosity rules it (lubrication) has

    u = tau / (4 eta h) (3 z^2 - 2 h z),    tau_b = -tau / 2,    dp/dx = 3 tau / (2 h)

so that the rise of the pressure from the middle to the edge lies between the integrals of tau / h
and of 3 tau / (2 h). Left out: the change of u^2 along the flow, rho d(int u^2 dz)/dx, which is
small beside tau where melt is thin.

    for d in 16 8 4; do lasersph run dlip-steel --set particles.spacing=${d}nm \\
        --set time.end=60ns --no-figures --threads 1 --out runs/lid-$d; done
    python benchmarks/lid_pressure.py runs/lid-16 runs/lid-8 runs/lid-4 \\
        --figure docs/images/lid-pressure.png
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from lasersph import load_case, open_run
from lasersph.output import Run

TIMES = (50e-9, 54e-9, 56e-9)
"""When the rise is compared [s]: the pool grows, is widest, and shrinks."""
DRAWN = 54e-9
NOISY = ((48e-9, 52e-9), (52e-9, 58e-9))
"""Spans in which steps are compared [s]: while the pool grows, and later."""


@dataclass(frozen=True)
class Wedge:
    """A pool at a time, by columns of the surface from the middle to the edge.

    Attributes:
        x: (m,) [m]. depth: (m,) of the melt [m]. stress: (m,) of the surface, outward [Pa].
        pressure: (m,) of the flat surface [Pa].
    """

    x: np.ndarray
    depth: np.ndarray
    stress: np.ndarray
    pressure: np.ndarray

    def rise(self, gradient: np.ndarray) -> float:
        """Integral of a gradient of the pressure [Pa/m] from the middle to the edge [Pa]."""
        return float(np.sum(0.5 * (gradient[1:] + gradient[:-1]) * np.diff(self.x)))


def return_flow_gradient(stress: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """dp/dx of a thin layer between a stressed surface and a wall, no net flux: 3 tau / (2 h)."""
    return 1.5 * stress / depth


def least_gradient(stress: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """dp/dx of a layer whose bottom is at rest, no net flux: tau / h."""
    return stress / depth


def wedge_of(run: Run, time: float) -> Wedge:
    """The pool of a run in the snapshot next to a time [s]."""
    shot, spacing = run.snapshots.nearest(time), run.summary["spacing_m"]
    (x, z), flows = shot["position"], shot["flows"] > 0
    top = np.flatnonzero((shot["surface"] > 0) & flows)
    top = top[np.argsort(x[top])]
    lowest = [z[flows & (np.abs(x - x[i]) < spacing)].min() for i in top]
    slope = load_case(run.path / "case.toml").material.surface_tension_slope_at(2500.0)
    return Wedge(
        x=x[top],
        depth=0.5 * spacing - np.array(lowest),
        stress=float(slope) * shot["surface_gradient"][top],
        pressure=shot["lid_pressure"][top],
    )


def change_of_a_step(run: Run, begin: float, end: float) -> float:
    """Root of the mean square change of the largest pressure from step to step [Pa]."""
    time, pressure = run.history["time_s"], run.history["lid_pressure_max_Pa"]
    chosen = (time >= begin) & (time < end)
    return float(np.sqrt(np.mean(np.diff(pressure[chosen]) ** 2)))


def print_table(runs: list[Run]) -> None:
    """Rise from the middle to the edge beside both integrals, largest value, steps [MPa]."""
    print("spacing  time  rise  tau/h  3tau/2h     all in MPa, ns, nm")
    for run in runs:
        for time in (one for one in TIMES if one < 1.001 * run.summary["time_s"]):
            pool = wedge_of(run, time)
            limits = (f(pool.stress, pool.depth) for f in (least_gradient, return_flow_gradient))
            found = (pool.pressure[-1] - pool.pressure[0], *(pool.rise(g) for g in limits))
            words = "  ".join(f"{1e-6 * one:5.2f}" for one in found)
            print(f"{1e9 * run.summary['spacing_m']:5.1f}  {1e9 * time:5.0f}  {words}")
    for run in runs:
        largest = 1e-6 * run.summary["lid"]["pressure_max_Pa"]
        steps = ", ".join(f"{1e-6 * change_of_a_step(run, *span):.2f}" for span in NOISY)
        print(f"{1e9 * run.summary['spacing_m']:5.1f} nm: largest {largest:.2f}, per step {steps}")


def draw(runs: list[Run], path: Path) -> None:
    """(a) rise of the pressure toward the edge, beside theory; (b) the largest over time."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.6), constrained_layout=True)
    for run in runs:
        pool, label = wedge_of(run, DRAWN), f"{1e9 * run.summary['spacing_m']:.0f} nm"
        left.plot(1e9 * pool.x, 1e-6 * (pool.pressure - pool.pressure[0]), label=label)
        time, largest = run.history["time_s"], run.history["lid_pressure_max_Pa"]
        right.plot(1e9 * time, 1e-6 * largest, linewidth=1.0, label=label)
    finest = wedge_of(runs[-1], DRAWN)
    bounds = [
        np.concatenate([[0.0], np.cumsum(0.5 * (g[1:] + g[:-1]) * np.diff(finest.x))])
        for g in (f(finest.stress, finest.depth) for f in (least_gradient, return_flow_gradient))
    ]
    shade = {"color": "0.85", "label": r"$\int\tau/h$ to $\int3\tau/2h$"}
    left.fill_between(1e9 * finest.x, *(1e-6 * one for one in bounds), **shade)
    left.set(xlabel="x [nm]", ylabel="pressure over the middle [MPa]")
    right.set(xlabel="time [ns]", ylabel="largest pressure [MPa]", xlim=(46.0, 60.0))
    left.set_title(f"(a) toward the edge, {1e9 * DRAWN:.0f} ns")
    right.set_title("(b) step by step")
    for axes in (left, right):
        axes.legend(frameon=False)
    figure.savefig(path, dpi=110)


def main() -> None:
    """Print the table; draw where a figure is asked for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", nargs="+", type=Path, help="run folders, coarse to fine")
    parser.add_argument("--figure", type=Path)
    given = parser.parse_args()
    runs = [open_run(folder) for folder in given.folder]
    print_table(runs)
    if given.figure is not None:
        draw(runs, given.figure)


if __name__ == "__main__":
    main()
