"""Made-up ablations: views and run folders with a plausible crater and ejecta, without a solver.

The front recedes from 1 ns on at SPEED times the profile of the beam; each particle above it left
when the front passed it, upward at VELOCITY, and is gone beyond the height HEIGHT. The temperature
is T0 + (T_v - T0) exp(-depth below the front/REACH) times the profile.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from kept_runs import written_once

from lasersph.observers import AblationView, View, ablation_observers, snapshot_fields
from lasersph.observers.snapshots import UNITS
from lasersph.output import RunFolder
from lasersph.output.run_folder import Origin
from lasersph.output.settings import SnapshotPlan, SnapshotSchedule, Trace

NS, UM = 1e-9, 1e-6
DX, WIDTH, DEPTH, HEIGHT = 0.2 * UM, 6 * UM, 3 * UM, 3 * UM
T0, MELTING, BOILING, DENSITY = 300.0, 933.0, 2730.0, 2705.0
ONSET, PULSE, END = 1 * NS, 10 * NS, 12 * NS
SPEED, VELOCITY, REACH = 100.0, 400.0, 0.8 * UM
GAS_CONSTANT = 308.17
CASE_TEXT = """\
# A crater in aluminium, made up for tests
title = "made-up crater"
material = "aluminium-aa6014"

[laser]
fluence = "10 J/cm^2"

[particles]
spacing = "0.2 um"

[time]
end = "12 ns"
"""


def lattice(dimension):
    """Positions (dim, n), layer by layer from the surface down, 1, 2 or 3-D."""
    z = -(np.arange(round(DEPTH / DX)) + 0.5) * DX
    across = (np.arange(round(WIDTH / DX)) + 0.5) * DX - 0.5 * WIDTH
    grids = np.meshgrid(z, *([across] * (dimension - 1)), indexing="ij")
    return np.array([*(g.ravel() for g in grids[1:]), grids[0].ravel()])


def profile(lateral, kind="top-hat"):
    """Profile of the beam at lateral places (dim - 1, m): top hat or Gaussian, 1.6 um wide."""
    r = np.sqrt(np.sum(lateral**2, axis=0)) if lateral.size else np.zeros(lateral.shape[1])
    if kind == "top-hat":
        return np.where(r < 1.6 * UM, 1.0, np.where(r < 2.0 * UM, 0.3, 0.0))
    return np.exp(-2.0 * (r / (2.0 * UM)) ** 2)


def view_at(time, step, dimension, kind="top-hat"):
    """The made-up state at a time."""
    start = lattice(dimension)
    lateral, z = start[:-1], start[-1]
    share = profile(lateral, kind)
    lasted = min(max(time - ONSET, 0.0), PULSE - ONSET)
    front = SPEED * share * lasted
    passed = np.where(share > 0.0, ONSET + (0.5 * DX - z) / (SPEED * np.maximum(share, 1e-9)), 1.0)
    left = (-z + 0.5 * DX <= front) & (front > 0.0)
    position = start.copy()
    position[-1] = np.where(left, z + VELOCITY * (time - passed), z)
    gone = left & (position[-1] > HEIGHT)
    warm = T0 + (BOILING - T0) * share * np.exp(np.minimum(z + front, 0.0) / REACH) * min(
        time / ONSET, 1.0
    )
    temperature = np.where(left, BOILING + 100.0, warm)
    stage = np.where(gone, 3, np.where(left, 2, 0))
    velocity = np.zeros_like(start)
    velocity[-1] = np.where(left, VELOCITY, 0.0)
    count = start.shape[1] // z[z == z[0]].size
    columns = start[:-1, : z.size // count]
    kept = np.where(left, -np.inf, z + 0.5 * DX).reshape(count, -1)
    top = np.max(kept, axis=0)
    exposed = np.flatnonzero(~left & (np.tile(top, count) < z + DX))
    mass = DENSITY * DX**dimension
    flying = stage == 2
    number = int(np.count_nonzero(left))
    full = 896.0 * (BOILING - T0) + 10.9e6
    seen = AblationView(
        stage=stage,
        velocity=velocity,
        density=np.full(z.size, DENSITY),
        pressure=np.zeros(z.size),
        vapor_pressure=np.where(left, 2e5, 0.0),
        normal=np.where(np.isin(np.arange(z.size), exposed), velocity * 0.0 + 1.0, 0.0),
        column_center=columns,
        column_width=DX,
        column_top=top,
        ejecta_position=position[:, flying],
        ejecta_velocity=velocity[:, flying],
        ejecta_temperature=temperature[flying],
        ejecta_mass=np.full(int(np.count_nonzero(flying)), mass),
        ejecta_time=passed[flying],
        ejected_count=number,
        ejected_mass=number * mass,
        ejected_energy=number * mass * full,
        ejected_kinetic=number * mass * 0.5 * VELOCITY**2,
        gone_count=int(np.count_nonzero(gone)),
        pressure_max=0.0,
        speed_max_condensed=0.0,
        particle_mass=mass,
        density_reference=DENSITY,
        gas_constant=GAS_CONSTANT,
    )
    incident = 1e5 * (min(time, PULSE) / PULSE) * WIDTH ** (dimension - 1)
    energy = dict.fromkeys(("lost", "discarded", "transmitted"), 0.0)
    energy |= {"incident": incident, "reflected": 0.75 * incident, "absorbed": 0.25 * incident}
    energy["removed"] = seen.ejected_energy
    return View(
        time=time,
        step=step,
        time_step=0.5 * NS if step else 0.0,
        position=position,
        width=np.full_like(start, DX),
        volume=np.full(z.size, DX**dimension),
        mass=np.full(z.size, mass),
        temperature=temperature,
        enthalpy=np.where(left, full, 896.0 * (temperature - T0)),
        melt_fraction=(temperature >= MELTING).astype(float),
        vapor_fraction=left.astype(float),
        surface=exposed,
        energy=energy,
        limit="given" if step else "",
        solidus=MELTING,
        liquidus=MELTING,
        vaporization=BOILING,
        ablation=seen,
    )


def views(dimension, kind="top-hat"):
    """The views of a run, one each half nanosecond."""
    for step in range(int(END / NS) * 2 + 1):
        yield view_at(0.5 * NS * step, step, dimension, kind)


@written_once
def make_run(folder: Path, dimension: int, kind: str = "top-hat") -> Path:
    """Write a complete run folder with observers, history, snapshots and summary."""
    case = {
        "title": "made-up crater",
        "laser": {"fluence": 1e5, "reflectivity": 0.75, "position": [0.0, 0.0],
                  "pulse": {"kind": "square", "duration": PULSE}},
        "solver": {"kind": "ablation", "dimensions": dimension},
        "ejection": {"model": "enthalpy"},
        "particles": {"spacing": DX},
        "domain": {"depth": DEPTH, "width": WIDTH},
        "time": {"end": END},
    }  # fmt: skip
    versions = {"lasersph": "0.0.0", "python": "3.11"}
    run = RunFolder.create(folder, Origin(CASE_TEXT, case, versions, "made-up"))
    traces = (Trace(name="center", depth=0.1 * UM), Trace(name="third-layer", depth=0.5 * UM))
    observers = ablation_observers(dimension, traces=traces, axis=(0.0, 0.0))
    snapshots = SnapshotSchedule(SnapshotPlan(interval=1 * NS), END)
    for view in views(dimension, kind):
        run.history.append(observers.observe(view))
        if snapshots.due(view.time):
            run.particles.append(view.time, view.position, snapshot_fields(view), units=UNITS)
    summary = {
        "case": "made-up", "title": "made-up crater", "solver": "ablation",
        "dimensions": dimension, "particles": int(view.temperature.size), "spacing_m": DX,
        "spacing_requested_m": DX, "steps": view.step, "time_s": END, "is_steady": False,
        "wall_time_s": 1.0, "precision": "float64", "threads": 1,
    }  # fmt: skip
    run.finish({**summary, **observers.summary()})
    run.close()
    return folder
