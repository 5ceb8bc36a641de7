"""A drop between walls to which its surface is pinned comes to rest as an arc."""

import numpy as np
import pytest
from scipy.optimize import brentq

from lasersph import compute
from lasersph.case import Case, load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import binding_limit

HALF, TENSION, VISCOSITY = 1e-6, 0.87, 2.2747e-3
WAVE = {"amplitude": 2.5e-7, "period": 4e-6}
END = 3e-7


def drop():
    """Liquid 1 um deep between walls 2 um apart, whose surface starts as a cosine."""
    data = load_case("moving-film").resolved()
    sides = {side: "no-slip" for side in ("left", "right", "bottom")}
    data |= {
        "material": {
            "name": "liquid", "density": 2379.0, "viscosity": VISCOSITY,
            "surface_tension": TENSION, "heat_capacity": 1000.0, "conductivity": 90.0,
        },
        "domain": {"depth": 1e-6, "width": 2.0 * HALF, "extent": "full"},
        "particles": {"spacing": 1e-7, "arrangement": "uniform"},
        "boundaries": {},
        "solver": {
            "kind": "melt-pool", "dimensions": 2, "gravity": 0.0, "marangoni": False,
            "flow": sides | {"surface": "moving", "initial_surface": WAVE},
        },
        "time": {"end": END},
    }  # fmt: skip
    return recipe_of(Case.model_validate(data)).build(compute.cpu(threads=1))


def arc_curvature(area):
    """1/R of an arc over the chord with an area below it [1/m]."""

    def radius(sagitta):
        return (HALF**2 + sagitta**2) / (2.0 * sagitta)

    def excess(sagitta):
        R = radius(sagitta)
        return R**2 * np.arcsin(HALF / R) - (R - sagitta) * HALF - area

    return 1.0 / radius(brentq(excess, 1e-9, 0.9e-6))


def test_static_arc():
    """Pressure gamma/R within 1 %, uniform to the ends, and mu u / gamma below 1e-4."""
    solver = drop()
    while solver.state.time < END * (1.0 - 1e-12):
        solver.step(binding_limit(solver.time_step_limits() | {"mark": END - solver.state.time})[1])
    line = solver.domain.surface.line
    kappa = arc_curvature(line.widths[0] * line.height.sum())
    assert line.curvature == pytest.approx(kappa, rel=0.01)
    pressure = solver.backend.to_host(solver.flow.pressure)
    assert np.mean(pressure) == pytest.approx(TENSION * kappa, rel=0.01)
    assert np.ptp(pressure) < 0.03 * TENSION * kappa
    assert VISCOSITY * solver.flow.largest_speed / TENSION < 1e-4
