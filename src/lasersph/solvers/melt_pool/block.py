"""The block of particles that may move, their ghosts, and their pairs.

The layers from the surface down to some depth below the melt form the block; they have the first
numbers. Its pairs are searched in every step, those of the particles below stay as they are. A
margin of resting layers below the moving rows belongs to the block, so that every moving particle
finds all its neighbors there. Fields of the block with ghosts are gathers of the particles' own:

    f_extended[k] = f[source[k]]

where a particle of the block is its own source.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from lasersph.boundaries.surface import Surface
from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, outer
from lasersph.particles.faces import LEFT
from lasersph.particles.ghosts import LOWER, UPPER, GhostParticles, ghost_types_of
from lasersph.particles.neighbor_lists import Box, NeighborList, find_neighbors
from lasersph.solvers.conduction.body import Weighing
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.near_melt import NearMelt

SKIN = 1.02
"""Search radius over the support radius: positions change a little within a step."""


def ghost_position(x, sign, offset):
    """Place of a ghost [m]; sign 1 and offset 0 for a particle itself."""
    return sign * x + offset


def ghost_velocity(v, factor, added, slope, jump, along):
    """Velocity of a ghost [m/s]: S v + c, and the slope of a stressed surface.

    Args:
        jump: 2 d tau / eta of the source [m/s]. along: tangent of the surface.
    """
    return factor * v + added + slope * jump * along


def ghost_tensor(M, sign):
    """Tensor of a ghost, S M S with the signs on the diagonal of S."""
    return outer(sign, sign) * M


def wall_terms(g_ij, dirichlet_j, P_w_j, T_w_j, flux_j, normal_j, plane_j, x_i, x_j):
    """Share of a pair in the boundary coefficient A [m^(d-2)], A P_w, A T_w and the power b.

    Beyond a Dirichlet face c_ij = n_ij / n_i times the weight, n normal to the face; beyond a
    Neumann face 2 q n_j times the weight.
    """
    n_i = max(plane_j - dot(x_i, normal_j), 1.0e-30)
    n_j = dot(x_j, normal_j) - plane_j
    A = dirichlet_j * g_ij * (n_i + n_j) / n_i
    return A, A * P_w_j, A * T_w_j, 2.0 * (1.0 - dirichlet_j) * g_ij * flux_j * n_j


def inner_weight(g_ij, dirichlet_j):
    """Weight of a pair that conducts between particles: 0 toward ghosts beyond a Dirichlet face."""
    return g_ij * (1.0 - dirichlet_j)


def ghost_layer(value, base, sign):
    """Number of a layer or its factor as ghosts have it: base + sign * value."""
    return base + sign * value


def distance(r_ij):
    """Distance of a pair [m]."""
    return r_ij


def weight_of(g_ij):
    """Weight of a pair, for its sum over the neighbors."""
    return g_ij


@dataclass(frozen=True)
class StaticParticleData:
    """What stays the same of particles that move, host arrays by number.

    Attributes:
        support: (n,) [m]. volume: (n,) [m^2]. layer: (n,). layers: how many there are.
        weighing: how pairs are weighed.
    """

    support: np.ndarray
    volume: np.ndarray
    layer: np.ndarray
    layers: int
    weighing: Weighing


class Block:
    """Particles 0 ... count - 1 with their ghosts and pairs.

    Args:
        lattice: what stays the same of the particles. conditions: at the faces. surface: None in
            a box without.
        layers, complete_rows: layers and particles whose pairs are all in the block. count:
            particles with the margin below them. bottom: z of its lowest face [m]. has_bottom:
            whether that is the bottom of the domain.
        potential, enthalpy: heat potential [W/m] and enthalpy [J/kg] of a wall's temperature [K].

    Attributes:
        source: (M,) particle behind each of the block with ghosts. pairs: NeighborList with the
            rows of the block, among all M. weights: (pairs,) g_ij [1] at the last positions.
        moving_support: of the particles that move, the finest [m]. search_radius: largest of
            the block [m].
        ghosts: of its particles. rows: numbers of the particles whose pairs were found, has_row:
            (count,) 1 for them.
    """

    def __init__(
        self,
        backend: Backend,
        lattice: StaticParticleData,
        conditions: FaceConditions,
        surface: Surface | None,
        *,
        layers: int,
        complete_rows: int,
        count: int,
        bottom: float,
        has_bottom: bool,
        potential: Callable[[np.ndarray], np.ndarray],
        enthalpy: Callable[[np.ndarray], np.ndarray],
    ) -> None:
        self.backend, self.lattice, self.conditions = backend, lattice, conditions
        self.layers, self.complete_rows, self.count = layers, complete_rows, count
        self.has_bottom, self.surface = has_bottom, surface
        self._tangent = (1.0, 0.0) if surface is None else surface.tangent
        self.potential, self.enthalpy = potential, enthalpy
        self.volume = backend.asarray(lattice.volume[:count])
        support = lattice.support[:count]
        self.moving_support, largest = float(support.min()), float(support.max())
        self.search_radius = SKIN * largest
        self._own_support = backend.asarray(support), backend.asarray(SKIN * support)
        (x, z), repeats = conditions.box, conditions.flow_kind(LEFT) == "periodic"
        self._bounds = x, (max(z[0], bottom), z[1])
        near = SKIN * float(lattice.weighing.mean(self.moving_support, largest))
        self._near_melt = NearMelt(backend, count, self._bounds, near, repeats=repeats)
        types = ghost_types_of(conditions.ghost_faces(has_bottom=has_bottom))
        self.ghosts = GhostParticles(backend, count, self.search_radius, types)
        self._set_rules()
        self._set_factors()

    def _set_rules(self) -> None:
        """Tables of what ghosts carry."""
        ghosts = self.ghosts
        rules = self.conditions.rules(ghosts.ghost_types, self.surface)
        self.has_walls = bool(rules.dirichlet.any() or rules.flux.any())
        names = ("factor", "added", "slope", "dirichlet", "flux", "normal", "plane")
        self._rules = {name: ghosts.table(getattr(rules, name)) for name in names}
        is_ghost = np.arange(ghosts.ghost_types.count) > 0
        for name, values in self._wall_state(rules.wall_temperature).items():
            self._rules[name] = ghosts.table(is_ghost * values)
        self._varies = ghosts.table(rules.varies) if rules.varies.any() else None

    def _wall_state(self, temperature: np.ndarray) -> dict[str, np.ndarray]:
        """Temperature, heat potential and enthalpy of walls."""
        return {
            "T_w": temperature,
            "P_w": self.potential(temperature),
            "wall_enthalpy": self.enthalpy(temperature),
        }

    def _set_factors(self) -> None:
        """Layers and factors of the particles, and of their ghosts, as tables.

        Beyond surface and bottom the factors of `sph.second_moment` are mirrored, however deep the
        layer is from which a particle came there.
        """
        backend, lattice, ghosts = self.backend, self.lattice, self.ghosts
        layer, last = lattice.layer[: self.count], lattice.layers - 1
        normal, lateral = lattice.weighing.factors(layer)
        ends, _ = lattice.weighing.factors(np.array([-1, 0, last, last + 1]))
        crossed = ghosts.ghost_types.crossed[1]
        is_up, is_down = crossed == UPPER, crossed == LOWER
        sign = ghosts.table(np.where(is_up | is_down, -1.0, 1.0))
        bases = {
            "layer": -1.0 * is_up + (2.0 * last + 1.0) * is_down,
            "normal": ends[:2].sum() * is_up + ends[2:].sum() * is_down,
        }
        self._factors = {
            name: (backend.asarray(values), ghosts.table(bases[name]), sign)
            for name, values in (("layer", layer), ("normal", normal))
        }
        self._lateral = backend.asarray(lateral)

    def gather(self, field: Array) -> Array:
        """The field of all particles on the block with ghosts: (..., n) to (..., M)."""
        out = self.backend.zeros((*field.shape[:-1], self.total))
        self.backend.gather(field, self.source, out)
        return out

    def find_pairs(self, position: Array, has_row: Array) -> None:
        """Find ghosts of the particles at `position`, shape (2, n) [m], and pairs of chosen ones.

        Args:
            has_row: (count,) 1 where the pairs of a particle are to be found, else 0.

        Raises:
            EscapedParticle: a position is not finite or beyond the faces.
        """
        backend, lattice, ghosts = self.backend, self.lattice, self.ghosts
        self.has_row, self.rows = has_row, backend.rows_where(has_row, 1.0)
        ghosts.find(position)
        self.total, self.source = ghosts.total, ghosts.source
        self.rules = {name: ghosts.by_type(table) for name, table in self._rules.items()}
        self.V = self.gather(self.volume)
        self.support, radius = (self.gather(own) for own in self._own_support)
        self._weighing = {"V": self.V, "lateral": self.gather(self._lateral)}
        for name, (values, base, sign) in self._factors.items():
            value = self._weighing[name] = self.gather(values)
            fields = {"value": value, "base": ghosts.by_type(base), "sign": ghosts.by_type(sign)}
            backend.pointwise(ghost_layer, fields, value)
        place = self._place(position)
        self._vary(place)
        how = {"kernel": lattice.weighing.kernel, "mean": lattice.weighing.mean}
        how["box"] = Box(self._corner(0), self._corner(1), (0.0, 0.0))
        self.pairs = find_neighbors(
            backend, place, self.support, self.count, radius=radius, wanted=self.rows, **how
        )
        neighbor = self.pairs.neighbor
        self._folded = backend.zeros(neighbor.shape[0], "index")
        backend.gather(self.source, neighbor, self._folded)
        self.weights = backend.zeros(neighbor.shape[0])
        self._weigh()

    def _vary(self, place: Array) -> None:
        """State of the ghosts beyond a face whose temperature varies along it.

        Found on the host: it is that of few ghosts, and curves of the material.
        """
        if self._varies is None:
            return
        backend = self.backend
        rows = backend.rows_where(self.ghosts.by_type(self._varies), 1.0)
        chosen = backend.zeros((2, rows.shape[0]))
        backend.gather(place, rows, chosen)
        T = self.conditions.varying_temperature(backend.to_host(chosen)[0])
        for name, values in self._wall_state(T).items():
            backend.scatter(backend.asarray(values), rows, self.rules[name])

    def move(self, position: Array) -> None:
        """The same pairs at other positions."""
        self.pairs = replace(self.pairs, position=self._place(position))
        self._weigh()

    def without_ghosts(self) -> NeighborList:
        """The pairs with every ghost replaced by its source."""
        return self.pairs.with_neighbors(self.backend, self._folded)

    def extend_velocity(self, v: Array, jump: Array) -> Array:
        """Velocities (2, M) from those of the particles (2, n) [m/s].

        Args:
            jump: (n,) 2 d tau / eta [m/s].
        """
        extended = self.gather(v)
        fields = {"v": extended, "jump": self.gather(jump)} | self.rules
        self.backend.pointwise(ghost_velocity, fields, extended, along=self._tangent)
        return extended

    def mirror_velocity(self, v: Array, jump: Array) -> Array:
        """Velocities (2, n) on the block with ghosts as mirrors at the walls show them [m/s].

        Beyond a stressed surface they continue the profile: mirrored, it would bend there, and its
        divergence with it. Args as of `extend_velocity`.
        """
        extended = self.gather(v)
        fields = {"v": extended, "factor": self.ghosts.sign, "jump": self.gather(jump)}
        fields["slope"], along = self.rules["slope"], self._tangent
        self.backend.pointwise(ghost_velocity, fields, extended, added=(0.0, 0.0), along=along)
        return extended

    def extend_tensor(self, M: Array) -> Array:
        """Tensors (2, 2, count) of the block on the block with ghosts."""
        extended = self.gather(M)
        fields = {"M": extended, "sign": self.ghosts.sign}
        self.backend.pointwise(ghost_tensor, fields, extended)
        return extended

    def find_near_fluid(self, position: Array, fluid: Array) -> Array:
        """(count,) 1 for particles within the support of a fluid one, or nearly; see `near_melt`.

        Args:
            position: (2, n) [m]. fluid: (n,) 1 where a particle flows or did so one step ago.

        Raises:
            EscapedParticle: a position is not finite or beyond the faces.
        """
        return self._near_melt.find(position, fluid)

    def smallest_distance(self, position: Array, rows: Array) -> float:
        """Smallest distance from one of `rows` to another particle or ghost [m]."""
        pairs = replace(self.pairs, position=self._place(position))
        (least,) = self.backend.pair_sum(
            distance, pairs, {}, (None,), rows=rows, combine=("min",), reduce=("min",)
        )
        return least

    def _place(self, position: Array) -> Array:
        place = self.gather(position)
        fields = {"x": place, "sign": self.ghosts.sign, "offset": self.ghosts.offset}
        self.backend.pointwise(ghost_position, fields, place)
        return place

    def _weigh(self) -> None:
        weighing = self.lattice.weighing
        self.backend.pair_values(
            weighing.function, self.pairs, self._weighing, self.weights, **weighing.constants
        )

    def _corner(self, end: int) -> tuple[float, ...]:
        """Box that no particle and no ghost may leave [m]."""
        outward = -1.0 if end == 0 else 1.0
        return tuple(pair[end] + outward * self.search_radius for pair in self._bounds)
