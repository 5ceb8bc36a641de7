"""The view of a flow: arrays where they lie, those of a closed box as copies.

The observer of a box looks at some states later than the step after which it is shown them.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.case import Case
from lasersph.case.solver_choice import has_two_temperatures
from lasersph.compute.array_types import Array
from lasersph.materials import Material
from lasersph.observers.flow_view import FlowView
from lasersph.physics.recoil import recoil_at
from lasersph.solvers.melt_pool.solver import MeltPool


def flow_view(
    case: Case,
    numbers: dict[str, float],
    solver: MeltPool,
    fetch: Callable[[Array], np.ndarray],
) -> FlowView:
    """The flow for observers.

    Args:
        numbers: of the liquid, see `numbers_of`. fetch: gets an array of the solver.
    """
    flow, exchange = solver.flow, solver.exchange
    liquid = flow.liquid
    position, velocity = fetch(solver.position), fetch(flow.velocity)
    pressure = fetch(flow.pressure)
    found = _along_surface(case, solver, position, velocity)
    is_box, boundaries = case.flow is not None, case.boundaries
    kinds = {side: boundaries.kind_of(side) for side in case.geometry.faces}

    # Sides of a box with a given temperature, which walls of a block do not show.
    wall_temperature = {
        side: boundaries.temperature_of(side, case.initial_temperature)
        for side, kind in kinds.items()
        if is_box and kind in DIRICHLET
    }
    return FlowView(
        velocity=velocity,
        pressure=pressure,
        flows=solver.backend.host_view(solver.kinds.fluid) > 0.0,
        surface=found.particles,
        surface_temperature=found.temperature,
        surface_gradient=found.gradient,
        surface_velocity=found.velocity,
        surface_pressure=pressure[found.particles],
        divergence_rms=flow.divergence[0],
        divergence_max=flow.divergence[1],
        spacing_min=solver.spacing_min,
        density=liquid.density,
        viscosity=liquid.density * liquid.viscosity,
        recoil=_recoil(case),
        box=is_box,
        mirror=case.flow.mirror if case.flow else "",
        wall_temperature=wall_temperature,
        conducting_sides=tuple(
            s for s, kind in kinds.items() if is_box and kind in (*DIRICHLET, NEUMANN)
        ),
        wall_heat=dict(exchange.heat),
        wall_impulse=dict(exchange.impulse),
        wall_pressing=dict(exchange.pressing) if exchange.books_pressing else {},
        full_step=solver.state.unclipped_step,
        **numbers,
    )


class _AlongSurface(NamedTuple):
    """Particles at the surface in order of x, with temperature [K], gradient [K/m] and velocity of
    the surface [m/s] there."""

    particles: np.ndarray
    temperature: np.ndarray
    gradient: np.ndarray
    velocity: np.ndarray


def _along_surface(
    case: Case, solver: MeltPool, position: np.ndarray, velocity: np.ndarray
) -> _AlongSurface:
    """The surface: what its particles are, and what it is itself where it is computed."""
    free, backend, kinds = solver.domain.surface, solver.backend, solver.kinds
    at_surface = np.asarray(backend.host_view(backend.rows_where(free.at_surface, 1.0)), np.int64)
    if not at_surface.size:
        return _AlongSurface(at_surface, *3 * (np.zeros(0),))
    # melt that electrons hotter than it hold: the surface of the last flow is no longer its own
    rests = has_two_temperatures(case.solver) and not solver.has_moved

    # The temperature of the particles' centers, or that of the surface itself.
    particles = at_surface[np.argsort(position[0, at_surface], kind="stable")]
    temperature = backend.host_view(solver.particles["temperature"])[particles]
    places = position[:, particles]
    flows = backend.host_view(kinds.fluid)[particles]
    if solver.fluid_count > 0.0 and solver.flow.has_block and not rests:
        of_surface = backend.host_view(free.temperature)[particles]
        known = backend.host_view(kinds.active)[particles] > 0.0
        if free.moves:  # a surface that moves is known where it flows only
            known = flows > 0.0
            of_surface = np.where(known, of_surface, temperature)
        temperature = of_surface
        own = _size(backend.host_view(free.gradient), particles)
        gradient = np.where(known, own, _along_x(temperature, places))
    else:
        gradient = _along_x(temperature, places)

    # Velocity of the surface: that of the particle and half the jump to its ghost.
    level = velocity.shape[0] - 1
    jump = np.atleast_2d(backend.host_view(free.ghost_velocity_jump)[..., particles])[:level]
    speed = velocity[:level, particles] + flows * (not rests) * (0.5 * jump)
    return _AlongSurface(particles, temperature, gradient, speed[0] if level == 1 else speed)


def numbers_of(material: Material) -> dict[str, float]:
    """Numbers of the liquid that `FlowView` has and no step changes, each taken at one temperature:
    conductivity [W/(m K)] and d gamma/dT [N/(m K)], 0 where it is not known."""
    T = material.flow_temperature
    has_slope = material.surface_tension_slope is not None or material.surface_tension is not None
    return {
        "conductivity": float(material.conductivity_at(T)),
        "surface_tension_slope": float(material.surface_tension_slope_at(T)) if has_slope else 0.0,
    }


def _along_x(temperature: np.ndarray, position: np.ndarray) -> np.ndarray:
    """Derivative along a surface of values (s,) at places (d, s) in order of x [K/m]; 0 in 3-D,
    where they lie in no line."""
    if position.shape[0] == 3:
        return np.zeros_like(temperature)
    return np.gradient(temperature, position[0])


def _size(gradient: np.ndarray, surface: np.ndarray) -> np.ndarray:
    """(s,) dT/dx of some particles in a plane, the size of their gradient in 3-D [K/m]."""
    found = np.atleast_2d(gradient[..., surface])
    return found[0] if found.shape[0] < 3 else np.sqrt(np.sum(found * found, axis=0))


def _recoil(case: Case) -> Callable[[np.ndarray], np.ndarray] | None:
    """Recoil [Pa] at temperatures [K]: 0.54 p_sat(T); with a flux of vapor, what of it exceeds the
    surroundings."""
    vapor = case.material.vaporization
    if vapor is None or vapor.molar_mass is None:
        return None
    # Against a vacuum the recoil is 0.54 p_sat; against surroundings what exceeds their pressure.
    has_flux = case.solver.has_vapor_flux
    ambient = case.boundaries.pressure_of_surroundings if has_flux else None
    return partial(recoil_at, metal=vapor, ambient=ambient)
