"""The block of particles that may move, their ghosts, and their pairs.

The layers from the surface down to some depth below the melt form the block; they have the first
numbers. Its pairs are searched in every step, those of the particles below stay as they are. A
margin of resting layers below the moving rows belongs to the block, so that every moving particle
finds all its neighbors there. What a ghost carries follows from its source (`ghost_fields`).

Distances, kernels and weights of the pairs are computed once for each set of positions, and kept:
root and divisions take most of the time of a sum over pairs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from lasersph.boundaries.surface import Surface
from lasersph.compute.array_types import Array, Constants, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.launch import Launch
from lasersph.compute.search import Room
from lasersph.compute.vectors import dot, element
from lasersph.particles.faces import LEFT
from lasersph.particles.ghosts import LOWER, UPPER, GhostParticles, ghost_types_of
from lasersph.particles.neighbor_lists import Box, NeighborList, find_neighbors
from lasersph.particles.support import common
from lasersph.solvers.conduction.body import Weighing
from lasersph.solvers.melt_pool import ghost_fields
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.near_melt import NearMelt
from lasersph.solvers.melt_pool.pair_geometry import PairGeometry, distance_square

SKIN = 1.02
"""Search radius over the support radius: positions change a little within a step."""


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


def both(a, b):
    """1 where both marks are."""
    return a * b


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
        fine_depth: of the layers of the finest support; what lies below rests [m].
        layers, complete_rows: layers and particles whose pairs are all in the block. count:
            particles with the margin below them. bottom: z of its lowest face [m]. has_bottom:
            whether that is the bottom of the domain.
        potential, enthalpy: heat potential [W/m] and enthalpy [J/kg] of a wall's temperature [K].

    Attributes:
        source: (M,) particle behind each of the block with ghosts. sources: these and the types,
            the fields of `ghost_fields`; signs: tables of its arguments sign_x and sign_z. rules:
            (M,) what faces mean to heat, by the names of `ghost_walls`. heat_face, wall: tables
            of these by type, see `GhostRules`.
        pairs: NeighborList with the rows of the block, among all M.
        weights: (pairs,) g_ij [1] at the last positions. gradient: (2, pairs) G_ij = V_j grad W_ij
            there [1/m]. kernel: (pairs,) V_j W_ij where the pairs were found [1].
        moving_support: of the particles that move, the finest [m]. search_radius: largest of
            the block [m].
        ghosts: of its particles. rows: numbers of the particles whose pairs were found, None for
            all of the block; has_row: (count,) 1 for them, or None. rows_near_faces: those, of
            complete rows, that may have ghosts as neighbors.
    """

    def __init__(
        self,
        backend: Backend,
        lattice: StaticParticleData,
        conditions: FaceConditions,
        surface: Surface | None,
        *,
        fine_depth: float,
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
        self._mean = common if self.moving_support == largest else lattice.weighing.mean
        self._own = {"V": self.volume, "support": backend.asarray(support)}
        self._own["radius"] = backend.asarray(SKIN * support)
        (x, z), repeats = conditions.box, conditions.flow_kind(LEFT) == "periodic"
        self._bounds = x, (max(z[0], bottom), z[1])
        near = SKIN * float(lattice.weighing.mean(self.moving_support, largest))
        self._even_above = near - fine_depth
        self._near_melt = NearMelt(backend, count, self._bounds, near, repeats=repeats)
        types = ghost_types_of(conditions.ghost_faces(has_bottom=has_bottom))
        self.ghosts = GhostParticles(backend, count, self.search_radius, types)
        self._set_rules()
        self._set_factors()
        self._geometry, self._room = PairGeometry(backend, lattice.weighing), Room()

    def _set_rules(self) -> None:
        """Tables of what ghosts carry, by their type."""
        ghosts, types = self.ghosts, self.ghosts.ghost_types
        rules = self.conditions.rules(types, self.surface)
        self.has_walls = bool(rules.dirichlet.any() or rules.flux.any())
        self.signs = ghosts.tables("sign_x", "sign_z", types.sign)
        self._offsets = ghosts.tables("offset_x", "offset_z", types.offset)
        slope = {"slope": ghosts.table(rules.slope), "along": self._tangent}
        self._factors = ghosts.tables("factor_x", "factor_z", rules.factor)
        self._velocity = self._factors | ghosts.tables("added_x", "added_z", rules.added) | slope
        self._mirror = ghosts.tables("factor_x", "factor_z", types.sign) | slope
        self._mirror |= ghosts.tables("added_x", "added_z", 0.0 * rules.added)
        self._walls = ghosts.tables("normal_x", "normal_z", rules.normal)
        for name in ("dirichlet", "flux", "plane"):
            self._walls[name] = ghosts.table(getattr(rules, name))
        is_ghost = np.arange(types.count) > 0
        for name, values in self._wall_state(rules.wall_temperature).items():
            self._walls[name] = ghosts.table(is_ghost * values)
        self._varies = ghosts.table(rules.varies) if rules.varies.any() else None
        self.heat_face, self.wall = ghosts.table(rules.heat_face), ghosts.table(rules.wall)

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
        factors = {
            "layer": layer,
            "normal": normal,
            "lateral": lateral,
            "sign": np.where(is_up | is_down, -1.0, 1.0),
            "layer_base": -1.0 * is_up + (2.0 * last + 1.0) * is_down,
            "normal_base": ends[:2].sum() * is_up + ends[2:].sum() * is_down,
        }
        self._own |= {name: backend.asarray(values) for name, values in factors.items()}

    def gather(self, field: Array) -> Array:
        """The field of all particles on the block with ghosts: (..., n) to (..., M)."""
        out = self.backend.zeros((*field.shape[:-1], self.total))
        self.backend.gather(field, self.source, out)
        return out

    def of_type(self, table: Array) -> Array:
        """(M,) values by the type of each particle."""
        out, fields = self.backend.zeros(self.total), {"place": self.ghosts.ghost_type}
        self.backend.pointwise(element, fields, out, table=table)
        return out

    def extend(self, function: Callable, tables: Constants) -> Array:
        """Vectors (2, M) by a function of `ghost_fields`."""
        out = self.backend.zeros((2, self.total))
        self.backend.pointwise(function, self.sources, out, **tables)
        return out

    def find_pairs(
        self, position: Array, has_row: Array | None, *, has_kernel: bool = False
    ) -> None:
        """Find ghosts of the particles at `position`, shape (2, n) [m], and pairs of chosen ones.

        Args:
            has_row: (count,) 1 where the pairs of a particle are to be found, else 0; None for all.
            has_kernel: whether `kernel` is set. Heat takes the weights of loops without it, so that
                they are the same bits when a run is resumed.

        Raises:
            EscapedParticle: a position is not finite or beyond the faces.
        """
        backend, ghosts = self.backend, self.ghosts
        self.has_row = has_row
        self.rows = None if has_row is None else backend.rows_where(has_row, 1.0)
        ghosts.find(position)
        self.total, self.source = ghosts.total, ghosts.source
        self.sources = {"source": ghosts.source, "ghost_type": ghosts.ghost_type}
        names: tuple[str, ...] = ("V", "support", "radius", "layer", "normal", "lateral")
        found: dict[str, Array] = {name: backend.zeros(self.total) for name in names}
        backend.pointwise(
            ghost_fields.ghost_layers, self.sources, tuple(found.values()), **self._own
        )
        self.V, self.support, self._layers = found["V"], found["support"], found
        self._find_rows_near_faces()
        place = self._place(position)
        self._find_wall_rules(place)
        corners = (self._corner(0), self._corner(1), (0.0, 0.0))
        self.pairs = find_neighbors(
            backend,
            place,
            self.support,
            self.count,
            kernel=self.lattice.weighing.kernel,
            mean=self._mean,
            box=Box(*corners),
            radius=found["radius"],
            wanted=self.rows,
            room=self._room,
        )
        geometry, neighbor = self._geometry, self.pairs.neighbor
        geometry.begin(self.pairs, has_row, self._even_above)
        geometry.find(self.pairs, self._layers, has_kernel=has_kernel)
        self.weights, self.gradient, self.kernel = geometry.arrays
        self._folded = backend.zeros(neighbor.shape[0], "index")
        backend.pointwise(element, {"place": neighbor}, self._folded, table=self.source)

    def _find_rows_near_faces(self) -> None:
        """Numbers of the particles with complete pairs that may have ghosts among them."""
        backend, ghosts, complete = self.backend, self.ghosts, self.complete_rows
        if not self.has_walls or self.has_row is None:
            self.rows_near_faces = ghosts.near
            return
        marks = {"a": backend.head(ghosts.is_near, complete)}
        marks["b"] = backend.head(self.has_row, complete)
        found = backend.zeros(complete)
        backend.pointwise(both, marks, found)
        self.rows_near_faces = backend.rows_where(found, 1.0)

    def _find_wall_rules(self, place: Array) -> None:
        """What `wall_terms` reads of each particle, in a domain with walls that matter to heat.

        The state of ghosts beyond a face whose temperature varies along it is found on the host: it
        is that of few ghosts, and curves of the material.
        """
        backend = self.backend
        self.rules = {"dirichlet": backend.zeros(self.total)}
        if not self.has_walls:
            return
        names = ("dirichlet", "flux", "plane", "T_w", "P_w", "wall_enthalpy")
        self.rules = {name: backend.zeros(self.total) for name in names}
        self.rules["normal"] = backend.zeros((2, self.total))
        fields, out = {"ghost_type": self.ghosts.ghost_type}, tuple(self.rules.values())
        backend.pointwise(ghost_fields.ghost_walls, fields, out, **self._walls)
        if self._varies is None:
            return
        rows = backend.rows_where(self.of_type(self._varies), 1.0)
        chosen = backend.zeros((2, rows.shape[0]))
        backend.gather(place, rows, chosen)
        T = self.conditions.varying_temperature(backend.to_host(chosen)[0])
        for name, values in self._wall_state(T).items():
            backend.scatter(backend.asarray(values), rows, self.rules[name])

    def move(self, position: Array) -> None:
        """The same pairs at other positions."""
        self.pairs = replace(self.pairs, position=self._place(position))
        self._geometry.find(self.pairs, self._layers)

    def without_ghosts(self) -> NeighborList:
        """The pairs with every ghost replaced by its source."""
        return self.pairs.with_neighbors(self.backend, self._folded)

    def extend_velocity(self, v: Array, jump: Array) -> Array:
        """Velocities (2, M) from those of the particles (2, n) [m/s].

        Args:
            jump: (n,) 2 d tau / eta [m/s].
        """
        return self._extended_velocity(v, jump, self._velocity)

    def mirror_velocity(self, v: Array, jump: Array) -> Array:
        """Velocities (2, n) on the block with ghosts as mirrors at the walls show them [m/s].

        Beyond a stressed surface they continue the profile: mirrored, it would bend there, and its
        divergence with it. Args as of `extend_velocity`.
        """
        return self._extended_velocity(v, jump, self._mirror)

    def _extended_velocity(self, v: Array, jump: Array, rules: Constants) -> Array:
        v_x, v_z = (self.backend.component(v, k) for k in (0, 1))
        tables = {"v_x": v_x, "v_z": v_z, "jump": jump, **rules}
        return self.extend(ghost_fields.extended_velocity, tables)

    def prepare_velocity_change(self, d: Array, out: Array, again: Launch | None) -> Launch:
        """Loop that extends a change (2, n) of velocities, where walls and stress stay the same."""
        d_x, d_z = (self.backend.component(d, k) for k in (0, 1))
        tables: Constants = {"d_x": d_x, "d_z": d_z, **self._factors}
        function = ghost_fields.velocity_change
        return self.backend.prepare(function, self.sources, out, again=again, **tables)

    def extend_tensor(self, M: Array) -> Array:
        """Tensors (2, 2, count) of the block on the block with ghosts."""
        backend, names = self.backend, ("M_xx", "M_xz", "M_zx", "M_zz")
        tables = {name: backend.component(M, k) for k, name in enumerate(names)}
        out = backend.zeros((2, 2, self.total))
        function = ghost_fields.extended_tensor
        backend.pointwise(function, self.sources, out, **tables, **self.signs)
        return out

    def find_near_fluid(self, position: Array, fluid: Array) -> Array:
        """(count,) 1 for particles within the support of a fluid one, or nearly; see `near_melt`.

        Args:
            position: (2, n) [m]. fluid: (n,) 1 where a particle flows or did so one step ago.

        Raises:
            EscapedParticle: a position is not finite or beyond the faces.
        """
        return self._near_melt.find(position, fluid)

    def smallest_distance(self, position: Array, rows: Rows) -> float:
        """Smallest distance from one of `rows` to another particle or ghost [m]."""
        pairs = replace(self.pairs, position=self._place(position))
        (least,) = self.backend.pair_sum(
            distance_square, pairs, {}, (None,), rows=rows, combine=("min",), reduce=("min",)
        )
        return least**0.5

    def _place(self, position: Array) -> Array:
        x, z = (self.backend.component(position, k) for k in (0, 1))
        tables = {"x": x, "z": z, **self.signs, **self._offsets}
        return self.extend(ghost_fields.ghost_position, tables)

    def _corner(self, end: int) -> tuple[float, ...]:
        """Box that no particle and no ghost may leave [m]."""
        outward = -1.0 if end == 0 else 1.0
        return tuple(pair[end] + outward * self.search_radius for pair in self._bounds)
