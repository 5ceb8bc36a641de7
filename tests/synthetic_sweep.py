"""A sweep whose runs are made up: its melting and boiling lines are known in closed form."""

import json

import numpy as np

from lasersph import load_case
from lasersph.sweeps import Table
from lasersph.sweeps.folder import LOG, PLAN, POINTS, RUNS

CASE = load_case("dlip-steel", ["solver.kind=conduction"])
START, LIQUIDUS = CASE.initial_temperature, CASE.material.liquidus
BOILING = CASE.material.vaporization.temperature


def melting_fluence(duration):
    """Fluence [J/m^2] at which a pulse of a duration [s] just melts the made-up metal."""
    return 4e3 * (np.asarray(duration) / 1e-8) ** 0.4


def boiling_fluence(duration):
    """The same to boil: the temperature rises in proportion to the fluence."""
    return melting_fluence(duration) * (BOILING - START) / (LIQUIDUS - START)


def made_up_depth(fluence, duration):
    """Depth of the melt [m], zero below the threshold."""
    return 1e-7 * np.maximum(0.0, np.asarray(fluence) / melting_fluence(duration) - 1.0)


def made_up_summary(fluence, duration):
    """summary.json of a run of fluence [J/m^2] and duration [s]."""
    share = fluence / melting_fluence(duration)
    melt = {"start_s": 1e-8, "depth_max_m": float(made_up_depth(fluence, duration))}
    return {
        "dimensions": 2,
        "temperature_max_K": min(float(START + (LIQUIDUS - START) * share), BOILING),
        "material": {"liquidus_K": LIQUIDUS, "vaporization_K": BOILING},
        "melt": melt if share >= 1.0 else None,
        "numerical_sd": {"melt.depth_max_m": 1e-10},
    }


def made_up_sweep(folder, points, failed=(), kind="grid"):
    """The table of runs at points (fluence, duration); those with a number in `failed` failed."""
    case = {
        "material": CASE.resolved()["material"],
        "initial_temperature": START,
    }
    entries, events = [], []
    for k, (fluence, duration) in enumerate(points):
        name = f"{k + 1:04d}-{k + 1:016x}"
        settings = {"laser.fluence": float(fluence), "laser.pulse.fwhm": float(duration)}
        entries.append({"run": name, "settings": settings, "overrides": [], "refused": ""})
        if k in failed:
            events.append({"run": name, "event": "failed", "message": "no step converges"})
            continue
        place = folder / RUNS / name
        place.mkdir(parents=True)
        (place / "resolved.json").write_text(json.dumps({"case": case}))
        (place / "summary.json").write_text(json.dumps(made_up_summary(fluence, duration)))
    units = {"laser.fluence": "J/m^2", "laser.pulse.fwhm": "s"}
    if len({duration for _, duration in points}) == 1:
        del units["laser.pulse.fwhm"]
    content = {"schema_version": 1, "units": units, "columns": [], "points": entries}
    (folder / POINTS).write_text(json.dumps(content))
    (folder / LOG).write_text("\n".join(json.dumps(event) for event in events))
    (folder / PLAN).write_text(f'[sampling]\nkind = "{kind}"\n')
    return Table.read(folder)


def grid_points(fluences=(2e3, 1.2e4, 6), durations=(1e-9, 5e-8, 4)):
    """Fluences evenly, durations evenly in the logarithm, all combined."""
    return [(f, t) for f in np.linspace(*fluences) for t in np.geomspace(*durations)]
