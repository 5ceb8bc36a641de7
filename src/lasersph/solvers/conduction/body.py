"""The body that conducts: particles at rest, their pairs assembled once, and what heats them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from lasersph.boundaries import Boundaries
from lasersph.boundaries.held_faces import HeldFace, face_pulls
from lasersph.compute.backend import Backend
from lasersph.lasers import Laser
from lasersph.linear_solvers.conjugate_gradient import PairOperator
from lasersph.materials import Material
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.particles import Domain, Lattice
from lasersph.particles.filling import FREE, HELD, IMAGE, PERIODIC, Filling, fill
from lasersph.particles.layers import Layers
from lasersph.particles.neighbors import find_neighbors
from lasersph.particles.support import arithmetic, graded
from lasersph.physics.heating import Irradiation
from lasersph.sph.kernels import kernel
from lasersph.sph.laplacian import layered_weight, weight
from lasersph.sph.second_moment import layer_factors

KINDS = {
    "adiabatic": IMAGE, "periodic": PERIODIC, "free": FREE,
    "fixed-temperature": HELD, "wall": HELD,
}  # fmt: skip
SUPPORT = {"quintic-spline": 3.75, "cubic-spline": 3.0, "wendland-c2": 3.0}


@dataclass(frozen=True)
class Body:
    """All that stays the same during a run.

    Attributes:
        filling: host arrays of the particles. pairs: assembled weights g_ij [m^(d-2)].
        mass: (n,) [kg per (3 - d) lengths]. wall_flow, wall_heat: (n,) sums over held
            faces of A_i P_w and A_i T_w.
        area: (n,) exposed cross-section of surface particles [m^(d-1)], 0 for all others.
        tables: nodes of the caloric curve as tables of the backend.
    """

    backend: Backend
    filling: Filling
    material: Material
    curve: CaloricCurve
    irradiation: Irradiation
    pairs: PairOperator
    mass: Any
    wall_flow: Any
    wall_heat: Any
    area: Any
    tables: dict[str, Any]
    ambient: dict[str, float]

    @property
    def count(self) -> int:
        """Number of particles."""
        return self.filling.count


def assemble(
    backend: Backend,
    *,
    domain: Domain,
    lattice: Lattice,
    layers: Layers,
    boundaries: Boundaries,
    material: Material,
    laser: Laser | None,
    curve: CaloricCurve,
    use_second_moment: bool,
) -> Body:
    """Fill the domain, find the pairs, and assemble their weights."""
    faces = {"surface": boundaries.surface, "bottom": boundaries.bottom, "sides": boundaries.sides}
    filling = fill(layers, **{face: KINDS[kind] for face, kind in faces.items()})
    held = [
        HeldFace(face, boundaries.temperature_of(face, curve.initial_temperature), kind == "wall")
        for face, kind in faces.items()
        if KINDS[kind] == HELD
    ]
    pairs, pulls = _pairs(backend, domain, lattice, layers, filling, held, use_second_moment)
    count = filling.count
    wall_flow, wall_heat = np.zeros(count), np.zeros(count)
    for face in held:
        wall_flow += pulls[face.name] * _potential(curve, face.temperature)
        wall_heat += pulls[face.name] * face.temperature
    area = np.zeros(count)
    area[filling.surface] = np.prod(filling.width[:-1, filling.surface], axis=0)
    ambient = boundaries.ambient_temperature
    return Body(
        backend=backend,
        filling=filling,
        material=material,
        curve=curve,
        irradiation=Irradiation(backend, laser, material, filling),
        pairs=pairs,
        mass=backend.asarray(material.density_reference * filling.volume[:count]),
        wall_flow=backend.asarray(wall_flow),
        wall_heat=backend.asarray(wall_heat),
        area=backend.asarray(area),
        tables={
            "h_nodes": backend.asarray(curve.enthalpy),
            "T_nodes": backend.asarray(curve.temperature),
            "P_nodes": backend.asarray(curve.potential),
            "m_nodes": backend.asarray(curve.melt_fraction),
            "v_nodes": backend.asarray(curve.vapor_fraction),
        },
        ambient={
            "T_a": curve.initial_temperature if ambient is None else ambient,
            "h_c": boundaries.convection,
            "eps": boundaries.emissivity,
        },
    )


def _potential(curve: CaloricCurve, temperature: float) -> float:
    """Heat potential of a wall [W/m]; the end segments continue, flat where T is held."""
    rising = np.concatenate([[True], np.diff(curve.temperature) > 0.0])
    T, P = curve.temperature[rising], curve.potential[rising]
    if temperature < T[0]:
        return float(P[0] + (P[1] - P[0]) / (T[1] - T[0]) * (temperature - T[0]))
    if temperature > T[-1] and rising[-1]:
        return float(P[-1] + (P[-1] - P[-2]) / (T[-1] - T[-2]) * (temperature - T[-1]))
    return float(np.interp(temperature, T, P))


def _pairs(
    backend: Backend,
    domain: Domain,
    lattice: Lattice,
    layers: Layers,
    filling: Filling,
    held: list[HeldFace],
    use_second_moment: bool,
) -> tuple[PairOperator, dict[str, Any]]:
    """Weights of all pairs, dummies folded onto the particles that they stand for."""
    dimension = layers.dimension
    ratio = lattice.support_ratio or SUPPORT[lattice.kernel]
    shape = kernel(lattice.kernel, dimension)
    mean = graded if lattice.arrangement == "graded" else arithmetic
    fields = {"V": backend.asarray(filling.volume)}
    neighbors = find_neighbors(
        backend,
        backend.asarray(filling.position),
        backend.asarray(ratio * filling.width[-1]),
        filling.count,
        kernel=shape,
        mean=mean,
    )
    weights = backend.zeros(backend.to_host(neighbors.neighbor).size)
    if use_second_moment:
        normal, lateral = layer_factors(layers, shape, ratio, mean).at(filling.layer)
        fields |= {
            "layer": backend.asarray(filling.layer),
            "normal": backend.asarray(normal),
            "lateral": backend.asarray(lateral),
        }
        up = (0.0,) * (dimension - 1) + (1.0,)
        backend.pair_values(layered_weight, neighbors, fields, weights, up=up)
    else:
        backend.pair_values(weight, neighbors, fields, weights)
    row_start = backend.to_host(neighbors.row_start).astype(np.int64)
    row = np.repeat(np.arange(filling.count), np.diff(row_start))
    host = backend.to_host(weights)
    pulls = face_pulls(
        held, filling, host, row, backend.to_host(neighbors.neighbor), layers.bounds,
        float(layers.thickness.sum()),
    )  # fmt: skip
    total = np.bincount(row, host, minlength=filling.count)
    pull = sum(pulls.values(), np.zeros(filling.count))
    operator = PairOperator(
        neighbors=neighbors.folded(backend, backend.asarray(filling.source, "index")),
        weights=backend.asarray(host),
        pull=backend.asarray(pull),
        total=backend.asarray(total),
    )
    return operator, pulls
