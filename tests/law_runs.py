"""Solvers stepped in memory, without a run folder, for tests of laws."""

import numpy as np

from lasersph import compute
from lasersph.case import load_case
from lasersph.observers import EnergyBudget
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import binding_limit


def solver_of(name, *settings, threads=2, backend=None):
    """Case with settings, of heat alone unless they say otherwise, and its solver at rest."""
    case = load_case(name, ("solver.kind=conduction", *settings))
    return case, recipe_of(case).build(backend or compute.cpu(threads=threads))


def go(solver, end):
    """Step to `end` [s] by the solver's own limits; returns the number of steps."""
    steps = 0
    while solver.state.time < end * (1.0 - 1e-12):
        limits = solver.time_step_limits()
        limits["end"] = end - solver.state.time
        solver.step(binding_limit(limits)[1])
        steps += 1
    return steps


def host(solver, name):
    """Field of the particles as an array."""
    return solver.body.backend.to_host(solver.particles[name])


def budget(case, solver):
    """Energy budget of a run that began without heat, as its observer sums it, by column."""
    return EnergyBudget(case.solver.dimensions).observe(recipe_of(case).view(solver, 1, ""))


def imbalance(case, solver):
    """Relative imbalance of the energy."""
    return budget(case, solver)["energy_imbalance_relative"]


def start_from(solver, enthalpy):
    """Give the particles enthalpies [J/kg], as after a step that changed nothing."""
    for name in ("enthalpy", "enthalpy_before"):
        solver.particles.set(name, np.asarray(enthalpy, float))
    solver.body.update_temperature()
