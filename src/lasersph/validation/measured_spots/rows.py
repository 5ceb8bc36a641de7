"""Size of measured weld spots whose absorbed energy was measured, and what moves it."""

from __future__ import annotations

import numpy as np

from lasersph.output import Run
from lasersph.validation.drawing import Panel, line, marks
from lasersph.validation.study import Study

DURATION = 10.0
"""Of the pulses [ms]."""
OF_METAL = "material.surface_tension_slope="
"""Leaves the slope to the metal, iron with its 20 ppm of sulfur."""
MELT = (
    "{ solid = { polynomial = [9.248, 0.01571], scale = '1 W/(m K)' }, "
    "liquid = { value = '30 W/(m K)' } }"
)
VARIANTS = {
    "same": ("the same inputs", ()),
    "heat": ("heat alone, no flow", ("solver.kind=conduction",)),
    "iron": ("slope of pure iron, -0.43 mN/(m K)", (OF_METAL, "material.sulfur=0 %")),
    "sulfur": ("iron with 20 ppm of sulfur", (OF_METAL,)),
    "viscosity": (
        "melt of 5 mPa s instead of 6.1 to 1.6",
        ("material.viscosity=5 mPa s",),
    ),
    "conductivity": (
        "melt that conducts 30 W/(m K) instead of 18 to 20",
        (f"material.conductivity={MELT}",),
    ),
    "gaussian": (
        "Gaussian beam of that 1/e^2 diameter",
        ("laser.beam={ kind = 'gaussian', radius_1e2 = '151.5 um' }",),
    ),
    "moving": ("surface that moves", ("solver.flow.surface=moving",)),
}
"""Name of an input that differs, and the settings that make it so."""


def compare(study: Study) -> None:
    """Judge width, depth and begin of melting; show what other inputs change."""
    table, runs = study.table(), {}
    spacing = study.plan.spacing_um
    # absorbed power: the absorbed energy over the time of the pulse
    for k, energy in enumerate(table["energy_J"]):
        if energy not in study.plan.energies_J:
            continue
        power = 1e3 * table["absorbed_J"][k] / DURATION
        runs[energy] = one = study.run(
            f"{energy}J-{spacing}um",
            f"particles.spacing={spacing} um",
            f"laser.power={power:.6g} W",
        )
        melt = one.summary["melt"]
        study.add("width", 1e6 * melt["width_max_m"], table["width_um"][k], energy=energy)
        study.add("depth", 1e6 * melt["depth_max_m"], table["depth_um"][k], energy=energy)
        study.add("onset", 1e3 * melt["start_any_s"], table["onset_ms"][k], energy=energy)
    # other inputs, beside the same ones at their spacing
    spacing = study.plan.variant_spacing_um
    for name in study.plan.variants:
        title, settings = VARIANTS[name]
        title = f"{spacing} um, {title}"
        one = study.run(name, f"particles.spacing={spacing} um", *settings)
        melt = one.summary["melt"]
        study.add("variant_width", 1e6 * melt["width_max_m"], judge=False, variant=title)
        study.add("variant_depth", 1e6 * melt["depth_max_m"], judge=False, variant=title)
        if "flow" in one.summary:
            study.add("variant_speed", outward(one), judge=False, variant=title)
    draw(study, runs)


def outward(one: Run) -> float:
    """Largest speed of the surface at the end of the pulse, negative inward [m/s]."""
    lit = [step for step in one.snapshots if step["time"] <= 1.001e-3 * DURATION]
    last = lit[-1]
    speeds = last["surface_velocity"][np.flatnonzero(last["surface"])]
    return float(speeds[np.argmax(np.abs(speeds))])


def draw(study: Study, runs: dict[float, Run]) -> None:
    """Width and depth over time, with what was measured at the end of the pulse."""
    table = study.table()
    panels = []
    for column, measured, title in (
        ("melt_width_m", "width_um", "width of the pool [µm]"),
        ("melt_depth_m", "depth_um", "depth of the pool [µm]"),
    ):
        curves = []
        for k, (energy, one) in enumerate(runs.items()):
            time = 1e3 * np.asarray(one.history["time_s"])
            values = 1e6 * np.asarray(one.history[column])
            place = int(np.flatnonzero(table["energy_J"] == energy)[0])
            curves.append(line(time, values, f"{energy} J", k))
            curves.append(marks([DURATION], [table[measured][place]], f"{energy} J, measured", k))
        panels.append(Panel("time [ms]", title, curves))
    study.draw("measured-spots", *panels, height=3.6, legend=4)
