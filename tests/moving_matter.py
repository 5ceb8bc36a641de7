"""Matter that moves, stepped in memory, and what a test wants to know of it."""

import numpy as np

from lasersph import compute
from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import binding_limit

DRIFTING_BLOCK = (
    "solver.dimensions=2", "domain.depth=12 um", "domain.width=10 um", "particles.spacing=1 um",
    "particles.kernel=cubic-spline",
)  # fmt: skip
"""Settings of `sound-wave` for a small block that is periodic on all sides."""
HEATED_BLOCK = (
    "laser.fluence=10 J/cm^2", "laser.reflectivity=0.75", "laser.beam={kind='uniform'}",
    "laser.pulse={kind='square', duration='10 ns'}", "laser.absorption={kind='surface'}",
    "motion=", "boundaries.surface=free", "boundaries.bottom=wall", "solver.sound_speed=1000 m/s",
    "solver.viscosity_solid=5", "solver.tension=false", "particles.kernel=cubic-spline",
)  # fmt: skip
"""Settings of `sound-wave` that make it a column of solid aluminium in light."""


def moving(name, *settings, backend=None, threads=2):
    """Case with settings, and its solver at the start."""
    case = load_case(name, settings)
    return case, recipe_of(case).build(backend or compute.cpu(threads=threads))


def go(solver, steps=None, end=None, share=1.0):
    """Take a number of steps, or those to `end` [s], of a share of the smallest limit."""
    taken = 0
    while taken != steps and (end is None or solver.state.time < end * (1.0 - 1e-12)):
        limits = solver.time_step_limits()
        if end is not None:
            limits["end"] = (end - solver.state.time) / share
        solver.step(share * binding_limit(limits)[1])
        taken += 1
    return taken


def host(solver, name):
    """Field of the material particles as an array."""
    return solver.backend.to_host(solver.fields[name])[..., : solver.body.count]


def put(solver, name, values):
    """Give the material particles values of a field."""
    array = solver.backend.to_host(solver.fields[name])
    array[..., : solver.body.count] = values
    solver.backend.copy(solver.backend.asarray(array), solver.fields[name])
    solver.body.refresh(solver.particles)
    solver._include_active()
    solver._is_surface_current = False


def mass(solver):
    """Masses of the material particles [kg]."""
    return solver.backend.to_host(solver.particles["mass"])[: solver.body.count]


def momentum(solver):
    """Total momentum, (dim,)."""
    return host(solver, "velocity") @ mass(solver)


def stir(solver, speed, seed=1):
    """Give all particles random velocities up to `speed` [m/s]."""
    shape = host(solver, "velocity").shape
    put(solver, "velocity", speed * np.random.default_rng(seed).uniform(-1.0, 1.0, shape))
