"""The block of particles that may move, their images, and their pairs.

The layers from the surface down to some depth below the melt form the block; they have the first
numbers. Its pairs are searched in every step, those of the particles below stay as they are. A
margin of resting layers below the moving rows belongs to the block, so that every moving particle
finds all its neighbors there. Fields of the block with images are gathers of the particles' own:

    f_extended[k] = f[source[k]]

where a particle of the block is its own source.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from lasersph.compute import search
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, matmul, outer
from lasersph.particles.images import LOWER, UPPER, Images, ways_of
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.solvers.conduction.body import Weighing
from lasersph.solvers.melt_pool.near_melt import NearMelt
from lasersph.solvers.melt_pool.sides import Sides

SKIN = 1.02
"""Reach of the search over the support: positions change a little within a step."""


def mirrored(x, sign, offset):
    """Place of an image [m]; sign 1 and offset 0 for a particle itself."""
    return sign * x + offset


def image_velocity(v, factor, added, slope, reach, along):
    """Velocity of an image [m/s]: S v + c, and the slope of a stressed surface.

    Args:
        reach: 2 d tau / eta of the source [m/s]. along: tangent of the surface.
    """
    return factor * v + added + slope * reach * along


def mirrored_tensor(M, sign, e_x, e_z):
    """Tensor of an image, S M S with the signs on the diagonal of S."""
    S = dot(sign, e_x) * outer(e_x, e_x) + dot(sign, e_z) * outer(e_z, e_z)
    return matmul(S, matmul(M, S))


def mirrored_part(d, factor):
    """S d, what remains of the image's velocity where walls rest and no stress acts [m/s]."""
    return factor * d


def wall_terms(g_ij, held_j, P_w_j, T_w_j, flux_j, normal_j, plane_j, x_i, x_j):
    """What a pair with an image beyond a face brings: pull A [m^(d-2)], A P_w, A T_w, power b.

    Beyond a held face c_ij = n_ij / n_i times the weight, n normal to the face; beyond a heated one
    2 q n_j times the weight.
    """
    n_i = max(plane_j - dot(x_i, normal_j), 1.0e-30)
    n_j = dot(x_j, normal_j) - plane_j
    pull = held_j * g_ij * (n_i + n_j) / n_i
    return pull, pull * P_w_j, pull * T_w_j, 2.0 * (1.0 - held_j) * g_ij * flux_j * n_j


def inner_weight(g_ij, held_j):
    """Weight of a pair that conducts between particles: 0 toward held images."""
    return g_ij * (1.0 - held_j)


def seen(value, base, sign):
    """Number of a layer or its factor as images show it: base + sign * value."""
    return base + sign * value


def distance(r_ij):
    """Distance of a pair [m]."""
    return r_ij


def weight_of(g_ij):
    """Weight of a pair, for its sum over the neighbors."""
    return g_ij


@dataclass(frozen=True)
class Carried:
    """What stays of the particles while they move, host arrays by number.

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
    """Particles 0 ... count - 1 with their images and pairs.

    Args:
        lattice: what stays of the particles while they move. sides: of the domain.
        layers, rows: layers and particles whose rows are complete. count: particles with the
            margin below them. bottom: z of its lowest face [m]. has_bottom: whether that is the
            bottom of the domain.
        potential, enthalpy: heat potential [W/m] and enthalpy [J/kg] of a wall's temperature [K].

    Attributes:
        source: (M,) particle behind each of the block with images. pairs: NeighborList with the
            rows of the block, among all M. weights: (pairs,) g_ij [1] at the last positions.
        moving_support: of the particles that move, the finest [m]. reach: of any of the block [m].
        images: how they came about. wanted: numbers of the particles whose rows were found,
            is_wanted: (count,) 1 for them.
    """

    def __init__(
        self,
        backend: Backend,
        lattice: Carried,
        sides: Sides,
        *,
        layers: int,
        rows: int,
        count: int,
        bottom: float,
        has_bottom: bool,
        potential: Callable[[np.ndarray], np.ndarray],
        enthalpy: Callable[[np.ndarray], np.ndarray],
    ) -> None:
        self.backend, self.lattice, self.sides = backend, lattice, sides
        self.layers, self.rows, self.count, self.has_bottom = layers, rows, count, has_bottom
        self.potential, self.enthalpy = potential, enthalpy
        self.volume = backend.asarray(lattice.volume[:count])
        support = lattice.support[:count]
        self.moving_support, largest = float(support.min()), float(support.max())
        self.reach = SKIN * largest
        self._own_support = backend.asarray(support), backend.asarray(SKIN * support)
        (x, z), repeats = sides.box, sides.flow_kind("left") == "periodic"
        self._sides = x, (max(z[0], bottom), z[1])
        near = SKIN * float(lattice.weighing.mean(self.moving_support, largest))
        self._near_melt = NearMelt(backend, count, self._sides, near, repeats=repeats)
        self.images = Images(
            backend, count, self.reach, ways_of(sides.face_pairs(has_bottom=has_bottom))
        )
        self._take_rules()
        self._take_factors()

    def _take_rules(self) -> None:
        """Tables of what images carry."""
        images = self.images
        rules = self.sides.rules(images.ways)
        self.has_walls = bool(rules.held.any() or rules.flux.any())
        names = ("factor", "added", "slope", "held", "flux", "normal", "plane")
        self._rules = {name: images.table(getattr(rules, name)) for name in names}
        is_image = np.arange(images.ways.count) > 0
        for name, values in self._wall_state(rules.wall_temperature).items():
            self._rules[name] = images.table(is_image * values)
        self._varies = images.table(rules.varies) if rules.varies.any() else None

    def _wall_state(self, temperature: np.ndarray) -> dict[str, np.ndarray]:
        """Temperature, heat potential and enthalpy of walls."""
        return {
            "T_w": temperature,
            "P_w": self.potential(temperature),
            "wall_enthalpy": self.enthalpy(temperature),
        }

    def _take_factors(self) -> None:
        """Layers and factors of the particles, and tables of how images show them.

        Beyond surface and bottom the factors of `sph.second_moment` are mirrored, however deep the
        layer is from which a particle came there.
        """
        backend, lattice, images = self.backend, self.lattice, self.images
        layer, last = lattice.layer[: self.count], lattice.layers - 1
        normal, lateral = lattice.weighing.factors(layer)
        ends, _ = lattice.weighing.factors(np.array([-1, 0, last, last + 1]))
        crossed = images.ways.crossed[1]
        is_up, is_down = crossed == UPPER, crossed == LOWER
        sign = images.table(np.where(is_up | is_down, -1.0, 1.0))
        bases = {
            "layer": -1.0 * is_up + (2.0 * last + 1.0) * is_down,
            "normal": ends[:2].sum() * is_up + ends[2:].sum() * is_down,
        }
        self._factors = {
            name: (backend.asarray(values), images.table(bases[name]), sign)
            for name, values in (("layer", layer), ("normal", normal))
        }
        self._lateral = backend.asarray(lateral)

    def gather(self, field: Any) -> Any:
        """The field of all particles on the block with images: (..., n) to (..., M)."""
        out = self.backend.zeros((*field.shape[:-1], self.total))
        self.backend.gather(field, self.source, out)
        return out

    def find_pairs(self, position: Any, wanted: Any) -> None:
        """Images of the particles at `position`, shape (2, n) [m], and pairs of the wanted ones.

        Args:
            wanted: (count,) 1 where the row of a particle is to be found, else 0.

        Raises:
            EscapedParticle: a position is not finite or beyond the sides.
        """
        backend, lattice, images = self.backend, self.lattice, self.images
        self.is_wanted, self.wanted = wanted, backend.rows_where(wanted, 1.0)
        images.find(position)
        self.total, self.source = images.total, images.source
        self.rules = {name: images.of_way(table) for name, table in self._rules.items()}
        self.V, (self.support, reach) = (
            self.gather(self.volume), [self.gather(own) for own in self._own_support]
        )  # fmt: skip
        self._weighing = {"V": self.V, "lateral": self.gather(self._lateral)}
        for name, (values, base, sign) in self._factors.items():
            fields = {
                "value": self.gather(values), "base": images.of_way(base),
                "sign": images.of_way(sign),
            }  # fmt: skip
            backend.pointwise(seen, fields, fields["value"])
            self._weighing[name] = fields["value"]
        place = self._place(position)
        self._vary(place)
        row_start, neighbor = search.neighbor_list(
            backend, place, reach, self.count, mean=lattice.weighing.mean,
            lower=self._corner(0), upper=self._corner(1), wanted=self.wanted,
        )  # fmt: skip
        self.pairs = NeighborList(
            row_start, neighbor, place, self.support, lattice.weighing.kernel,
            lattice.weighing.mean, (0.0, 0.0),
        )  # fmt: skip
        self._folded = backend.zeros(neighbor.shape[0], "index")
        backend.gather(self.source, neighbor, self._folded)
        self.weights = backend.zeros(neighbor.shape[0])
        self._weigh()

    def _vary(self, place: Any) -> None:
        """State of the images beyond a face whose temperature varies along it.

        Found on the host: it is that of few images, and curves of the material.
        """
        if self._varies is None:
            return
        backend = self.backend
        rows = backend.rows_where(self.images.of_way(self._varies), 1.0)
        chosen = backend.zeros((2, rows.shape[0]))
        backend.gather(place, rows, chosen)
        T = self.sides.varying_temperature(backend.to_host(chosen)[0])
        for name, values in self._wall_state(T).items():
            backend.scatter(backend.asarray(values), rows, self.rules[name])

    def move(self, position: Any) -> None:
        """The same pairs at other positions."""
        self.pairs = replace(self.pairs, position=self._place(position))
        self._weigh()

    def folded(self) -> NeighborList:
        """The pairs with every image replaced by its source."""
        head = self.backend.head
        return replace(
            self.pairs,
            neighbor=self._folded,
            position=head(self.pairs.position, self.count),
            support=head(self.support, self.count),
        )

    def velocity(self, v: Any, reach: Any) -> Any:
        """Velocities (2, M) from those of the particles (2, n) [m/s].

        Args:
            reach: (n,) 2 d tau / eta [m/s].
        """
        moved = self.gather(v)
        fields = {"v": moved, "reach": self.gather(reach)} | self.rules
        self.backend.pointwise(image_velocity, fields, moved, along=(1.0, 0.0))
        return moved

    def homogeneous(self, d: Any) -> Any:
        """A change of velocity (2, n) on the block with images: S d."""
        moved = self.gather(d)
        self.backend.pointwise(mirrored_part, {"d": moved} | self.rules, moved)
        return moved

    def reflected(self, v: Any, reach: Any) -> Any:
        """Velocities (2, n) on the block with images as mirrors at the walls show them [m/s].

        Beyond a stressed surface they continue the profile: mirrored, it would bend there, and its
        divergence with it. Args as of `velocity`.
        """
        moved = self.gather(v)
        fields = {
            "v": moved, "factor": self.images.sign, "slope": self.rules["slope"],
            "reach": self.gather(reach),
        }  # fmt: skip
        self.backend.pointwise(
            image_velocity, fields, moved, added=(0.0, 0.0), along=(1.0, 0.0)
        )  # fmt: skip
        return moved

    def tensor(self, M: Any) -> Any:
        """Tensors (2, 2, count) of the block on the block with images."""
        turned = self.gather(M)
        fields = {"M": turned, "sign": self.images.sign}
        self.backend.pointwise(
            mirrored_tensor, fields, turned, e_x=(1.0, 0.0), e_z=(0.0, 1.0)
        )  # fmt: skip
        return turned

    def touched(self, position: Any, fluid: Any) -> Any:
        """(count,) 1 for particles in reach of a fluid one, or nearly so; see `near_melt`.

        Args:
            position: (2, n) [m]. fluid: (n,) 1 where a particle flows or did so one step ago.

        Raises:
            EscapedParticle: a position is not finite or beyond the sides.
        """
        return self._near_melt.find(position, fluid)

    def smallest_distance(self, position: Any, rows: Any) -> float:
        """Smallest distance from one of `rows` to another particle or image [m]."""
        pairs = replace(self.pairs, position=self._place(position))
        (least,) = self.backend.pair_sum(
            distance, pairs, {}, (None,), rows=rows, combine=("min",), reduce=("min",)
        )
        return least

    def _place(self, position: Any) -> Any:
        place = self.gather(position)
        fields = {"x": place, "sign": self.images.sign, "offset": self.images.offset}
        self.backend.pointwise(mirrored, fields, place)
        return place

    def _weigh(self) -> None:
        weighing = self.lattice.weighing
        self.backend.pair_values(
            weighing.function, self.pairs, self._weighing, self.weights, **weighing.constants
        )

    def _corner(self, end: int) -> tuple[float, ...]:
        """Box that no particle and no image may leave [m]."""
        outward = -1.0 if end == 0 else 1.0
        return tuple(pair[end] + outward * self.reach for pair in self._sides)
