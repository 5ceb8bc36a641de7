"""Bodies under short pulses, for tests of electrons and lattice."""

import numpy as np

from lasersph import compute
from lasersph.analytic.two_temperatures import HalfSpace
from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step

CONSTANT = """
schema_version = 2
initial_temperature = "300 K"
boundaries = { emissivity = 0 }
[material]
density = "1000 kg/m^3"
heat_capacity = "2511 J/(kg K)"
conductivity = "318 W/(m K)"
[material.electrons]
heat_capacity = "2.1e4 J/(m^3 K)"
conductivity = "318 W/(m K)"
coupling = "2.1e16 W/(m^3 K)"
[laser]
fluence = "10 J/m^2"
beam = { kind = "uniform" }
pulse = { kind = "gaussian", fwhm = "150 fs", center = "0.5 ps" }
absorption = { kind = "beer-lambert", absorption_coefficient = "8e6 1/m" }
reflectivity = 0.0
[domain]
depth = "4 um"
[particles]
spacing = "4 nm"
arrangement = "graded"
coarsest = "50 nm"
ratio = 0.95
[solver]
dimensions = 1
heat = "two-temperature"
phase_change = false
[time]
end = "20 ps"
"""
"""Gold of constant coefficients; its lattice has 2511 - 21 J/(kg K) and conducts nothing."""
EXACT = HalfSpace(
    C_e=2.1e4, C_l=2.49e6, coupling=2.1e16, conductivity=318.0, alpha=8e6, fluence=10.0,
    fwhm=150e-15, center=0.5e-12,
)  # fmt: skip
GOLD = (
    "material=gold", "laser.absorption.absorption_coefficient=8e7 1/m", "laser.fluence=0.4 J/cm^2",
    "laser.reflectivity=0.5", "solver.phase_change=true", "domain.depth=1 um",
    "particles.spacing=5 nm", "time.end=100ps",
)  # fmt: skip
"""Gold that melts."""


def case_of(folder, *settings, text=CONSTANT):
    """The case with settings, from a file in a folder."""
    file = folder / "case.toml"
    file.write_text(text, encoding="utf-8")
    return load_case(file, settings)


def solver_of(case, threads=1, backend=None):
    """Its solver at the start."""
    return recipe_of(case).build(backend or compute.cpu(threads=threads))


def go(solver, end):
    """Step to `end` [s] by the solver's own limits; returns the names of those that bound it."""
    names = []
    while solver.state.time < end * (1.0 - 1e-12):
        limits = solver.time_step_limits() | {"snapshot": end - solver.state.time}
        name, step, unclipped = choose_step(limits)
        solver.step(step, unclipped)
        names.append(name)
    solver.state.time = end
    return names


def host(solver, name):
    """Field of the particles as an array."""
    return np.array(solver.body.backend.to_host(solver.particles[name]))


def split(solver, T_e, T_l):
    """Give all particles two temperatures [K], as after a step under light."""
    nodes = solver.body.nodes
    e = float(nodes.energy_at(T_e))
    h = float(np.interp(T_l, nodes.lattice_temperature, nodes.enthalpy)) + e
    count = solver.body.count
    solver.particles.set("electron_energy", np.full(count, e))
    solver.particles.set("enthalpy", np.full(count, h))
    solver.state.has_two = 1.0
    solver.body.update_temperature()
