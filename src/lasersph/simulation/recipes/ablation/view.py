"""The view of matter that moves and ablates: arrays where they lie, not copied.

After the first view particles that follow the last active one are left out: cold, at rest and the
deepest, since particles are numbered from the surface down.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.case import Case
from lasersph.observers.ablation_view import AblationView
from lasersph.particles.kinds import EJECTED
from lasersph.solvers.ablation.solver import Ablation


def ablation_fields(case: Case, solver: Ablation, step: int) -> dict[str, Any]:
    """Fields of `View` for matter that moves; particles of walls are left out."""
    particles, backend = solver.particles, solver.backend
    geometry, curve = solver.body.geometry, solver.body.curve
    count = _shown_count(solver) if step else particles.count
    position = backend.host_view(particles["position"])[:, :count]
    names = ("temperature", "enthalpy", "melt_fraction", "vapor_fraction")
    return {name: backend.host_view(particles[name])[:count] for name in names} | {
        "position": position,
        "width": np.broadcast_to(np.array(geometry.cell)[:, None], position.shape),
        "volume": np.broadcast_to(np.array(geometry.volume), (count,)),
        "mass": backend.host_view(particles["mass"])[:count],
        "latent_heats": curve.latent_heats,
        "surface": _surface(solver, count),
        "solidus": curve.solidus,
        "liquidus": curve.liquidus,
        "vaporization": curve.vaporization,
        "ablation": _ablation_view(case, solver, count),
    }


def _shown_count(solver: Ablation) -> int:
    """How many particles there are up to the last active one."""
    count = solver.body.count
    if solver.rows is None:
        return count
    # Indices of active particles come sorted; walls have the numbers from `count` on.
    rows = solver.backend.host_view(solver.rows)
    return int(rows[np.searchsorted(rows, count) - 1]) + 1


def _surface(solver: Ablation, count: int) -> np.ndarray:
    """Particles that the light meets; without light those of the free surface, or the first."""
    backend = solver.backend
    # The light knows which particles it meets; without light those of the free surface count.
    if solver.light is not None:
        found = backend.host_view(solver.light.hit).astype(np.int64)
        found = found[found < count]
    else:
        found = np.flatnonzero(backend.host_view(solver.surface.at_surface)[:count])
    return found if found.size else np.zeros(1, np.int64)


def _ablation_view(case: Case, solver: Ablation, count: int) -> AblationView:
    """Crater, ejecta and flow."""
    particles = solver.particles
    backend = solver.backend
    state = solver.state
    geometry = solver.body.geometry
    flying = np.zeros(0, np.int64)
    if state.ejecta.number:
        flying = backend.host_view(backend.rows_where(particles["kind"], EJECTED)).astype(np.int64)

    # Fields of the particles of the body.
    fields = {"stage": particles["kind"], "normal": solver.surface.normal}
    names = ("velocity", "density", "pressure", "vapor_pressure")
    fields |= {name: particles[name] for name in names}
    fields = {name: backend.host_view(array)[..., :count] for name, array in fields.items()}
    columns = solver.light
    dimension = geometry.dimension
    pressure, speed = solver.extremes()
    vapor = case.material.vaporization
    return AblationView(
        **fields,
        column_center=np.zeros((dimension - 1, 0)) if columns is None else columns.center,
        column_width=float(geometry.cell[0]),
        column_top=np.zeros(0) if columns is None else columns.column_tops(),
        # Fields of the flying ones, and the sums over all that has left.
        ejecta_position=backend.host_view(particles["position"])[:, flying],
        ejecta_velocity=fields["velocity"][:, flying],
        ejecta_temperature=backend.host_view(particles["temperature"])[flying],
        ejecta_mass=backend.host_view(particles["mass"])[flying],
        ejecta_time=backend.host_view(particles["leaving_time"])[flying],
        ejected_count=state.ejecta.number,
        ejected_mass=state.ejecta.mass,
        ejected_energy=state.ejecta.energy,
        ejected_kinetic=state.ejecta.kinetic,
        gone_count=state.gone,
        pressure_max=pressure,
        speed_max_condensed=speed,
        particle_mass=case.material.density_reference * geometry.volume,
        density_reference=case.material.density_reference,
        gas_constant=None if vapor is None else vapor.specific_gas_constant,
    )
