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
from lasersph.particles.images import LOWER, UPPER, images_of
from lasersph.particles.neighbors import NeighborList
from lasersph.solvers.conduction.body import Weighing
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
        self.layers, self.rows, self.count = layers, rows, count
        self.bottom, self.has_bottom = bottom, has_bottom
        self.potential, self.enthalpy = potential, enthalpy
        self.volume = backend.asarray(lattice.volume[:count])
        self.largest_support = float(lattice.support[:count].max())
        self.reach = SKIN * self.largest_support

    def gather(self, field: Any) -> Any:
        """The field of all particles on the block with images: (..., n) to (..., M)."""
        out = self.backend.zeros((*field.shape[:-1], self.total))
        self.backend.gather(field, self.source, out)
        return out

    def find_pairs(self, position: Any, wanted: np.ndarray) -> None:
        """Images of the particles at `position`, shape (2, n) [m], and pairs of the wanted ones.

        Args:
            wanted: host array (count,), whether the row of a particle is to be found.

        Raises:
            EscapedParticle: a position is not finite or beyond the sides.
        """
        backend, lattice, count = self.backend, self.lattice, self.count
        self.wanted = backend.asarray(np.flatnonzero(wanted), "index")
        host = backend.to_host(position)[:, :count]
        images = images_of(host, self.reach, self.sides.face_pairs(has_bottom=self.has_bottom))
        rules = self.sides.rules(images, host)
        self.total = count + images.count
        source = np.concatenate([np.arange(count), images.source])
        self.source = backend.asarray(source, "index")
        self.sign = backend.asarray(_padded(images.sign, count, 1.0))
        self.offset = backend.asarray(_padded(images.offset, count, 0.0))
        self.rules = {
            name: backend.asarray(_padded(getattr(rules, name), count, rest))
            for name, rest in (
                ("factor", 1.0), ("added", 0.0), ("slope", 0.0), ("held", 0.0),
                ("flux", 0.0), ("normal", 0.0), ("plane", 0.0),
            )
        }  # fmt: skip
        T = rules.wall_temperature
        self.has_walls = bool(np.any(rules.held) or np.any(rules.flux))
        for name, values in (
            ("T_w", T), ("P_w", self.potential(T)), ("wall_enthalpy", self.enthalpy(T))
        ):  # fmt: skip
            self.rules[name] = backend.asarray(_padded(values, count, 0.0))
        support = lattice.support[source]
        layer, normal, lateral = self._factors(source, images.crossed[1])
        self.V = backend.asarray(lattice.volume[source])
        self.support = backend.asarray(support)
        self._weighing = {
            "V": self.V, "layer": backend.asarray(layer), "normal": backend.asarray(normal),
            "lateral": backend.asarray(lateral),
        }  # fmt: skip
        place = self._place(position)
        row_start, neighbor = search.neighbor_list(
            backend, place, backend.asarray(SKIN * support), count, mean=lattice.weighing.mean,
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
            "v": moved, "factor": self.sign, "slope": self.rules["slope"],
            "reach": self.gather(reach),
        }  # fmt: skip
        self.backend.pointwise(
            image_velocity, fields, moved, added=(0.0, 0.0), along=(1.0, 0.0)
        )  # fmt: skip
        return moved

    def tensor(self, M: Any) -> Any:
        """Tensors (2, 2, count) of the block on the block with images."""
        turned = self.gather(M)
        fields = {"M": turned, "sign": self.sign}
        self.backend.pointwise(
            mirrored_tensor, fields, turned, e_x=(1.0, 0.0), e_z=(0.0, 1.0)
        )  # fmt: skip
        return turned

    def touched(self, position: Any, fluid: Any) -> np.ndarray:
        """Host array (count,): whether a particle is in reach of a fluid one, or nearly so.

        Particles and their neighbors lie in cells as wide as the reach that touch each other.

        Args:
            position: (2, n) [m]. fluid: (n,) 1 where a particle flows or did so one step ago.

        Raises:
            EscapedParticle: a position is not finite or beyond the sides.
        """
        host = self.backend.to_host(position)[:, : self.count]
        search.refuse_escape(host, self._corner(0), self._corner(1))
        flows = self.backend.to_host(fluid)[: self.count] > 0.0
        (x0, x1), _ = self.sides.box
        corner = np.array([[x0 - 2.0 * self.reach], [self.bottom - 2.0 * self.reach]])
        cell = ((host - corner) / self.reach).astype(np.int64)
        shape = cell.max(axis=1) + 2
        marks = np.zeros(shape, bool)
        marks[cell[0, flows], cell[1, flows]] = True
        for axis in (0, 1):
            marks |= np.roll(marks, 1, axis) | np.roll(marks, -1, axis)
        if self.sides.flow_kind("left") == "periodic":
            width = round((x1 - x0) / self.reach) + 3
            ends = [*range(5), *range(max(width - 4, 0), shape[0])]
            near = marks[ends].any(axis=0)
            marks[ends] |= near
        return marks[cell[0], cell[1]]

    def smallest_distance(self, position: Any, rows: Any) -> float:
        """Smallest distance from one of `rows` to another particle or image [m]."""
        pairs = replace(self.pairs, position=self._place(position))
        (least,) = self.backend.pair_sum(
            distance, pairs, {}, (None,), rows=rows, combine=("min",), reduce=("min",)
        )
        return least

    def _place(self, position: Any) -> Any:
        place = self.gather(position)
        fields = {"x": place, "sign": self.sign, "offset": self.offset}
        self.backend.pointwise(mirrored, fields, place)
        return place

    def _factors(self, source: np.ndarray, crossed: np.ndarray) -> tuple[np.ndarray, ...]:
        """Layer, running normal factor and lateral factor of particles and images.

        Beyond surface and bottom the factors of `sph.second_moment` are mirrored, however deep the
        layer is from which a particle came there.
        """
        lattice, last = self.lattice, self.lattice.layers - 1
        layer = lattice.layer[source]
        normal, lateral = lattice.weighing.factors(layer)
        ends, _ = lattice.weighing.factors(np.array([-1, 0, last, last + 1]))
        beyond = np.concatenate([np.zeros(self.count, np.uint8), crossed])
        for end, mirror, ends_at in ((UPPER, -1, ends[:2]), (LOWER, 2 * last + 1, ends[2:])):
            normal = np.where(beyond == end, ends_at.sum() - normal, normal)
            layer = np.where(beyond == end, mirror - layer, layer)
        return layer, normal, lateral

    def _weigh(self) -> None:
        weighing = self.lattice.weighing
        self.backend.pair_values(
            weighing.function, self.pairs, self._weighing, self.weights, **weighing.constants
        )

    def _corner(self, end: int) -> tuple[float, ...]:
        """Box that no particle and no image may leave [m]."""
        outward = -1.0 if end == 0 else 1.0
        (x, z) = self.sides.box
        bottom = max(z[0], self.bottom)
        return tuple(pair[end] + outward * self.reach for pair in (x, (bottom, z[1])))


def _padded(values: np.ndarray, count: int, rest: float) -> np.ndarray:
    """Values of the images after `count` equal ones for the particles themselves."""
    return np.concatenate([np.full((*values.shape[:-1], count), rest), values], axis=-1)
