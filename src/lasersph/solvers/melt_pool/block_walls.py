"""`BlockWalls`: what the faces between particles of a block and their ghosts mean to heat.

Beyond a Dirichlet face a ghost knows its temperature, beyond a Neumann face its flux, beyond both
where the face lies (`block_terms.wall_terms`). Where a temperature varies along a face it is found
for each ghost; below a surface that moves the face is the tangent at the source.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.particles.faces import SURFACE
from lasersph.solvers.melt_pool import ghost_fields
from lasersph.solvers.melt_pool.face_conditions import FaceConditions, GhostRules
from lasersph.solvers.melt_pool.ghost_extension import GhostExtension


class BlockWalls:
    """Faces between particles and their ghosts.

    Args:
        potential, enthalpy: heat potential [W/m] and enthalpy [J/kg] of a wall's temperature [K].

    Attributes:
        exchange_heat: whether any does. min_distance: see `wall_terms` [m]. heat_face: (M,) number
            of the face that heat crosses, 0 where there is none. rules: (M,) what they mean to
            heat, by the names of `ghost_walls`. force_shares: lower, upper, see
            `FaceConditions.force_shares`.
    """

    def __init__(
        self,
        backend: Backend,
        conditions: FaceConditions,
        rules: GhostRules,
        ghosts: GhostExtension,
        *,
        potential: Callable[[np.ndarray], np.ndarray],
        enthalpy: Callable[[np.ndarray], np.ndarray],
    ) -> None:
        self.backend, self.conditions, self.ghosts = backend, conditions, ghosts
        self.potential, self.enthalpy = potential, enthalpy
        self.exchange_heat = bool(rules.dirichlet.any() or rules.flux.any())
        self.min_distance = ghosts.surface.min_distance
        self.heat_face = backend.zeros(0)
        self.rules: dict[str, Array] = {}
        # tables by the type of a ghost; particles themselves have no wall
        table = ghosts.particles.table
        names = ("normal", "dirichlet", "flux", "plane")
        self._walls = {name: table(getattr(rules, name)) for name in names}
        is_ghost = np.arange(rules.dirichlet.size) > 0
        for name, values in self._state(rules.wall_temperature).items():
            self._walls[name] = table(is_ghost * values)
        self._varies = table(rules.varies) if rules.varies.any() else None
        self._heat_face = table(rules.heat_face)
        shares = conditions.force_shares(ghosts.particles.ghost_types)
        self.force_shares = {end: table(values) for end, values in shares.items()}

    def _state(self, temperature: np.ndarray) -> dict[str, np.ndarray]:
        """Temperature, heat potential and enthalpy of walls."""
        return {
            "T_w": temperature,
            "P_w": self.potential(temperature),
            "wall_enthalpy": self.enthalpy(temperature),
        }

    def extend(self) -> None:
        """Set `rules` and `heat_face` of the particles and the ghosts that were found."""
        backend, ghosts, size = self.backend, self.ghosts, self.ghosts.size
        fields = {"ghost_type": ghosts.sources["ghost_type"]}
        # what `wall_terms` reads, where walls matter to heat
        self.rules = {"dirichlet": backend.zeros(size)}
        if self.exchange_heat:
            names = ("dirichlet", "flux", "plane", "T_w", "P_w", "wall_enthalpy")
            self.rules = {name: backend.zeros(size) for name in names}
            self.rules["normal"] = backend.zeros((ghosts.dimension, size))
            out = tuple(self.rules.values())
            backend.pointwise(ghost_fields.ghost_walls, fields, out, **self._walls)
        self.heat_face = ghosts.of_type(self._heat_face)

    def find_varying(self) -> None:
        """Set the state of ghosts beyond a face whose temperature varies along it.

        It is found on the host, as that of few ghosts, by the curves of the material.
        """
        backend, ghosts = self.backend, self.ghosts
        if self._varies is None or not self.exchange_heat:
            return
        rows = backend.rows_where(ghosts.of_type(self._varies), 1.0)
        chosen = backend.zeros((ghosts.dimension, rows.shape[0]))
        backend.gather(ghosts.place, rows, chosen)
        T = self.conditions.varying_temperature(backend.to_host(chosen)[:-1])
        for name, values in self._state(T).items():
            backend.scatter(backend.asarray(values), rows, self.rules[name])

    def find_tangents(self) -> None:
        """Set where the tangents of a surface lie between ghosts and their sources."""
        if not self.exchange_heat:
            return
        given = {name: self.rules[name] for name in ("normal", "plane")}
        number = self.conditions.number_of(SURFACE)
        self.ghosts.find_tangent_planes(given, self._heat_face, number)
