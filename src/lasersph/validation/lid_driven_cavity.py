"""Lid-driven cavity: center lines within 2 % of the lid's speed, and converging.

The case `lid-driven-cavity` at Reynolds numbers 100, 400 and 1000 with 25, 50 and 100 particles a
side, run to a steady state from rest. u on the vertical and w on the horizontal center line of the
last snapshot against our finite differences; Ghia, Ghia & Shin (1982) drawn beside, their misprints
marked. The tolerance is the root of the mean square over the tabulated points between the walls.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lasersph.case import load_case
from lasersph.observers.box_sections import Box, center_lines
from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.lid_driven_cavity_reference import (
    REYNOLDS_NUMBERS,
    CenterLine,
    center_line,
)
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, at_most, judged, shown

TITLE = "Cavity under a moving lid: center lines against finite differences, Re 100, 400, 1000"
SOURCE = "own finite differences, 128 and 256 cells, extrapolated"
GHIA = "Ghia, Ghia & Shin 1982"
COUNTS = (25, 50, 100)
"""Particles a side."""
QUICK = {100: (16, 32)}
ENDS = {100: 15.0, 400: 35.0, 1000: 50.0}
"""Times by Reynolds number, over width / speed of the lid, at which the flow is steady."""
TOLERANCE = 0.02
QUICK_TOLERANCE = 0.03
CONVERGED = 0.5
"""Error with most over that with fewest particles; 0.25 would be first order."""
VORTEX = {100: -0.103423, 400: -0.113909, 1000: -0.117929}
"""Stream function in the main vortex over the lid's speed and the side [Ghia1982, Table III]."""
VORTEX_SHARE = 2.5
"""Its tolerance, in parts of itself, over that of the velocities."""
COMPONENTS = ("u", "v")
Lines = dict[str, np.ndarray]


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """Three Reynolds numbers and three spacings; `quick`: Re 100 with 16 and 32 particles."""
    plan = QUICK if quick else dict.fromkeys(REYNOLDS_NUMBERS, COUNTS)
    rows: list[Row] = []
    figures: list[Path] = []
    remarks: list[str] = []
    for reynolds, counts in plan.items():
        reference = {c: center_line(c, reynolds) for c in COMPONENTS}
        runs = {n: cavity(out_dir, reynolds, n) for n in counts}
        lines = {n: lines_of(one, reference) for n, one in runs.items()}
        tolerance = QUICK_TOLERANCE if quick else TOLERANCE
        rows += error_rows(reynolds, reference, lines, tolerance)
        rows += vortex_rows(reynolds, runs[counts[-1]], tolerance)
        figures.append(draw(out_dir, reynolds, reference, lines))
        remarks += [misprint_remark(reynolds, line) for line in reference.values()
                    if line.is_misprint.any()]  # fmt: skip
    return Report("lid-driven-cavity", TITLE, tuple(rows), tuple(figures), tuple(remarks), quick)


def settings(reynolds: int, count: int) -> list[str]:
    """Overrides of the case for a Reynolds number and a number of particles a side."""
    case = load_case("lid-driven-cavity")
    if case.domain.width is None or case.flow is None:
        raise ValueError("the case lid-driven-cavity has no box")
    speed, width = case.flow.surface.velocity, case.domain.width
    return [
        f"particles.spacing={width / count!r} m",
        f"material.kinematic_viscosity={speed * width / reynolds!r} m^2/s",
        f"time.end={ENDS[reynolds] * width / speed!r} s",
    ]


def cavity(out_dir: Path, reynolds: int, count: int) -> Run:
    """Steady run at a Reynolds number with `count` particles a side."""
    label = f"re{reynolds:g}-{count}"
    return computed("lid-driven-cavity", settings(reynolds, count), out_dir, label)


def lines_of(one: Run, reference: dict[str, CenterLine]) -> Lines:
    """u and w over the speed of the lid at the tabulated places, by component "u", "v"."""
    first, last = one.snapshots[0], one.snapshots[-1]
    box = Box.around(first["position"], first["width"])
    lid = one.case["flow"]["surface"]["velocity"]
    found: Lines = {}
    for component, line in reference.items():
        lines = center_lines(last["position"], last["velocity"], box, line.share)
        found[component] = (lines.u if component == "u" else lines.w) / lid
    return found


def deviation(line: CenterLine, values: np.ndarray) -> float:
    """Root of the mean square deviation between the walls, over the speed of the lid."""
    return float(np.sqrt(np.mean((values - line.value)[line.inner] ** 2)))


def error_rows(
    reynolds: float,
    reference: dict[str, CenterLine],
    lines: dict[int, Lines],
    tolerance: float,
) -> list[Row]:
    """Deviations at every spacing, the finest judged, and their ratio."""
    rows = []
    counts = list(lines)
    for component, line in reference.items():
        errors = {n: deviation(line, found[component]) for n, found in lines.items()}
        for n in counts:
            name = f"Re {reynolds}: {component} on its center line, {n} a side, RMS deviation"
            if n == counts[-1]:
                rows.append(at_most(name, "% of lid", 100.0 * errors[n], 100.0 * tolerance,
                                    source=SOURCE))  # fmt: skip
            else:
                rows.append(shown(name, "% of lid", 100.0 * errors[n], source=SOURCE))
        rows.append(
            at_most(f"Re {reynolds}: {component}, deviation {counts[-1]} over {counts[0]} a side",
                    "1", errors[counts[-1]] / errors[counts[0]], CONVERGED, source="converges")
        )  # fmt: skip
        ghia = np.sqrt(np.mean(((line.ghia - line.value) ** 2)[line.inner & ~line.is_misprint]))
        rows.append(shown(f"Re {reynolds}: {component}, RMS deviation of the printed table",
                          "% of lid", 100.0 * float(ghia), source=GHIA))  # fmt: skip
    return rows


def vortex_rows(reynolds: int, one: Run, tolerance: float) -> list[Row]:
    """The stream function in the main vortex, and the least distance of two particles."""
    summary = one.summary
    least = summary["flow"]["spacing_min_m"] / summary["spacing_m"]
    lid = one.case["flow"]["surface"]["velocity"] * one.case["domain"]["width"]
    psi = summary["box"]["stream_function"]["min_m2_s"] / lid
    printed = VORTEX[reynolds]
    return [
        judged(f"Re {reynolds}: stream function in the main vortex over lid x side", "1", psi,
               printed, tolerance * abs(printed) * VORTEX_SHARE, published=printed,
               source=f"{GHIA}, Table III"),
        shown(f"Re {reynolds}: least distance of two particles over the spacing", "1", least),
    ]  # fmt: skip


def misprint_remark(reynolds: int, line: CenterLine) -> str:
    """Which printed numbers stand out, and what they should be."""
    places = " and ".join(
        f"{'y' if line.component == 'u' else 'x'} = {s:.4f} ({g:.5f}; finite differences {v:.5f})"
        for s, g, v in zip(line.share[line.is_misprint], line.ghia[line.is_misprint],
                           line.value[line.is_misprint], strict=True)
    )  # fmt: skip
    return f"misprint in Ghia's table of {line.component} at Re {reynolds}: {places}"


def draw(
    out_dir: Path, reynolds: int, reference: dict[str, CenterLine], lines: dict[int, Lines]
) -> Path:
    """(a) u on the vertical, (b) w on the horizontal center line."""
    figure, axes = style.new_figure(1, 2, height=3.6)
    for one, (component, line) in zip(axes, reference.items(), strict=True):
        upright = component == "u"

        def pair(values: np.ndarray, place: np.ndarray, upright: bool = upright):
            return (values, place) if upright else (place, values)

        one.plot(*pair(line.value, line.share), color=style.GRAY, label="finite differences")
        good = ~line.is_misprint
        one.plot(*pair(line.ghia[good], line.share[good]), "k+", markersize=6, label="Ghia 1982")
        if line.is_misprint.any():
            one.plot(*pair(line.ghia[line.is_misprint], line.share[line.is_misprint]), "kx",
                     markersize=8, label="misprint")  # fmt: skip
        for k, (count, found) in enumerate(lines.items()):
            one.plot(*pair(found[component], line.share), "os^"[k], color=style.COLORS[k],
                     markersize=3, label=f"SPH, {count} a side")  # fmt: skip
    style.label(axes[0], "u / lid [1]", "height / side [1]", title=f"(a) Re {reynolds}")
    style.label(axes[1], "x / side [1]", "w / lid [1]", title="(b)")
    style.legend(axes[0])
    style.legend(axes[1])
    return style.save(figure, out_dir / f"cavity-re{reynolds}.png")
