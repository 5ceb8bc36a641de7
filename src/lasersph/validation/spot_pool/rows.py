"""Size, temperature and flow of the melt pool of a Gaussian spot."""

from __future__ import annotations

import numpy as np

from lasersph.output import Run
from lasersph.validation.drawing import Panel, exact, line
from lasersph.validation.study import Study

PEAK = 20.0
"""Time of the peak of the pulse [ns], from which the table counts."""
COLUMNS = {
    "volume": ("melt_volume_m3", "melt_volume_um3", 1e18),
    "depth": ("melt_depth_half_m", "depth_fm05_nm", 1e9),
    "temperature": ("temperature_max_K", "T_max_K", 1.0),
    "speed": ("flow_surface_speed_max_m_s", "u_max_m_per_s", 1.0),
}
"""Column of the history, of the table, and the factor between them, by row."""
LARGEST = {"volume": 0.7346, "depth": 205.2, "temperature": 3121.1, "speed": 2.182}
"""Largest values of the finite volumes, between the times of the table."""
PLACE, INWARD = 775.0, 0.696
"""Place [nm] of that speed, and the largest speed inward [m/s]."""

RELIEF = {
    "depth of the dimple [nm]": ("topography", "depth_m", 1e9),
    "displaced volume [um^3]": ("topography", "displaced_volume_m3", 1e18),
    "largest volume of melt [um^3]": ("melt", "volume_max_m3", 1e18),
}
"""Room and key of the summary of both, and the factor to the unit, by quantity."""


def compare(study: Study) -> None:
    """Judge the finest run beside the largest values of finite volumes."""
    runs = {}
    for spacing in study.plan.spacings_nm:
        label = f"{spacing}nm"
        runs[spacing] = one = study.run(
            label, *study.plan.settings, f"particles.spacing={spacing} nm"
        )
        add_rows(study, spacing, one, judge=spacing == study.plan.judged_nm)
    # the error of the step, of the judged run
    spacing = study.plan.judged_nm
    settings = (*study.plan.settings, f"particles.spacing={spacing} nm")
    half = study.run(f"{spacing}nm-half", *settings, "time.step=25 ps")
    change = speed_of(half) / speed_of(runs[spacing]) - 1.0
    study.add("half_step", abs(change), spacing=spacing)
    for spacing in study.plan.quarters_nm:
        add_quarter(study, spacing)
    draw(study, runs)


def add_rows(study: Study, spacing: int, one: Run, *, judge: bool) -> None:
    """Rows of one run."""
    for name, (column, _, factor) in COLUMNS.items():
        value = factor * float(np.max(one.history[column]))
        study.add(name, value, LARGEST[name], judge=judge, spacing=spacing)
    flow = one.summary["flow"]
    place = 1e9 * flow["surface_speed_max_x_m"]
    study.add("place", place, PLACE, judge=judge, spacing=spacing)
    study.add("inward", flow["return_speed_max_m_s"], INWARD, judge=judge, spacing=spacing)
    # what the fields hold against the light that the solver booked; nothing else is exchanged
    held, taken = (np.asarray(one.history[f"energy_{name}_J"]) for name in ("stored", "absorbed"))
    study.add("heat", float(np.max(np.abs(held - taken)) / taken[-1]), judge=judge, spacing=spacing)


def add_quarter(study: Study, spacing: int) -> None:
    """Rows of a quarter of the block in 3-D: below a flat surface beside the finite volumes, and
    where the surface moves beside the section."""
    fine = f"particles.spacing={spacing} nm"
    flat = study.run(f"quarter-{spacing}nm", *study.plan.settings, *study.plan.quarter, fine)
    values = {
        name: factor * float(np.max(flat.history[column]))
        for name, (column, _, factor) in COLUMNS.items()
    }
    # what a probe shows at the surface, not the center of the uppermost particle
    values["temperature"] = flat.summary["probes"]["center"]["temperature_max_K"]
    for name, value in values.items():
        study.add(f"quarter_{name}", value, LARGEST[name], spacing=spacing)

    # relief and melt of the case as it is
    moving = study.run(f"relief-{spacing}nm", *study.plan.quarter, fine).summary
    section = study.run(f"relief-{spacing}nm-section", fine).summary
    for name, (room, key, factor) in RELIEF.items():
        expected = factor * section[room][key]
        study.add("relief", factor * moving[room][key], expected, name=name, spacing=spacing)


def speed_of(one: Run) -> float:
    """Largest speed of the surface [m/s]."""
    return float(one.summary["flow"]["surface_speed_max_m_s"])


def draw(study: Study, runs: dict[int, Run]) -> None:
    """Depth, volume, temperature and speed over time."""
    table = study.table()
    names = {
        "temperature": "largest temperature [K]",
        "volume": "melt [µm³]",
        "depth": "depth, half molten [nm]",
        "speed": "speed of the surface [m/s]",
    }
    panels = []
    for name, title in names.items():
        column, of_table, factor = COLUMNS[name]
        curves = [exact(table["t_ns"], table[of_table], "finite volumes")]
        for k, (spacing, one) in enumerate(runs.items()):
            time = 1e9 * np.asarray(one.history["time_s"]) - PEAK
            shown = time > float(table["t_ns"][0])
            values = factor * np.asarray(one.history[column])
            curves.append(line(time[shown], values[shown], f"{spacing} nm", k))
        panels.append(Panel("time after the peak of the pulse [ns]", title, curves))
    study.draw("spot-pool", *panels, height=5.6, rows=2, legend=3)
