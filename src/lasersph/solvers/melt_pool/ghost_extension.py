"""`GhostExtension`: fields of the particles of a block, extended to their ghosts.

What a ghost carries follows from its source, its type and the tangent there (`ghost_fields`). No
type crosses the tangent of a plane: normals and shifts are 0 there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import element
from lasersph.particles.ghosts import GhostParticles, Reach
from lasersph.solvers.melt_pool import ghost_fields
from lasersph.solvers.melt_pool.face_conditions import GhostRules
from lasersph.surface.surface import Surface, SurfaceGhosts


class GhostExtension:
    """Fields (..., n) of all particles on those of a block with ghosts, (..., M).

    Attributes:
        dimension: d. particles: which ghosts there are. size: M, their number with capacity for a
            few more. source: (M,) particle behind each. place: (d, M) [m]. sources: these and the
            types, the fields of `ghost_fields`. surface: what ghosts across its tangents
            have. crosses_surface: (M,) 1 for these, once `mark_crossing` was called.
            has_still_walls: whether there are walls on which no liquid slips.
    """

    def __init__(
        self, backend: Backend, particles: GhostParticles, rules: GhostRules, surface: Surface
    ) -> None:
        self.backend, self.particles = backend, particles
        self.surface: SurfaceGhosts = surface.ghosts
        self.dimension = particles.ghost_types.sign.shape[0]
        # those that were found
        self.size, self.source = 0, particles.source
        self.sources: dict[str, Array] = {}
        self.place = backend.zeros((self.dimension, 0))
        self.crosses_surface = backend.zeros(0)

        # S and o by their types, with the tangent between as far as there is one
        table, types = particles.table, particles.ghost_types
        self._crosses_surface = table(types.crosses_surface)
        self._stays_inside = table(1.0 - types.crosses_surface)
        self._sign = table(types.sign)
        self._mirrors: Constants = {
            "sign": self._sign,
            "normal": self.surface.normal,
            "crosses_surface": self._crosses_surface,
        }
        self._images: Constants = {
            "sign": self._sign,
            "offset": table(types.offset),
            "shift": self.surface.shift,
        }

        # F and v_0 of walls, or S alone; beyond a stressed surface the velocity is carried on
        self._velocity = self._tables(rules.velocity)
        self._mirrored_velocity = self._tables(rules.mirrored_velocity)
        self._velocity_change = self._tables(rules.velocity_change)

        # walls on which no liquid slips: components along them, with the sign by which planes of
        # symmetry beside them turn these around, normal and place
        is_wall = (rules.sticks > 0.0) & rules.has_one_wall & (types.crosses_surface == 0.0)
        along_wall = np.where(~is_wall & is_wall.any(axis=0), -rules.factor, 0.0)
        self.has_still_walls = bool(along_wall.any())
        # S x + o = x lies on the plane of the wall: n . x = o/2
        normal = is_wall.astype(float)
        plane = 0.5 * np.sum(normal * types.offset, axis=0)
        self._still_walls = self._tables({"along": along_wall, "normal": normal, "plane": plane})

    def _tables(self, values: Mapping[str, np.ndarray]) -> Constants:
        """Tables by the type of a ghost, for loops."""
        return {name: self.particles.table(one) for name, one in values.items()}

    def find(self, position: Array, reach: Reach) -> None:
        """Find the ghosts of the particles at `position`, shape (d, n) [m], within their reach."""
        particles = self.particles
        particles.find(position, self.surface.distance, reach)
        self.size, self.source = particles.source.shape[0], particles.source
        if self.place.shape[1] != self.size:
            self.place = self.backend.zeros((self.dimension, self.size))
        self.sources = {"source": particles.source, "ghost_type": particles.ghost_type}
        self.sources["place"] = self.place

    def gather(self, field: Array) -> Array:
        """The field of all particles on the block with ghosts: (..., n) to (..., M)."""
        return self._read(field, self.source)

    def of_type(self, table: Array) -> Array:
        """(M,) values by the type of each particle."""
        return self._read(table, self.particles.ghost_type)

    def _read(self, table: Array, place: Array) -> Array:
        """(..., M) values of a table at their places."""
        out = self.backend.unset((*table.shape[:-1], self.size))
        self.backend.pointwise(element, {"place": place}, out, table=table)
        return out

    def _extend(self, function: Callable, tables: Constants, out: Array | None = None) -> Array:
        """Vectors (d, M) by a function of `ghost_fields`, into `out` where it is given."""
        found = self.backend.unset((self.dimension, self.size)) if out is None else out
        self.backend.pointwise(function, self.sources, found, **tables)
        return found

    def extend_velocity(self, v: Array, jump: Array) -> Array:
        """Velocities (d, M) from those of the particles (d, n) [m/s].

        Args:
            jump: (d, n) by how much the surface makes a ghost faster than its source, 2 d tau / eta
                [m/s].
        """
        return self._extend(ghost_fields.ghost_velocity, {"v": v, "jump": jump, **self._velocity})

    def mirror_velocity(self, v: Array, jump: Array) -> Array:
        """Velocities (d, M) on the block with ghosts as mirrors at the walls show them [m/s].

        Beyond a stressed surface they continue the profile: mirrored, it would bend there, and its
        divergence with it. Args as of `extend_velocity`.
        """
        return self._extend(
            ghost_fields.ghost_velocity, {"v": v, "jump": jump, **self._mirrored_velocity}
        )

    def bend_at_walls(self, v: Array, b: Array, relative: Array, nu: float) -> None:
        """Bend velocities (d, M) beyond walls as `ghost_fields.velocity_at_wall` does.

        Args:
            b: (d, n) force [m/s^2]. relative: (n,) viscosity over that at the liquidus.
            nu: at the liquidus [m^2/s].
        """
        fields = {**self.sources, "v": v}
        tables: Constants = {"m": relative, "b": b, **self._still_walls}
        self.backend.pointwise(ghost_fields.velocity_at_wall, fields, v, **tables, nu=nu)

    def extend_velocity_change(self, d: Array, out: Array) -> None:
        """Extend a change (d, n) of velocities, where walls and stress stay the same, into `out`
        (d, M) [m/s]."""
        self._extend(ghost_fields.velocity_change, {"d": d, **self._velocity_change}, out)

    def mirror(self, a: Array) -> Array:
        """A vector field (d, n) on the block with ghosts, as the planes between mirror it."""
        return self._extend(ghost_fields.ghost_vector, {"a": a, **self._mirrors})

    def extend_tensor(self, M: Array) -> Array:
        """Tensors (d, d, count) of the block on the block with ghosts."""
        out = self.backend.unset((self.dimension, self.dimension, self.size))
        return self._extend(ghost_fields.ghost_tensor, {"M": M, **self._mirrors}, out)

    def extend_pressure(self, p: Array) -> Array:
        """(M,) pressure, mirrored at planes, and across a tangent carried on through p_b there."""
        tables: Constants = {"p": p, "p_b": self.surface.pressure}
        tables["crosses_surface"] = self._crosses_surface
        return self._extend(ghost_fields.ghost_pressure, tables, self.backend.unset(self.size))

    def put_in_place(self, position: Array) -> None:
        """Set `place` from the positions of the particles (d, n) [m]."""
        self._images_of(position, self._crosses_surface, self.place)

    def places_of(self, position: Array) -> Array:
        """Places (d, M) of particles at other positions (d, n), with their ghosts [m]."""
        return self._images_of(position, self._crosses_surface)

    def unfold(self, position: Array) -> Array:
        """Places (d, M) with those of the sources along the axes that are mirrored [m]."""
        return self._extend(ghost_fields.unfolded_place, {"x": position, "sign": self._sign})

    def places_swapped(self, position: Array) -> Array:
        """Places (d, M) where all sources lie across the surface, and their ghosts there in the
        places of the sources [m]."""
        return self._images_of(position, self._stays_inside)

    def _images_of(
        self, position: Array, crosses_surface: Array, out: Array | None = None
    ) -> Array:
        """Places of all; `crosses_surface` says by type what is shifted across the surface."""
        tables = {"x": position, "crosses_surface": crosses_surface, **self._images}
        return self._extend(ghost_fields.ghost_position, tables, out)

    def mark_crossing(self) -> None:
        """Set `crosses_surface` of the ghosts that were found."""
        if self.crosses_surface.shape[0] != self.size:
            self.crosses_surface = self.backend.zeros(self.size)
        place, table = {"place": self.particles.ghost_type}, self._crosses_surface
        self.backend.pointwise(element, place, self.crosses_surface, table=table)

    def find_tangent_planes(
        self, given: Mapping[str, Array], heat_face: Array, surface: float
    ) -> None:
        """Set normal (d, M) and plane (M,) of the faces between ghosts and sources to those of the
        tangents below a surface that moves.

        Args:
            given: both, as they are for planes. heat_face: by type, the number of the face that
                heat crosses. surface: number of the surface.
        """
        self.backend.pointwise(
            ghost_fields.tangent_plane,
            {**self.sources, **given},
            (given["normal"], given["plane"]),
            surface_normal=self.surface.normal,
            distance=self.surface.distance,
            sign=self._sign,
            crosses_surface=self._crosses_surface,
            heat_face=heat_face,
            surface=surface,
        )
