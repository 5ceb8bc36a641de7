"""Two particles (or a few) of AA6014 in 1-D, and what a hand needs to follow them."""

import numpy as np

from lasersph import compute
from lasersph.boundaries import Boundaries
from lasersph.materials import load_material
from lasersph.particles import Domain, Geometry, Lattice
from lasersph.particles.layers import stack
from lasersph.solvers.conduction.body import assemble
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.time_settings import TimeSettings
from lasersph.sph.kernels import kernel

SPACING = 1e-7
COLD, HOT = 300.0, 400.0
FREE = Boundaries(surface="free", bottom="free", emissivity=0.0)


def solver_of(
    *, count=2, boundaries=FREE, time=None, laser=None, backend=None, phase_change=False,
    initial=COLD, kernel="cubic-spline", support_ratio=None, ambient_pressure=0.0, **settings,
):  # fmt: skip
    """Solver of a column at rest, with plain weights."""
    chosen = ConductionSettings(
        dimensions=1, phase_change=phase_change, weights="plain", **settings
    )
    material = load_material("aluminium-aa6014")
    domain = Domain(depth=count * SPACING)
    lattice = Lattice(spacing=SPACING, kernel=kernel, support_ratio=support_ratio)
    body = assemble(
        backend or compute.cpu(threads=2),
        lattice=lattice,
        layers=stack(domain, lattice, Geometry(1), 0.0),
        boundaries=boundaries,
        material=material,
        laser=laser,
        curve=material.caloric_curve(initial, chosen.curve_plateau, phase_change=phase_change),
        use_second_moment=False,
    )
    return Conduction(body, chosen, time or TimeSettings(end=1e-9), laser, ambient_pressure)


def set_enthalpy(solver, enthalpy):
    """Give the particles enthalpies [J/kg], as after a step that changed nothing."""
    for name in ("enthalpy", "enthalpy_before"):
        solver.particles.set(name, np.asarray(enthalpy, float))
    solver.body.update_temperature()


def enthalpy_of(solver):
    """Enthalpies on the host [J/kg]."""
    return solver.body.backend.to_host(solver.particles["enthalpy"])


def temperature_of(solver):
    """Temperatures on the host [K]."""
    return solver.body.backend.to_host(solver.particles["temperature"])


def constants(solver):
    """Density, heat capacity and conductivity [SI], and the weight g = -2 d^2 W'(d) / d."""
    material = solver.body.material
    density = material.density_reference
    k = float(material.conductivity_at(COLD))
    capacity = k / (density * material.diffusivity_reference)
    slope = kernel("cubic-spline", 1).derivative(SPACING, 3.0 * SPACING)
    return density, capacity, k, -2.0 * SPACING * slope
