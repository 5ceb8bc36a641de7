"""A made-up dot: views and run folders of a surface over x and y, made without a solver.

    eta = -A(t) cos kx cos ky,   T = T0 + 900 K cos kx cos ky e^(z/d),   u = U(t) (sin kx cos ky,
    cos kx sin ky)

over a whole period, half or a quarter of it. The dot lies at x = y = 0 and in the corners.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from kept_runs import written_once

from lasersph.observers import FlowView, View, flow_observers, snapshot_fields
from lasersph.observers.area_relief import AreaRelief
from lasersph.observers.snapshots import UNITS
from lasersph.observers.topography import Topography
from lasersph.observers.view import of_whole
from lasersph.output import RunFolder
from lasersph.output.run_folder import Origin
from lasersph.simulation.surface_output import append_surface, write_relief

PERIOD, DEPTH, FASTEST, MEAN = 5e-6, 60e-9, 2.0, 1800.0
SHARES = {"full": (1.0, 1.0), "half": (0.5, 1.0), "quarter": (0.5, 0.5)}
TIMES = np.linspace(0.0, 60e-9, 7)


def axis(share: float, columns: int) -> np.ndarray:
    """Places of the columns along an axis [m], of a whole period about 0 or of its upper half."""
    count = round(columns * share)
    return (np.arange(count) + 0.5) * PERIOD / columns - (0.5 * PERIOD if share == 1.0 else 0.0)


def dot_view(time: float, step: int = 0, *, extent: str = "quarter", columns: int = 40) -> View:
    """The state at a time, two rows of particles below each column."""
    x, y = (axis(share, columns) for share in SHARES[extent])
    dx, k = PERIOD / columns, 2.0 * np.pi / PERIOD
    share = np.sin(0.5 * np.pi * time / TIMES[-1])
    shape = np.cos(k * x)[:, None] * np.cos(k * y)
    ends = tuple("periodic" if one == 1.0 else "mirror" for one in SHARES[extent])
    relief = AreaRelief(x, y, -DEPTH * share * shape, ends)
    # particles: rows below the columns, and their temperature and velocity
    X, Y = (grid.ravel() for grid in np.meshgrid(x, y, indexing="ij"))
    z = relief.height.ravel()
    position = np.concatenate([np.stack([X, Y, z - depth * dx]) for depth in (0.5, 1.5)], axis=1)
    n, s = position.shape[1], X.size
    pattern = np.tile(shape.ravel(), 2) * np.repeat([1.0, 0.6], s)
    temperature = MEAN + 900.0 * pattern * (0.2 + 0.8 * share)
    melt = np.clip((temperature - 1700.0) / 100.0, 0.0, 1.0)
    along = (
        FASTEST * share * np.stack([np.sin(k * X) * np.cos(k * Y), np.cos(k * X) * np.sin(k * Y)])
    )
    along = along * (melt[:s] >= 1.0)
    velocity = np.concatenate([np.concatenate([along, 0.4 * along], axis=1), np.zeros((1, n))])
    flow = FlowView(
        velocity=velocity,
        pressure=np.zeros(n),
        flows=melt >= 1.0,
        surface=np.arange(s),
        surface_temperature=temperature[:s],
        surface_gradient=np.zeros(s),
        surface_velocity=along,
        surface_pressure=np.zeros(s),
        divergence_rms=0.0,
        divergence_max=0.0,
        spacing_min=dx,
        density=7000.0,
        viscosity=5e-3,
    )
    volume = np.full(n, dx**3)
    view = View(
        time=time,
        step=step,
        time_step=1e-10,
        position=position,
        width=np.full((3, n), dx),
        volume=volume,
        mass=7000.0 * volume,
        temperature=temperature,
        enthalpy=700.0 * temperature,
        melt_fraction=melt,
        vapor_fraction=np.zeros(n),
        surface=np.arange(s),
        symmetry_factor=1 if extent == "full" else 2,
        energy={"incident": 2e-9, "absorbed": 1e-9, "reflected": 1e-9, "lost": 0.0},
        solidus=1700.0,
        liquidus=1800.0,
        relief=relief,
        flow=flow,
    )
    return of_whole(view, round(1.0 / np.prod(SHARES[extent])))


def below_lid(view: View) -> View:
    """The same flow below a surface that stays flat."""
    columns = replace(view.relief, height=np.zeros_like(view.relief.height))
    return replace(view, relief=None, columns=columns)


@written_once
def make_dot_run(
    folder: Path, *, extent: str = "quarter", columns: int = 40, fluence=3000.0, moves=True
) -> Path:
    """Write a complete run folder of a dot, or of melt below a flat surface; return its path."""
    title = f"made-up dot, {extent}"
    beam = {"kind": "interference", "beams": 4, "wavelength": 1e-6, "period": PERIOD}
    case = {
        "title": title,
        "material": {"name": "steel-304-demuth"},
        "laser": {
            "fluence": fluence,
            "beam": beam,
            "pulse": {"kind": "gaussian", "duration": 1e-8},
        },
        "domain": {"extent": extent},
        "solver": {"dimensions": 3},
        "particles": {"spacing": PERIOD / columns},
        "time": {"end": float(TIMES[-1])},
    }
    run = RunFolder.create(folder, Origin("", case, {"lasersph": "0.1.0"}))
    observers = [
        one
        for one in flow_observers(3, topography=Topography(PERIOD, PERIOD, dimensions=3)).members
        if type(one).__name__ in ("Steps", "MeltPool", "PoolCount", "FlowSpeed", "FlowExtrema")
        or (moves and type(one).__name__ == "Topography")
    ]
    for step, time in enumerate(TIMES):
        view = dot_view(float(time), step, extent=extent, columns=columns)
        view = view if moves else below_lid(view)
        row = {key: value for one in observers for key, value in one.observe(view).items()}
        run.history.append({**row, "temperature_max_K": float(view.temperature.max())})
        fields = snapshot_fields(replace(view, flow=None))
        fields["speed"] = np.linalg.norm(view.flow.velocity, axis=0).astype(np.float32)
        run.particles.append(view.time, view.position, fields, units=UNITS)
        append_surface(run.surface, view)
    if moves:
        write_relief(run.path, view.relief, extent)
    summary = {"case": title, "solver": "melt-pool", "particles": fields["mass"].size}
    summary |= {"steps": len(TIMES), "time_s": float(TIMES[-1]), "wall_time_s": 1.0}
    summary |= {"temperature_max_K": 2700.0, "energy": {}}
    summary["material"] = {"solidus_K": 1700.0, "liquidus_K": 1800.0}
    for one in observers:
        for name, part in one.summary().items():
            joined = isinstance(part, dict) and name in summary
            summary[name] = {**summary[name], **part} if joined else part
    run.finish(summary)
    run.close()
    return folder
