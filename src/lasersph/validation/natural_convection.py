"""Natural convection between a warm and a cold wall: heat transfer and velocities.

The case `natural-convection` at Rayleigh numbers 1e3, 1e4 and 1e5 with Pr = 0.71, run to a steady
state. Velocities are in units of a / width. Reference: de Vahl Davis (1983), believed accurate to
0.1 % at 1e3 and 1 % at 1e6.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lasersph.case import load_case
from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.references import read_table
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, at_most, judged, shown

TITLE = "Natural convection in a square box: heat transfer and velocities, Ra 1e3, 1e4, 1e5"
SOURCE = "de Vahl Davis 1983"
PRANDTL = 0.71
PLAN = {1e3: (40, 80), 1e4: (40, 80), 1e5: (80,)}
"""Particles a side by Rayleigh number; the last is judged."""
QUICK = {1e4: (24,)}
TOLERANCES = {"Nu_0": 0.02, "u_max": 0.02, "w_max": 0.02, "psi": 0.02}
"""In parts of the reference; `quick` allows three times as much."""
BALANCE = 0.01
"""Of the heat that leaves through the cold wall against what enters through the warm one."""


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """Three Rayleigh numbers; `quick`: 1e4 with 24 particles a side."""
    rows: list[Row] = []
    runs: dict[tuple[float, int], Run] = {}
    for rayleigh, counts in (QUICK if quick else PLAN).items():
        for count in counts:
            one = box(out_dir, rayleigh, count)
            runs[rayleigh, count] = one
            rows += compared(rayleigh, count, one, is_judged=count == counts[-1], quick=quick)
    figures = (draw(out_dir, runs),)
    return Report("natural-convection", TITLE, tuple(rows), figures, (), quick)


def box(out_dir: Path, rayleigh: float, count: int) -> Run:
    """Steady run at a Rayleigh number with `count` particles a side."""
    case = load_case("natural-convection")
    width = case.domain.width or 1.0
    settings = [
        f"particles.spacing={width / count!r} m",
        f"material.kinematic_viscosity={np.sqrt(PRANDTL / rayleigh):.8g} m^2/s",
        f"material.conductivity={diffusivity(rayleigh):.8g} W/(m K)",
    ]
    return computed("natural-convection", settings, out_dir, f"ra{rayleigh:.0e}-{count}")


def numbers(one: Run, a: float) -> dict[str, float]:
    """Nusselt numbers of the walls, velocities over a / width, and where they are largest.

    a: thermal diffusivity [m^2/s].
    """
    found: dict[str, Any] = one.summary["box"]
    width, heat, center = found["width_m"], found["heat"], found["center"]
    domain = one.case["domain"]
    bottom, left = -domain["depth"], -0.5 * domain["width"]
    psi = found["stream_function"]
    return {
        "Nu_0": heat["nusselt_left"],
        "Nu_1": heat["nusselt_right"],
        "u_max": center["u_max_m_s"] * width / a,
        "z": (center["u_max_at_z_m"] - bottom) / width,
        "w_max": center["w_max_m_s"] * width / a,
        "x": (center["w_max_at_x_m"] - left) / width,
        "psi": max(abs(psi["max_m2_s"]), abs(psi["min_m2_s"])) / a,
    }


def diffusivity(rayleigh: float) -> float:
    """a = k / (rho c) of the case at a Rayleigh number, g beta dT width^3 being 1 [m^2/s]."""
    return float(1.0 / np.sqrt(PRANDTL * rayleigh))


def compared(rayleigh: float, count: int, one: Run, *, is_judged: bool, quick: bool) -> list[Row]:
    """Rows of one run."""
    table = read_table("de_vahl_davis_1983.csv")
    k = int(np.flatnonzero(table["Ra"] == rayleigh)[0])
    exact = {name: float(table[name][k]) for name in ("Nu_0", "u_max", "z", "w_max", "x")}
    largest = float(table["psi_max"][k])
    exact["psi"] = largest if np.isfinite(largest) else float(table["psi_mid"][k])
    found = numbers(one, diffusivity(rayleigh))
    label = f"Ra {rayleigh:.0e}, {count} a side"
    words = {
        "Nu_0": "Nusselt number of the warm wall",
        "u_max": "largest u on the vertical center line over a/width",
        "w_max": "largest w on the horizontal center line over a/width",
        "psi": "largest stream function over a",
        "z": "height of the largest u over width",
        "x": "place of the largest w over width",
    }
    rows: list[Row] = []
    for name, text in words.items():
        value, expected = found[name], exact[name]
        if is_judged and name in TOLERANCES:
            tolerance = (3.0 if quick else 1.0) * TOLERANCES[name] * expected
            rows.append(judged(f"{label}: {text}", "1", value, expected, tolerance,
                               published=expected, source=SOURCE))  # fmt: skip
        else:
            rows.append(shown(f"{label}: {text}", "1", value, published=expected, source=SOURCE))
    if is_judged:
        balance = abs(found["Nu_1"] / found["Nu_0"] - 1.0)
        allowed = (3.0 if quick else 1.0) * BALANCE
        rows.append(at_most(f"{label}: heat of the cold wall against the warm one", "1", balance,
                            allowed, source="steady state"))  # fmt: skip
    return rows


def draw(out_dir: Path, runs: dict[tuple[float, int], Run]) -> Path:
    """(a) u on the vertical, (b) w on the horizontal center line."""
    figure, axes = style.new_figure(1, 2, height=3.6)
    for color, ((rayleigh, count), one) in zip(style.COLORS, runs.items(), strict=False):
        lines, a = one.summary["box"]["lines"], diffusivity(rayleigh)
        label = f"Ra {rayleigh:.0e}, {count} a side"
        width = one.summary["box"]["width_m"]
        u, w = (np.array(lines[name]) * width / a for name in ("u_m_s", "w_m_s"))
        axes[0].plot(u, np.array(lines["z_m"]) / width, color=color, label=label)
        axes[1].plot(np.array(lines["x_m"]) / width, w, color=color)
    style.label(axes[0], "u width / a [1]", "z / width [1]", title="(a)")
    style.label(axes[1], "x / width [1]", "w width / a [1]", title="(b)")
    style.legend(axes[0])
    return style.save(figure, out_dir / "natural-convection.png")
