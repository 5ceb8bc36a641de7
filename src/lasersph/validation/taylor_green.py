"""Decaying Taylor-Green vortices: decay, velocities and order of convergence, against exact ones.

The case `taylor-green` with 25, 50 and 100 particles a side, with particle shifting and without.
The flow stretches the lattice along the lines where it diverges: without shifting particles line
up and leave gaps, and a run may end early; then is reported when.

Compared: the rate at which the kinetic energy decays, fitted over the run, and the root of the mean
square of the velocities' error over the largest exact speed of that time.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lasersph.analytic.taylor_green import TaylorGreen
from lasersph.case import Case, load_case
from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.report import Report
from lasersph.validation.runs import to_failure
from lasersph.validation.verdict import Row, at_most, judged, shown

TITLE = "Decaying vortices: decay and order of convergence, with and without particle shifting"
SOURCE = "exact; Taylor & Green 1937"
COUNTS = (25, 50, 100)
QUICK_COUNTS = (16, 32)
ENERGY_TOLERANCE = {False: 0.02, True: 0.1}
"""Of the rate at which the kinetic energy decays, by `quick`."""
VELOCITY_TOLERANCE = {False: 0.03, True: 0.1}
"""Of the largest exact speed of that time, by `quick`."""
CONVERGED = {False: 0.5, True: 0.8}
"""Error with most over that with fewest particles, by `quick`."""


@dataclass(frozen=True)
class Decay:
    """What one run says.

    Attributes:
        one: the run. count: particles a side. failure: why it ended early, or "".
        rate: fitted rate of the kinetic energy over the exact one [1].
        times: of the snapshots [s]. errors: of the velocities at these times [1].
    """

    one: Run
    count: int
    failure: str
    rate: float
    times: np.ndarray
    errors: np.ndarray


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """Three spacings with and without shifting; `quick`: 16 and 32 a side, a third of the time."""
    counts = QUICK_COUNTS if quick else COUNTS
    shifted = {n: decay(out_dir, n, quick=quick) for n in counts}
    plain = {n: decay(out_dir, n, shifting=False, quick=quick) for n in counts}
    vortices = vortices_of(load_case("taylor-green"))
    rows = shifted_rows(shifted, quick=quick) + plain_rows(plain)
    figures = (draw(out_dir, vortices, shifted, plain),)
    remarks = (f"Re = {vortices.reynolds_number:.4g}, speeds fall by 1/e in "
               f"{1.0 / vortices.decay_rate:.4g} s",)  # fmt: skip
    remarks += tuple(
        f"without shifting, {n} a side: ended early at {found.times[-1]:.4g} s: {found.failure}"
        for n, found in plain.items()
        if found.failure
    )
    return Report("taylor-green", TITLE, tuple(rows), figures, remarks, quick)


def vortices_of(case: Case) -> TaylorGreen:
    """The exact solution of the case."""
    start = case.flow.initial if case.flow is not None else None
    if start is None or start.kind != "taylor-green" or case.domain.width is None:
        raise ValueError(f"{case.name} does not start from Taylor-Green vortices")
    temperature = case.initial_temperature
    return TaylorGreen(
        speed=start.speed,
        period=start.period or case.domain.width,
        viscosity=float(case.material.kinematic_viscosity_at(temperature)),
        density=case.material.density_reference,
    )


def decay(out_dir: Path, count: int, *, shifting: bool = True, quick: bool = False) -> Decay:
    """Run with `count` particles a side, compared."""
    case = load_case("taylor-green")
    vortices = vortices_of(case)
    overrides = [f"particles.spacing={(case.domain.width or 0.0) / count!r} m"]
    if not shifting:
        overrides.append("solver.shifting=0")
    if quick:
        overrides.append(f"time.end={case.time.end / 3.0!r} s")
    label = f"{count}{'' if shifting else '-without-shifting'}"
    one, failure = to_failure("taylor-green", overrides, out_dir, label)
    steps = [step for step in one.snapshots if "velocity" in step]
    times = np.array([step["time"] for step in steps])
    errors = [velocity_error(step, vortices) for step in steps]
    return Decay(one, count, failure, energy_rate(one, vortices), times, np.array(errors))


def velocity_error(step: dict, vortices: TaylorGreen) -> float:
    """Root of the mean square of |v - exact| over the largest exact speed of that time."""
    time = float(step["time"])
    exact = vortices.velocity(step["position"], time)
    square = np.mean(np.sum((step["velocity"] - exact) ** 2, axis=0))
    return float(np.sqrt(square)) / (vortices.speed * np.exp(-vortices.decay_rate * time))


def energy_rate(one: Run, vortices: TaylorGreen) -> float:
    """Slope of the logarithm of the kinetic energy over time, over the exact -4 nu k^2 [1]."""
    time, energy = one.history["time_s"], one.history["flow_kinetic_energy_J"]
    is_moving = energy > 0.0
    if np.count_nonzero(is_moving) < 3:
        return float("nan")
    slope = np.polyfit(time[is_moving], np.log(energy[is_moving]), 1)[0]
    return float(-slope / (2.0 * vortices.decay_rate))


def order(found: dict[int, Decay]) -> float:
    """Order by which the final error falls with the spacing, fitted over the runs."""
    counts = np.array(list(found), float)
    errors = np.array([one.errors[-1] for one in found.values()])
    return float(-np.polyfit(np.log(counts), np.log(errors), 1)[0])


def shifted_rows(found: dict[int, Decay], *, quick: bool) -> list[Row]:
    """Runs with shifting: the finest judged, and that the error falls."""
    rows: list[Row] = []
    counts = list(found)
    for n, one in found.items():
        name = f"{n} a side: error of velocities at the end, over the largest speed"
        percent = 100.0 * one.errors[-1]
        if n == counts[-1]:
            rows += [
                judged(f"{n} a side: rate of decay of the energy over the exact one", "1",
                       one.rate, 1.0, ENERGY_TOLERANCE[quick], source=SOURCE),
                at_most(name, "%", percent, 100.0 * VELOCITY_TOLERANCE[quick], source=SOURCE),
            ]  # fmt: skip
        else:
            rows += [
                shown(f"{n} a side: rate of decay of the energy over the exact one", "1",
                      one.rate, reference=1.0, source=SOURCE),
                shown(name, "%", percent, source=SOURCE),
            ]  # fmt: skip
    ratio = found[counts[-1]].errors[-1] / found[counts[0]].errors[-1]
    rows.append(at_most(f"error, {counts[-1]} over {counts[0]} a side", "1", ratio,
                        CONVERGED[quick], source="converges"))  # fmt: skip
    rows.append(shown("order of convergence of the velocities", "1", order(found)))
    return rows


def plain_rows(found: dict[int, Decay]) -> list[Row]:
    """Runs without shifting: shown, with the time that they reach."""
    rows = []
    for n, one in found.items():
        end = one.one.case["time"]["end"]
        least = np.min(one.one.history["flow_spacing_min_m"])
        spacing = one.one.case["domain"]["width"] / n
        rows += [
            shown(f"{n} a side, without shifting: time reached over the end", "1",
                  float(one.one.history["time_s"][-1]) / end, reference=1.0),
            shown(f"{n} a side, without shifting: error of velocities there", "%",
                  100.0 * one.errors[-1], source=SOURCE),
            shown(f"{n} a side, without shifting: rate of decay over the exact one", "1",
                  one.rate, reference=1.0, source=SOURCE),
            shown(f"{n} a side, without shifting: least distance over the spacing", "1",
                  float(least) / spacing),
        ]  # fmt: skip
    return rows


def draw(
    out_dir: Path, vortices: TaylorGreen, shifted: dict[int, Decay], plain: dict[int, Decay]
) -> Path:
    """(a) kinetic energy, (b) error of the velocities over time."""
    figure, axes = style.new_figure(1, 2, height=3.6)
    longest = 0.0
    for number, (found, line) in enumerate(((shifted, "-"), (plain, ":"))):
        for k, (n, one) in enumerate(found.items()):
            history = one.one.history
            energy = history["flow_kinetic_energy_J"]
            word = f"{n} a side" + (", no shifting" if number else "")
            longest = max(longest, float(history["time_s"][-1]))
            axes[0].semilogy(history["time_s"], energy / energy[0], line, color=style.COLORS[k],
                             label=word)  # fmt: skip
            axes[1].semilogy(one.times, 100.0 * one.errors, line, color=style.COLORS[k])
    time = np.linspace(0.0, longest, 50)
    exact = vortices.kinetic_energy(time) / vortices.kinetic_energy(0.0)
    axes[0].semilogy(time, exact, "--", color=style.GRAY, label="exact")
    style.label(axes[0], "time [s]", "kinetic energy / initial [1]", title="(a)")
    style.label(axes[1], "time [s]", "error of velocities [% of largest]", title="(b)")
    # A run that bursts leaves the picture: the others are to be told apart.
    axes[0].set_ylim(0.1 * exact[-1], 2.0)
    axes[1].set_ylim(0.1, 100.0)
    style.legend(axes[0])
    return style.save(figure, out_dir / "taylor-green.png")
