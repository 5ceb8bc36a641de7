"""Fields of a snapshot of all particles."""

from __future__ import annotations

import numpy as np

from lasersph.observers.view import View
from lasersph.particles.fields import FIELDS

NAMES = (
    *("temperature", "mass", "enthalpy", "melt_fraction", "vapor_fraction", "width", "surface"),
    *("velocity", "speed", "pressure", "flows", "surface_temperature", "surface_gradient"),
    *("electron_temperature", "electron_energy"),
    *("surface_velocity", "lid_pressure", "density", "vapor_pressure", "normal", "stage"),
)
"""Fields of a snapshot; each solver writes those that it has."""
UNITS = {name: FIELDS[name].unit for name in NAMES}
"""Their units."""


def snapshot_fields(view: View) -> dict[str, np.ndarray]:
    """Fields of a snapshot beside the positions: see `UNITS`.

    Mass and enthalpy have the precision of the run, so that a reader finds the stored heat of the
    summary again (mass is that of the particle, without mirror images); the others are in single
    precision. With flow the fields of the surface above the particles (`surface_temperature`, ...)
    are 0 for particles that do not lie at it. With ablation `stage` tells ejecta from the body, see
    `AblationView`.
    """
    # bytes mark the particles at the surface
    count = view.temperature.size
    surface = np.zeros(count, dtype=np.uint8)
    surface[view.surface] = 1
    fields = {
        "temperature": view.temperature,
        "melt_fraction": view.melt_fraction,
        "vapor_fraction": view.vapor_fraction,
        "width": view.width,
    }
    marks = {"surface": surface}
    # hot electrons
    if view.electrons is not None:
        fields["electron_temperature"] = view.electrons.temperature
        fields["electron_energy"] = view.electrons.energy
    # a flow has fields of its own, at the surface as well
    if view.flow is not None:
        flow = view.flow
        fields["velocity"] = flow.velocity
        fields["speed"] = np.sqrt(np.sum(flow.velocity * flow.velocity, axis=0))
        fields["pressure"] = flow.pressure
        at_surface = {
            "surface_temperature": flow.surface_temperature,
            "surface_gradient": flow.surface_gradient,
            "surface_velocity": flow.surface_velocity,
            "lid_pressure": flow.surface_pressure,
        }
        if view.dimension == 3:  # a vector along the surface
            level = np.zeros_like(flow.surface_temperature)
            at_surface["surface_velocity"] = np.vstack([flow.surface_velocity, level])
        for name, values in at_surface.items():
            fields[name] = np.zeros((*values.shape[:-1], count))
            fields[name][..., flow.surface] = values
        marks["flows"] = flow.flows.astype(np.uint8)
    # so has matter that ablates
    if view.ablation is not None:
        seen = view.ablation
        fields["velocity"], fields["pressure"] = seen.velocity, seen.pressure
        fields["speed"] = np.sqrt(np.sum(seen.velocity * seen.velocity, axis=0))
        fields["density"], fields["vapor_pressure"] = seen.density, seen.vapor_pressure
        fields["normal"] = seen.normal
        marks["stage"] = seen.stage.astype(np.uint8)
    # mass and enthalpy in double precision: budgets are summed from them
    exact = {"mass": np.array(view.mass / view.mirror_images), "enthalpy": np.array(view.enthalpy)}
    return {**{name: a.astype(np.float32) for name, a in fields.items()}, **exact, **marks}
