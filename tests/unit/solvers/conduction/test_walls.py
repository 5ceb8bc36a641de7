"""Faces of given temperature and flux against closed forms of slabs, in 1-D, 2-D and 3-D."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.analytic.slab import slab_step_rise
from lasersph.case import Case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import binding_limit

DEPTH = 1.0
"""[m]; conductivity, density and heat capacity are one."""
MATERIAL = {
    "density": "1 kg/m^3", "heat_capacity": "1 J/(kg K)", "conductivity": "1 W/(m K)",
    "viscosity": "1 Pa s",
}  # fmt: skip


def solver_of(boundaries, *, end, dimensions=1, cells=20, **settings):
    """Solver of a slab of 1 m, at 300 K, and the case."""
    short = 4.0 * DEPTH / cells if dimensions > 1 else None
    sideways = any(key.startswith(("left", "right")) for key in boundaries)
    domain = {"depth": short if sideways else DEPTH, "width": DEPTH if sideways else short,
              "breadth": short if dimensions > 2 else None}  # fmt: skip
    any_change = {} if settings.get("scheme") == "explicit" else {"temperature_change": 1e9}
    case = Case.model_validate(
        {
            "material": MATERIAL, "initial_temperature": 300.0, "domain": domain,
            "particles": {"spacing": DEPTH / cells}, "boundaries": boundaries,
            "solver": {"dimensions": dimensions, **settings},
            "time": {"end": end, "step": end / 400, **any_change},
        }
    )  # fmt: skip
    return case, recipe_of(case).build(compute.cpu(threads=1))


def run(solver, end):
    """Step to the end; temperatures above 300 K and positions."""
    while solver.state.time < end * (1.0 - 1e-12):
        solver.step(binding_limit(solver.time_step_limits())[1])
    body = solver.body
    return body.backend.to_host(solver.particles["temperature"]) - 300.0, body.filling.position[
        :, : body.count
    ]


@pytest.mark.parametrize("scheme", ["implicit", "explicit"])
def test_slab_under_a_flux(scheme):
    """A flux of 10 W/m2 through the surface, the bottom insulated: Carslaw & Jaeger 3.8."""
    faces = {"surface": "prescribed-flux", "surface_flux": 10.0}
    _, solver = solver_of(faces, end=0.2, scheme=scheme)
    rise, position = run(solver, 0.2)
    exact = slab_step_rise(
        -position[-1], 0.2, thickness=DEPTH, flux=10.0, conductivity=1.0, diffusivity=1.0
    )
    assert rise == pytest.approx(exact, abs=0.01 * exact.max())
    energy = solver.state.energy
    assert energy["lost"] == pytest.approx(-10.0 * 0.2, rel=1e-12)
    mass, h = (solver.backend.to_host(solver.particles[name]) for name in ("mass", "enthalpy"))
    assert float(mass @ h) == pytest.approx(2.0, rel=1e-9)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_slab_under_a_flux_through_its_left_side(dimensions):
    """The same slab lying on its side, at every height; energy per length or whole."""
    faces = {"left": "prescribed-flux", "left_flux": 10.0}
    _, solver = solver_of(faces, end=0.2, dimensions=dimensions, scheme="implicit")
    rise, position = run(solver, 0.2)
    exact = slab_step_rise(
        position[0] + 0.5, 0.2, thickness=DEPTH, flux=10.0, conductivity=1.0, diffusivity=1.0
    )
    assert rise == pytest.approx(exact, abs=0.01 * exact.max())
    assert solver.state.energy["lost"] == pytest.approx(-2.0 * 0.2 ** (dimensions - 1), rel=1e-9)


@pytest.mark.parametrize("kind", ["fixed-temperature", "wall"])
@pytest.mark.parametrize("scheme", ["implicit", "explicit"])
def test_slab_between_two_temperatures(kind, scheme):
    """Steady: a straight line from left to right; a wall of particles errs by half a cell."""
    faces = {"left": kind, "left_temperature": 310.0, "right": kind, "right_temperature": 290.0}
    _, solver = solver_of(faces, end=2.0, dimensions=2, cells=10, scheme=scheme)
    rise, position = run(solver, 2.0)
    allowed = 1e-3 if kind == "fixed-temperature" else 1.1
    assert rise == pytest.approx(-20.0 * position[0], abs=allowed)


def test_slab_between_a_flux_and_a_temperature():
    """Steady: T - T_w = q (x - x_w)/k to rounding, what enters leaves."""
    faces = {"left": "prescribed-flux", "left_flux": 10.0, "right": "fixed-temperature"}
    _, solver = solver_of(faces, end=4.0, dimensions=2, cells=10, scheme="implicit")
    rise, position = run(solver, 4.0)
    assert rise == pytest.approx(10.0 * (0.5 - position[0]), abs=2e-3)


def test_periodic_in_depth():
    """A wave of temperature decays as exp(-D k^2 t) across surface and bottom."""
    faces = {"surface": "periodic", "bottom": "periodic"}
    _, solver = solver_of(faces, end=0.02, cells=40, scheme="implicit")
    body = solver.body
    z = body.filling.position[-1, : body.count]
    wave = np.sin(2.0 * np.pi * z + 0.3)
    for name in ("enthalpy", "enthalpy_before"):
        solver.particles.set(name, wave)
    solver.body.update_temperature()
    rise, _ = run(solver, 0.02)
    decay = np.exp(-((2.0 * np.pi) ** 2) * 0.02)
    assert rise == pytest.approx(decay * wave, abs=0.01 * decay)


def test_surface_held_at_a_wave():
    """Steady below a wave of temperature over an insulated bottom: cosh(k (z + H))/cosh(k H)."""
    faces = {
        "surface": "fixed-temperature", "surface_temperature": 300.0, "sides": "periodic",
        "surface_temperature_wave": {"amplitude": 10.0, "period": 1.0},
    }  # fmt: skip
    case = Case.model_validate(
        {
            "material": MATERIAL, "initial_temperature": 300.0,
            "domain": {"depth": 0.5, "width": 1.0}, "particles": {"spacing": 0.025},
            "boundaries": faces, "solver": {"dimensions": 2},
            "time": {"end": 1.0, "step": 0.01, "temperature_change": 1e9},
        }
    )  # fmt: skip
    solver = recipe_of(case).build(compute.cpu(threads=1))
    rise, (x, z) = run(solver, 1.0)
    k = 2.0 * np.pi
    exact = 10.0 * np.cos(k * x) * np.cosh(k * (z + 0.5)) / np.cosh(0.5 * k)
    assert rise == pytest.approx(exact, abs=0.1)
