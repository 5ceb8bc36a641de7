"""The body that conducts: particles at rest, their pairs assembled once, and what heats them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries import Boundaries
from lasersph.boundaries.settings import Surroundings
from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.irradiation.hot_light import HotLight
from lasersph.irradiation.layered import LayeredLight
from lasersph.lasers import Laser
from lasersph.linear_solvers.conjugate_gradient import PairOperator
from lasersph.materials import Material
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.materials.hot_optics import HotOptics
from lasersph.particles import Lattice
from lasersph.particles.extended_lattice import DIRICHLET, FREE, MIRROR, PERIODIC
from lasersph.particles.faces import ENDS
from lasersph.particles.filling import Filling, fill
from lasersph.particles.layers import Layers
from lasersph.particles.neighbor_lists import NeighborList, find_neighbors
from lasersph.particles.particles import Particles
from lasersph.particles.support import arithmetic, graded
from lasersph.physics.phase_change import state_near
from lasersph.solvers.conduction.walls import walls_of
from lasersph.sph.even_rings import RingPairs, ring_additions
from lasersph.sph.face_weights import PairRows, pairs_beside, without_joined
from lasersph.sph.kernels import Kernel, kernel
from lasersph.sph.laplacian import layered_weight, weight
from lasersph.sph.rings import evened_ring_weight, ring_weight
from lasersph.sph.second_moment import layer_exchange, layer_factors
from lasersph.surface.surface import upward

KINDS = {"adiabatic": MIRROR, "prescribed-flux": MIRROR, "periodic": PERIODIC, "free": FREE}
KINDS |= {"fixed-temperature": DIRICHLET, "wall": DIRICHLET}
"""Continuation of the body beyond a face of each kind."""
HISTORY = ("enthalpy", "enthalpy_excess", "enthalpy_before", "enthalpy_two_before")
"""Fields from which a step is predicted."""
DERIVED = ("temperature", "potential", "melt_fraction", "vapor_fraction")


@dataclass(frozen=True)
class Body:
    """The particles of a run, and all that stays the same.

    Attributes:
        filling: host arrays of the lattice. particles: their fields, at rest at the initial
            temperature, h = 0. pairs: assembled weights g_ij [m^(d-2)]. wall_flow, wall_heat:
            (n,) sums over the pairs with Dirichlet faces of weight times P_w and times T_w.
            wall_power: (n,) power of prescribed fluxes [W per (3 - d) lengths].
        area: (n,) exposed cross-section of surface particles [m^(d-1)], 0 for all others.
        tables: nodes of the caloric curve as tables of the backend. segment: (n,) number of that of
            the curve in which an enthalpy lay last, where it is looked for first. free: (n,) 1 for
            particles whose pairs may be found anew, 0 for coarse columns and what they touch; None
            for all.
    """

    backend: Backend
    filling: Filling
    particles: Particles
    material: Material
    curve: CaloricCurve
    light: LayeredLight
    pairs: PairOperator
    wall_flow: Array
    wall_heat: Array
    wall_power: Array
    area: Array
    tables: dict[str, Array]
    segment: Array
    surroundings: Surroundings
    free: Array | None = None
    additions: Array | None = None

    @property
    def count(self) -> int:
        """Number of particles."""
        return self.filling.count

    def update_temperature(self) -> None:
        """Set temperature, potential and fractions from the enthalpy."""
        particles = self.particles
        fields = {"h": particles["enthalpy"], "guess": self.segment}
        out = (*(particles[name] for name in DERIVED), self.segment)
        self.backend.pointwise(state_near, fields, out, **self.tables)


def assemble(
    backend: Backend,
    *,
    lattice: Lattice,
    layers: Layers,
    boundaries: Boundaries,
    material: Material,
    laser: Laser | None,
    curve: CaloricCurve,
    use_second_moment: bool,
    hot: HotOptics | None = None,
) -> Body:
    """Fill the domain, find the pairs, and assemble their weights.

    Args:
        hot: how hot electrons take up the light, where they change it.
    """
    # particles with dummies beyond the faces, pairs and weights g_ij
    ends = {face: KINDS[boundaries.kind_of(face)] for face in ENDS}
    filling = fill(layers, sides=KINDS[boundaries.sides], **ends)
    weighing = weighing_of(lattice, layers, use_second_moment=use_second_moment)
    neighbors, pairs, additions = _weights(backend, weighing, filling)
    crossing = None
    if filling.beside is not None:
        pairs, crossing = pairs_beside(filling, pairs)

    # faces: A, sum of A P_w, sum of A T_w and b; their pairs weigh 0 from then on
    row, neighbor, weights = pairs
    walls = walls_of(boundaries, curve, layers, filling, weights, row, neighbor)
    count = filling.count
    free = None
    if crossing is not None:
        is_free = np.arange(count) < filling.fine_count
        is_free[crossing.row] = False
        free = backend.asarray(is_free.astype(float))
        pairs = without_joined(filling, pairs, crossing)
        row, weights = pairs.row, pairs.weight
        neighbors = _listed(backend, weighing, filling, pairs)

    # operator of the pairs between particles, sum_j g_ij (P_j - P_i) - A_i P_i
    operator = PairOperator(
        neighbors=neighbors.without_ghosts(backend, backend.asarray(filling.source, "index")),
        weights=backend.asarray(weights),
        boundary_coefficient=backend.asarray(walls.coefficient),
        total=backend.asarray(np.bincount(row, weights, minlength=count)),
    )

    # cross-section of surface particles that light and losses pass
    area = np.zeros(count)
    area[filling.surface] = filling.cross_section[filling.surface]

    # fields at rest at the initial temperature, h = 0
    fields = ("mass", *HISTORY, "evaporated_mass", *DERIVED)
    particles = Particles(backend, count, layers.dimension, fields)
    particles.set("mass", material.density_reference * filling.body_volume)

    # the light, and caloric curve as tables of the backend
    if hot is None:
        light = LayeredLight(backend, laser, material, filling)
    else:
        light = HotLight(backend, laser, material, filling, hot)
    body = Body(
        backend=backend,
        filling=filling,
        particles=particles,
        material=material,
        curve=curve,
        light=light,
        pairs=operator,
        wall_flow=backend.asarray(walls.flow),
        wall_heat=backend.asarray(walls.heat),
        wall_power=backend.asarray(walls.power),
        area=backend.asarray(area),
        tables={name: backend.asarray(nodes) for name, nodes in curve.tables.items()},
        segment=backend.zeros(count),
        surroundings=boundaries.surroundings(material, curve.initial_temperature),
        free=free,
        additions=additions,
    )
    body.update_temperature()
    return body


@dataclass(frozen=True)
class Weighing:
    """How the pairs of a lattice of layers are weighed.

    Attributes:
        kernel, mean: of the list. ratio: support radius over thickness. function: pair function of
            g_ij with its constants. factors: layer numbers (k,) -> factors N and a (k,).
            exchange: by which layers of a plane exchange heat; None where rings stay as printed.
    """

    kernel: Kernel
    mean: Callable[[float, float], float]
    ratio: float
    function: Callable[..., Any]
    constants: dict[str, Any]
    factors: Callable[[NDArray[np.int64]], tuple[NDArray[np.float64], NDArray[np.float64]]]
    exchange: Callable[[], NDArray[np.float64]] | None = None


def weighing_of(lattice: Lattice, layers: Layers, *, use_second_moment: bool) -> Weighing:
    """The rule of a lattice, corrected to conduct exactly or as printed."""
    ratio = lattice.support_over_spacing
    shape = kernel(lattice.kernel, layers.dimension)
    mean = graded if lattice.arrangement == "graded" else arithmetic
    if not use_second_moment:
        return Weighing(shape, mean, ratio, weight, {}, _equal_factors)
    # factors N and a of each layer, by which a linear profile conducts exactly
    up = upward(layers.dimension)
    stack = layers, shape, ratio, mean
    factors, exchange = layer_factors(*stack), partial(layer_exchange, *stack)
    return Weighing(shape, mean, ratio, layered_weight, {"up": up}, factors.at, exchange)


def _equal_factors(layer: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Factors that change nothing."""
    return layer.astype(float), np.ones(layer.size)


def _weights(
    backend: Backend, weighing: Weighing, filling: Filling
) -> tuple[NeighborList, PairRows, Array | None]:
    """Pairs of the fine particles with dummies: the list, rows and weights on the host, and
    additions to those of rings."""
    # fine particles and their dummies
    seen = filling.fine_numbers
    layer = filling.layer[seen]

    # g_ij of all of them
    normal, lateral = weighing.factors(layer)
    fields = {
        "V": backend.asarray(filling.volume[seen]),
        "layer": backend.asarray(layer),
        "normal": backend.asarray(normal),
        "lateral": backend.asarray(lateral),
    }
    neighbors = find_neighbors(
        backend,
        backend.asarray(filling.position[:, seen]),
        backend.asarray(weighing.ratio * filling.width[-1, seen]),
        filling.fine_count,
        kernel=weighing.kernel,
        mean=weighing.mean,
    )
    weights = backend.zeros(backend.to_host(neighbors.neighbor).size)
    backend.pair_values(weighing.function, neighbors, fields, weights, **weighing.constants)

    # row of each pair, on the host, where faces are assembled
    row_start = backend.to_host(neighbors.row_start).astype(np.int64)
    row = np.repeat(np.arange(filling.fine_count), np.diff(row_start))
    neighbor = backend.to_host(neighbors.neighbor)
    if filling.beside is not None:
        neighbor = np.arange(filling.position.shape[1])[seen][neighbor]
    additions = None
    # pairs of rings pass on heat through the mean ring, along z as those of a plane
    if filling.is_axisymmetric:
        rings = {"g_ij": weights, "measure": backend.asarray(filling.measure[seen])}
        backend.pair_values(ring_weight, neighbors, rings, weights)
        if weighing.exchange is not None:
            pairs = PairRows(row, neighbor, backend.to_host(weights))
            has_none = _stands_for_no_ring(filling)
            found = _additions(filling, pairs, has_none, weighing.exchange())
            additions = backend.asarray(found.ravel())
            rings = {"g_ij": weights, "layer": fields["layer"]}
            rings["ring"] = backend.asarray(filling.source[seen].astype(float))
            rings["has_none"] = backend.asarray(has_none[seen].astype(float))
            table: Constants = {"additions": additions, "layers": float(_last_layer(filling) + 1)}
            backend.pair_values(evened_ring_weight, neighbors, rings, weights, **table)
    return neighbors, PairRows(row, neighbor, np.array(backend.to_host(weights))), additions


def _last_layer(filling: Filling) -> int:
    """Number of the lowest layer."""
    return int(filling.layer[: filling.count].max())


def _stands_for_no_ring(filling: Filling) -> NDArray[np.bool_]:
    """(N,) dummies without additions: of given temperature, or in the place of coarse columns."""
    has_none = filling.dirichlet > 0
    if filling.beside is not None:
        has_none[filling.beside.joined] = True
    return has_none


def _additions(
    filling: Filling,
    pairs: PairRows,
    has_none: NDArray[np.bool_],
    exchange: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Additions of the rings, with which they conduct along z as layers of a plane do."""
    # dummies have those of their sources
    i, j, layer = pairs.row, pairs.neighbor, filling.layer
    other = np.where(has_none[j], -1, filling.source[j].astype(np.int64))
    # layers between both, and as a mirrored layer sees them
    steps = layer[j] - layer[i]
    is_mirrored = (layer[j] < 0) | (layer[j] > _last_layer(filling))
    back = np.where(is_mirrored, steps, -steps)
    # what each ring gives a layer of a plane
    count = filling.fine_count
    wanted = filling.cross_section[:count, None] * exchange[layer[:count]]
    return ring_additions(RingPairs(i, other, steps, back, pairs.weight), wanted)


def _listed(
    backend: Backend, weighing: Weighing, filling: Filling, pairs: PairRows
) -> NeighborList:
    """Pairs of the whole body as a list."""
    start = np.concatenate([[0], np.cumsum(np.bincount(pairs.row, minlength=filling.count))])
    return NeighborList(
        backend.asarray(start, "offset"),
        backend.asarray(pairs.neighbor, "index"),
        backend.asarray(filling.position),
        backend.asarray(weighing.ratio * filling.width[-1]),
        weighing.kernel,
        weighing.mean,
    )
