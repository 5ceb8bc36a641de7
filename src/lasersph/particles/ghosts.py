"""Ghost particles beyond faces: moving particles mirrored, or one period away.

A closed box whose faces mirror (or repeat) the particles inside gives every particle a full
support, so that no sum is cut. A ghost k has a source s, and between both lies a face with the unit
normal n: a plane, or the plane that is tangent to a surface near s. It is the image of its source
in that plane, x_k = x_s + 2 (b - n . x_s) n, or one period away. Vectors there are those of the
source times H = I - 2 n n^T (`particles.reflection`).

Faces of the box are normal to the axes: H is diagonal. Particles closer to a face than the search
radius have ghosts; those of one axis have ghosts again across the faces of the next, which fills
edges and corners. There H is the product of those of the faces between, and

    x_k = S (x_s + c d_s) + o

with S = diag(sign), the product for the planes, the offset o, and c = 1 where a tangent lies
between, d_s the way across it. S, o and c are those of the ghost's type: which face of each axis
lies between, one of 3^d at most. The velocity or temperature of a ghost follows from its type too
and is not known here.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array, Constants, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, vector

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


class Reach(NamedTuple):
    """How far each particle finds others, or is found, along which faces have ghosts of it.

    radius: (count,) among those of its own support [m]. reach: (count,) among all [m]. plane: z
    above which nobody sees one of another support [m].
    """

    radius: Array
    reach: Array
    plane: float


@dataclass(frozen=True)
class GhostTypes:
    """Types of ghosts; the first type is that of the particles themselves.

    Attributes:
        sign, offset: (d, w) S [1] and o [m]. crossed: (d, w) which face of each axis lies between,
            0, LOWER or UPPER. crosses_surface: (w,) 1 where that of one is a TANGENT face. near:
            (d, 2) place of the sources beyond each face [m]; infinite beyond an open one.
    """

    sign: NDArray[np.float64]
    offset: NDArray[np.float64]
    crossed: NDArray[np.int64]
    crosses_surface: NDArray[np.float64]
    near: NDArray[np.float64]

    @property
    def count(self) -> int:
        """Number of types."""
        return self.crossed.shape[1]


def ghost_types_of(faces: tuple[FacePair, ...]) -> GhostTypes:
    """Types of the faces along each axis; those of the first axis come first."""
    # rule by face: sign, offset and place of the sources; face 0 is the particle itself
    rules = [{0: (1.0, 0.0, np.inf)} for _ in faces]
    for rule, pair in zip(rules, faces, strict=True):
        for face in (LOWER, UPPER):
            rule[face] = pair.beyond(face)
    near = np.array([[rule[face][2] for face in (LOWER, UPPER)] for rule in rules])
    # types are all combinations of a face of each axis, none included
    is_there = [
        [f for f, (_, _, place) in rule.items() if f == 0 or place < np.inf] for rule in rules
    ]
    crossed = np.array([chosen[::-1] for chosen in product(*is_there[::-1])]).T
    # a product of reflections in planes normal to the axes multiplies the signs of each axis
    sign, offset = (
        np.array([[rule[f][part] for f in row] for rule, row in zip(rules, crossed, strict=True)])
        for part in (0, 1)
    )
    tangents = [
        (row == face) & (kind == TANGENT)
        for row, pair in zip(crossed, faces, strict=True)
        for face, kind in ((LOWER, pair.lower_kind), (UPPER, pair.upper_kind))
    ]
    return GhostTypes(sign, offset, crossed, np.any(tangents, axis=0).astype(float), near)


def face_mark(x, low, high, radius):
    """Faces of an axis that a place x on it is near: 0, LOWER, UPPER or BOTH, their sum."""
    mark = 0.0
    if abs(x - low) < radius:
        mark += 1.0
    if abs(x - high) < radius:
        mark += 2.0
    return mark


def reach_at(x, radius, reach, plane):
    """How far a particle finds others or is found at its place [m], see `Reach`."""
    return radius if x[-1] > plane else reach


def near_faces(x, radius, reach, plane, low, high):
    """Faces of each axis that a particle is near, see `face_mark`; 1 where near any."""
    within = reach_at(x, radius, reach, plane)
    marks = vector(*(face_mark(x[k], low[k], high[k], within) for k in range(len(x))))
    return marks, 1.0 if dot(marks, marks) > 0.0 else 0.0


def near_surface(x, distance, radius, reach, plane, low, high):
    """`near_faces` below a surface at a distance, instead of an upper face of the last axis.

    Within the particle's own radius: ghosts of coarse ones deep below a flank would lie across its
    tangent far from it, in the melt of a valley. Ghosts across an inclined tangent are seen beyond
    a lateral face though their source is not within the radius of it.
    """
    within = reach_at(x, radius, reach, plane)
    below = 1.0 if abs(x[-1] - low[-1]) < within else 0.0
    above = 2.0 if distance < radius else 0.0
    # ghosts across a tangent may lie beyond a side though their source is further from it
    aside = SLANTED * within if above > 0.0 else within
    marks = vector(
        *(face_mark(x[k], low[k], high[k], aside) for k in range(len(x) - 1)), below + above
    )
    return marks, 1.0 if dot(marks, marks) > 0.0 else 0.0


def makes_ghost(near, face):
    """1 where a particle that is near some faces of an axis has ghosts beyond one, or beyond 0."""
    return 1.0 if face == 0 or near == face or near >= BOTH else 0.0


def is_ghost(k, near, marks, crossed, size):
    """1 where the k-th pair of type and particle near a face makes a ghost, type after type."""
    # pairs are ordered type after type
    mark, faces = marks[near[k % size]], crossed[k // size + 1]
    # a ghost lies beyond the faces of its type in every axis
    made = vector(*(makes_ghost(mark[axis], faces[axis]) for axis in range(len(faces))))
    return 1.0 if dot(made, made) == len(made) else 0.0


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

    def __init__(self, backend: Backend, count: int, ghost_types: GhostTypes) -> None:
        self.backend, self.count, self.ghost_types = backend, count, ghost_types
        low, high = (tuple(places.tolist()) for places in ghost_types.near.T)
        self._bounds: Constants = {"low": low, "high": high}
        self._near_faces = near_surface if ghost_types.crosses_surface.any() else near_faces
        self._crossed = backend.asarray(ghost_types.crossed, "index")
        self._marks = backend.zeros((len(low), count))
        self.is_near, self.all_rows = backend.zeros(count), backend.zeros(count)
        backend.fill(self.all_rows, 1.0)
        self.near: Rows = backend.zeros(0, "index")
        self._numbers = backend.zeros(0, "index")
        self.total = 0
        self.source = backend.zeros(0, "index")
        self.ghost_type = backend.zeros(0, "index")

    def find(self, position: Array, distance: Array, reach: Reach) -> None:
        """Find the ghosts of the particles at `position`, shape (d, n) [m].

        Args:
            distance: (n,) from a surface that is the upper TANGENT face [m]. reach: within which
                particles have ghosts.
        """
        backend, count = self.backend, self.count

        # particles near a face, and the faces that they are near
        fields = {"x": backend.head(position, count), "radius": reach.radius}
        fields |= {"reach": reach.reach, "distance": backend.head(distance, count)}
        out = self._marks, self.is_near
        backend.pointwise(self._near_faces, fields, out, **self._bounds, plane=reach.plane)
        near = self.near = backend.rows_where(self.is_near, 1.0)

        # which pairs of a type and such a particle make a ghost
        size, others = near.shape[0], self.ghost_types.count - 1
        marks = backend.zeros(others * size)
        fields = {"k": self._numbers_below(others * size)}
        tables: Constants = {"near": near, "marks": self._marks, "crossed": self._crossed}
        backend.pointwise(is_ghost, fields, marks, **tables, size=max(size, 1))
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
        sizes: Constants = {"count": count, "total": total, "size": max(size, 1)}
        backend.pointwise(origin, fields, out, **tables, **sizes)

    def table(self, values: NDArray[Any]) -> Array:
        """Host values (..., w) of the types, for loops that read them at `ghost_type`."""
        return self.backend.asarray(values)

    def _numbers_below(self, size: int) -> Array:
        """0, 1, ... size - 1, kept on the backend."""
        if self._numbers.shape[0] < size:
            self._numbers = self.backend.asarray(np.arange(size + size // 4), "index")
        return self.backend.head(self._numbers, size)
