"""`SurfaceColumns`: which part of the surface each particle at it stands for now (2-D).

The surface is cut into columns of one spacing. A particle at it covers up to two of them, by the
shares c_ic of its width; of a column it stands for c_ic / sum_j c_jc. So the particles at the
surface share its whole area, however many there are, and a column has the mean of their values.
What is lost leaves through the true length of an inclined surface, sqrt(1 + eta_x^2) times that of
its column; light meets the length that is seen from above.
"""

from __future__ import annotations

from math import floor
from typing import Any

import numpy as np

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.particles.neighbor_lists import NeighborList, members_of


def column_at_end(x, low, inverse, right, columns):
    """Column at an end of a particle's width, and the share c of the width in it.

    What reaches beyond an end of the surface counts for the column there.

    Args:
        x: position [m]. low: left end [m]. inverse: 1 / width of a column [1/m]. right: 1 for the
            right end. columns: their number.
    """
    place = (x[0] - low) * inverse - 0.5
    column = floor(place)
    # shares c of a width of one column that begins within another
    beyond = place - column
    number = int(min(max(column + right, 0.0), columns - 1.0))
    return number, (beyond if right > 0.0 else 1.0 - beyond)


def covered(cover_j, f_j):
    """Cover of a column, and that times a value of the particle."""
    return cover_j, cover_j * f_j


def mean_of_ends(cover, weighted, cover_right, weighted_right):
    """Mean value of a column, 0 where no particle covers it, and the sum of their covers."""
    whole = cover + cover_right
    return (weighted + weighted_right) / max(whole, 1.0e-300), whole


def shared_area(left, cover_left, right, cover_right, covers, length_ratio, width):
    """Area that a particle stands for [m]: its shares of two columns.

    Args:
        left, right: numbers of the columns. covers: table of the sums over their particles.
            length_ratio: table of their true lengths over the width.
    """
    return width * (
        cover_left / max(covers[left], 1.0e-300) * length_ratio[left]
        + cover_right / max(covers[right], 1.0e-300) * length_ratio[right]
    )


def share_of_column(column, cover, factor, covers):
    """Share of a column that one end of a particle stands for, times a factor."""
    return factor * cover / max(covers[column], 1.0e-300)


def product(a, b):
    """Product of two numbers, 1 where two marks both are."""
    return a * b


def lies_at_surface(depth, V, spacing):
    """1 for a particle of the uppermost row, as high as it is and at most one spacing, else 0."""
    return 1.0 if depth * spacing < min(V, spacing * spacing) else 0.0


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
    """Columns below a surface from `low` on [m], of one width [m].

    Attributes:
        rows: numbers of the particles at the surface. area: (n,) true one of the surface that each
            of them stands for [m], 0 of all others.
    """

    def __init__(
        self, backend: Backend, count: int, low: float, width: float, columns: int
    ) -> None:
        self.backend, self.count, self._width = backend, columns, width
        self.rows: Rows = backend.asarray(np.zeros(0), "index")
        self.area = backend.zeros(count)
        self._grid: dict[str, Any] = {"low": low, "inverse": 1.0 / width, "columns": float(columns)}
        self._mean, self._covers = backend.zeros(columns), backend.zeros(columns)
        self._flat = self._length_ratio = backend.asarray(np.ones(columns))
        self._sums = {side: tuple(backend.zeros(columns) for _ in "12") for side in ("", "_right")}
        self._ends: list[tuple[Array, Array, NeighborList]] = []
        self._values = backend.zeros(0)

    def keep(self, numbers: np.ndarray, area: Array) -> None:
        """Let particles at the surface beside the columns, which rest, stand for their areas.

        Args:
            numbers: (k,) of them. area: (n,) of all on the lattice [m].
        """
        if not numbers.size:
            return
        backend, rows = self.backend, self.backend.asarray(numbers, "index")
        found = backend.zeros(numbers.size)
        backend.gather(area, rows, found)
        backend.scatter(found, rows, self.area)

    def find(self, position: Array, rows: Rows, length_ratio: Array | None = None) -> None:
        """Let the particles `rows` at their positions (2, n) [m] share the surface.

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
        x = backend.zeros((2, size))
        backend.gather(position, rows, x)

        # the column at each end of each particle, and the particles of each column
        self._ends, self._values = [], backend.zeros(length)
        for right in (0.0, 1.0):
            column, cover = backend.zeros(length, "index"), backend.zeros(length)
            backend.fill(column, self.count)
            out = (backend.head(column, size), backend.head(cover, size))
            backend.pointwise(column_at_end, {"x": x}, out, **self._grid, right=right)
            self._ends.append((column, cover, members_of(backend, column, self.count)))

        # sums of c over the columns, then the area that each particle stands for
        self._average()
        fields = {}
        for (column, cover, _), side in zip(self._ends, ("left", "right"), strict=True):
            fields |= {side: backend.head(column, size)}
            fields |= {f"cover_{side}": backend.head(cover, size)}
        area = backend.zeros(size)
        tables = {"covers": self._covers, "length_ratio": self._length_ratio}
        backend.pointwise(shared_area, fields, area, **tables, width=self._width)
        backend.scatter(area, rows, self.area)

    def shares(self, factor: float) -> list[tuple[Array, Array]]:
        """Of the left and the right ends of the particles at the surface: their column (rows,), and
        the share of it for which they stand (rows,), times a factor."""
        backend, size, found = self.backend, self.rows.shape[0], []
        for column, cover, _ in self._ends:
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
        fields = {}
        for (_, cover, members), side in zip(self._ends, ("", "_right"), strict=True):
            sums = fields[f"cover{side}"], fields[f"weighted{side}"] = self._sums[side]
            self.backend.pair_sum(covered, members, {"cover": cover, "f": self._values}, sums)
        self.backend.pointwise(mean_of_ends, fields, (self._mean, self._covers))
