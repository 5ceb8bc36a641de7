"""Collapse of a water column: how far its front has run, against the experiments of 1952.

The case `dam-break`: a column twice as high as wide, as in [Martin1952], Table 2. The front is the
far end of the particle at the largest x. Computations start at once, the experiments with a
membrane that takes time to clear the water, so that their front comes later by a time that is the
same at all places. Judged are the places as measured, with a band that covers this, the speed of
the front, and the places after one delay has been fitted. The experiment states no error; the bands
were set after a first run had shown the delay.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lasersph.case import load_case
from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.references import read_table
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, at_most, judged, shown

TITLE = "Collapse of a water column: its front against experiments"
SOURCE = "Martin & Moyce 1952, Table 2"
PLACE_TOLERANCE = 0.2
DELAYED_TOLERANCE = {False: 0.03, True: 0.05}
"""Of the distance, root of the mean square, by `quick`."""
SPEED_TOLERANCE = {False: 0.1, True: 0.15}
FAST = 1.4
"""Scaled time from which the front's speed is nearly constant."""
PARTICLES = (15, 30)
"""In the width of the column."""


@dataclass(frozen=True)
class Front:
    """Scaled times T = t sqrt(2 g / a) and distances Z = x / a from the back wall, (k,)."""

    time: np.ndarray
    place: np.ndarray

    def delayed(self, delay: float, time: np.ndarray) -> np.ndarray:
        """Distance at given times, had the column been held for `delay` longer."""
        return np.interp(time - delay, self.time, self.place)


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """Two spacings; `quick`: the coarser one."""
    width, gravity = given()
    fronts = {}
    for count in PARTICLES[:1] if quick else PARTICLES:
        overrides = [f"particles.spacing={width / count!r} m"]
        one = computed("dam-break", overrides, out_dir, f"{count}")
        fronts[count] = front_of(one, width, gravity)
    table = read_table("martin_moyce_1952.csv")
    measured = Front(table["T"], table["Z"])
    rows = rows_of(fronts[list(fronts)[-1]], measured, quick=quick)
    for count, front in list(fronts.items())[:-1]:
        rows.append(
            shown(f"front at T = {measured.time[-1]:.2f}, {count} particles in the width", "a",
                  float(front.delayed(0.0, measured.time[-1:])[0]),
                  published=float(measured.place[-1]), source=SOURCE)
        )  # fmt: skip
    figures = (draw(out_dir, fronts, measured),)
    return Report("dam-break", TITLE, tuple(rows), figures, (), quick)


def given() -> tuple[float, float]:
    """Width of the column [m] and gravity [m/s^2] of the case."""
    case = load_case("dam-break")
    if case.domain.width is None or case.solver.kind != "ablation":
        raise ValueError("the case dam-break has no column that moves")
    return case.domain.width, case.solver.gravity


def front_of(one: Run, width: float, gravity: float) -> Front:
    """The front over time, from the history; x = 0 is the middle of the column."""
    time = one.history["time_s"] * np.sqrt(2.0 * gravity / width)
    return Front(time, one.history["front_m"] / width + 0.5)


def fitted_delay(front: Front, measured: Front) -> float:
    """Delay with the least mean square of the distances' errors."""
    tried = np.linspace(0.0, 0.6, 301)
    errors = [np.mean((front.delayed(d, measured.time) - measured.place) ** 2) for d in tried]
    return float(tried[int(np.argmin(errors))])


def rows_of(front: Front, measured: Front, *, quick: bool) -> list[Row]:
    """Numbers of the finest run."""
    at_once = front.delayed(0.0, measured.time)
    rows: list[Row] = [
        judged(f"front at T = {T:.2f}", "a", float(found), float(Z), PLACE_TOLERANCE * float(Z),
               published=float(Z), source=SOURCE)
        for T, Z, found in zip(measured.time, measured.place, at_once, strict=True)
    ]  # fmt: skip
    late = measured.time >= FAST
    speeds = [
        float(np.polyfit(measured.time[late], place[late], 1)[0])
        for place in (measured.place, at_once)
    ]
    delay = fitted_delay(front, measured)
    shifted = front.delayed(delay, measured.time) / measured.place - 1.0
    return [
        *rows,
        judged(f"speed of the front from T = {FAST} on", "sqrt(2 g a)", speeds[1],
               speeds[0], SPEED_TOLERANCE[quick] * speeds[0], source=SOURCE),
        shown("delay of the experiment that fits best", "sqrt(a / 2 g)", delay),
        at_most("root of the mean square deviation of the front with that delay", "%",
                100.0 * float(np.sqrt(np.mean(shifted**2))), 100.0 * DELAYED_TOLERANCE[quick],
                source=SOURCE),
    ]  # fmt: skip


def draw(out_dir: Path, fronts: dict[int, Front], measured: Front) -> Path:
    """Distance over time."""
    figure, axes = style.new_figure(1, 1, height=3.8)
    axes[0].plot(measured.time, measured.place, "ko", markersize=4, label=SOURCE)
    for k, (count, front) in enumerate(fronts.items()):
        is_shown = front.time <= measured.time[-1] + 0.1
        axes[0].plot(front.time[is_shown], front.place[is_shown], color=style.COLORS[k],
                     label=f"{count} particles in the width")  # fmt: skip
    finest = list(fronts.values())[-1]
    delay = fitted_delay(finest, measured)
    axes[0].plot(measured.time, finest.delayed(delay, measured.time), "--", color=style.GRAY,
                 label=f"finest, {delay:.2f} later")  # fmt: skip
    style.label(axes[0], "T = t sqrt(2 g / a)", "Z = x / a")
    style.legend(axes[0])
    return style.save(figure, out_dir / "dam-break.png")
