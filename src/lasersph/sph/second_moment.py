"""Weights that conduct exactly on a lattice of layers.

The plain weights g_ij carry a bias: on a uniform lattice their second moment is not exactly 1
(1-D cubic spline at l = 3 dx: 0.988, 3-D 1.010), and layers graded by 7/9 conduct up to 3 % too
little, with errors up to 10 % where the grading begins. Here each weight gets a factor such that

    normal:   sum over the pairs that cross the plane p between two layers of g_ij |z_ij| = area
    lateral:  sum over the pairs of a layer of g_ij x_ij^2 = 2 volume, for each lateral axis

that is, a linear temperature flows with its exact flux through every plane. The factor of a pair
across layers is the mean of those of the planes it crosses, f_p, stored as the running sum
N_k = f_0 + ... + f_(k-1); so it is symmetric in i and j, and constants stay exactly at rest. The
conditions are met in the least-squares sense, factors pulled to 1 by a weight of 1e-3.

Left out: moments of single particles where layers of unequal columns meet; they hold on average
over the layer.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.extended_lattice import GHOSTS
from lasersph.particles.layers import Layers
from lasersph.sph.kernels import Kernel

Array = NDArray[np.float64]
KEPT = 3 * GHOSTS
"""Layers kept of a uniform stretch; the others repeat them."""
LARGEST_SAMPLE = 4096
"""Columns over which layers of different width repeat, at most. Geometry: a longer pattern is cut,
and the conditions hold to 1 / 4096 of a period."""
PULL = 1e-3
"""Weight of keeping the factors near 1 against meeting the moments, in the least squares sense.
Accuracy: 1e-6 in the sum, so that moments are met where they can be."""

LEAST_SHARE = 1e-9
"""Share of what a layer conducts along its normal below which it gives another one nothing.
Rounding: weights at the end of a support are 0 but for that."""


@dataclass(frozen=True)
class LayerFactors:
    """Factors of layers -GHOSTS ... layers + GHOSTS - 1: running normal sum N and lateral a."""

    normal: Array
    lateral: Array

    def at(self, layer: NDArray[np.int64]) -> tuple[Array, Array]:
        """N and a of particles with the given layer numbers."""
        return self.normal[layer + GHOSTS], self.lateral[layer + GHOSTS]


@lru_cache(maxsize=1)  # heat and flow of a run ask for the same
def _solved(
    layers: Layers, kernel: Kernel, support_ratio: float, mean: Callable[[float, float], float]
) -> tuple[_Lattice, NDArray[np.int64], Array, Array]:
    """The short stack in which all layers of different surroundings occur, the layer of it that
    each layer is, and its factors of planes and layers."""
    # coarse columns have weights of their own
    short, index = _shortened(layers.fine_only if layers.beside else layers)
    lattice = _Lattice(short, kernel, support_ratio, mean)
    return lattice, index, *lattice.solve()


def layer_exchange(
    layers: Layers, kernel: Kernel, support_ratio: float, mean: Callable[[float, float], float]
) -> Array:
    """(layers, 2 GHOSTS + 1) what each layer gives that `GHOSTS - k` above it, per area and unit
    difference of P: the sum of the corrected weights of a planar cell over its area [1/m]."""
    lattice, index, planes, lateral = _solved(layers, kernel, support_ratio, mean)
    return lattice.exchange(planes, lateral)[index]


@lru_cache(maxsize=1)
def layer_factors(
    layers: Layers, kernel: Kernel, support_ratio: float, mean: Callable[[float, float], float]
) -> LayerFactors:
    """Solve for the factors of all layers, mirrored beyond surface and bottom."""
    _, index, planes, lateral = _solved(layers, kernel, support_ratio, mean)
    total = layers.thickness.size

    # layers beyond the faces mirror those inside
    number = np.arange(-GHOSTS, total + GHOSTS)
    inside = np.where(number < 0, -1 - number, number)
    inside = np.where(inside >= total, 2 * total - 1 - inside, inside)
    inside = np.clip(inside, 0, total - 1)
    # plane p lies below layer p; planes beyond the faces mirror those inside
    plane = np.arange(-GHOSTS, total + GHOSTS)
    mirrored = np.where(plane < -1, -2 - plane, plane)
    mirrored = np.where(mirrored > total - 1, 2 * (total - 1) - mirrored, mirrored)
    mirrored = np.clip(mirrored, -1, total - 1)
    factor = np.where(mirrored < 0, planes[0], planes[index[np.maximum(mirrored, 0)] + 1])

    # N_k = f_0 + ... + f_(k-1)
    normal = np.concatenate([[0.0], np.cumsum(factor)[:-1]])
    return LayerFactors(normal, lateral[index[inside]])


def _shortened(layers: Layers) -> tuple[Layers, NDArray[np.int64]]:
    """Layers with long uniform stretches cut to KEPT, and the short layer that each layer is."""
    d = layers.thickness
    # a uniform stretch: layers as thick as the one above
    same = np.concatenate([[False], np.abs(np.diff(d)) < 1e-9 * d[1:]])
    starts = np.flatnonzero(~same)
    kept: list[int] = []
    index = np.zeros(d.size, np.int64)
    # of a long stretch keep both ends, whose neighbors differ; the inside repeats
    for start, end in zip(starts, [*starts[1:], d.size], strict=True):
        length = end - start
        base = len(kept)
        if length <= 2 * KEPT:
            kept.extend(range(start, end))
            index[start:end] = base + np.arange(length)
            continue
        kept.extend([*range(start, start + KEPT), *range(end - KEPT, end)])
        position = np.arange(length)
        index[start:end] = base + np.where(
            position < KEPT, position, np.maximum(position - (length - 2 * KEPT), KEPT)
        )
    return Layers(d[kept], layers.columns[:, kept], layers.bounds, layers.geometry), index


class _Lattice:
    """The conditions on a short stack of layers, mirrored at both ends."""

    def __init__(
        self, layers: Layers, kernel: Kernel, ratio: float, mean: Callable[[float, float], float]
    ) -> None:
        self.layers, self.kernel, self.ratio, self.mean = layers, kernel, ratio, mean
        self.total = layers.thickness.size
        self.center = layers.center()
        self.width = layers.column_width()
        self.depth = float(layers.thickness.sum())
        self.cache: dict[tuple[float, ...], Array] = {}

    def solve(self) -> tuple[Array, Array]:
        """Factors of planes -1 ... total - 1 and of layers."""
        total, planes = self.total, self.total + 1
        # conditions: flux through each plane, then lateral moment of each layer
        matrix = np.zeros((planes + total, planes + total))
        for k in range(total):
            for step in range(-GHOSTS, GHOSTS + 1):
                other, z = self._neighbor(k, k + step)
                # two layers further apart than the support exchange nothing
                if other is not None and abs(z) < self._support(k, other):
                    self._add(matrix, k, k + step, other, z)
        target = np.concatenate([np.ones(planes), np.full(total, 2.0)])
        # 1-D has no lateral pairs: factor 1
        if not self.layers.bounds:
            matrix[planes:, planes:] = 2.0 * np.eye(total)

        # least squares for the deviation from 1, pulled to 0
        ones = np.ones(planes + total)
        missing = (target - matrix @ ones) / PULL
        system = np.vstack([matrix / PULL, np.eye(planes + total)])
        change = np.linalg.lstsq(system, np.concatenate([missing, 0.0 * ones]), rcond=None)[0]
        factors = ones + change
        return factors[:planes], factors[planes:]

    def exchange(self, planes: Array, lateral: Array) -> Array:
        """(layers, 2 GHOSTS + 1) sums of the weights between two layers over their area [1/m]."""
        total, d = self.total, self.layers.thickness
        found = np.zeros((total, 2 * GHOSTS + 1))
        for k in range(total):
            for step in (*range(-GHOSTS, 0), *range(1, GHOSTS + 1)):
                other, z = self._neighbor(k, k + step)
                if other is None or abs(z) >= self._support(k, other):
                    continue
                # the mean factor of the planes that are crossed, and that of both layers
                along, across, _, _ = self._moments(k, other, z)
                normal = planes[self._crossed(k, k + step)].mean()
                weight = along * normal + 0.5 * across * (lateral[k] + lateral[other])
                if weight * z * z > LEAST_SHARE * (d[k] + d[other]):
                    found[k, GHOSTS + step] = weight
        return found

    def _crossed(self, k: int, number: int) -> NDArray[np.int64]:
        """Places of the planes between layers k and `number`, those beyond the faces mirrored."""
        crossed = np.arange(min(k, number), max(k, number))
        mirrored = np.where(crossed < -1, -2 - crossed, crossed)
        last = self.total - 1
        return np.where(mirrored > last, 2 * last - mirrored, mirrored) + 1

    def _neighbor(self, k: int, number: int) -> tuple[int | None, float]:
        """Layer inside that layer `number` mirrors, and its z."""
        total = self.total
        # reflect at the surface, then at the bottom
        inside = -1 - number if number < 0 else number
        inside = 2 * total - 1 - inside if inside >= total else inside
        if not 0 <= inside < total:
            return None, 0.0
        z = self.center[inside]
        if number < 0:
            z = -z
        elif number >= total:
            z = -2.0 * self.depth - z
        return inside, self.center[k] - z

    def _add(self, matrix: Array, k: int, number: int, other: int, z: float) -> None:
        """Add the pairs of layer k with layer `number` to the conditions."""
        planes = self.total + 1
        # sums per area of layer k
        along, across, x_along, x_across = self._moments(k, other, z)
        thickness = self.layers.thickness[k]

        # planes between the two layers, those beyond the faces mirrored; the pair takes their mean
        low, high = min(k, number), max(k, number)
        crossed, share = self._crossed(k, number), np.zeros(planes)
        if crossed.size:
            np.add.at(share, crossed, 1.0 / crossed.size)
        # pairs of two inner layers are met from both sides
        counted = 0.5 if 0 <= number < self.total else 1.0
        # normal condition: g |z| of the pair counts in each plane that it crosses
        rows = slice(max(low, -1) + 1, min(high, planes - 1) + 1)
        flux = counted * abs(z)
        matrix[rows, :planes] += flux * along * share
        matrix[rows, planes + k] += 0.5 * flux * across
        matrix[rows, planes + other] += 0.5 * flux * across
        # lateral condition: g x^2 over the thickness of the layer
        if self.layers.bounds:
            matrix[planes + k, :planes] += x_along / thickness * share
            matrix[planes + k, planes + k] += 0.5 * x_across / thickness
            matrix[planes + k, planes + other] += 0.5 * x_across / thickness

    def _moments(self, k: int, other: int, z: float) -> Array:
        """Per area of layer k: sums of g e_n^2, g (1 - e_n^2), and both times x^2 (mean axis)."""
        d = self.layers.thickness
        key = (d[k], d[other], round(z / d[k], 9), *self.width[:, k], *self.width[:, other])
        if key not in self.cache:
            self.cache[key] = self._sum(k, other, z)
        return self.cache[key]

    def _support(self, k: int, other: int) -> float:
        """Support radius of a pair of two layers [m]."""
        d = self.layers.thickness
        return self.mean(self.ratio * d[k], self.ratio * d[other])

    def _sum(self, k: int, other: int, z: float) -> Array:
        d, support = self.layers.thickness, self._support(k, other)
        offsets = [
            self._offsets(axis, k, other, support) for axis in range(len(self.layers.bounds))
        ]

        # squares of the lateral distances of all pairs, from each column of a period
        samples = 1
        squares: list[Array] = [np.zeros(1)]
        if len(offsets) == 1:
            samples = offsets[0].shape[0]
            squares = [offsets[0].ravel() ** 2]
        elif len(offsets) == 2:
            samples = offsets[0].shape[0] * offsets[1].shape[0]
            x, y = np.meshgrid(offsets[0].ravel() ** 2, offsets[1].ravel() ** 2, indexing="ij")
            squares = [x.ravel(), y.ravel()]

        # neighbors within the support, but for the particle itself
        r2 = z * z + np.sum(squares, axis=0)
        is_near = (r2 < support * support) & (r2 > 1e-12 * support * support)
        r = np.sqrt(r2[is_near])

        # g_ij = -2 V_i V_j (dW/dr) / r per area of layer k, its moments by e_n^2 and 1 - e_n^2
        slope = np.vectorize(self.kernel.slope, otypes=[float])(r / support)
        volume = d[k] * d[other] * np.prod(self.width[:, other])
        scale = self.kernel.sigma / support ** (self.kernel.dimension + 1)
        g = -2.0 * volume * scale * slope / r / samples
        share = z * z / (r * r)
        lateral = np.mean([s[is_near] for s in squares], axis=0)
        parts = (share * g, (1.0 - share) * g)
        return np.array([(part * factor).sum() for factor in (1.0, lateral) for part in parts])

    def _offsets(self, axis: int, k: int, other: int, support: float) -> Array:
        """(columns of layer k, neighbors) x_i - x_j along an axis of the endless lattice."""
        w_i, w_j = self.width[axis, k], self.width[axis, other]
        count = int(self.layers.columns[axis, k])
        columns = np.arange(1 if abs(w_i - w_j) < 1e-9 * w_i else min(count, LARGEST_SAMPLE))
        # each column of layer k, and the columns of the other layer within the support around it
        x = (columns + 0.5) * w_i
        farthest = int(np.ceil(support / w_j)) + 1
        nearest = np.floor(x / w_j).astype(np.int64)
        steps = np.arange(-farthest, farthest + 1)
        return x[:, None] - (nearest[:, None] + steps + 0.5) * w_j
