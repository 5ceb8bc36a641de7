"""Made-up flows: views and run folders with plausible velocities, made without a solver.

The pool flows with the stream function psi = U(t) s(x) d exp(-d/delta), d depth below the surface:

    u = U s (1 - d/delta) exp(-d/delta),  w = U s' d exp(-d/delta)

outward at the surface, inward below the depth delta, free of divergence, w = 0 at the surface.
The box turns with psi = -V L sin^2(pi x/L) sin^2(pi z/L), clockwise.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import synthetic_run
from kept_runs import written_once
from synthetic_run import NM, NS, PERIOD

from lasersph.observers import FlowView, View, flow_observers, snapshot_fields
from lasersph.observers.snapshots import UNITS
from lasersph.output import RunFolder
from lasersph.output.run_folder import Origin
from lasersph.output.settings import SnapshotPlan, SnapshotSchedule

LAYER = 120 * NM
FASTEST = 4.0
SLOPE = -4.3e-4
VISCOSITY = 6.4e-3
DENSITY = 6863.0


def shape(x, inner):
    """s(x) and its derivative: an outer maximum at a quarter of the period, an inner one."""
    k, place, width = 2 * np.pi / PERIOD, 400 * NM, 120 * NM
    bump = inner * np.exp(-(((x - place) / width) ** 2))
    return np.sin(k * x) + bump, k * np.cos(k * x) - 2 * (x - place) / width**2 * bump


def pool_flow(view: View, *, inner=None) -> View:
    """A view of heat and melting with the made-up flow where it is completely fluid.

    Args:
        inner: height of the inner maximum; if not given, a while around 60 ns.
    """
    x, depth = view.position[0], -view.position[1]
    flows = view.melt_fraction >= 1.0
    if inner is None:
        inner = 1.3 * np.exp(-(((view.time - 60 * NS) / (3 * NS)) ** 2))
    fastest = FASTEST * np.exp(-(((view.time - 57 * NS) / (12 * NS)) ** 2))
    s, slope = shape(x, inner)
    fall = np.exp(-depth / LAYER)
    u = fastest * s * (1.0 - depth / LAYER) * fall
    velocity = np.array([u, fastest * slope * depth * fall]) * flows
    surface = view.surface[np.argsort(x[view.surface])]
    at_surface = np.where(flows[surface], fastest * s[surface], 0.0)
    flow = FlowView(
        velocity=velocity,
        pressure=1e5 * np.cos(2 * np.pi * x / PERIOD) * flows,
        flows=flows,
        surface=surface,
        surface_temperature=view.temperature[surface] + 5.0,
        surface_gradient=np.gradient(view.temperature[surface], x[surface]),
        surface_velocity=at_surface,
        surface_pressure=-1e5 * np.cos(2 * np.pi * x[surface] / PERIOD) * flows[surface],
        divergence_rms=1e6 if np.any(flows) else 0.0,
        divergence_max=4e6 if np.any(flows) else 0.0,
        spacing_min=45 * NM,
        density=DENSITY,
        viscosity=VISCOSITY,
        surface_tension_slope=SLOPE,
        recoil=lambda T: 5e4 * np.exp((T - 3273.0) / 300.0),
    )
    counts = {**view.iterations, "pressure": 25, "viscosity": 8}
    return replace(view, flow=flow, iterations=counts if view.step else {})


def liquid_rows(count, spacing=5 * NM) -> View:
    """Half a period of liquid metal: rows of particles below the surface, without a flow."""
    columns = round(0.5 * PERIOD / spacing)
    x = (np.arange(columns) + 0.5) * spacing
    z = -(np.arange(count) + 0.5) * spacing
    grid = np.array([g.ravel() for g in np.meshgrid(x, z)])
    n = grid.shape[1]
    temperature = 2000.0 + 1000.0 * np.cos(2 * np.pi * grid[0] / PERIOD)
    return View(
        time=57 * NS,
        step=1,
        time_step=0.1 * NS,
        position=grid,
        width=np.full((2, n), spacing),
        volume=np.full(n, spacing**2),
        mass=np.full(n, spacing**2),
        temperature=temperature,
        enthalpy=temperature,
        melt_fraction=np.ones(n),
        vapor_fraction=np.zeros(n),
        surface=np.arange(columns),
        symmetry_factor=2,
        iterations={"pressure": 7},
        vaporization=2990.0,
    )


@written_once
def make_pool_run(folder: Path, *, complete=True) -> Path:
    """Write a run folder with heat, melting and flow and return its path."""
    return write_run(folder, pool_views(), box=False, end=200 * NS, complete=complete, times=FINE)


FINE = tuple(float(t) * NS for t in range(48, 76, 4))


def pool_views():
    """The views of a made-up melt pool."""
    position, width = synthetic_run.lattice(2)
    for step, time in enumerate(synthetic_run.times()[::4]):
        yield pool_flow(synthetic_run.view_at(float(time), step, position, width))


def box_view(time=0.0, step=0, *, count=40, size=1e-3, speed=1.0, wall=(310.0, 290.0)) -> View:
    """A view of the box: z from -size to 0, hot on the left, linear temperature."""
    spacing = size / count
    nodes = (np.arange(count) + 0.5) * spacing
    x, z = (grid.ravel() for grid in np.meshgrid(nodes, nodes - size))
    a, b = np.pi * x / size, np.pi * (z + size) / size
    u = -np.pi * speed * np.sin(a) ** 2 * np.sin(2 * b)
    w = np.pi * speed * np.sin(2 * a) * np.sin(b) ** 2
    none = np.zeros(x.size)
    temperature = wall[0] + (wall[1] - wall[0]) * x / size
    flow = FlowView(
        velocity=np.array([u, w]),
        pressure=speed**2 * (np.cos(2 * a) + np.cos(2 * b)),
        flows=np.ones(x.size, dtype=bool),
        surface=np.zeros(0, dtype=np.int64),
        surface_temperature=np.zeros(0),
        surface_gradient=np.zeros(0),
        surface_velocity=np.zeros(0),
        surface_pressure=np.zeros(0),
        divergence_rms=1.0,
        divergence_max=3.0,
        spacing_min=spacing,
        density=1.0,
        viscosity=1e-2,
        box=True,
        conductivity=2.0,
        wall_temperature={"left": wall[0], "right": wall[1]},
        conducting_sides=("left", "right"),
        wall_heat={"left": 40.0 * time, "right": -40.0 * time, "bottom": 0.0, "surface": 0.0},
        wall_impulse={"left": -3.0 * time, "right": 3.0 * time, "bottom": time, "surface": -time},
        wall_pressing={"left": 5.0 * time, "right": 2.0 * time, "bottom": time, "surface": -time},
    )
    return View(
        time=time,
        step=step,
        time_step=1e-5 if step else 0.0,
        position=np.array([x, z]),
        width=np.full((2, x.size), spacing),
        volume=np.full(x.size, spacing**2),
        mass=np.full(x.size, spacing**2),
        temperature=temperature,
        enthalpy=temperature - 300.0,
        melt_fraction=none + 1.0,
        vapor_fraction=none,
        surface=np.arange(x.size - count, x.size),
        limit="cfl" if step else "",
        iterations={"newton": 1, "linear": 3, "pressure": 20, "viscosity": 5} if step else {},
        flow=flow,
    )


@written_once
def make_box_run(folder: Path) -> Path:
    """Write the run folder of a box and return its path."""
    views = (
        box_view(step * 2e-5, step, count=24, speed=1.0 - np.exp(-step / 15)) for step in range(51)
    )
    return write_run(folder, views, box=True, end=1e-3, complete=True)


def write_run(folder, views, *, box, end, complete, times=()):
    """Write a run folder from views."""
    case = {
        "title": "made-up box" if box else "made-up melt pool",
        "material": {"name": "steel-304-demuth"},
        "laser": None if box else {"fluence": 6000.0},
        "domain": {"extent": "full" if box else "half"},
        "solver": {"dimensions": 2},
        "particles": {"spacing": 50 * NM},
        "time": {"end": end},
    }
    versions = {"lasersph": "0.1.0", "numpy": np.__version__}
    run = RunFolder.create(folder, Origin("# made up\n", case, versions))
    counts = ("newton", "linear", "pressure", "viscosity")
    observers = flow_observers(2, box=box, iterations=counts)
    schedule = SnapshotSchedule(SnapshotPlan(interval=end / 20, times=times), end)
    view = None
    for view in views:
        run.history.append(observers.observe(view))
        if schedule.due(view.time):
            run.particles.append(view.time, view.position, snapshot_fields(view), units=UNITS)
    run.events.append("started", time=0.0, step=0)
    if complete:
        summary = {"case": case["title"], "solver": "formula", "wall_time_s": 1.5}
        run.finish({**summary, "particles": view.volume.size, **observers.summary()})
    run.log("made up")
    run.close()
    return folder


def cube_view(*, count=6, size=1e-3) -> View:
    """A view of a cube of liquid at rest and of one temperature, z from -size to 0."""
    flat = box_view(count=count, size=size, speed=0.0, wall=(300.0, 300.0))
    layers = [np.tile(values, count) for values in (flat.temperature, flat.enthalpy, flat.volume)]
    temperature, enthalpy, volume = layers
    x, z = (np.tile(values, count) for values in flat.position)
    y = np.repeat(flat.position[0, :count], flat.volume.size)
    cells, spacing = x.size, size / count
    flow = replace(
        flat.flow,
        velocity=np.zeros((3, cells)),
        pressure=np.zeros(cells),
        flows=np.ones(cells, dtype=bool),
        wall_temperature={},
        conducting_sides=(),
    )
    return replace(
        flat,
        position=np.array([x, y, z]),
        width=np.full((3, cells), spacing),
        volume=volume * spacing,
        mass=volume * spacing,
        temperature=temperature,
        enthalpy=enthalpy,
        melt_fraction=np.ones(cells),
        vapor_fraction=np.zeros(cells),
        surface=np.flatnonzero(z > -spacing),
        flow=flow,
    )
