"""The block of particles that may move, their ghosts, and their pairs.

The layers from the surface down to some depth below the melt form the block; they have the first
numbers. Its pairs are searched in every step, those of the particles below stay as they are. A
margin of resting layers below the moving rows belongs to the block, so that every moving particle
finds all its neighbors there.

What a particle has of its layer is in `block_layers`, what a ghost has of its source in
`ghost_extension`, what the faces between them mean to heat in `block_walls`, who may have melt
among its neighbors in `near_melt`; here are the pairs.
Distances, kernels and weights of the pairs are computed once for each set of positions, and kept:
root and divisions take most of the time of a sum over pairs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.compute.search import Room
from lasersph.compute.vectors import element
from lasersph.particles.ghosts import GhostParticles, ghost_types_of
from lasersph.particles.neighbor_lists import Box, NeighborList, find_neighbors
from lasersph.physics.viscosity import viscous_weight
from lasersph.solvers.melt_pool.block_layers import BlockLayers, StaticParticleData
from lasersph.solvers.melt_pool.block_walls import BlockWalls
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.ghost_extension import GhostExtension
from lasersph.solvers.melt_pool.near_melt import NearMelt
from lasersph.solvers.melt_pool.pair_geometry import PairGeometry, distance_square
from lasersph.sph.correction import bounded_inverse, moment_term
from lasersph.surface.columns import product
from lasersph.surface.surface import Surface


class Block:
    """Particles 0 ... count - 1 with their ghosts and pairs.

    Args:
        lattice: what stays the same of the particles. conditions: at the faces. surface: over the
            melt.
        volume: (n,) of all particles, which may change [m^2].
        fine_depth: of the layers of the finest support; what lies below rests [m].
        complete_layers, complete_rows: layers and particles whose pairs are all in the block.
        count: particles with the margin below them. bottom: z of its lowest face [m]. has_bottom:
            whether that is the bottom of the domain.
        potential, enthalpy: heat potential [W/m] and enthalpy [J/kg] of a wall's temperature [K].

    Attributes:
        layers: volumes, supports and factors. ghosts: fields of the particles with their ghosts.
            walls: what faces mean to heat. near_melt: who may see those that flow.
        pairs: NeighborList with the rows of the block, among all M.
        weights: (pairs,) g_ij [1] at the last positions. gradient: (d, pairs) G_ij = V_j grad W_ij
            there [1/m]. kernel: (pairs,) V_j W_ij where the pairs were found [1]. viscous_weights:
            (pairs,) g_ij there times the mean of the relative viscosities of both particles [1].
        correction: (d, d, count) matrices C of corrected gradients, see `correct_kernel`.
        rows: numbers of the particles whose pairs were found, None for
            all of the block; has_row: (count,) 1 for them, or None. rows_near_faces: those, of
            complete rows, that may have ghosts as neighbors. rows_across: those with pairs across
            the tangents of a surface that moves; None where none does. placings: how often
            particles have been put in places.
    """

    reach = 1.0
    """Search radii beyond a face at most in which ghosts lie."""
    rows_across: Rows | None = None

    def __init__(
        self,
        backend: Backend,
        lattice: StaticParticleData,
        conditions: FaceConditions,
        surface: Surface,
        volume: Array,
        *,
        fine_depth: float,
        complete_layers: int,
        complete_rows: int,
        count: int,
        bottom: float,
        has_bottom: bool,
        potential: Callable[[np.ndarray], np.ndarray],
        enthalpy: Callable[[np.ndarray], np.ndarray],
    ) -> None:
        self.backend, self.lattice = backend, lattice
        self.conditions, self.surface = conditions, surface
        self.complete_layers, self.complete_rows = complete_layers, complete_rows
        self.has_bottom = has_bottom
        self.count, self.volume = count, backend.head(volume, count)

        # layers, ghosts and walls
        types = ghost_types_of(conditions.ghost_faces(surface, has_bottom=has_bottom))
        self.layers = BlockLayers(backend, lattice, self.volume, types, fine_depth)
        rules = conditions.rules(types)
        particles = GhostParticles(backend, count, types)
        self.ghosts = GhostExtension(backend, particles, rules, surface)
        self.walls = BlockWalls(
            backend, conditions, rules, self.ghosts, potential=potential, enthalpy=enthalpy
        )

        # the box around the block, and who in it may see melt
        *sides, z = conditions.box
        self._bounds = (*sides, (max(z[0], bottom), surface.top))
        self.near_melt = NearMelt(
            backend,
            self.layers.reach_of_melt,
            self.spacing,
            self._bounds,
            repeats=[period > 0.0 for period in conditions.periods],
        )

        # pairs, of which there are none yet
        dimension, nothing = self.ghosts.dimension, backend.zeros(0, "index")
        self.pairs = NeighborList(backend.zeros(count + 1, "offset"), nothing)
        self.rows: Rows | None = None
        self.has_row: Array | None = None
        self.placings = 0
        self.rows_near_faces: Rows = nothing
        self._geometry = PairGeometry(backend, lattice.weighing, dimension)
        self._capacity = Room()
        self.weights, self.gradient, self.kernel = self._geometry.arrays
        self.viscous_weights = self.weights
        self.correction = backend.zeros((dimension, dimension, count))
        self._folded = nothing

    @property
    def spacing(self) -> float:
        """Of the particles that move [m]."""
        return self.layers.moving_support / self.lattice.weighing.ratio

    @property
    def V(self) -> Array:
        """(M,) volumes of particles and ghosts [m^2]."""
        return self.layers.fields["V"]

    @property
    def heat_weights(self) -> Array:
        """(pairs,) weights with which heat is conducted, [1] of a plane."""
        return self.weights

    @property
    def ring_fields(self) -> dict[str, Array]:
        """Fields that the flow of rings reads beside those of a plane section."""
        return {}

    @property
    def across(self) -> Array:
        """(M,) 1 for ghosts beyond a surface that moves."""
        return self.ghosts.crosses_surface

    def gather(self, field: Array) -> Array:
        """The field of all particles on the block with ghosts: (n,) to (M,)."""
        return self.ghosts.gather(field)

    def mirror(self, a: Array) -> Array:
        """A vector field (d, n) on the block with ghosts, (d, M), as planes between mirror it."""
        return self.ghosts.mirror(a)

    def find_pairs(
        self, position: Array, has_row: Array | None, *, has_kernel: bool = False
    ) -> None:
        """Find ghosts of the particles at `position`, shape (d, n) [m], and pairs of chosen ones.

        Args:
            has_row: (count,) 1 where the pairs of a particle are to be found, else 0; None for all.
            has_kernel: whether `kernel` is set. Heat takes the weights of loops without it, so that
                they are the same bits when a run is resumed.

        Raises:
            EscapedParticle: a position is not finite or beyond the faces.
        """
        # rows to search: those near what flows, the pairs of all others are known
        backend = self.backend
        ghosts, layers = self.ghosts, self.layers
        self.has_row = has_row
        self.placings += 1
        self.rows = None if has_row is None else backend.rows_where(has_row, 1.0)

        # ghosts, what they have of their sources and of the faces between
        ghosts.find(position, layers.reach)
        self.extend_to_ghosts(position)
        self._find_rows_near_faces()
        self.walls.find_varying()

        # pairs among all within the search radius
        corners = (self._corner(0), self._corner(1), (0.0,) * ghosts.dimension)
        self.pairs = find_neighbors(
            backend,
            ghosts.place,
            layers.fields["support"],
            self.count,
            kernel=self.lattice.weighing.kernel,
            mean=layers.mean,
            box=Box(*corners),
            radius=layers.fields["radius"],
            wanted=self.rows,
            total=ghosts.particles.total,
            room=self._capacity,
        )

        # kernels and weights of the pairs
        geometry = self._geometry
        geometry.set_pairs(self.pairs, has_row, layers.reach.plane)
        self.weights, self.gradient, self.kernel = geometry.arrays
        self._folded = geometry.per_pair("folded", "index")
        self.find_geometry(has_kernel=has_kernel)
        self._adapt_weights(position)
        # viscosity may weigh the pairs anew
        self.viscous_weights = self.weights

    @graph
    def extend_to_ghosts(self, position: Array) -> None:
        """Values of lattice and walls of particles with their ghosts at `position` (d, n) [m], and
        their places."""
        self.layers.extend(self.ghosts)
        self.walls.extend()
        self.ghosts.put_in_place(position)

    @graph
    def find_geometry(self, *, has_kernel: bool) -> None:
        """Geometry of the pairs that were found, and their neighbors without ghosts."""
        self._geometry.find(self.pairs, self.layers.fields, has_kernel=has_kernel)
        fields = {"place": self.pairs.neighbor}
        self.backend.pointwise(element, fields, self._folded, table=self.ghosts.source)

    def _adapt_weights(self, position: Array) -> None:
        """A pair of a plane section weighs what its distance says."""

    def inner_weights(self) -> Array:
        """(pairs,) weights of the pressure: ghosts mirror it, so that all pairs count."""
        return self.weights

    def normalize_surface_flux(self) -> None:
        """Pairs across a plane see all of its length."""

    @graph
    def correct_kernel(self, rows: Rows) -> None:
        """C_i = (sum_j x_ij (x) G_ij)^-1, bounded, of some rows at the present positions."""
        fields = {"G_ij": self.gradient}
        self.backend.pair_sum(
            moment_term, self.pairs, fields, self.correction, finish=bounded_inverse, rows=rows
        )

    def weigh_viscosity(self, relative: Array) -> None:
        """Set `viscous_weights` from viscosities (n,) of particles over that at the liquidus."""
        found = self.viscous_weights = self._geometry.per_pair("viscous")
        fields = {"g_ij": self.weights, "m": self.gather(relative)}
        self.backend.pair_values(viscous_weight, self.pairs, fields, found, rows=self.rows)

    def _find_rows_near_faces(self) -> None:
        """Numbers of the particles with complete pairs that may have ghosts among them."""
        backend, ghosts, complete = self.backend, self.ghosts.particles, self.complete_rows
        # heat of faces is summed only over rows that have both pairs and ghosts
        if not self.walls.exchange_heat or self.has_row is None:
            self.rows_near_faces = ghosts.near
            return
        marks = {"a": backend.head(ghosts.is_near, complete)}
        marks["b"] = backend.head(self.has_row, complete)
        found = backend.zeros(complete)
        backend.pointwise(product, marks, found)
        self.rows_near_faces = backend.rows_where(found, 1.0)

    def move(self, position: Array) -> None:
        """The same pairs at other positions."""
        # lists are kept, distances and what follows from them are not
        self.placings += 1
        self.place_pairs(position)
        self._adapt_weights(position)

    @graph
    def place_pairs(self, position: Array) -> None:
        """Places and geometry of the same pairs at other positions (d, n) [m]."""
        self.ghosts.put_in_place(position)
        self._geometry.find(self.pairs, self.layers.fields)

    def without_ghosts(self) -> NeighborList:
        """The pairs with every ghost replaced by its source."""
        return self.pairs.with_neighbors(self.backend, self._folded)

    def smallest_distance(self, position: Array, rows: Rows) -> tuple[float, ...]:
        """Square of the smallest distance from one of `rows` to another particle or ghost [m^2]."""
        pairs = replace(self.pairs, position=self.ghosts.places_of(position))
        return self.backend.pair_sum(
            distance_square, pairs, {}, (None,), rows=rows, combine=("min",), reduce=("min",)
        )

    def _corner(self, end: int) -> tuple[float, ...]:
        """Box that no particle and no ghost may leave [m]."""
        outward, reach = (-1.0 if end == 0 else 1.0), self.reach * self.layers.search_radius
        return tuple(pair[end] + outward * reach for pair in self._bounds)
