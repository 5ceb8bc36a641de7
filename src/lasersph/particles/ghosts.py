"""Ghost particles beyond flat faces: moving particles mirrored, or one period away.

A closed box whose faces mirror (or repeat) the particles inside gives every particle a full
support, so that no sum is cut. Ghost k of particle s lies at

    x_k = sign x_s + offset            (axis by axis)

and follows its source. Particles closer to a face than the search radius have ghosts; those of one
axis have ghosts again across the faces of the next, which fills the corners. Sign and offset are
those of its type, one of nine at most: which face of each axis lies between ghost and source. The
velocity or temperature of a ghost follows from its type too and is not known here. Left out: one
and three dimensions.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array, Constants, Rows
from lasersph.compute.backend import Backend

MIRROR, PERIODIC, OPEN, TANGENT = "mirror", "periodic", "open", "tangent"
LOWER, UPPER = 1, 2
SLANTED = 2.5
"""Search radii beside a lateral face within which ghosts across a tangent are mirrored: one, and
the way across twice one, 2 sin 45 degrees."""
SPARE = 8
"""Part of the ghosts for which there is capacity beside them."""
BOTH = 3
"""Mark of a particle close to both faces of an axis in `near_faces`, LOWER + UPPER."""


@dataclass(frozen=True)
class FacePair:
    """Faces of the box along one axis: kinds MIRROR, PERIODIC (both) or OPEN, and places [m].

    Ghosts beyond a TANGENT face lie across the local tangent of a surface, which shifts them.
    """

    lower_kind: str
    upper_kind: str
    lower: float
    upper: float

    def beyond(self, face: int) -> tuple[float, float, float]:
        """Sign, offset [m] and where the sources of ghosts beyond a face are near [m]."""
        kind, plane = (
            (self.lower_kind, self.lower) if face == LOWER else (self.upper_kind, self.upper)
        )
        # no ghosts: no source is ever near
        if kind == OPEN:
            return 1.0, 0.0, np.inf
        # shifted by the surface itself
        if kind == TANGENT:
            return 1.0, 0.0, plane
        # mirrored about the plane
        if kind == MIRROR:
            return -1.0, 2.0 * plane, plane
        # the ghost beyond one face of a period belongs to a particle near the other
        near = self.lower + self.upper - plane
        return 1.0, plane - near, near


@dataclass(frozen=True)
class GhostTypes:
    """Types of ghosts; the first type is that of the particles themselves.

    Attributes:
        sign, offset: (2, w) [1], [m]. crossed: (2, w) which face of each axis lies between, 0,
            LOWER or UPPER. near: place of the sources beyond each face, x then z [m]; infinite
            beyond an open one.
    """

    sign: NDArray[np.float64]
    offset: NDArray[np.float64]
    crossed: NDArray[np.int64]
    near: tuple[float, float, float, float]

    @property
    def count(self) -> int:
        """Number of types."""
        return self.crossed.shape[1]


def ghost_types_of(faces: tuple[FacePair, FacePair]) -> GhostTypes:
    """Types of the faces along x and z; those of x come first."""
    # rule by face: sign, offset and place of the sources; face 0 is the particle itself
    rules = [{0: (1.0, 0.0, np.inf)} for _ in faces]
    for rule, pair in zip(rules, faces, strict=True):
        for face in (LOWER, UPPER):
            rule[face] = pair.beyond(face)
    # types are all combinations of a face of x and one of z, none included
    is_there = [
        [f for f, (_, _, near) in rule.items() if f == 0 or near < np.inf] for rule in rules
    ]
    crossed = np.array([(x, z) for z, x in product(is_there[1], is_there[0])]).T
    sign, offset = (
        np.array([[rules[axis][f][part] for f in crossed[axis]] for axis in (0, 1)])
        for part in (0, 1)
    )
    x, z = rules
    return GhostTypes(sign, offset, crossed, (x[LOWER][2], x[UPPER][2], z[LOWER][2], z[UPPER][2]))


def near_faces(x, search_radius, low_0, high_0, low_1, high_1):
    """Faces of x and of z that a particle is near: 0, LOWER, UPPER or BOTH; 1 where near any."""
    # LOWER and UPPER add up to BOTH
    across, along = 0.0, 0.0
    if abs(x[0] - low_0) < search_radius:
        across += 1.0
    if abs(x[0] - high_0) < search_radius:
        across += 2.0
    if abs(x[1] - low_1) < search_radius:
        along += 1.0
    if abs(x[1] - high_1) < search_radius:
        along += 2.0
    return int(across), int(along), min(across + along, 1.0)


def near_surface(x, distance, radius, search_radius, low_0, high_0, low_1, high_1):
    """`near_faces` below a surface at a distance, instead of an upper face of z.

    Within the particle's own radius: ghosts of coarse ones deep below a flank would lie across its
    tangent far from it, in the melt of a valley. Ghosts across an inclined tangent are seen beyond
    a lateral face though their source is not within the radius of it.
    """
    # ghosts across a tangent may lie beyond a side though their source is further from it
    wide, _lowest, _is_wide = near_faces(x, SLANTED * search_radius, low_0, high_0, low_1, low_1)
    narrow, below, _is_near = near_faces(x, search_radius, low_0, high_0, low_1, low_1)
    along = 2.0 if distance < radius else 0.0
    if below > 0:
        along += 1.0
    across = wide if along > 1.0 else narrow
    return across, int(along), min(across + along, 1.0)


def makes_ghost(near, face):
    """Whether a particle that is near some faces of an axis has ghosts beyond one, or beyond 0."""
    return face == 0 or near == face or near >= BOTH


def is_ghost(k, near, across, along, crossed_x, crossed_z, size):
    """1 where the k-th pair of type and particle near a face makes a ghost, type after type."""
    # pairs are ordered type after type
    place = near[k % size]
    ghost_type = k // size + 1
    if makes_ghost(across[place], crossed_x[ghost_type]) and makes_ghost(
        along[place], crossed_z[ghost_type]
    ):
        return 1.0
    return 0.0


def origin(k, count, total, size, near, found):
    """Source and type of particle k among all `count` with their ghosts, 0 beyond these."""
    # a particle stands for itself
    if k < count:
        return k, 0 * k
    if k >= total:
        return 0 * k, 0 * k
    # a ghost for its source
    pair = found[k - count]
    return near[pair % size], pair // size + 1


class GhostParticles:
    """The first `count` particles with their ghosts.

    Attributes:
        total: number of both. source, ghost_type: (M,) kind "index", particle behind each and its
            type; a particle is its own source, of type 0. M exceeds the total, so that arrays stay
            while their number changes a little; the places beyond it stand for nothing.
            near: numbers of the particles near a face, which may have ghosts as neighbors;
            is_near: (n,) 1 for them; all_rows: (n,) 1 for all.
    """

    source: Array
    ghost_type: Array
    near: Rows

    def __init__(
        self, backend: Backend, count: int, search_radius: float, ghost_types: GhostTypes
    ) -> None:
        self.backend, self.count, self.ghost_types = backend, count, ghost_types
        low_0, high_0, low_1, high_1 = ghost_types.near
        self._near: Constants = {"low_0": low_0, "high_0": high_0, "low_1": low_1, "high_1": high_1}
        self._near["search_radius"] = search_radius
        self._crossed = {
            name: backend.asarray(row, "index")
            for name, row in zip(("crossed_x", "crossed_z"), ghost_types.crossed, strict=True)
        }
        self._faces = tuple(backend.zeros(count, "index") for _ in range(2))
        self.is_near, self.all_rows = backend.zeros(count), backend.zeros(count)
        backend.fill(self.all_rows, 1.0)
        self._numbers = backend.zeros(0, "index")
        self.total, self.source = 0, backend.zeros(0, "index")

    def find(self, position: Array, below: tuple[Array, Array] | None = None) -> None:
        """Find the ghosts of the particles at `position`, shape (2, n) [m].

        Args:
            below: (n,) distances from a surface that is the upper TANGENT face [m], and (count,)
                radii within which particles have ghosts across it [m].
        """
        backend, count = self.backend, self.count
        # particles near a face, and the faces that they are near
        fields = {"x": backend.head(position, count)}
        out = (*self._faces, self.is_near)
        if below is None:
            backend.pointwise(near_faces, fields, out, **self._near)
        else:
            fields["distance"], fields["radius"] = (backend.head(a, count) for a in below)
            backend.pointwise(near_surface, fields, out, **self._near)
        near = self.near = backend.rows_where(self.is_near, 1.0)
        # which pairs of a type and such a particle make a ghost
        size, others = near.shape[0], self.ghost_types.count - 1
        marks = backend.zeros(others * size)
        fields = {"k": self._numbers_below(others * size)}
        tables = dict(zip(("across", "along"), self._faces, strict=True)) | {"near": near}
        backend.pointwise(is_ghost, fields, marks, **tables, **self._crossed, size=max(size, 1))
        found = backend.rows_where(marks, 1.0)
        # source and type of each particle and each ghost
        ghosts = found.shape[0]
        total = self.total = count + ghosts
        # arrays grow in steps, so that loops keep theirs
        if self.source.shape[0] < total:
            capacity = total + ghosts // SPARE
            self.source, self.ghost_type = (backend.zeros(capacity, "index") for _ in range(2))
        fields = {"k": self._numbers_below(self.source.shape[0])}
        out, tables = (self.source, self.ghost_type), {"near": near, "found": found}
        sizes = {"count": count, "total": total, "size": max(size, 1)}
        backend.pointwise(origin, fields, out, **tables, **sizes)

    def table(self, values: NDArray[Any]) -> Array:
        """Host values (w,) of the types, for loops that read them at `ghost_type`."""
        return self.backend.asarray(values)

    def tables(self, first: str, second: str, values: NDArray[Any]) -> dict[str, Array]:
        """Tables of both components of host values (2, w) by their names."""
        return {first: self.table(values[0]), second: self.table(values[1])}

    def _numbers_below(self, size: int) -> Array:
        """0, 1, ... size - 1, kept on the backend."""
        if self._numbers.shape[0] < size:
            self._numbers = self.backend.asarray(np.arange(size + size // 4), "index")
        return self.backend.head(self._numbers, size)
