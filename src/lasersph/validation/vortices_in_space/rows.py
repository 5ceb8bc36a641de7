"""Energy of vortices in three dimensions that decay, beside a pseudo-spectral run."""

from __future__ import annotations

import numpy as np

from lasersph.output import Run
from lasersph.validation.drawing import Panel, exact, marks
from lasersph.validation.study import Study

SIDES = ("left", "right", "front", "back", "bottom", "surface")


def compare(study: Study) -> None:
    """Judge the finest run at each Reynolds number, which is 1/nu."""
    plan, table, panels = study.plan, study.table(), []
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
    study.draw("vortices-in-space", *panels, height=3.4)


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
        *("solver.frame=lagrangian", f"solver.shifting={shifting}", f"time.end={end!r} s"),
        "particles.support_ratio=3.1",
        f"output.snapshots.interval={end!r} s",
    )


def energy_share(one: Run, time: float) -> float:
    """Kinetic energy at a time [s] over U^2/8 of the mass, that of the start."""
    history = one.history
    energy = np.interp(time, history["time_s"], history["flow_kinetic_energy_J"])
    # half of a period along z, all of it along x and y
    return float(energy / (0.125 * 0.5 * (2.0 * np.pi) ** 3))
