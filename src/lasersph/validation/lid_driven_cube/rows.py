"""Extrema on the center lines of a cube below a lid, beside finite volumes."""

from __future__ import annotations

from lasersph.validation.drawing import Panel, exact, marks
from lasersph.validation.study import Study
from lasersph.validation.tables import quantities_at

EXTREMA = ("u_min", "w_max", "w_min")


def compare(study: Study) -> None:
    """Judge the finest run at each Reynolds number."""
    plan, panels = study.plan, []
    for reynolds, end in zip(plan.reynolds, plan.ends, strict=True):
        expected = quantities_at(study.table(), "Re", reynolds)
        curves = []
        for number, count in enumerate(plan.particles):
            box = study.run(
                f"lid-{reynolds}-{count}",
                *plan.settings,
                f"particles.spacing={1.0 / count!r} m",
                f"material.kinematic_viscosity={1.0 / reynolds!r} m^2/s",
                f"time.end={end!r} s",
            ).summary["box"]
            words = {"Re": reynolds, "count": count, "judge": count == plan.particles[-1]}
            for name in EXTREMA:
                value = box["center"][f"{name}_m_s"]
                study.add("speed", value, expected[name], name=name, **words)
            lines = box["lines"]
            curves.append(marks(lines["x_m"], lines["w_m_s"], f"{count} a side", number))
        # w along the level line, and where the reference has its extrema; x is 0 in the middle
        places = [expected[f"x_of_{name}"] - 0.5 for name in ("w_max", "w_min")]
        values = [expected[name] for name in ("w_max", "w_min")]
        curves.append(exact(places, values, "extrema", marker="+", markersize=12, linestyle=""))
        panels.append(Panel("x [m]", "w / lid [1]", curves, f"Re {reynolds}"))
    study.draw("lid-driven-cube", *panels, height=3.4)
