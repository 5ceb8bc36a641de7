"""Extrema in cubes, heat through their walls, and the energy of vortices that decay."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from lasersph.output import Run
from lasersph.validation.drawing import Panel, exact, marks
from lasersph.validation.natural_convection.rows import diffusivity
from lasersph.validation.study import HOME, Study
from lasersph.validation.tables import read_table

TABLES = HOME / "cubes"
LID = ("u_min", "w_max", "w_min")
HEATED = ("u_max", "w_max")
SIDES = ("left", "right", "front", "back", "bottom", "surface")


def compare(study: Study) -> None:
    """Judge the finest run of each flow."""
    lid, convection, vortices = (
        SimpleNamespace(**getattr(study.plan, name)) for name in ("lid", "convection", "vortices")
    )
    _below_lid(study, lid)
    _between_walls(study, convection)
    study.draw("cubes", *_vortices(study, vortices), height=3.4)


def _below_lid(study: Study, plan: SimpleNamespace) -> None:
    """Extrema on the center lines at each Reynolds number."""
    for reynolds, end in zip(plan.reynolds, plan.ends, strict=True):
        expected = _values("lid", "Re", reynolds)
        for count in plan.particles:
            one = study.run(
                f"lid-{reynolds}-{count}",
                f"particles.spacing={1.0 / count!r} m",
                f"material.kinematic_viscosity={1.0 / reynolds!r} m^2/s",
                f"time.end={end!r} s",
            )
            center, judge = one.summary["box"]["center"], count == plan.particles[-1]
            for name in LID:
                value, words = center[f"{name}_m_s"], {"Re": reynolds, "count": count}
                study.add("lid", value, expected[name], judge=judge, name=name, **words)


def _between_walls(study: Study, plan: SimpleNamespace) -> None:
    """Nusselt numbers and speeds at each Rayleigh number."""
    for rayleigh, end in zip(plan.rayleigh, plan.ends, strict=True):
        expected = _values("convection", "Ra", rayleigh)
        # viscosity sqrt(Pr/Ra) and diffusivity 1/sqrt(Pr Ra), g beta dT width^3 being 1
        a = diffusivity(rayleigh, plan.prandtl)
        for count in plan.particles:
            one = study.run(
                f"convection-{rayleigh:.0e}-{count}",
                f"particles.spacing={1.0 / count!r} m",
                f"material.kinematic_viscosity={np.sqrt(plan.prandtl / rayleigh):.8g} m^2/s",
                f"material.conductivity={a:.8g} W/(m K)",
                f"time.end={end!r} s",
                case=study.plan.heated,
            )
            box, judge = one.summary["box"], count == plan.particles[-1]
            words = {"Ra": f"{rayleigh:.0e}", "count": count}
            warm, cold = (box["heat"][f"nusselt_{side}"] for side in ("left", "right"))
            study.add("nusselt", warm, expected["Nu_wall"], judge=judge, **words)
            for name in HEATED:
                value = box["center"][f"{name}_m_s"] / a
                study.add("speed", value, expected[name], judge=judge, name=name, **words)
            study.add("balance", abs(cold / warm - 1.0), judge=judge, **words)


def _vortices(study: Study, plan: SimpleNamespace) -> list[Panel]:
    """Energy over that of the start at each Reynolds number, which is 1/nu; a panel of each."""
    panels = []
    table = read_table(TABLES / "vortices.csv")
    for reynolds in plan.reynolds:
        own = table["Re"] == reynolds
        curves = [exact(table["t"][own], table["E_over_E0"][own])]
        for number, count in enumerate(plan.particles):
            settings = vortices_of(reynolds, count, plan.shifting, plan.times[-1])
            one = study.run(f"vortices-{reynolds}-{count}", *settings)
            judge = count == plan.particles[-1]
            for t in plan.times:
                words = {"Re": reynolds, "count": count, "t": t}
                expected = float(table["E_over_E0"][own & (table["t"] == t)][0])
                study.add("energy", energy_share(one, t), expected, judge=judge, **words)
            times = np.linspace(0.0, plan.times[-1], 9)
            shares = np.array([energy_share(one, t) for t in times])
            curves.append(marks(times, shares, f"{count} a period", number))
        panels.append(Panel("time [s]", "energy over the first", curves, f"Re {reynolds}"))
    return panels


def vortices_of(reynolds: int, count: int, shifting: float, end: float) -> tuple[str, ...]:
    """Settings of an eighth of a period of 2 pi, whose faces are planes of symmetry, with `count`
    particles a period, up to `end` [s]."""
    side = 2.0 * np.pi
    return (
        *("domain.extent=quarter", f"domain.width={side!r} m", f"domain.breadth={side!r} m"),
        *(f"domain.depth={0.5 * side!r} m", f"particles.spacing={side / count!r} m"),
        *("solver.flow.sides=", *(f"solver.flow.{face}=symmetry" for face in SIDES)),
        *("solver.flow.initial.kind=taylor-green", "solver.flow.initial.speed=1 m/s"),
        *(f"solver.flow.initial.period={side!r} m", "solver.steady="),
        f"material.kinematic_viscosity={1.0 / reynolds!r} m^2/s",
        *(f"solver.shifting={shifting}", f"time.end={end!r} s"),
        f"output.snapshots.interval={end!r} s",
    )


def energy_share(one: Run, time: float) -> float:
    """Kinetic energy at a time [s] over U^2/8 of the mass, that of the start."""
    history = one.history
    energy = np.interp(time, history["time_s"], history["flow_kinetic_energy_J"])
    # half of a period along z, all of it along x and y
    return float(energy / (0.125 * 0.5 * (2.0 * np.pi) ** 3))


def _values(name: str, key: str, number: float) -> dict[str, float]:
    """Quantities of a table at a Reynolds or Rayleigh number."""
    table = read_table(TABLES / f"{name}.csv")
    rows = np.flatnonzero(table[key] == number)
    return {str(table["quantity"][row]): float(table["value"][row]) for row in rows}
