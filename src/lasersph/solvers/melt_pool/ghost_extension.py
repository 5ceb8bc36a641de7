"""`GhostExtension`: fields of the particles of a block, extended to their ghosts.

What a ghost carries follows from its source and its type (`ghost_fields`), and across the local
tangent of a surface that is no plane from where that lies.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from lasersph.boundaries.surface import Surface, SurfaceGhosts
from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.compute.launch import Launch
from lasersph.compute.vectors import element
from lasersph.particles.ghosts import UPPER, GhostParticles
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.solvers.melt_pool import ghost_fields
from lasersph.solvers.melt_pool.face_conditions import GhostRules


class GhostExtension:
    """Fields (..., n) of all particles on those of a block with ghosts, (..., M).

    Attributes:
        ghosts: of its particles. total: M, see `ghosts`. source: (M,) particle behind each of the
            block with ghosts. sources: these and the types, the fields of `ghost_fields`. signs:
            tables of its arguments sign_x and sign_z.
    """

    total: int
    source: Array
    sources: Mapping[str, Array]
    pairs: NeighborList

    def __init__(self, backend: Backend, ghosts: GhostParticles, surface: Surface | None) -> None:
        self.backend, self.ghosts = backend, ghosts
        self._tangent = (1.0, 0.0) if surface is None else surface.tangent
        self._beyond: SurfaceGhosts | None = None if surface is None else surface.ghosts

    def _set_tables(self, rules: GhostRules) -> None:
        """Tables of what ghosts carry, by their type."""
        ghosts, types = self.ghosts, self.ghosts.ghost_types
        self.signs = ghosts.tables("sign_x", "sign_z", types.sign)
        self._offsets = ghosts.tables("offset_x", "offset_z", types.offset)
        self._across = {"across": ghosts.table((types.crossed[1] == UPPER).astype(float))}
        self._within = {"across": ghosts.table((types.crossed[1] != UPPER).astype(float))}
        slope: Constants = self._across
        if self._beyond is None:
            slope = {"slope": ghosts.table(rules.slope), "along": self._tangent}
        self._factors = ghosts.tables("factor_x", "factor_z", rules.factor)
        self._velocity = self._factors | ghosts.tables("added_x", "added_z", rules.added) | slope
        self._mirror = ghosts.tables("factor_x", "factor_z", types.sign) | slope
        self._mirror |= ghosts.tables("added_x", "added_z", 0.0 * rules.added)
        # walls below a surface that moves: what no liquid slips on, and where that lies
        wall, is_still = rules.wall, rules.factor < 0.0
        lateral, bottom = (wall == 1.0) | (wall == 2.0), wall == 3.0
        along = np.stack([bottom & is_still[0], lateral & is_still[1]]).astype(float)
        self.has_still_walls = self._beyond is not None and bool(along.any())
        plane = 0.5 * np.where(bottom, types.offset[1], types.offset[0])
        self._walls_along = ghosts.tables("along_x", "along_z", along)
        self._walls_along["plane"] = ghosts.table(plane)

    def gather(self, field: Array) -> Array:
        """The field of all particles on the block with ghosts: (n,) to (M,)."""
        out, fields = self.backend.zeros(self.total), {"place": self.source}
        self.backend.pointwise(element, fields, out, table=field)
        return out

    def of_type(self, table: Array) -> Array:
        """(M,) values by the type of each particle."""
        out, fields = self.backend.zeros(self.total), {"place": self.ghosts.ghost_type}
        self.backend.pointwise(element, fields, out, table=table)
        return out

    def extend(self, function: Callable, tables: Constants, out: Array | None = None) -> Array:
        """Vectors (2, M) by a function of `ghost_fields`, into `out` where it is given."""
        found = self.backend.zeros((2, self.total)) if out is None else out
        self.backend.pointwise(function, self.sources, found, **tables)
        return found

    def extend_velocity(self, v: Array, jump: Array) -> Array:
        """Velocities (2, M) from those of the particles (2, n) [m/s].

        Args:
            jump: (n,) 2 d tau / eta [m/s].
        """
        return self._extended_velocity(v, jump, self._velocity)

    def add_at_walls(self, v: Array, a: Array, relative: Array, step: float, nu: float) -> None:
        """Add to velocities (2, M) what `ghost_fields.velocity_at_wall` says.

        Args:
            a: (2, n) grad p/rho [m/s^2]. relative: (n,) viscosity over that at the liquidus.
                step: [s]. nu: at the liquidus [m^2/s].
        """
        a_x, a_z = (self.backend.component(a, k) for k in (0, 1))
        tables: Constants = {"m": relative, "a_x": a_x, "a_z": a_z, **self._walls_along}
        fields = {**self.sources, "v": v, "x": self.pairs.position}
        function = ghost_fields.velocity_at_wall
        self.backend.pointwise(function, fields, v, **tables, step=step, nu=nu)

    def mirror_velocity(self, v: Array, jump: Array) -> Array:
        """Velocities (2, n) on the block with ghosts as mirrors at the walls show them [m/s].

        Beyond a stressed surface they continue the profile: mirrored, it would bend there, and its
        divergence with it. Args as of `extend_velocity`.
        """
        return self._extended_velocity(v, jump, self._mirror)

    def _extended_velocity(self, v: Array, jump: Array, rules: Constants) -> Array:
        v_x, v_z = (self.backend.component(v, k) for k in (0, 1))
        tables = {"v_x": v_x, "v_z": v_z, **rules}
        if self._beyond is None:
            return self.extend(ghost_fields.extended_velocity, tables | {"jump": jump})
        tables["jump_x"], tables["jump_z"] = (self.backend.component(jump, k) for k in (0, 1))
        return self.extend(ghost_fields.velocity_across, tables)

    def mirror(self, v: Array) -> Array:
        """A vector field (2, n) on the block with ghosts, as the faces between mirror it."""
        v_x, v_z = (self.backend.component(v, k) for k in (0, 1))
        tables: Constants = {"v_x": v_x, "v_z": v_z, **self.signs}
        if self._beyond is None:
            return self.extend(ghost_fields.mirrored_vector, tables)
        return self.extend(ghost_fields.vector_across, tables | self._normals())

    def _normals(self) -> Constants:
        """Tables of the surface's normal at each particle, and of what lies beyond it."""
        assert self._beyond is not None
        n_x, n_z = (self.backend.component(self._beyond.normal, k) for k in (0, 1))
        return {"n_x": n_x, "n_z": n_z, **self._across}

    def pressure_across(self, p: Array) -> Array | None:
        """(M,) pressure, carried on beyond a surface that moves; None where there is none."""
        if self._beyond is None:
            return None
        found, tables = self.backend.zeros(self.total), {"p": p, "p_b": self._beyond.pressure}
        function = ghost_fields.pressure_across
        self.backend.pointwise(function, self.sources, found, **tables, **self._across)
        return found

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
        if self._beyond is not None:
            function, tables = ghost_fields.tensor_across, tables | self._normals()
        backend.pointwise(function, self.sources, out, **tables, **self.signs)
        return out

    def _place(
        self, position: Array, out: Array | None = None, across: Constants | None = None
    ) -> Array:
        """Places of all; `across` says by type what is shifted across the surface."""
        x, z = (self.backend.component(position, k) for k in (0, 1))
        tables = {"x": x, "z": z, **self.signs, **self._offsets}
        if self._beyond is None:
            return self.extend(ghost_fields.ghost_position, tables, out)
        tables["shift_x"], tables["shift_z"] = (
            self.backend.component(self._beyond.shift, k) for k in (0, 1)
        )
        tables |= across or self._across
        return self.extend(ghost_fields.position_across, tables, out)
