"""Heat through the walls of a cube that is warm on one side, and the speeds in it."""

from __future__ import annotations

import numpy as np

from lasersph.validation.drawing import Panel, exact, marks
from lasersph.validation.natural_convection.rows import diffusivity
from lasersph.validation.study import Study
from lasersph.validation.tables import quantities_at

EXTREMA = ("u_max", "w_max")


def compare(study: Study) -> None:
    """Judge the finest run at each Rayleigh number."""
    plan, panels = study.plan, []
    for rayleigh, end in zip(plan.rayleigh, plan.ends, strict=True):
        expected = quantities_at(study.table(), "Ra", rayleigh)
        # viscosity sqrt(Pr/Ra) and diffusivity 1/sqrt(Pr Ra), g beta dT width^3 being 1
        nu, a = np.sqrt(plan.prandtl / rayleigh), diffusivity(rayleigh, plan.prandtl)
        curves = []
        for number, count in enumerate(plan.particles):
            one = study.run(
                f"convection-{rayleigh:.0e}-{count}",
                *plan.settings,
                f"particles.spacing={1.0 / count!r} m",
                f"material.kinematic_viscosity={nu:.8g} m^2/s",
                f"material.conductivity={a:.8g} W/(m K)",
                f"time.end={end!r} s",
            )
            box = one.summary["box"]
            words = {
                "Ra": f"{rayleigh:.0e}",
                "count": count,
                "judge": count == plan.particles[-1],
            }
            warm, cold = (box["heat"][f"nusselt_{side}"] for side in ("left", "right"))
            study.add("nusselt", warm, expected["Nu_wall"], **words)
            for name in EXTREMA:
                value = box["center"][f"{name}_m_s"] / a
                study.add("speed", value, expected[name], name=name, **words)
            study.add("balance", abs(cold / warm - 1.0), **words)
            # the first steps heat rows beside the walls
            history = one.history
            late = history["time_s"] > 0.1 * end
            label = f"{count} a side"
            time, values = history["time_s"][late], history["box_nusselt_left"][late]
            curves.append(marks(time, values, label, number, markersize=2))
        curves.append(exact([0.1 * end, end], 2 * [expected["Nu_wall"]], "finite volumes"))
        panels.append(Panel("time [s]", "Nusselt number [1]", curves, f"Ra {rayleigh:.0e}"))
    study.draw("heated-cube", *panels, height=3.4)
