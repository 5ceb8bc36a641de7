"""Heat transfer and velocities of natural convection in a square box."""

from __future__ import annotations

import numpy as np

from lasersph.observers.box_sections import Box, CenterLines, center_lines, extremum
from lasersph.observers.wall_exchange import LAST
from lasersph.output import Run
from lasersph.validation.drawing import Curve, Panel, line
from lasersph.validation.study import Study

JUDGED = ("Nu", "u_max", "w_max", "psi")
SHOWN = ("Nu_0", "z", "x")
POINTS = 201
"""Of a center line; the boundary layer at Ra 1e5 is a twentieth of the width thick."""


def compare(study: Study) -> None:
    """Judge the finest run of every Rayleigh number."""
    runs: dict[tuple[float, int], Run] = {}
    plan = study.plan
    # Some numbers of particles at each Rayleigh number; the finest is judged.
    for rayleigh, counts, end in zip(plan.rayleigh, plan.particles, plan.ends, strict=True):
        for count in counts:
            runs[rayleigh, count] = one = box(study, rayleigh, count, end)
            add_rows(study, rayleigh, count, one, judge=count == counts[-1])
    draw(study, runs)


def box(study: Study, rayleigh: float, count: int, end: float) -> Run:
    """Run to a steady state at a Rayleigh number with `count` particles a side; end [s]."""
    # Viscosity sqrt(Pr/Ra) and diffusivity 1/sqrt(Pr Ra), g beta dT width^3 being 1.
    width, prandtl = study.case().domain.width or 1.0, study.plan.prandtl
    return study.run(
        f"ra{rayleigh:.0e}-{count}",
        f"particles.spacing={width / count!r} m",
        f"material.kinematic_viscosity={np.sqrt(prandtl / rayleigh):.8g} m^2/s",
        f"material.conductivity={diffusivity(rayleigh, prandtl):.8g} W/(m K)",
        f"time.end={end!r} s",
        f"output.snapshots.interval={study.plan.interval!r} s",
    )


def diffusivity(rayleigh: float, prandtl: float) -> float:
    """a = k / (rho c) of the case at a Rayleigh number, g beta dT width^3 being 1 [m^2/s]."""
    return float(1.0 / np.sqrt(prandtl * rayleigh))


def add_rows(study: Study, rayleigh: float, count: int, one: Run, *, judge: bool) -> None:
    """Rows of one run beside the line of the table for its Rayleigh number."""
    # The line of the table; where it has no largest stream function, that of the middle.
    table = study.table()
    k = int(np.flatnonzero(table["Ra"] == rayleigh)[0])
    published = {name: float(column[k]) for name, column in table.items()}
    largest = published["psi_max"]
    published["psi"] = largest if np.isfinite(largest) else published["psi_mid"]
    found = numbers(one, diffusivity(rayleigh, study.plan.prandtl))
    label = f"Ra {rayleigh:.0e}, {count} a side"
    # Numbers of the table, judged or shown.
    for name in (*JUDGED, *SHOWN):
        value = published[name]
        reference = value if judge and name in JUDGED else None
        study.add(name, found[name], reference, published=value, judge=judge, label=label)
    # Heat in and out, and heat that is carried inside.
    if judge:
        study.add("balance", abs(found["Nu_1"] / found["Nu_0"] - 1.0), label=label)
        study.add("carried", abs(found["Nu"] / found["Nu_0"] - 1.0), label=label)


def numbers(one: Run, a: float) -> dict[str, float]:
    """Nusselt numbers of walls and box, and what the mean center lines show, over a / width.

    a: thermal diffusivity [m^2/s].
    """
    found, domain = one.summary["box"], one.case["domain"]
    width = found["width_m"]
    heat = found["heat"]
    psi = found["stream_function"]
    # Extrema of the mean center lines, over a / width.
    lines = mean_lines(one)
    z, u_max = extremum(lines.z, lines.u, 1.0)
    x, w_max = extremum(lines.x, lines.w, 1.0)
    return {
        "Nu": heat["nusselt_mean"],
        "Nu_0": heat["nusselt_left"],
        "Nu_1": heat["nusselt_right"],
        "u_max": u_max * width / a,
        "z": (z + domain["depth"]) / width,
        "w_max": w_max * width / a,
        "x": (x + 0.5 * domain["width"]) / width,
        "psi": max(abs(psi["max_m2_s"]), abs(psi["min_m2_s"])) / a,
    }


def mean_lines(one: Run) -> CenterLines:
    """Mean of the center lines over the snapshots of the last quarter of the time."""
    # Mean over the last quarter of the time, in which the flow is steady.
    first, end = one.snapshots[0], one.summary["time_s"]
    box = Box.around(first["position"], first["width"])
    shares = np.linspace(0.0, 1.0, POINTS)
    chosen = (shot for shot in one.snapshots if shot["time"] >= (1.0 - LAST) * end)
    lines = [center_lines(shot["position"], shot["velocity"], box, shares) for shot in chosen]
    u, w = (np.mean([getattr(line, name) for line in lines], axis=0) for name in "uw")
    return CenterLines(lines[0].z, u, lines[0].x, w)


def draw(study: Study, runs: dict[tuple[float, int], Run]) -> None:
    """(a) u on the vertical, (b) w on the horizontal center line."""
    on_vertical: list[Curve] = []
    on_horizontal: list[Curve] = []
    # Velocities over a / width, places over the width.
    for k, ((rayleigh, count), one) in enumerate(runs.items()):
        lines, width = mean_lines(one), one.summary["box"]["width_m"]
        unit = diffusivity(rayleigh, study.plan.prandtl) / width
        label = f"Ra {rayleigh:.0e}, {count} a side"
        on_vertical.append(line(lines.u / unit, lines.z / width, label, k))
        on_horizontal.append(line(lines.x / width, lines.w / unit, k=k))
    study.draw(
        "natural-convection",
        Panel("u width / a [1]", "z / width [1]", on_vertical, "(a)"),
        Panel("x / width [1]", "w width / a [1]", on_horizontal, "(b)"),
        height=4.1,
        legend=3,
    )
