"""`SurfaceColumns`: which part of the surface each particle at it stands for now.

The surface is cut into columns of one spacing along each of its d - 1 axes. A particle at it covers
up to two of them along each, by the shares c_ic of its cell; of a column it stands for
c_ic / sum_j c_jc. So the particles at the surface share its whole area, however many there are, and
a column has the mean of their values. What is lost leaves through the true area of an inclined
surface, sqrt(1 + |grad eta|^2) times that of its column; light meets the area seen from above.
"""

from __future__ import annotations

from itertools import product as product_of
from math import floor, prod

import numpy as np

from lasersph.compute.array_types import Array, Constants, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import vector
from lasersph.particles.neighbor_lists import NeighborList, members_of
from lasersph.surface.loops import number_of


def column_at_corner(x, low, inverse_width, columns, upper):
    """Column at a corner of a particle's cell, and the share c of the cell in it.

    What reaches beyond an end of the surface counts for the column there.

    Args:
        x: position [m]. low: lower ends [m]. inverse_width: of a column [1/m]. columns: their
            numbers along each axis. upper: 1 where the corner is the upper one of an axis.
    """
    place = vector(*((x[k] - low[k]) * inverse_width[k] - 0.5 for k in range(len(low))))
    column = vector(*(floor(place[k]) for k in range(len(low))))
    # shares c of a width of one column that begins within another, multiplied over the axes
    shares = vector(
        *(
            place[k] - column[k] if upper[k] > 0.0 else 1.0 - (place[k] - column[k])
            for k in range(len(low))
        )
    )
    cover = shares[0]
    if len(low) == 2:
        cover = shares[0] * shares[1]
    at_corner = vector(
        *(min(max(column[k] + upper[k], 0.0), columns[k] - 1.0) for k in range(len(low)))
    )
    return number_of(at_corner, columns), cover


def covered(cover_j, f_j):
    """Cover of a column, and that times a value of the particle."""
    return cover_j, cover_j * f_j


def add_sums(cover, weighted, more_cover, more_weighted):
    """Sums of covers and of weighted values, with those of one more corner."""
    return cover + more_cover, weighted + more_weighted


def mean_of_corners(cover, weighted):
    """Mean value of a column, 0 where no particle covers it."""
    return weighted / max(cover, 1.0e-300)


def add_shared_area(total, column, cover, covers, length_ratio):
    """Area that a particle stands for, over that of a column, with its share of one more.

    Args:
        column: its number. covers: table of the sums over the particles of the columns.
            length_ratio: table of their true lengths over the width.
    """
    return total + cover / max(covers[column], 1.0e-300) * length_ratio[column]


def share_of_column(column, cover, factor, covers):
    """Share of a column that one corner of a particle stands for, times a factor."""
    return factor * cover / max(covers[column], 1.0e-300)


def scaled(value, factor):
    """A number times a factor."""
    return factor * value


def product(a, b):
    """Product of two numbers, 1 where two marks both are."""
    return a * b


def lies_at_surface(depth, V, spacing, area):
    """1 for a particle of the uppermost row, as high as it is and at most one spacing, else 0.

    Args:
        depth: below the surface [m]. V: volume [m^d]. area: of a column seen from above [m^(d-1)].
    """
    return 1.0 if depth * area < min(V, spacing * area) else 0.0


class OwnColumns:
    """Columns whose particles keep to them, and of which one particle each lies at the surface.

    Args:
        columns: their number; the particles at the surface come first. area: (n,) of columns seen
            from above [m^(d-1)], coarse ones beside them included, 0 of all that lies deeper.

    Attributes:
        area: (n,) true one of the surface [m^(d-1)].
    """

    def __init__(self, backend: Backend, columns: int, area: Array) -> None:
        self.backend, self.count = backend, columns
        self._from_above, self.area = area, backend.zeros(area.shape[0])
        self._length_ratio = backend.asarray(np.ones(columns))
        self._mean = backend.zeros(columns)
        backend.copy(area, self.area)

    def incline(self, length_ratio: Array) -> None:
        """Take the true length of the surface over that seen from above, (columns,)."""
        self._length_ratio = length_ratio
        fields = {"a": self.backend.head(self._from_above, self.count), "b": length_ratio}
        self.backend.pointwise(product, fields, self.backend.head(self.area, self.count))

    def mean(self, values: Array) -> Array:
        """(columns,) of a field (n,) at the surface."""
        return self.backend.head(values, self.count)

    def mean_from_above(self, flux: Array) -> Array:
        """(columns,) flux (n,) through the surface, per area that is seen from above."""
        fields = {"a": self.mean(flux), "b": self._length_ratio}
        self.backend.pointwise(product, fields, self._mean)
        return self._mean


class SurfaceColumns:
    """Columns below a surface, alike along each axis.

    Args:
        low: lower end of each axis [m]. width: of a column along each [m]. columns: their numbers.

    Attributes:
        rows: numbers of the particles at the surface. area: (n,) true one of the surface that each
            of them stands for [m^(d-1)], 0 of all others.
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        low: tuple[float, ...],
        width: tuple[float, ...],
        columns: tuple[int, ...],
    ) -> None:
        self.backend, self.count, self._column_area = backend, prod(columns), prod(width)
        self.rows: Rows = backend.asarray(np.zeros(0), "index")
        self.area = backend.zeros(count)
        self._grid: Constants = {"low": low, "inverse_width": tuple(1.0 / one for one in width)}
        self._grid |= {"columns": tuple(map(float, columns))}
        self._mean, self._covers, self._weighted = (backend.zeros(self.count) for _ in range(3))
        self._flat = self._length_ratio = backend.asarray(np.ones(self.count))
        self._sums = backend.zeros(self.count), backend.zeros(self.count)
        self._upper = tuple(product_of((0.0, 1.0), repeat=len(columns)))
        self._corners: list[tuple[Array, Array, NeighborList]] = []
        self._values = backend.zeros(0)

    def keep(self, numbers: np.ndarray, area: Array) -> None:
        """Let particles at the surface beside the columns, which rest, stand for their areas.

        Args:
            numbers: (k,) of them. area: (n,) of all on the lattice [m^(d-1)].
        """
        if not numbers.size:
            return
        backend, rows = self.backend, self.backend.asarray(numbers, "index")
        found = backend.zeros(numbers.size)
        backend.gather(area, rows, found)
        backend.scatter(found, rows, self.area)

    def find(self, position: Array, rows: Rows, length_ratio: Array | None = None) -> None:
        """Let the particles `rows` at their positions (d, n) [m] share the surface.

        Args:
            length_ratio: (columns,) its true length over that seen from above; None for a plane.
        """
        backend, size = self.backend, rows.shape[0]
        self._length_ratio = self._flat if length_ratio is None else length_ratio
        backend.scatter(backend.zeros(self.rows.shape[0]), self.rows, self.area)
        # the particles that were at the surface stand for no area any more
        self.rows = rows
        # loops over columns ask for fields at least as long
        length = max(size, self.count)
        x = backend.zeros((position.shape[0], size))
        backend.gather(position, rows, x)

        # the column at each corner of each particle, and the particles of each column
        self._corners, self._values = [], backend.zeros(length)
        for upper in self._upper:
            column, cover = backend.zeros(length, "index"), backend.zeros(length)
            backend.fill(column, self.count)
            out = (backend.head(column, size), backend.head(cover, size))
            backend.pointwise(column_at_corner, {"x": x}, out, **self._grid, upper=upper)
            self._corners.append((column, cover, members_of(backend, column, self.count)))

        # sums of c over the columns, then the area that each particle stands for
        self._average()
        area = backend.zeros(size)
        tables = {"covers": self._covers, "length_ratio": self._length_ratio}
        for column, cover, _ in self._corners:
            fields = {"column": backend.head(column, size), "cover": backend.head(cover, size)}
            backend.pointwise(add_shared_area, {"total": area, **fields}, area, **tables)
        backend.pointwise(scaled, {"value": area}, area, factor=self._column_area)
        backend.scatter(area, rows, self.area)

    def shares(self, factor: float) -> list[tuple[Array, Array]]:
        """Of each corner of the particles at the surface: their column (rows,), and the share of it
        for which they stand (rows,), times a factor."""
        backend, size, found = self.backend, self.rows.shape[0], []
        for column, cover, _ in self._corners:
            share = backend.zeros(size)
            fields = {"column": backend.head(column, size), "cover": backend.head(cover, size)}
            backend.pointwise(share_of_column, fields, share, factor=factor, covers=self._covers)
            found.append((fields["column"], share))
        return found

    def mean(self, values: Array) -> Array:
        """(columns,) mean of a field (n,) over the particles at each column."""
        inner = self.backend.head(self._values, self.rows.shape[0])
        self.backend.gather(values, self.rows, inner)
        self._average()
        return self._mean

    def mean_from_above(self, flux: Array) -> Array:
        """(columns,) mean of a flux (n,) through the surface, per area that is seen from above."""
        fields = {"a": self.mean(flux), "b": self._length_ratio}
        self.backend.pointwise(product, fields, self._mean)
        return self._mean

    def _average(self) -> None:
        """Mean of `_values` in each column, and the sum of the covers."""
        backend, both = self.backend, (self._covers, self._weighted)
        for values in both:
            backend.fill(values, 0.0)
        for _, cover, members in self._corners:
            backend.pair_sum(covered, members, {"cover": cover, "f": self._values}, self._sums)
            fields = dict(zip(("cover", "weighted"), both, strict=True))
            fields |= {"more_cover": self._sums[0], "more_weighted": self._sums[1]}
            backend.pointwise(add_sums, fields, both)
        fields = {"cover": self._covers, "weighted": self._weighted}
        backend.pointwise(mean_of_corners, fields, self._mean)
