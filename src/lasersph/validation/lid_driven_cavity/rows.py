"""Center lines of the cavity under a moving lid beside finite differences and Ghia's table."""

from __future__ import annotations

import numpy as np

from lasersph.observers.box_sections import Box, center_lines
from lasersph.output import Run
from lasersph.validation.drawing import Curve, Panel, exact, marks
from lasersph.validation.lid_driven_cavity.center_lines import CenterLine, center_line
from lasersph.validation.study import Study

Lines = dict[str, np.ndarray]
SNAPSHOTS = 20
"""Over which lines are averaged."""


def compare(study: Study) -> None:
    """Judge the finest run of every Reynolds number, and convergence."""
    counts = study.plan.particles
    for reynolds in study.plan.reynolds:
        # References, runs and their center lines.
        reference = {component: center_line(component, reynolds) for component in "uv"}
        runs = {n: study.run(f"re{reynolds}-{n}", *settings(study, reynolds, n)) for n in counts}
        first = study.plan.ends[str(reynolds)] - study.plan.averaged
        lines = {n: lines_of(one, reference, first) for n, one in runs.items()}
        # Each line has its rows; the vortex is that of the finest run.
        for line in reference.values():
            add_rows(
                study, reynolds, line, {n: found[line.component] for n, found in lines.items()}
            )
        add_vortex(study, reynolds, runs[counts[-1]])
        add_moving(study, reynolds, reference, first)
        draw(study, reynolds, reference, lines)
        # Misprints of the table are named.
        for line in reference.values():
            if line.is_misprint.any():
                study.remarks.append(misprint_remark(reynolds, line))


def settings(study: Study, reynolds: int, count: int) -> list[str]:
    """Overrides of the case for a Reynolds number and a number of particles a side."""
    case = study.case()
    assert case.domain.width is not None and case.flow is not None
    speed, width = case.flow.surface.velocity, case.domain.width
    # Steps to average over, where there are any.
    averaged = study.plan.averaged * width / speed
    stored = [f"output.snapshots.interval={averaged / SNAPSHOTS!r} s"] if averaged else []
    # The material has the viscosity that the Reynolds number asks for.
    return [
        *stored,
        f"particles.spacing={width / count!r} m",
        f"material.kinematic_viscosity={speed * width / reynolds!r} m^2/s",
        f"time.end={study.plan.ends[str(reynolds)] * width / speed!r} s",
    ]


def lines_of(one: Run, reference: dict[str, CenterLine], first: float) -> Lines:
    """u and w over the speed of the lid at the tabulated places, by component "u", "v".

    Means of the snapshots from the time `first` [width / speed of the lid] to the end.
    """
    start, lid = one.snapshots[0], one.case["solver"]["flow"]["surface"]["velocity"]
    box = Box.around(start["position"], start["width"])
    # The end, and what lies within the time that is averaged over.
    begun = first * one.case["domain"]["width"] / lid
    times = one.snapshots.times
    steps = [one.snapshots[k] for k in range(len(times)) if times[k] > begun or k == len(times) - 1]
    # u on the vertical line, w on the horizontal one, over the speed of the lid.
    found: Lines = {}
    for component, line in reference.items():
        lines = [center_lines(s["position"], s["velocity"], box, line.share) for s in steps]
        values = [one.u if component == "u" else one.w for one in lines]
        found[component] = np.mean(values, axis=0) / lid
    return found


def deviation(line: CenterLine, values: np.ndarray) -> float:
    """Root of the mean square deviation between the walls, over the speed of the lid."""
    return float(np.sqrt(np.mean((values - line.value)[line.inner] ** 2)))


def add_rows(study: Study, reynolds: int, line: CenterLine, found: dict[int, np.ndarray]) -> None:
    """Deviations of one component by particles a side, the finest judged, and their ratio."""
    names = {"Re": reynolds, "component": line.component}
    # Deviations by number of particles; only the finest is judged.
    errors = {n: deviation(line, values) for n, values in found.items()}
    coarse, fine = min(found), max(found)
    for n, error in errors.items():
        study.add(f"deviation_{reynolds}", 100.0 * error, judge=n == fine, count=n, **names)
    study.add("convergence", errors[fine] / errors[coarse], fine=fine, coarse=coarse, **names)
    # The printed table against finite differences, without its misprints.
    good = line.inner & ~line.is_misprint
    printed = np.sqrt(np.mean((line.ghia - line.value)[good] ** 2))
    study.add("printed", 100.0 * printed, **names)


def add_moving(study: Study, reynolds: int, reference: dict[str, CenterLine], first: float) -> None:
    """The same of particles that move with the liquid, as those of a pool do."""
    for n in study.plan.moving:
        moving = ("solver.frame=lagrangian", "solver.shifting=0.01", "particles.support_ratio=3.1")
        one = study.run(f"re{reynolds}-{n}-moving", *settings(study, reynolds, n), *moving)
        for component, values in lines_of(one, reference, first).items():
            error = 100.0 * deviation(reference[component], values)
            study.add("moving", error, count=n, Re=reynolds, component=component)


def add_vortex(study: Study, reynolds: int, one: Run) -> None:
    """The stream function in the main vortex, and the least distance of two particles."""
    summary, printed = one.summary, study.plan.vortex[str(reynolds)]
    lid = one.case["solver"]["flow"]["surface"]["velocity"] * one.case["domain"]["width"]
    psi = summary["box"]["stream_function"]["min_m2_s"] / lid
    study.add("vortex", psi, printed, published=printed, Re=reynolds)
    study.add("spacing", summary["flow"]["spacing_min_m"] / summary["spacing_m"], Re=reynolds)


def misprint_remark(reynolds: int, line: CenterLine) -> str:
    """Which printed numbers stand out, and what they should be."""
    name, wrong = "y" if line.component == "u" else "x", line.is_misprint
    rows = zip(line.share[wrong], line.ghia[wrong], line.value[wrong], strict=True)
    places = " and ".join(
        f"{name} = {s:.4f} ({g:.5f}; finite differences {v:.5f})" for s, g, v in rows
    )
    return f"misprint in Ghia's table of {line.component} at Re {reynolds}: {places}"


def draw(
    study: Study, reynolds: int, reference: dict[str, CenterLine], lines: dict[int, Lines]
) -> None:
    """(a) u on the vertical, (b) w on the horizontal center line."""
    u, w = reference["u"], reference["v"]
    panels = [
        Panel("u / lid [1]", "height / side [1]", curves(u, lines), f"(a) Re {reynolds}"),
        Panel("x / side [1]", "w / lid [1]", curves(w, lines), "(b)"),
    ]
    study.draw(f"cavity-re{reynolds}", *panels, height=3.6)


def curves(line: CenterLine, lines: dict[int, Lines]) -> list[Curve]:
    """Finite differences, the printed table and runs; u over the height, w over x."""

    def place(values: np.ndarray, share: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return (values, share) if line.component == "u" else (share, values)

    # Printed numbers, misprints apart, and each run.
    good, wrong = ~line.is_misprint, line.is_misprint
    printed = marks(*place(line.ghia[good], line.share[good]), "Ghia 1982", color="k", marker="+")
    drawn = [exact(*place(line.value, line.share), "finite differences"), printed]
    if wrong.any():
        options = {"color": "k", "marker": "x", "markersize": 8}
        drawn.append(marks(*place(line.ghia[wrong], line.share[wrong]), "misprint", **options))
    for k, (count, found) in enumerate(lines.items()):
        values = found[line.component]
        drawn.append(marks(*place(values, line.share), f"SPH, {count} a side", k))
    return drawn
