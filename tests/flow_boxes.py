"""Small boxes and pools of moving particles, for tests of the flow."""

import numpy as np

from lasersph import compute
from lasersph.case import Case, load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step

MATERIAL = {
    "density": "1 kg/m^3", "heat_capacity": "1 J/(kg K)", "conductivity": "0.01 W/(m K)",
    "kinematic_viscosity": "0.01 m^2/s",
}  # fmt: skip
LID = {"surface": {"kind": "moving-wall", "velocity": 1.0}}
PERIODIC = {side: "periodic" for side in ("left", "right", "bottom", "surface")}
PERIODIC_HEAT = {"sides": "periodic", "bottom": "periodic", "surface": "periodic"}


def box_case(
    *, flow=None, heat=None, cells=10, width=1.0, depth=1.0, end=1.0, step=0.01, material=None,
    steady=None, domain=None, support=None, frame="lagrangian", **settings,
):  # fmt: skip
    """Case of a box of unit liquid: nu = a = 0.01 m^2/s, `cells` particles a meter."""
    return Case.model_validate(
        {
            "material": MATERIAL | (material or {}), "initial_temperature": 300.0,
            "domain": {"width": width, "depth": depth} | (domain or {}),
            "particles": {
                "spacing": 1.0 / cells, "arrangement": "uniform", "support_ratio": support,
            },
            "boundaries": heat or {},
            "solver": {
                "kind": "melt-pool", "flow": LID if flow is None else flow, "steady": steady,
                "frame": frame,
                **settings,
            },
            "time": {"end": end, "step": step},
            "output": {"snapshots": {"interval": 0.25 * end}},
        }
    )  # fmt: skip


def box(backend=None, **settings):
    """Solver of `box_case`."""
    return recipe_of(box_case(**settings)).build(backend or compute.cpu(threads=1))


def pool_case(*settings):
    """Case of a `pool`."""
    common = ("solver.kind=melt-pool", "particles.spacing=125nm", "particles.fine_depth=1.25um",
              "time.step=50ps")  # fmt: skip
    return load_case("dlip-steel", (*common, *settings))


def pool(molten, *settings, backend=None, hot=2500.0, cold=1500.0, slope=0.0):
    """Steel at 125 nm, 20 columns of half a period, liquid where `molten(x, z)`, else solid.

    Args:
        hot, cold: temperatures [K]; slope: of the hot one along x [K/m].
    """
    solver = recipe_of(pool_case(*settings)).build(backend or compute.cpu(threads=1))
    x, z = place_of(solver)
    curve = solver.body.curve
    rising = np.concatenate([[True], np.diff(curve.temperature) > 0.0])
    T = np.where(molten(x, z), hot + slope * x, cold)
    start_from(solver, np.interp(T, curve.temperature[rising], curve.enthalpy[rising]))
    return solver


def start_from(solver, enthalpy):
    """Give the particles enthalpies [J/kg], as after steps that changed nothing."""
    for name in ("enthalpy", "enthalpy_before", "enthalpy_two_before"):
        solver.particles.set(name, np.asarray(enthalpy, float))
    solver.body.update_temperature()


def block_of(solver, position=None):
    """Block of the solver with the pairs at `position`, shape (2, n) [m]; its own without."""
    backend = solver.backend
    if position is not None:
        backend.copy(backend.asarray(position), solver.position)
    solver.fluid_count = solver.kinds.find_fluid(solver.particles["melt_fraction"])
    solver.advect(0.0)
    return solver.flow.block


def place_of(solver):
    """Positions on the host, shape (2, n) [m]."""
    return solver.backend.to_host(solver.position)


def jittered(solver, share=0.2, seed=1):
    """Positions of the lattice, moved by up to a share of the spacing."""
    place = place_of(solver)
    shift = np.random.default_rng(seed).uniform(-share, share, place.shape)
    return place + solver.domain.spacing * shift


def places_of(backend, neighbors):
    """Row of each pair of a list, and its place there."""
    start = backend.to_host(neighbors.row_start).astype(np.int64)
    end = start[1:] if neighbors.row_end is None else backend.to_host(neighbors.row_end)
    length = end.astype(np.int64) - start[:-1]
    row = np.repeat(np.arange(length.size), length)
    within = np.arange(row.size) - np.repeat(np.cumsum(length) - length, length)
    return row, start[row] + within


def matrix_of(backend, neighbors, weights, count):
    """Dense sum of the weights of all pairs (i, j)."""
    row, place = places_of(backend, neighbors)
    matrix = np.zeros((count, count))
    neighbor, g = (backend.to_host(one)[place] for one in (neighbors.neighbor, weights))
    np.add.at(matrix, (row, neighbor), g)
    return matrix


def go(solver, steps):
    """Take steps by the solver's own limits; returns their lengths [s]."""
    taken = []
    for _ in range(steps):
        _, step, unclipped_step = choose_step(solver.time_step_limits())
        taken.append(solver.step(step, unclipped_step))
    return taken


def host_fields(solver):
    """Copies of all fields of the particles but their kind, which each step finds anew."""
    table, host = solver.particles.table, solver.backend.to_host
    names = [name for name, field in table.items() if field.storage == "real"]
    return {name: host(solver.particles[name]) for name in names}
