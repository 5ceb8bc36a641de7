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
from lasersph.boundaries.surface_loops import inner_weight as weight_within
from lasersph.boundaries.surface_loops import mean_weight
from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.search import Room
from lasersph.compute.vectors import element
from lasersph.particles.faces import LEFT, PLANE, SURFACE
from lasersph.particles.ghosts import LOWER, SLANTED, UPPER, GhostParticles, ghost_types_of
from lasersph.particles.neighbor_lists import Box, NeighborList, find_neighbors
from lasersph.particles.support import common
from lasersph.physics.viscosity import viscous_weight
from lasersph.solvers.conduction.body import Weighing
from lasersph.solvers.melt_pool import ghost_fields
from lasersph.solvers.melt_pool.block_terms import both, is_near
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.ghost_extension import GhostExtension
from lasersph.solvers.melt_pool.near_melt import NearMelt
from lasersph.solvers.melt_pool.pair_geometry import PairGeometry, distance_square

SKIN = 1.02
"""Search radius over the support radius. Geometry: pairs are found at the advected positions, from
which the final ones differ by dt/2 times the change of v: two neighbors come 0.02 supports closer
where both change by a third of the largest speed in a step of 0.06 supports."""


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


class Block(GhostExtension):
    """Particles 0 ... count - 1 with their ghosts and pairs.

    Args:
        lattice: what stays the same of the particles. conditions: at the faces. surface: None in
            a box without.
        volume: (n,) of all particles, which may change [m^2].
        fine_depth: of the layers of the finest support; what lies below rests [m].
        layers, complete_rows: layers and particles whose pairs are all in the block. count:
            particles with the margin below them. bottom: z of its lowest face [m]. has_bottom:
            whether that is the bottom of the domain.
        potential, enthalpy: heat potential [W/m] and enthalpy [J/kg] of a wall's temperature [K].

    Attributes:
        walls: (M,) faces of the ghosts by the names of `ghost_faces`, 0 where there is none. rules:
            (M,) what faces mean to heat, by the names of `ghost_walls`. across: (M,) 1
            beyond a surface that is no plane.
        pairs: NeighborList with the rows of the block, among all M. place: (2, M) of these [m].
        weights: (pairs,) g_ij [1] at the last positions. gradient: (2, pairs) G_ij = V_j grad W_ij
            there [1/m]. kernel: (pairs,) V_j W_ij where the pairs were found [1]. viscous_weights:
            (pairs,) g_ij there times the mean of the relative viscosities of both particles [1].
        moving_support: of the particles that move, the finest [m]. search_radius: largest of
            the block [m].
        rows: numbers of the particles whose pairs were found, None for
            all of the block; has_row: (count,) 1 for them, or None. rows_near_faces: those, of
            complete rows, that may have ghosts as neighbors. closest: see `wall_terms`.
    """

    def __init__(
        self,
        backend: Backend,
        lattice: StaticParticleData,
        conditions: FaceConditions,
        surface: Surface | None,
        volume: Array,
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
        support = lattice.support[:count]
        self.moving_support, largest = float(support.min()), float(support.max())
        self.search_radius = SKIN * largest
        types = ghost_types_of(conditions.ghost_faces(surface, has_bottom=has_bottom))
        ghosts = GhostParticles(backend, count, self.search_radius, types)
        super().__init__(backend, ghosts, surface)
        self.lattice, self.conditions = lattice, conditions
        self.layers, self.complete_rows, self.count = layers, complete_rows, count
        self.has_bottom, self.surface = has_bottom, surface
        self.potential, self.enthalpy = potential, enthalpy
        self.volume = backend.head(volume, count)
        self._mean = common if self.moving_support == largest else lattice.weighing.mean
        self._own = {"V": self.volume, "support": backend.asarray(support)}
        self._own["radius"] = backend.asarray(SKIN * support)
        (x, z), repeats = conditions.box, conditions.flow_kind(LEFT) == "periodic"
        top = z[1] if self._beyond is None else z[1] + fine_depth
        self._bounds = x, (max(z[0], bottom), top)
        near = SKIN * float(lattice.weighing.mean(self.moving_support, largest))
        self._even_above = near - fine_depth
        self._near_melt = NearMelt(backend, count, self._bounds, near, repeats=repeats)
        self.closest = 1e-30 if self._beyond is None else self._beyond.min_distance
        self._set_rules()
        self._set_factors()
        self._geometry, self._room = PairGeometry(backend, lattice.weighing), Room()
        self._folded, self.place = backend.zeros(0, "index"), backend.zeros((2, 0))
        self._extend_to_ghosts = backend.phase(Block._run_extension)
        self._find_geometry = backend.phase(Block._run_geometry)
        self._move_pairs = backend.phase(Block._run_move)

    def _set_rules(self) -> None:
        """Tables of what ghosts carry, by their type."""
        ghosts, types = self.ghosts, self.ghosts.ghost_types
        rules = self.conditions.rules(types, self.surface)
        self.has_walls = bool(rules.dirichlet.any() or rules.flux.any())
        self._set_tables(rules)
        self._walls = ghosts.tables("normal_x", "normal_z", rules.normal)
        for name in ("dirichlet", "flux", "plane"):
            self._walls[name] = ghosts.table(getattr(rules, name))
        is_ghost = np.arange(types.count) > 0
        for name, values in self._wall_state(rules.wall_temperature).items():
            self._walls[name] = ghosts.table(is_ghost * values)
        self._varies = ghosts.table(rules.varies) if rules.varies.any() else None
        self._faces = ghosts.tables("wall_x", "wall_z", rules.walls)
        self._faces["heat_face"] = ghosts.table(rules.heat_face)

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
        beyond = self._beyond
        ghosts.find(position, None if beyond is None else (beyond.distance, self._own["radius"]))
        self.total, self.source = ghosts.source.shape[0], ghosts.source
        self.sources = {"source": ghosts.source, "ghost_type": ghosts.ghost_type}
        if self.place.shape[1] != self.total:
            self.place = backend.zeros((2, self.total))
        self._extend_to_ghosts(self, position, reads=(position, ghosts.source, self.place))
        self._find_rows_near_faces()
        place = self.place
        self._find_varying_walls(place)
        self._find_tangent_planes(place)
        corners = (self._corner(0), self._corner(1), (0.0, 0.0))
        self.pairs = find_neighbors(
            backend,
            place,
            self.support,
            self.count,
            kernel=self.lattice.weighing.kernel,
            mean=self._mean,
            box=Box(*corners),
            radius=self._layers["radius"],
            wanted=self.rows,
            total=ghosts.total,
            room=self._room,
        )
        geometry, neighbor = self._geometry, self.pairs.neighbor
        geometry.begin(self.pairs, has_row, self._even_above)
        self.weights, self.gradient, self.kernel = geometry.arrays
        if self._folded.shape != neighbor.shape:
            self._folded = backend.zeros(neighbor.shape[0], "index")
        if has_kernel:
            self._find_geometry(self, reads=self.arrays, rows=geometry.rows)
        else:
            self._run_geometry(has_kernel=False)
        self._average_weights(position)
        self.viscous_weights = self.weights

    @property
    def arrays(self) -> tuple[Array, ...]:
        """Those of pairs and ghosts that are replaced where there is no room for more, as all
        others are then too."""
        return self.pairs.neighbor, self.source, self.V, self.weights, self.place

    def _run_extension(self, position: Array) -> None:
        """What particles with their ghosts at `position` (2, n) [m] have of the lattice and of the
        walls, and where they are."""
        backend, names = self.backend, ("V", "support", "radius", "layer", "normal", "lateral")
        self._layers: dict[str, Array] = {name: backend.zeros(self.total) for name in names}
        out = tuple(self._layers.values())
        backend.pointwise(ghost_fields.ghost_layers, self.sources, out, **self._own)
        self.V, self.support = self._layers["V"], self._layers["support"]
        self._find_wall_rules()
        self.walls = {name: backend.zeros(self.total) for name in self._faces}
        fields, out = {"ghost_type": self.ghosts.ghost_type}, tuple(self.walls.values())
        backend.pointwise(ghost_fields.ghost_faces, fields, out, **self._faces)
        self._place(position, self.place)

    def _run_geometry(self, *, has_kernel: bool = True) -> None:
        """Geometry of the pairs that were found, and their neighbors without ghosts."""
        self._geometry.find(self.pairs, self._layers, has_kernel=has_kernel)
        fields = {"place": self.pairs.neighbor}
        self.backend.pointwise(element, fields, self._folded, table=self.source)

    def _average_weights(self, position: Array) -> None:
        """Make the weights toward ghosts across a tangent symmetric.

        Where the surface bends, the ghost of j is not as far from i as that of i from j: both
        distances count, the second found with the ghosts in the place of their sources.
        """
        if self._beyond is None:
            return
        backend, ghosts = self.backend, self.ghosts
        self.across = self.of_type(self._across["across"])
        near = backend.zeros(self.count)
        fields = {"distance": backend.head(self._beyond.distance, self.count)}
        fields["has_row"] = self.has_row if self.has_row is not None else ghosts.all_rows
        backend.pointwise(is_near, fields, near, radius=self.search_radius)
        rows = backend.rows_where(near, 1.0)
        swapped = self._geometry.per_pair("swapped")
        pairs = replace(
            self.pairs, position=self._place(position, across=self._within), mean=common
        )
        self._geometry.find_weights(pairs, self._layers, swapped, rows)
        fields = {"g_ij": self.weights, "swapped_ij": swapped, "across": self.across}
        backend.pair_values(mean_weight, self.pairs, fields, self.weights, rows=rows)

    def weigh_viscosity(self, relative: Array) -> None:
        """Set `viscous_weights` from viscosities (n,) of particles over that at the liquidus."""
        found = self.viscous_weights = self._geometry.per_pair("viscous")
        fields = {"g_ij": self.weights, "m": self.gather(relative)}
        self.backend.pair_values(viscous_weight, self.pairs, fields, found, rows=self.rows)

    def weights_within(self) -> Array:
        """(pairs,) weights that are 0 toward ghosts across the surface."""
        if self._beyond is None:
            return self.weights
        found = self._geometry.per_pair("within")
        fields = {"g_ij": self.weights, "across": self.across}
        self.backend.pair_values(weight_within, self.pairs, fields, found, rows=self.rows)
        return found

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

    def _find_wall_rules(self) -> None:
        """What `wall_terms` reads of each particle, in a domain with walls that matter to heat."""
        backend = self.backend
        self.rules = {"dirichlet": backend.zeros(self.total)}
        if not self.has_walls:
            return
        names = ("dirichlet", "flux", "plane", "T_w", "P_w", "wall_enthalpy")
        self.rules = {name: backend.zeros(self.total) for name in names}
        self.rules["normal"] = backend.zeros((2, self.total))
        fields, out = {"ghost_type": self.ghosts.ghost_type}, tuple(self.rules.values())
        backend.pointwise(ghost_fields.ghost_walls, fields, out, **self._walls)

    def _find_varying_walls(self, place: Array) -> None:
        """State of ghosts beyond a face whose temperature varies along it.

        It is found on the host, as that of few ghosts, by the curves of the material.
        """
        backend = self.backend
        if self._varies is None or not self.has_walls:
            return
        rows = backend.rows_where(self.of_type(self._varies), 1.0)
        chosen = backend.zeros((2, rows.shape[0]))
        backend.gather(place, rows, chosen)
        T = self.conditions.varying_temperature(backend.to_host(chosen)[0])
        for name, values in self._wall_state(T).items():
            backend.scatter(backend.asarray(values), rows, self.rules[name])

    def _find_tangent_planes(self, place: Array) -> None:
        """Where the surface lies between ghosts and their sources, for heat."""
        if self._beyond is None or not self.has_walls:
            return
        backend, beyond = self.backend, self._beyond
        n_x, n_z = (backend.component(beyond.normal, k) for k in (0, 1))
        fields = {**self.sources, "x": place}
        fields |= {name: self.rules[name] for name in ("normal", "plane")}
        backend.pointwise(
            ghost_fields.tangent_plane,
            fields,
            (self.rules["normal"], self.rules["plane"]),
            n_x=n_x,
            n_z=n_z,
            distance=beyond.distance,
            sign_x=self.signs["sign_x"],
            heat_face=self._faces["heat_face"],
            surface=1.0 + PLANE.index(SURFACE),
            **self._across,
        )

    def move(self, position: Array) -> None:
        """The same pairs at other positions."""
        self._move_pairs(self, position, reads=(position, *self.arrays), rows=self._geometry.rows)
        self._average_weights(position)
        self._find_tangent_planes(self.place)

    def _run_move(self, position: Array) -> None:
        self._place(position, self.place)
        self._geometry.find(self.pairs, self._layers)

    def without_ghosts(self) -> NeighborList:
        """The pairs with every ghost replaced by its source."""
        return self.pairs.with_neighbors(self.backend, self._folded)

    def find_near_fluid(self, position: Array, fluid: Array) -> Array:
        """(count,) 1 for particles within the support of a fluid one, or nearly; see `near_melt`.

        Args:
            position: (2, n) [m]. fluid: (n,) 1 where a particle flows or did so one step ago.

        Raises:
            EscapedParticle: a position is not finite or beyond the faces.
        """
        return self._near_melt.find(position, fluid)

    def smallest_distance(self, position: Array, rows: Rows) -> tuple[float, ...]:
        """Square of the smallest distance from one of `rows` to another particle or ghost [m^2]."""
        pairs = replace(self.pairs, position=self._place(position))
        return self.backend.pair_sum(
            distance_square, pairs, {}, (None,), rows=rows, combine=("min",), reduce=("min",)
        )

    def _corner(self, end: int) -> tuple[float, ...]:
        """Box that no particle and no ghost may leave [m]."""
        outward = -1.0 if end == 0 else 1.0
        room = self.search_radius if self._beyond is None else 2.0 * SLANTED * self.search_radius
        return tuple(pair[end] + outward * room for pair in self._bounds)
