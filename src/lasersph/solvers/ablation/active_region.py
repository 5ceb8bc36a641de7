"""`ActiveRegion`: only particles that heat or motion can get to are computed.

The box is cut into cells at least as wide as the support. A cell is inactive until something
disturbed comes within two cells; then it is active for good, and the cells next to it too.
Disturbed is what has

    |h| > 1e-11 times the largest |h| so far,    or moves.

A step evaluates rates twice, so that heat passes two supports in it at most: whatever is above the
limit at the start of a step has everything within its support active during it. Heat that is not
let through at the edge is below the limit, so that a run agrees with one of all particles to far
better than 1e-8 of the rise (tested). Inactive particles next to the active are their neighbors, at
rest.

Inactive particles must be in balance: where gravity acts or everything moves, all must be active.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.cell_grid import CellGrid
from lasersph.compute.vectors import dot, element
from lasersph.particles.kinds import EJECTED, GONE
from lasersph.particles.neighbor_lists import Subset

LEAST_RISE = 1e-11
"""Enthalpy over the largest one below which a particle counts as undisturbed. Accuracy: inactive
matter changes the rise of T by less than 1e-8 (`tests/laws/test_moving_matter.py`)."""
ACTIVE_AROUND = 2
"""Cells around something disturbed that must be active. Geometry: cells are as wide as the search
radius, and what acts within a step of two rates reaches two of them."""
ACTIVE_BEYOND = 1
"""Cells beyond those that become active with them. Cost: lists of pairs last for more steps; the
result is the same."""


def magnitude(h):
    """|h| [J/kg]."""
    return abs(h)


def is_disturbed(h, v, kind, least):
    """1 where a particle may disturb its neighbors: warm or moving, and not ejected."""
    if kind >= EJECTED and kind <= GONE:
        return 0.0
    return 1.0 if abs(h) > least or dot(v, v) > 0.0 else 0.0


class ActiveRegion:
    """Which particles are computed.

    Args:
        position: (dim, N) at the start [m]. support: largest support with its skin [m].
            period: length of the box per axis [m], 0 where not periodic.
        lit: particles that light or anything else may disturb from the start, kind "index".

    Attributes:
        rows: what is computed, kind "index" in order; None where that is everything.
        subset: the same with its inactive neighbors, for the search; None as well.
        fields: {"active": (cells,)}, all that a checkpoint needs.
    """

    rows: Rows | None
    subset: Subset | None

    def __init__(
        self,
        backend: Backend,
        position: Array,
        support: float,
        period: Sequence[float],
        lit: Rows,
    ) -> None:
        self.backend = backend
        self.count = position.shape[1]
        # cells at least as wide as the support, over the box or its periods
        host = backend.host_view(position)
        low, high = host.min(axis=1), host.max(axis=1)
        extent = np.where(np.array(period) > 0.0, period, high - low)
        self._grid = CellGrid.over(low, extent, support, [length > 0.0 for length in period])
        self._shape = self._grid.shape
        self.cell = self._grid.find_cells(backend, position)

        # what is active: cells around what is lit; all else is looked at once
        self._largest = 0.0
        self._mark = backend.zeros(self.count)
        self.fields = {"active": backend.zeros(self._grid.count)}
        self._set_active(self._grid.grown(self._cells_of(position, lit), ACTIVE_AROUND))
        self._checks_all = True

    @property
    def active_count(self) -> int:
        """How many particles are computed."""
        return self.count if self.rows is None else self.rows.shape[0]

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        return {"largest_enthalpy": self._largest, "all_checked": float(not self._checks_all)}

    def restore(self, arrays: Mapping[str, np.ndarray], scalars: Mapping[str, float]) -> None:
        """Continue from the arrays of `fields` and the `checkpoint_scalars`."""
        self._largest = scalars["largest_enthalpy"]
        self._checks_all = not scalars["all_checked"]
        self._set_active(arrays["active"].reshape(self._shape) > 0.0)

    def grow(self, fields: Mapping[str, Array]) -> bool:
        """Activate what may be disturbed in the next step; returns whether there is more now.

        Args:
            fields: by symbol; x, h, v and kind.
        """
        if self.rows is None:
            return False
        backend = self.backend
        # disturbed is
        # h
        #  > LEAST_RISE max
        # h
        # , or what moves
        (largest,) = backend.pointwise(
            magnitude, {"h": fields["h"]}, (None,), rows=self.rows, reduce=("max",)
        )
        self._largest = max(self._largest, largest)
        # only what lies near the edge can disturb inactive particles, but for the first time
        rows = None if self._checks_all else self._edge
        self._checks_all, least = False, LEAST_RISE * self._largest
        (found,) = backend.pointwise(
            is_disturbed, fields, (self._mark,), rows=rows, reduce=("max",), least=least
        )
        if found == 0.0:
            return False

        # cells two around it must be active; those beyond become so with them
        cells = self._cells_of(fields["x"], self._marked(rows))
        if not np.any(self._grid.grown(cells, ACTIVE_AROUND) & ~self._active):
            return False
        self._set_active(self._active | self._grid.grown(cells, ACTIVE_AROUND + ACTIVE_BEYOND))
        return True

    def _marked(self, rows: Rows | None) -> Rows:
        """Those of `rows` whose mark is 1."""
        backend = self.backend
        if rows is None:
            return backend.rows_where(self._mark, 1.0)
        place = self._marked_places(rows)
        marked = backend.zeros(place.shape[0], "index")
        backend.gather(rows, place, marked)
        return marked

    def _marked_places(self, rows: Rows) -> Rows:
        """Places in `rows` of those whose mark is 1."""
        mark = self.backend.zeros(rows.shape[0])
        self.backend.gather(self._mark, rows, mark)
        return self.backend.rows_where(mark, 1.0)

    def _set_active(self, active: np.ndarray) -> None:
        """Let the cells `active`, shaped as the box, be active and no others."""
        backend = self.backend
        self._active = active
        # field of a checkpoint; where all is active nothing is left out
        backend.copy(backend.asarray(active.ravel().astype(float)), self.fields["active"])
        if active.all():
            self.rows = self.subset = None
            return

        # particles near the edge, those that are computed, and their neighbors
        self._edge = self._particles_in(active & self._grid.grown(~active, ACTIVE_AROUND + 1))
        members = self._particles_in(self._grid.grown(active, 1))
        self.rows = self._particles_in(active)
        places = backend.asarray(np.arange(members.shape[0]), "index")
        self.subset = Subset(members, self._marked_places(members), places)

    def _particles_in(self, cells: np.ndarray) -> Rows:
        """Particles that started in these cells, in order; `_mark` is 1 for them."""
        marks = self.backend.asarray(cells.ravel().astype(float))
        self.backend.pointwise(element, {"place": self.cell}, self._mark, table=marks)
        return self.backend.rows_where(self._mark, 1.0)

    def _cells_of(self, position: Array, rows: Rows) -> np.ndarray:
        """Cells that hold any of the particles `rows`, shaped as the box."""
        backend = self.backend
        x = backend.zeros((len(self._shape), rows.shape[0]))
        backend.gather(position, rows, x)
        # cells that count one of them or more
        counts = backend.count_by_key(self._grid.find_cells(backend, x), self._grid.count)
        return backend.to_host(counts).reshape(self._shape) > 0
