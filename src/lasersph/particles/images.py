"""Images of moving particles beyond flat faces: mirrored, or one period away.

A closed box whose faces mirror (or repeat) the particles inside gives every particle a full
support, so that no sum is cut. Image k of particle s lies at

    x_k = sign x_s + offset            (axis by axis)

and follows its source. Particles closer to a face than the reach have images; those of one axis are
imaged again across the faces of the next, which fills the corners. Sign and offset are those of the
way by which an image came about, one of nine at most; what an image's velocity or temperature is
follows from that way too and is not known here. Left out: one and three dimensions.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.backend import Backend
from lasersph.compute.vectors import vector

Array = NDArray[np.float64]
Table = tuple[Any, ...]
"""Values of each way on the backend, an array (w,) for each component."""
MIRROR, PERIODIC, OPEN = "mirror", "periodic", "open"
LOWER, UPPER = 1, 2
BOTH = 3
"""What `near_faces` says of a particle close to both faces of an axis, LOWER + UPPER."""


@dataclass(frozen=True)
class FacePair:
    """Faces of the box along one axis: kinds MIRROR, PERIODIC (both) or OPEN, and places [m]."""

    lower_kind: str
    upper_kind: str
    lower: float
    upper: float

    def beyond(self, face: int) -> tuple[float, float, float]:
        """Sign, offset [m] and where the sources of images beyond a face are near [m]."""
        kind, plane = (
            (self.lower_kind, self.lower) if face == LOWER else (self.upper_kind, self.upper)
        )
        if kind == OPEN:
            return 1.0, 0.0, np.inf
        if kind == MIRROR:
            return -1.0, 2.0 * plane, plane
        # the image beyond one face of a period belongs to a particle near the other
        near = self.lower + self.upper - plane
        return 1.0, plane - near, near


@dataclass(frozen=True)
class Ways:
    """How particles of the box with images come about; the first way is to be no image.

    Attributes:
        sign, offset: (2, w) [1], [m]. crossed: (2, w) which face of each axis lies between, 0,
            LOWER or UPPER. near: place of the sources beyond each face, x then z [m]; infinite
            beyond an open one.
    """

    sign: Array
    offset: Array
    crossed: NDArray[np.int64]
    near: tuple[float, float, float, float]

    @property
    def count(self) -> int:
        """Number of ways."""
        return self.crossed.shape[1]


def ways_of(faces: tuple[FacePair, FacePair]) -> Ways:
    """Ways through the faces along x and z; those of x come first."""
    rules = [{0: (1.0, 0.0, np.inf)} for _ in faces]
    for rule, pair in zip(rules, faces, strict=True):
        for face in (LOWER, UPPER):
            rule[face] = pair.beyond(face)
    is_there = [[f for f, (_, _, near) in rule.items() if f == 0 or near < np.inf]
                for rule in rules]  # fmt: skip
    crossed = np.array([(x, z) for z, x in product(is_there[1], is_there[0])]).T
    sign, offset = (
        np.array([[rules[axis][f][part] for f in crossed[axis]] for axis in (0, 1)])
        for part in (0, 1)
    )
    x, z = rules
    return Ways(sign, offset, crossed, (x[LOWER][2], x[UPPER][2], z[LOWER][2], z[UPPER][2]))


def near_faces(x, reach, low_0, high_0, low_1, high_1):
    """Faces of x and of z that a particle is near: 0, LOWER, UPPER or BOTH; 1 where near any."""
    across, along = 0.0, 0.0
    if abs(x[0] - low_0) < reach:
        across += 1.0
    if abs(x[0] - high_0) < reach:
        across += 2.0
    if abs(x[1] - low_1) < reach:
        along += 1.0
    if abs(x[1] - high_1) < reach:
        along += 2.0
    return int(across), int(along), min(across + along, 1.0)


def belongs(near, face):
    """Whether a particle that is near some faces of an axis has images beyond one, or beyond 0."""
    return face == 0 or near == face or near >= BOTH


def is_image(k, across, along, crossed_x, crossed_z, size):
    """1 where the k-th pair of way and particle near a face makes an image, way after way."""
    place = k % size
    way = k // size + 1
    if belongs(across[place], crossed_x[way]) and belongs(along[place], crossed_z[way]):
        return 1.0
    return 0.0


def origin(k, count, size, near, found):
    """Source and way of particle k among all `count` with their images."""
    if k < count:
        return k, 0 * k
    pair = found[k - count]
    return near[pair % size], pair // size + 1


def one_of(way, first):
    """Number of a way."""
    return first[way]


def two_of(way, first, second):
    """Vector of a way."""
    return vector(first[way], second[way])


class Images:
    """The first `count` particles with their images.

    Attributes:
        source, way: (M,) kind "index", particle behind each and number of its way; a particle is
            its own source by way 0. sign, offset: (2, M) [1], [m]. total: M.
    """

    def __init__(self, backend: Backend, count: int, reach: float, ways: Ways) -> None:
        self.backend, self.count, self.reach, self.ways = backend, count, reach, ways
        self._crossed = {
            name: backend.asarray(row, "index")
            for name, row in zip(("crossed_x", "crossed_z"), ways.crossed, strict=True)
        }
        self._sides = tuple(backend.zeros(count, "index") for _ in range(2))
        self._is_near = backend.zeros(count)
        self._numbers = backend.zeros(0, "index")
        self._sign, self._offset = self.table(ways.sign), self.table(ways.offset)
        self.total = 0

    def find(self, position: Any) -> None:
        """Images of the particles at `position`, shape (2, n) [m]."""
        backend, count = self.backend, self.count
        low_0, high_0, low_1, high_1 = self.ways.near
        backend.pointwise(
            near_faces, {"x": backend.head(position, count)}, (*self._sides, self._is_near),
            reach=self.reach, low_0=low_0, high_0=high_0, low_1=low_1, high_1=high_1,
        )  # fmt: skip
        near = backend.rows_where(self._is_near, 1.0)
        size, others = near.shape[0], self.ways.count - 1
        across, along = (self._gathered(side, near) for side in self._sides)
        marks = backend.zeros(others * size)
        backend.pointwise(
            is_image, {"k": self._counted(others * size)}, marks, across=across, along=along,
            size=max(size, 1), **self._crossed,
        )  # fmt: skip
        found = backend.rows_where(marks, 1.0)
        self.total = count + found.shape[0]
        self.source, self.way = (backend.zeros(self.total, "index") for _ in range(2))
        backend.pointwise(
            origin, {"k": self._counted(self.total)}, (self.source, self.way),
            count=count, size=max(size, 1), near=near, found=found,
        )  # fmt: skip
        self.sign, self.offset = self.of_way(self._sign), self.of_way(self._offset)

    def table(self, values: NDArray[Any]) -> Table:
        """Host values (w,) or (2, w) of each way, for `of_way`."""
        return tuple(self.backend.asarray(row) for row in np.atleast_2d(values))

    def of_way(self, table: Table) -> Any:
        """(M,) or (2, M) values of each particle's way."""
        if len(table) == 1:
            out = self.backend.zeros(self.total)
            self.backend.pointwise(one_of, {"way": self.way}, out, first=table[0])
            return out
        out = self.backend.zeros((2, self.total))
        first, second = table
        self.backend.pointwise(two_of, {"way": self.way}, out, first=first, second=second)
        return out

    def _gathered(self, source: Any, order: Any) -> Any:
        out = self.backend.zeros(order.shape[0], "index")
        self.backend.gather(source, order, out)
        return out

    def _counted(self, size: int) -> Any:
        """0, 1, ... size - 1, kept on the backend."""
        if self._numbers.shape[0] < size:
            self._numbers = self.backend.asarray(np.arange(size + size // 4), "index")
        return self.backend.head(self._numbers, size)
