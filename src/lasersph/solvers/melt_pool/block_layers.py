"""`BlockLayers`: what the lattice gives the particles of a block, and their ghosts.

Volumes, supports and the factors of `sph.second_moment` follow from the layer in which a particle
was laid out. Ghosts have those of their sources; beyond surface and bottom the factors are
mirrored, however deep the layer is from which a particle came there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.particles.geometry import Geometry
from lasersph.particles.ghosts import LOWER, UPPER, GhostTypes, Reach
from lasersph.particles.support import common
from lasersph.solvers.conduction.body import Weighing
from lasersph.solvers.melt_pool import ghost_fields
from lasersph.solvers.melt_pool.ghost_extension import GhostExtension

SKIN = 1.02
"""Search radius over the support radius. Geometry: pairs are found at the advected positions, from
which the final ones differ by dt/2 times the change of v: two neighbors come 0.02 supports closer
where both change by a third of the largest speed in a step of 0.06 supports."""


@dataclass(frozen=True)
class StaticParticleData:
    """Values of particles that stay the same while they move, host arrays by number.

    Attributes:
        geometry: of the block. position: (d, n) on the lattice [m]. support: (n,) [m]. volume: (n,)
            of the cells [m^2]. layer: (n,). layers: how many there are.
        weighing: how pairs are weighed. additions: to the weights of rings with which they conduct
            heat, an array of the backend; None where there are none.
    """

    geometry: Geometry
    position: np.ndarray
    support: np.ndarray
    volume: np.ndarray
    layer: np.ndarray
    layers: int
    weighing: Weighing
    additions: Array | None = None


class BlockLayers:
    """Volumes, supports and factors of the first particles, and of their ghosts.

    Args:
        volume: (count,) of the particles, which may change [m^2]. types: of the ghosts.
            fine_depth: above which the finest particles stay [m].

    Attributes:
        moving_support: of the particles that move, the finest [m]. search_radius: largest [m].
        mean: support radius of a pair from those of both. reach: within which each particle finds
            neighbors. reach_of_melt: (count,) host array, within which it finds those that move
            [m]. fields: (M,) of particles and ghosts, by the names that pair functions use; V and
            support are among them.
    """

    def __init__(
        self,
        backend: Backend,
        lattice: StaticParticleData,
        volume: Array,
        types: GhostTypes,
        fine_depth: float,
    ) -> None:
        # supports, and the radius within which pairs are searched
        count = volume.shape[0]
        self.backend, support = backend, lattice.support[:count]
        self.moving_support, self.largest_support = float(support.min()), float(support.max())
        self.search_radius = SKIN * self.largest_support
        is_even = self.moving_support == self.largest_support
        self.mean: Callable[[float, float], float] = common if is_even else lattice.weighing.mean
        self.reach = self._reach_of(lattice, support, fine_depth)
        # how far each particle sees those that move, by the few supports that there are
        sizes, place = np.unique(support, return_inverse=True)
        mean = lattice.weighing.mean
        reaches = [SKIN * float(mean(self.moving_support, float(size))) for size in sizes]
        self.reach_of_melt = np.array(reaches)[place]
        self.fields: dict[str, Array] = {}
        # layers, and the factors N and a, of the particles
        layer, last = lattice.layer[:count], lattice.layers - 1
        normal, lateral = lattice.weighing.factors(layer)
        # beyond surface and bottom: mirrored about the first and the last layer
        ends, _ = lattice.weighing.factors(np.array([-1, 0, last, last + 1]))
        is_up, is_down = types.crossed[-1] == UPPER, types.crossed[-1] == LOWER
        factors = {
            "support": support,
            "layer": layer,
            "normal": normal,
            "lateral": lateral,
            "sign": np.where(is_up | is_down, -1.0, 1.0),
            "layer_base": -1.0 * is_up + (2.0 * last + 1.0) * is_down,
            "normal_base": ends[:2].sum() * is_up + ends[2:].sum() * is_down,
        }
        self._tables = {name: backend.asarray(values) for name, values in factors.items()}
        self._tables |= {"V": volume, "radius": self.reach.radius}

    def _reach_of(
        self, lattice: StaticParticleData, support: np.ndarray, fine_depth: float
    ) -> Reach:
        """How far particles find others: up to a plane the finest see no coarse ones, below it as
        far as some coarse layer sees them wherever they move; coarse ones rest."""
        # height and support of each layer, and what coarse ones see of a support
        _, first, place = np.unique(
            lattice.layer[: support.size], return_index=True, return_inverse=True
        )
        height, size = lattice.position[-1][first], support[first]
        is_fine = size <= self.moving_support * (1.0 + 1e-9)
        coarse = np.flatnonzero(~is_fine)
        mean = lattice.weighing.mean
        seen = SKIN * np.array([[mean(float(a), float(b)) for b in size[coarse]] for a in size])
        seen = seen.reshape(size.size, coarse.size)

        # layers that see a particle of each other one, or of the finest above their lowest place
        low = np.where(is_fine, -fine_depth, height)[:, None]
        high = np.where(is_fine, inf, height)[:, None]
        above, below = height[coarse] + seen, height[coarse] - seen
        is_seen = (above > low) & (below < high)
        reach = np.maximum(SKIN * size, np.where(is_seen, seen, 0.0).max(axis=1, initial=0.0))
        plane = float(above[is_fine].max(initial=-inf)) if coarse.size else 0.0
        asarray = self.backend.asarray
        return Reach(asarray(SKIN * support), asarray(reach[place]), plane)

    def extend(self, ghosts: GhostExtension) -> None:
        """Set `fields` of the particles and the ghosts that were found."""
        names = ("V", "support", "radius", "layer", "normal", "lateral")
        self.fields = {name: self.backend.zeros(ghosts.size) for name in names}
        out = tuple(self.fields.values())
        self.backend.pointwise(ghost_fields.ghost_layers, ghosts.sources, out, **self._tables)
