"""Films in three dimensions whose surface moves, small enough for tests of laws."""

import numpy as np

from lasersph import compute
from lasersph.analytic.liquid_film import LiquidFilm
from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import binding_limit

PERIOD, DEPTH = 2.8e-6, 280e-9
WAVE = "boundaries.surface_temperature_wave"
DOTS = (
    "solver.dimensions=3",
    "solver.pressure_tolerance=1e-12",
    "particles.spacing=56nm",
    "domain.width=2.8 um",
    "domain.breadth=2.8 um",
    "domain.extent=quarter",
    "solver.flow.front=symmetry",
    "solver.flow.back=symmetry",
    f"{WAVE}.period=2.8 um",
    f"{WAVE}.period_y=2.8 um",
)
"""A quarter of a period of dots, five rows thick."""


def film_of_period(period):
    """The film for a wave of a period [m]."""
    return LiquidFilm(DEPTH, period, 6863.0, 7e-3, 1.6, -4.3e-4)


def dots(*settings, backend=None):
    """Solver of the film of dots with further settings."""
    case = load_case("moving-film", (*DOTS, *settings))
    return recipe_of(case).build(backend or compute.cpu(threads=1))


def go(solver, end, step=5e-10):
    """Step to `end` [s] in steps of at most `step`; returns the heights (nx, ny) there [m]."""
    while solver.state.time < end * (1.0 - 1e-12):
        limits = solver.time_step_limits() | {"mark": end - solver.state.time, "case": step}
        solver.step(binding_limit(limits)[1])
    return solver.domain.surface.line.height


def host(solver, name):
    """A field of the particles as an array."""
    return np.array(solver.backend.to_host(solver.particles[name]))
