"""Preconditioner for pair operators of scattered particles: the diagonal plus a grid's correction.

    M^-1 r = D^-1 r + P B P^T r

for A = G + a with (G p)_i = sum_j g_ij (p_i - p_j), which discretizes V_i times the Laplacian, on
the particles whose mask is 1. P interpolates bilinearly from the nodes of a grid of squares two
thirds of a support radius wide (some 2.5 particles); B is a V cycle for the Laplacian of bilinear
elements on that grid, with the particles' own volume as the share of each node that is filled
(`grid_nodes`), on grids of twice the width and so on, one damped Jacobi sweep before and after,
and an exact inverse where few nodes are left.

The wide stencils of particles make D^-1 a good smoother for all that is shorter than a support
radius, and the grid carries the rest; so the number of iterations does not grow with the number of
particles, and an iteration costs one pair sum over particles. Grid and volumes follow from the
positions, the volumes and the mask alone and are made anew whenever these change, by one sort:
nothing of them needs to survive a step. An axis of two nodes is dropped, so that thin bodies keep
squares as long as they are two-dimensional.

Singular operators are welcome: pivots of the exact inverse that vanish are left out. All parts are
symmetric and not negative, and so is M^-1. Left out: one and three dimensions; particles of very
different sizes. References: [Xu1996], [Bramble1990] for the additive form.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.compute.dense import invert
from lasersph.compute.routine import Step
from lasersph.compute.vectors import element
from lasersph.linear_solvers import grid_nodes, grid_transfer
from lasersph.linear_solvers.cells import Axis, Cells
from lasersph.particles.neighbor_lists import NeighborList, members_of

WIDTH = 2.0 / 3.0
"""Spacing of the finest grid over the support radius."""
COARSEST = 80
"""Grids are coarsened until there are at most as many nodes."""
VANISHING = 1e-10
"""Pivot of the exact inverse over the largest diagonal element, below which a node is left out."""
COUPLINGS = ("across", "along", "aslant")
"""Of a node toward the next column, the next line, and the nodes of both."""
DAMPING = 8.0 / 9.0
"""Of the Jacobi sweeps: it reduces all that the next grid does not resolve to a third."""


class Level:
    """One grid with its work arrays, which are one longer than its nodes and end with 0."""

    def __init__(self, backend: Backend, x: Axis, z: Axis) -> None:
        self.backend, self.x, self.z = backend, x, z
        self.count = x.nodes * z.nodes
        names = ("C", "s", "a", "d", "v", "r", "x", "y", "rest")
        self.all = {name: backend.zeros(self.count + 1) for name in names}
        self.at = {name: backend.head(array, self.count) for name, array in self.all.items()}
        self.at |= _places(backend, x.nodes, z.nodes)
        across, along = x.spacing**-2, z.spacing**-2
        is_flat = x.nodes == 1 or z.nodes == 1
        self.shape: Constants = {
            "columns": x.nodes,
            "lines": z.nodes,
            "x_wraps": int(x.wraps),
            "z_wraps": int(z.wraps),
        }
        self.stencil: Constants = self.shape | {
            "across": across if is_flat else max(0.0, (2.0 * across - along) / 3.0),
            "along": along if is_flat else max(0.0, (2.0 * along - across) / 3.0),
            "aslant": (across + along) / 6.0,
        }

    def outputs(self, *names: str) -> tuple:
        """Arrays to be written."""
        return tuple(self.at[name] for name in names)

    def prepare(self) -> None:
        """Diagonal of K from the volumes C and the boundary coefficients a."""
        run, at = self.backend.pointwise, self.at
        run(grid_nodes.root, at, at["s"])
        given: Constants = self.stencil | {"damping": DAMPING}
        run(grid_nodes.diagonal, at, self.outputs("d", "v"), all_s=self.all["s"], **given)

    def smooth(self, function: Callable, out: Array) -> None:
        """`rest` or `sweep` of the present x and y = s x."""
        self.backend.pointwise(function, self.at, out, all_y=self.all["y"], **self.stencil)

    def collect(self, above: Level, name: str, out: tuple) -> None:
        """P^T of an array of this level into those of the next, as `grid_nodes.started`."""
        steps = {"x_step": self.x.step, "z_step": self.z.step}
        self.backend.pointwise(
            grid_nodes.collected, above.at, out, all_r=self.all[name], **steps, **self.shape
        )

    def add(self, above: Level) -> None:
        """x + P e with the x of the next level for e."""
        self.backend.pointwise(
            grid_nodes.added,
            self.at,
            self.outputs("x", "y"),
            coarse_x=above.all["x"],
            x_step=self.x.step,
            z_step=self.z.step,
            coarse_columns=above.x.nodes,
            coarse_lines=above.z.nodes,
            x_wraps=above.shape["x_wraps"],
            z_wraps=above.shape["z_wraps"],
        )


def _places(backend: Backend, columns: int, lines: int) -> dict[str, Array]:
    """Number k, column c and line m of each node or cell."""
    k = np.arange(columns * lines)
    arrays = {"k": k, "c": k // lines, "m": k % lines}
    return {name: backend.asarray(array, "index") for name, array in arrays.items()}


class GridCorrection:
    """Diagonal and grids for one set of particles.

    Args:
        count: number of particles. support: radius [m]. period: per axis [m], 0.0 where there is
            none.

    Attributes:
        levels: grids, the finest first.
    """

    def __init__(
        self, backend: Backend, count: int, support: float, period: Sequence[float] = (0.0, 0.0)
    ) -> None:
        self.backend, self.levels = backend, list[Level]()
        self._cells = Cells(backend, count, WIDTH * support, period)
        self._sorted_u, self._sorted_w = backend.zeros(count), backend.zeros(count)
        self._order = backend.zeros(count, "index")
        self._step: Step | None = None
        self._set_up: Step | None = None

    def prepare(
        self, position: Array, mask: Array, volume: Array, boundary_coefficient: Array
    ) -> None:
        """Make the grids for the particles with mask 1.

        Args:
            position: (2, n) [m]. mask: (n,). volume: (n,) V_i [m^2].
            boundary_coefficient: (n,) a_i.
        """
        backend, cells = self.backend, self._cells
        cells.place(position, mask)
        if not self.levels or (self.levels[0].x, self.levels[0].z) != (cells.x, cells.z):
            self._make_levels(cells.x, cells.z)
        members_of(backend, cells.number, cells.count, into=self._members)
        given = (volume, boundary_coefficient)
        if self._set_up and all(a is b for a, b in zip(given, self._set_up_of, strict=True)):
            self._set_up()
        else:
            self._set_up_of = given
            self._set_up = backend.recorded(lambda: self._set_up_levels(*given))
        backend.copy(backend.asarray(_inverse(backend, self.levels[-1])), self._inverse)

    def _set_up_levels(self, volume: Array, boundary_coefficient: Array) -> None:
        """Volumes, boundary coefficients and diagonals of all levels."""
        run, places = self.backend.pointwise, {"place": self._order}
        run(element, places, self._sorted_u, table=self._cells.u)
        run(element, places, self._sorted_w, table=self._cells.w)
        for values, name in ((volume, "C"), (boundary_coefficient, "a")):
            self._collect(values, (self.levels[0].at[name], None, None))
        for level, above in zip(self.levels, [*self.levels[1:], None], strict=True):
            level.prepare()
            if above:
                for name in ("C", "a"):
                    level.collect(above, name, (above.at[name], None, None))

    def correction(self, r: Array, diagonal: Array, mask: Array, z: Array) -> Step:
        """Step that writes M^-1 r into z, 0 where the mask is 0, and reduces r z.

        Args:
            diagonal: (n,) D, not 0.
        """
        given = (r, diagonal, mask, z)
        if self._step is not None and all(a is b for a, b in zip(given, self._given, strict=True)):
            return self._step
        self._given, finest, cells = given, self.levels[0], self._cells
        fields = {"r": r, "d": diagonal, "mask": mask, "u": cells.u, "w": cells.w}
        corrected = self.backend.prepare(
            grid_transfer.corrected,
            fields,
            (z, None),
            reduce=(None, "sum"),
            nodes=finest.all["x"],
            columns=finest.x.nodes,
            lines=finest.z.nodes,
            **cells.shape,
        )
        solve = self.backend.recorded(lambda: self._solve(r))
        self._step = Step([*solve.launches, corrected])
        return self._step

    def _make_levels(self, x: Axis, z: Axis) -> None:
        backend = self.backend
        cells = x.cells * z.cells
        self._step = self._set_up = None
        self._members = NeighborList(backend.zeros(cells + 1, "offset"), self._order)
        self._places = _places(backend, x.cells, z.cells)
        self._sums = [backend.zeros(cells + 1) for _ in range(4)]
        self._sum_heads = tuple(backend.head(array, cells) for array in self._sums)
        self.levels = [Level(backend, x, z)]
        while self.levels[-1].count > COARSEST:
            x, z = x.coarser(), z.coarser()
            self.levels.append(Level(backend, x, z))
        self._inverse = backend.zeros(self.levels[-1].count ** 2)

    def _collect(self, values: Array, out: tuple) -> None:
        """P^T of the particles' values into the finest grid, as `grid_nodes.started`."""
        backend = self.backend
        backend.pointwise(
            grid_transfer.corner_sums,
            self._places,
            self._sum_heads,
            values=values,
            order=self._order,
            start=self._members.row_start,
            u=self._sorted_u,
            w=self._sorted_w,
        )
        sums = dict(zip(("sum_00", "sum_01", "sum_10", "sum_11"), self._sums, strict=True))
        finest = self.levels[0].at
        backend.pointwise(grid_transfer.from_cells, finest, out, **sums, **self._cells.shape)

    def _solve(self, r: Array) -> None:
        """B P^T r on the finest grid."""
        self._collect(r, self.levels[0].outputs("r", "x", "y"))
        self._cycle(0)

    def _cycle(self, k: int) -> None:
        """V cycle from level k upward: turn x = v r into its solution."""
        level = self.levels[k]
        if level is self.levels[-1]:
            factors = {"inverse": self._inverse, "all_r": level.all["r"]}
            self.backend.pointwise(
                grid_nodes.product, level.at, level.at["x"], count=level.count, **factors
            )
            return
        above = self.levels[k + 1]
        level.smooth(grid_nodes.rest, level.at["rest"])
        level.collect(above, "rest", above.outputs("r", "x", "y"))
        self._cycle(k + 1)
        level.add(above)
        level.smooth(grid_nodes.sweep, level.at["x"])


def _inverse(backend: Backend, level: Level) -> np.ndarray:
    """(n n,) inverse of K on the coarsest grid, with 0 in rows and columns of vanishing pivots.

    Vanishing beside the largest: a node that particles touch by a rounding error has nothing else.
    """
    n, stencil = level.count, level.stencil
    s, a = (np.asarray(backend.look(level.at[name]), np.float64) for name in ("s", "a"))
    first, second, kinds, place = _couplings(*level.shape.values())
    g = np.array([stencil[name] for name in COUPLINGS])[kinds] * s[first] * s[second]
    K = np.asarray(np.bincount(place, np.concatenate([a, g, -g]), n * n), float).reshape(n, n)
    return invert(K, VANISHING * K.ravel()[:: n + 1].max(initial=0.0)).ravel()


@lru_cache(maxsize=8)
def _couplings(
    columns: int, lines: int, x_wraps: int, z_wraps: int
) -> tuple[NDArray[np.int64], ...]:
    """Both nodes of all that are coupled in a grid, the place of the kind in COUPLINGS, and the
    places in a matrix of its diagonal, and of what couplings add to the diagonal and beside it."""
    c, m = np.divmod(np.arange(columns * lines), lines)
    parts: list[tuple[NDArray[np.int64], ...]] = []
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            column = (c + i) % columns if x_wraps else c + i
            line = (m + j) % lines if z_wraps else m + j
            other = column * lines + line
            is_inside = (column >= 0) & (column < columns) & (line >= 0) & (line < lines)
            k = np.flatnonzero(is_inside & (other != np.arange(other.size)))
            parts.append((k, other[k], np.full(k.size, 2 if i and j else 0 if i else 1)))
    first, second, kinds = (np.concatenate(part) for part in zip(*parts, strict=True))
    n = c.size
    place = np.concatenate([np.arange(n) * (n + 1), first * (n + 1), first * n + second])
    return first, second, kinds, place
