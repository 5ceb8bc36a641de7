"""Pools of steel in sections (r, z), laid out in memory for tests of their flow."""

from itertools import count

import numpy as np
import pytest
from flow_boxes import place_of
from law_runs import start_from

from lasersph import compute, run
from lasersph.case import Case
from lasersph.simulation.recipes import recipe_of
from lasersph.simulation.time_loop import Stopped

LIGHT = {
    "fluence": 1e4,
    "fluence_kind": "peak",
    "beam": {"kind": "gaussian", "radius_1e2": 1e-6},
    "pulse": {"kind": "gaussian", "fwhm": 1e-8, "center": 2e-8},
    "absorption": {"kind": "beer-lambert"},
}


def spot_case(*, spacing=1e-7, width=2e-6, depth=1e-6, material=None, laser=LIGHT, **rooms):
    """Case of a block of steel, `width` the radius, with equal particles, and few snapshots; other
    rooms are added to what is here."""
    time = {"end": 4e-8} | rooms.pop("time", {})
    solver = {"kind": "melt-pool", "geometry": "axisymmetric"} | rooms.pop("solver", {})
    return Case.model_validate(
        {
            "material": material or "steel-304-demuth",
            "domain": {"width": width, "depth": depth},
            "particles": {"spacing": spacing, "arrangement": "uniform"},
            "solver": solver,
            "time": time,
            "output": {"snapshots": {"interval": 0.5 * time["end"]}},
            **({} if laser is None else {"laser": laser}),
            **rooms,
        }
    )


def spot_pool(temperature, *, backend=None, **settings):
    """Case, and its solver with temperatures [K] that a function of r and z [m] gives."""
    case = spot_case(**settings)
    solver = recipe_of(case).build(backend or compute.cpu(threads=1))
    start_from(solver, solver.body.curve.enthalpy_at(temperature(*place_of(solver))))
    return case, solver


def half_ball(r, z):
    """Melt within 0.9 um of the center of the spot, hottest there, in hot solid."""
    distance = np.hypot(r, z)
    return np.where(distance < 9e-7, 2600.0 - 6e14 * distance**2, 1500.0)


def run_in_two_parts(case, folder, steps=450):
    """Run with two threads, stop after some steps, and go on from the checkpoint."""
    taken = count(1)
    with pytest.raises(Stopped):
        run(case, folder, threads=2, should_stop=lambda: next(taken) > steps)
    run(case, folder, threads=2, resume=True)
