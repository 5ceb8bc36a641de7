"""`ActiveRegion`: only particles that heat or motion can reach are computed.

The box is cut into tiles at least as wide as the support. A tile sleeps until something disturbed
comes within two tiles; then it is awake for good, and the tiles next to it too. Disturbed is what
has

    |h| > 1e-11 times the largest |h| so far,    or moves.

A step evaluates rates twice, so that heat passes two supports in it at most: whatever is above the
limit at the start of a step has everything in its reach awake during it. Heat that is not let
through at the edge is below the limit, so that a run agrees with one of all particles to far better
than 1e-8 of the rise (tested). Sleepers next to the awake are their neighbors, at rest.

Sleepers must be in balance: where gravity acts or everything moves, let nothing sleep.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lasersph.compute import search
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot
from lasersph.particles.cell_grid import CellGrid
from lasersph.particles.support import common
from lasersph.physics.ejection import EJECTED, GONE

LEAST_RISE = 1e-11
"""Enthalpy over the largest one below which a particle counts as undisturbed."""
WAKING_REACH = 2
"""Tiles around something disturbed that must be awake."""
WAKING_AHEAD = 1
"""Tiles beyond those that wake along with them, so that lists of pairs last for more steps."""


def size_of(h):
    """|h| [J/kg]."""
    return abs(h)


def disturbed(h, v, kind, least):
    """1 where a particle may disturb its neighbors: warm or moving, and not ejected."""
    if kind >= EJECTED and kind <= GONE:
        return 0.0
    return 1.0 if abs(h) > least or dot(v, v) > 0.0 else 0.0


def of_tile(tile, marks):
    """Mark of a particle's tile."""
    return marks[tile]


def numbered(place, numbers):
    """Number of the particle at a place among those near what is awake."""
    return numbers[place]


def length_of(row, start):
    """Number of neighbors in a row of a list."""
    return start[row + 1] - start[row]


class ActiveRegion:
    """Which particles are computed.

    Args:
        position: (dim, N) at the start [m]. support: largest support with its skin [m].
            period: length of the box per axis [m], 0 where not periodic.
        awake: particles that light or anything else may disturb from the start, kind "index".

    Attributes:
        rows: what is computed, kind "index" in order; None where that is everything.
        fields: {"active": (tiles,)}, all that a checkpoint needs.
    """

    def __init__(
        self,
        backend: Backend,
        position: Any,
        support: float,
        period: Sequence[float],
        awake: Any,
    ) -> None:
        self.backend, self.period = backend, tuple(period)
        self.count = position.shape[1]
        host = backend.look(position)
        low, high = host.min(axis=1), host.max(axis=1)
        extent = np.where(np.array(self.period) > 0.0, self.period, high - low)
        self._tiles = CellGrid(backend, low, extent, support)
        self._shape = self._tiles.shape
        self.tile = backend.zeros(self.count, "index")
        self._tiles.find(position, self.tile)
        self._largest = 0.0
        self._room = search.Room()
        self._mark = backend.zeros(self.count)
        self.fields = {"active": backend.zeros(self._tiles.count)}
        self._set_active(self._around(self._tiles_of(position, awake), WAKING_REACH))
        self._checks_all = True

    @property
    def near(self) -> Any:
        """What is computed and its sleeping neighbors, kind "index"; None where all is computed."""
        return None if self.rows is None else self._near

    @property
    def active_count(self) -> int:
        """How many particles are computed."""
        return self.count if self.rows is None else self.rows.shape[0]

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        return {"largest_enthalpy": self._largest, "all_checked": float(not self._checks_all)}

    def restore(self, arrays: dict[str, np.ndarray], numbers: dict[str, float]) -> None:
        """Continue from the arrays of `fields` and the numbers of `checkpoint_scalars`."""
        self._largest = numbers["largest_enthalpy"]
        self._checks_all = not numbers["all_checked"]
        self._set_active(arrays["active"].reshape(self._shape) > 0.0)

    # --- waking ---------------------------------------------------------------------------------

    def activate(self, fields: dict[str, Any]) -> bool:
        """Wake what may be disturbed in the next step; returns whether there is more now.

        Args:
            fields: by symbol; x, h, v and kind.
        """
        if self.rows is None:
            return False
        backend = self.backend
        (largest,) = backend.pointwise(
            size_of, {"h": fields["h"]}, (None,), rows=self.rows, reduce=("max",)
        )
        self._largest = max(self._largest, largest)
        rows = None if self._checks_all else self._edge
        self._checks_all = False
        (found,) = backend.pointwise(
            disturbed, fields, (self._mark,), rows=rows, reduce=("max",),
            least=LEAST_RISE * self._largest,
        )  # fmt: skip
        if found == 0.0:
            return False
        warm = self._marked(rows)
        tiles = self._tiles_of(fields["x"], warm)
        if not np.any(self._around(tiles, WAKING_REACH) & ~self._awake):
            return False
        self._set_active(self._awake | self._around(tiles, WAKING_REACH + WAKING_AHEAD))
        return True

    def _marked(self, rows: Any) -> Any:
        """Those of `rows` whose mark is 1."""
        backend = self.backend
        if rows is None:
            return backend.rows_where(self._mark, 1.0)
        mark = backend.zeros(rows.shape[0])
        backend.gather(self._mark, rows, mark)
        place = backend.rows_where(mark, 1.0)
        warm = backend.zeros(place.shape[0], "index")
        backend.gather(rows, place, warm)
        return warm

    def _set_active(self, awake: np.ndarray) -> None:
        """Let the tiles `awake`, shaped as the box, be awake and no others."""
        backend = self.backend
        self._awake = awake
        backend.copy(backend.asarray(awake.ravel().astype(float)), self.fields["active"])
        if awake.all():
            self.rows = None
            return
        edge = awake & self._around(~awake, WAKING_REACH + 1)
        self._edge = self._particles_in(edge)
        self._near = self._particles_in(self._around(awake, 1))
        self.rows = self._particles_in(awake)
        self._numbers = backend.asarray(np.arange(self._near.shape[0]), "index")
        is_awake = backend.zeros(self._near.shape[0])
        backend.gather(self._mark, self._near, is_awake)
        self._wanted = backend.rows_where(is_awake, 1.0)

    def _particles_in(self, tiles: np.ndarray) -> Any:
        """Particles that started in these tiles, in order."""
        backend = self.backend
        marks = backend.asarray(tiles.ravel().astype(float))
        backend.pointwise(of_tile, {"tile": self.tile}, self._mark, marks=marks)
        return backend.rows_where(self._mark, 1.0)

    def _tiles_of(self, position: Any, rows: Any) -> np.ndarray:
        """Tiles that hold any of the particles `rows`, shaped as the box."""
        backend = self.backend
        x = backend.zeros((len(self._shape), rows.shape[0]))
        backend.gather(position, rows, x)
        tile = backend.zeros(rows.shape[0], "index")
        self._tiles.find(x, tile)
        counts = backend.to_host(backend.count_by_key(tile, self._tiles.count))
        return counts.reshape(self._shape) > 0

    def _around(self, tiles: np.ndarray, reach: int) -> np.ndarray:
        """The tiles and all within `reach` of them, around the ends of periodic axes."""
        grown = tiles.copy()
        for axis in range(tiles.ndim):
            before = grown.copy()
            for shift in range(1, min(reach, tiles.shape[axis] - 1) + 1):
                if self.period[axis] > 0.0:
                    grown |= np.roll(before, shift, axis) | np.roll(before, -shift, axis)
                    continue
                low, high = [slice(None)] * tiles.ndim, [slice(None)] * tiles.ndim
                low[axis], high[axis] = slice(None, -shift), slice(shift, None)
                grown[tuple(high)] |= before[tuple(low)]
                grown[tuple(low)] |= before[tuple(high)]
        return grown

    # --- pairs ----------------------------------------------------------------------------------

    def find_pairs(self, place: Any, reach: Any) -> tuple[Any, Any]:
        """Neighbors of what is awake: row_start (N + 1,), empty rows for sleepers, and neighbor.

        Args:
            place: (dim, N) [m]. reach: (N,) support with the skin [m].
        """
        backend = self.backend
        if self.rows is None:
            return search.neighbor_list(
                backend, place, reach, self.count, mean=common, period=self.period,
                room=self._room,
            )  # fmt: skip
        near, size = self._near, self._near.shape[0]
        x, support = backend.zeros((len(self._shape), size)), backend.zeros(size)
        backend.gather(place, near, x)
        backend.gather(reach, near, support)
        start, local = search.neighbor_list(
            backend, x, support, size, mean=common, period=self.period, wanted=self._wanted
        )
        neighbor = backend.zeros(local.shape[0], "index")
        backend.pointwise(numbered, {"place": local}, neighbor, numbers=near)
        counts = backend.zeros(self.count, "index")
        lengths = backend.zeros(size, "index")
        backend.pointwise(length_of, {"row": self._numbers}, lengths, start=start)
        backend.scatter(lengths, near, counts)
        row_start = backend.zeros(self.count + 1, "offset")
        backend.exclusive_scan(counts, row_start)
        return row_start, neighbor
