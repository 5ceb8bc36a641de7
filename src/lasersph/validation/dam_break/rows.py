"""How far the front of a collapsing column has run, beside the experiments of 1952."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lasersph.output import Run
from lasersph.validation.drawing import Panel, exact, line, marks
from lasersph.validation.study import Study


@dataclass(frozen=True)
class Front:
    """Scaled times T = t sqrt(2 g / a) and distances Z = x / a from the back wall, (k,)."""

    time: np.ndarray
    place: np.ndarray

    def delayed(self, delay: float, time: np.ndarray) -> np.ndarray:
        """Distance at given times, had the column been held for `delay` longer."""
        return np.interp(time - delay, self.time, self.place)


def compare(study: Study) -> None:
    """Judge the front of the finest run; those of coarser ones are shown."""
    # Runs by number of particles in the width of the column.
    width = study.case().domain.width or 0.0
    fronts = {
        n: front_of(study.run(f"{n}", f"particles.spacing={width / n!r} m"))
        for n in study.plan.particles
    }
    # The finest one is judged against the measured front.
    table = study.table()
    measured = Front(table["T"], table["Z"])
    *coarse, finest = fronts
    add_rows(study, fronts[finest], measured)
    for n in coarse:
        found, T = fronts[n].delayed(0.0, measured.time[-1:]), measured.time[-1]
        study.add("coarse_front", found[0], published=float(measured.place[-1]), T=T, count=n)
    draw(study, fronts, measured)


def front_of(one: Run) -> Front:
    """The front over time, from the history; x = 0 is the middle of the column."""
    width, gravity = one.case["domain"]["width"], one.case["solver"]["gravity"]
    # Scaled as the paper does: T = t sqrt(2 g / a), Z = x / a.
    time = one.history["time_s"] * np.sqrt(2.0 * gravity / width)
    return Front(time, one.history["front_m"] / width + 0.5)


def fitted_delay(front: Front, measured: Front) -> float:
    """Delay with the least mean square of the distances' errors."""
    # The gate of the experiment takes time to open: the delay that fits best.
    tried = np.linspace(0.0, 0.6, 301)
    errors = [np.mean((front.delayed(d, measured.time) - measured.place) ** 2) for d in tried]
    return float(tried[int(np.argmin(errors))])


def add_rows(study: Study, front: Front, measured: Front) -> None:
    """Numbers of the finest run."""
    # Distances at the measured times.
    at_once = front.delayed(0.0, measured.time)
    for T, Z, found in zip(measured.time, measured.place, at_once, strict=True):
        study.add("front", found, Z, published=float(Z), T=T)
    # Slope once the front is fast.
    begin = study.plan.fast_from
    late = measured.time >= begin
    wanted, found = (
        np.polyfit(measured.time[late], place[late], 1)[0] for place in (measured.place, at_once)
    )
    study.add("speed", found, wanted, T=begin)
    # Distances with the delay of the gate.
    delay = fitted_delay(front, measured)
    study.add("delay", delay)
    deviation = front.delayed(delay, measured.time) / measured.place - 1.0
    study.add("delayed", 100.0 * np.sqrt(np.mean(deviation**2)))


def draw(study: Study, fronts: dict[int, Front], measured: Front) -> None:
    """Distance over time."""
    curves = [marks(measured.time, measured.place, "Martin & Moyce 1952", color="black")]
    for k, (count, front) in enumerate(fronts.items()):
        seen = front.time <= measured.time[-1] + 0.1
        label = f"{count} particles in the width"
        curves.append(line(front.time[seen], front.place[seen], label, k))
    delay = fitted_delay(front, measured)
    late = front.delayed(delay, measured.time)
    curves.append(exact(measured.time, late, f"finest, {delay:.2f} later", linestyle="--"))
    study.draw("dam-break", Panel("T = t sqrt(2 g / a)", "Z = x / a", curves), height=3.8)
