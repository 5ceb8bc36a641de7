"""Width of a spot on aluminum while it grows, absorbed power as measured."""

from __future__ import annotations

import numpy as np

from lasersph.output import Run
from lasersph.validation.drawing import Panel, line, marks
from lasersph.validation.study import Study

CONDUCTIVITY = (
    "material.conductivity={{ solid = {{ value = '{solid} W/(m K)' }}, "
    "liquid = {{ table = [['911 K', '93 W/(m K)'], ['1473 K', '112 W/(m K)']] }} }}"
)
"""Of the solid alloy, and of liquid aluminum."""
ALLOY = CONDUCTIVITY.format(solid=123)
VARIANTS = {
    "same": ("the same inputs", ()),
    "heat": ("heat alone, no flow", ("solver.kind=conduction",)),
    "conductivity": (
        "solid that conducts 200 W/(m K), as pure aluminum",
        (CONDUCTIVITY.format(solid=200),),
    ),
    "power": ("10 % more absorbed", ("laser.power=131.7 W",)),
    "spot": (
        "spot 2.5 % smaller",
        ("laser.beam={ kind = 'gaussian', radius_1e2 = '59.7 um' }",),
    ),
}
"""Name of an input that differs, and the settings that make it so."""


def compare(study: Study) -> None:
    """Judge the widths before the keyhole; show the later ones, and what other inputs change."""
    table, plan = study.table(), study.plan
    times = [float(t) for t in table["time_us"] if t < plan.end_us]
    one = grown(study, "alloy", plan.spacing_um)
    for time, measured in zip(times, table["width_um"], strict=False):
        judged = time in plan.judged_us
        study.add("width", width_after(one, time), measured, judge=judged, time=f"{time:g}")
    # other inputs, beside the same ones at their spacing
    for name in plan.variants:
        title, settings = VARIANTS[name]
        other = grown(study, name, plan.variant_spacing_um, *settings)
        title = f"{plan.variant_spacing_um} um, {title}"
        for time in plan.judged_us:
            width = width_after(other, time)
            study.add("variant", width, judge=False, variant=title, time=f"{time:g}")
    # width over time, with what was measured
    curves = [line(1e6 * one.history["time_s"], widths(one), "computed", 0)]
    curves.append(marks(table["time_us"], table["width_um"], "measured", 1))
    study.draw("spot-growth", Panel("time [µs]", "width of the pool [µm]", curves))


def grown(study: Study, label: str, spacing: float, *settings: str) -> Run:
    """A run with some particles, of the alloy but for what settings change."""
    plan = study.plan
    size = (f"particles.spacing={spacing} um", f"time.end={plan.end_us} us")
    return study.run(f"{label}-{spacing}um", *plan.settings, ALLOY, *size, *settings)


def widths(one: Run) -> np.ndarray:
    """Width of what is half molten at each step [um]."""
    return 1e6 * np.asarray(one.history["melt_width_half_m"])


def width_after(one: Run, time: float) -> float:
    """The same at a time [us]."""
    return float(np.interp(time, 1e6 * np.asarray(one.history["time_s"]), widths(one)))
