"""Heat transfer and velocities of natural convection in a square box."""

from __future__ import annotations

import numpy as np

from lasersph.output import Run
from lasersph.validation.drawing import Curve, Panel, line
from lasersph.validation.study import Study

COMPARED = ("Nu_0", "u_max", "w_max", "psi", "z", "x")


def compare(study: Study) -> None:
    """Judge the finest run of every Rayleigh number."""
    runs: dict[tuple[float, int], Run] = {}
    for rayleigh, counts in zip(study.plan.rayleigh, study.plan.particles, strict=True):
        for count in counts:
            runs[rayleigh, count] = one = box(study, rayleigh, count)
            add_rows(study, rayleigh, count, one, judge=count == counts[-1])
    draw(study, runs)


def box(study: Study, rayleigh: float, count: int) -> Run:
    """Steady run at a Rayleigh number with `count` particles a side."""
    width, prandtl = study.case().domain.width or 1.0, study.plan.prandtl
    return study.run(
        f"ra{rayleigh:.0e}-{count}",
        f"particles.spacing={width / count!r} m",
        f"material.kinematic_viscosity={np.sqrt(prandtl / rayleigh):.8g} m^2/s",
        f"material.conductivity={diffusivity(rayleigh, prandtl):.8g} W/(m K)",
    )


def diffusivity(rayleigh: float, prandtl: float) -> float:
    """a = k / (rho c) of the case at a Rayleigh number, g beta dT width^3 being 1 [m^2/s]."""
    return float(1.0 / np.sqrt(prandtl * rayleigh))


def add_rows(study: Study, rayleigh: float, count: int, one: Run, *, judge: bool) -> None:
    """Rows of one run beside the line of the table for its Rayleigh number."""
    table = study.table()
    k = int(np.flatnonzero(table["Ra"] == rayleigh)[0])
    published = {name: float(column[k]) for name, column in table.items()}
    largest = published["psi_max"]
    published["psi"] = largest if np.isfinite(largest) else published["psi_mid"]
    found = numbers(one, diffusivity(rayleigh, study.plan.prandtl))
    label = f"Ra {rayleigh:.0e}, {count} a side"
    for name in COMPARED:
        value = published[name]
        reference = value if judge and name in COMPARED[:4] else None
        study.add(name, found[name], reference, published=value, judge=judge, label=label)
    if judge:
        study.add("balance", abs(found["Nu_1"] / found["Nu_0"] - 1.0), label=label)


def numbers(one: Run, a: float) -> dict[str, float]:
    """Nusselt numbers of the walls, velocities over a / width, and where they are largest.

    a: thermal diffusivity [m^2/s].
    """
    found, domain = one.summary["box"], one.case["domain"]
    width, heat, center = found["width_m"], found["heat"], found["center"]
    psi = found["stream_function"]
    return {
        "Nu_0": heat["nusselt_left"],
        "Nu_1": heat["nusselt_right"],
        "u_max": center["u_max_m_s"] * width / a,
        "z": (center["u_max_at_z_m"] + domain["depth"]) / width,
        "w_max": center["w_max_m_s"] * width / a,
        "x": (center["w_max_at_x_m"] + 0.5 * domain["width"]) / width,
        "psi": max(abs(psi["max_m2_s"]), abs(psi["min_m2_s"])) / a,
    }


def draw(study: Study, runs: dict[tuple[float, int], Run]) -> None:
    """(a) u on the vertical, (b) w on the horizontal center line."""
    on_vertical: list[Curve] = []
    on_horizontal: list[Curve] = []
    for k, ((rayleigh, count), one) in enumerate(runs.items()):
        found = one.summary["box"]
        lines, width = {name: np.array(x) for name, x in found["lines"].items()}, found["width_m"]
        unit = diffusivity(rayleigh, study.plan.prandtl) / width
        label = f"Ra {rayleigh:.0e}, {count} a side"
        on_vertical.append(line(lines["u_m_s"] / unit, lines["z_m"] / width, label, k))
        on_horizontal.append(line(lines["x_m"] / width, lines["w_m_s"] / unit, k=k))
    study.draw(
        "natural-convection",
        Panel("u width / a [1]", "z / width [1]", on_vertical, "(a)"),
        Panel("x / width [1]", "w width / a [1]", on_horizontal, "(b)"),
        height=3.6,
    )
