"""A small run folder with plausible content, made without a solver.

The temperature is a formula, T = T0 + A(t) (1 + cos(2 pi x/P))/2 exp(z/d(t)), clipped at T_v; the
melt fraction follows from it. Observers, history, snapshots and summary are the real ones.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from kept_runs import written_once

from lasersph.observers import View, heat_observers, snapshot_fields
from lasersph.observers.snapshots import UNITS
from lasersph.output import RunFolder
from lasersph.output.run_folder import Origin
from lasersph.output.settings import Probe, SnapshotPlan, SnapshotSchedule

NS, NM = 1e-9, 1e-9
PERIOD, END = 5e-6, 200 * NS
T0, SOLIDUS, LIQUIDUS, BOILING = 293.0, 1673.0, 1727.0, 3273.0
CASE_TEXT = """\
# Direct laser interference patterning of steel, made up for tests
title = "made-up steel"
material = "steel-304-demuth"

[laser]
fluence = "0.6 J/cm^2"

[particles]
spacing = "50 nm"

[time]
end = "200 ns"
"""


def lattice(dimension):
    """Positions (dim, n) and widths (dim, n): equal rows of 50 nm, then rows growing by 9/7."""
    rows = [50 * NM] * 16
    while sum(rows) < 4.5e-6:
        rows.append(rows[-1] * 9 / 7)
    z = -(np.cumsum(rows) - 0.5 * np.array(rows))
    position, width = [], []
    for depth, height in zip(z, rows, strict=True):
        count = max(1, round(0.5 * PERIOD / height))
        across = 0.5 * PERIOD / count
        x = (np.arange(count) + 0.5) * across
        if dimension == 1:
            position.append([[depth]])
            width.append([[height]])
        elif dimension == 2:
            position.append([x, np.full(count, depth)])
            width.append([np.full(count, across), np.full(count, height)])
        else:
            count, across = max(1, count // 4), 0.5 * PERIOD / max(1, count // 4)
            x = (np.arange(count) + 0.5) * across
            y = (np.arange(3) - 1.0) * across
            a, b = (grid.ravel() for grid in np.meshgrid(x, y, indexing="ij"))
            position.append([a, b, np.full(a.size, depth)])
            width.append([np.full(a.size, across)] * 2 + [np.full(a.size, height)])
    return np.concatenate([np.array(p) for p in position], axis=1), np.concatenate(
        [np.array(w) for w in width], axis=1
    )


def view_at(time, step, position, width, strength=1.0):
    """The made-up state at a time."""
    rise = 0.5 * (1.0 + np.tanh((time - 47 * NS) / (4 * NS)))
    decay = 1.0 / np.sqrt(1.0 + max(time - 50 * NS, 0.0) / (6 * NS))
    amplitude = strength * 7000.0 * rise * decay
    penetration = np.sqrt((200 * NM) ** 2 + 4 * 4e-6 * max(time - 40 * NS, 0.0))
    x = position[0] if position.shape[0] > 1 else np.zeros(position.shape[1])
    profile = 0.5 * (1.0 + np.cos(2 * np.pi * x / PERIOD)) * np.exp(position[-1] / penetration)
    raw = T0 + amplitude * profile
    volume = np.prod(width, axis=0)
    enthalpy = 669.0 * (raw - T0)
    stored = float(np.sum(8000.0 * volume * enthalpy))
    pulse = 0.5 * (1.0 + np.tanh((time - 45 * NS) / (5 * NS)))
    absorbed = max(stored, 2e-3 * pulse)
    return View(
        time=time,
        step=step,
        time_step=0.0 if step == 0 else (0.25 if 30 < time / NS < 70 else 1.0) * NS,
        position=position,
        width=width,
        volume=volume,
        mass=8000.0 * volume,
        temperature=np.minimum(raw, BOILING),
        enthalpy=enthalpy,
        melt_fraction=np.clip((raw - SOLIDUS) / (LIQUIDUS + 400 - SOLIDUS), 0.0, 1.0),
        vapor_fraction=np.clip((raw - BOILING) / 8000.0, 0.0, 1.0),
        surface=np.flatnonzero(position[-1] > -50 * NM),
        symmetry_factor=2,
        energy={
            "incident": absorbed / 0.4,
            "absorbed": absorbed,
            "reflected": absorbed / 0.4 - absorbed,
            "lost": absorbed - stored,
        },
        iterations={} if step == 0 else {"newton": 3, "linear": 12},
        limit="" if step == 0 else ("pulse" if 30 < time / NS < 70 else "accuracy"),
        solidus=SOLIDUS,
        liquidus=LIQUIDUS,
        vaporization=BOILING,
    )


def times():
    """Times of the made-up steps [s]."""
    fine = np.arange(30.25, 70.01, 0.25) * NS
    return np.concatenate([np.arange(0.0, 30.1, 1.0) * NS, fine, np.arange(71.0, 200.1, 1.0) * NS])


@written_once
def make_run(
    folder: Path, *, dimension=2, strength=1.0, fluence=6000.0, complete=True, after_step=None
) -> Path:
    """Write a whole run folder and return its path; `after_step(run, step)` may look or wait."""
    case = {
        "title": "made-up steel",
        "material": {"name": "steel-304-demuth", "vaporization": BOILING},
        "laser": {"fluence": fluence, "pulse": {"kind": "gaussian", "duration": 10 * NS}},
        "domain": {"extent": "half"},
        "solver": {"dimensions": dimension},
        "particles": {"spacing": 50 * NM},
        "time": {"end": END},
    }
    versions = {"lasersph": "0.1.0", "numpy": np.__version__}
    run = RunFolder.create(folder, Origin(CASE_TEXT, case, versions))
    position, width = lattice(dimension)
    probes = (Probe(name="surface", method="linear"), Probe(name="deep", depth=500 * NM))
    observers = heat_observers(dimension, probes=probes, iterations=("newton", "linear"))
    schedule = SnapshotSchedule(SnapshotPlan(interval=10 * NS), END)
    for step, time in enumerate(times()):
        view = view_at(float(time), step, position, width, strength)
        run.history.append(observers.observe(view))
        if schedule.due(view.time):
            run.particles.append(view.time, position, snapshot_fields(view), units=UNITS)
        if after_step is not None:
            after_step(run, step)
    run.events.append("warning", time=0.0, step=0, message="4.0 cells per absorption length")
    if complete:
        summary = {"case": "made-up steel", "solver": "formula", "particles": position.shape[1],
                   "mirror_images": 2}  # fmt: skip
        run.finish({**summary, "wall_time_s": 1.5, **observers.summary()})
    else:
        run.history.flush()
    run.log("made up")
    run.close()
    return folder
