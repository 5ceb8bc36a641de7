"""Preconditioner for pair operators of scattered particles: the diagonal plus a grid's correction.

    M^-1 r = D^-1 r + P B P^T r

for A = G + a with (G p)_i = sum_j g_ij (p_i - p_j), which discretizes V_i times the Laplacian, on
the particles whose mask is 1, in 1, 2 or 3 dimensions. P interpolates multilinearly from the nodes
of a grid of cells two thirds of a support radius wide (some 2.5 particles, `unknowns`); B is a V
cycle for the Laplacian of multilinear elements on that grid, with the particles' own volume as the
share of each node that is filled (`grid_nodes`), on grids of twice the width and so on
(`grid_levels`), one damped Jacobi sweep before and after, and an exact inverse where few nodes are
left.

The wide stencils of particles make D^-1 a good smoother for all that is shorter than a support
radius, and the grid carries the rest; so the number of iterations does not grow with the number of
particles, and an iteration costs one pair sum over particles. Grid and volumes follow from the
positions, the volumes and the mask alone and are made anew whenever these change, by one sort:
nothing of them needs to survive a step. An axis of two nodes is dropped, so that thin bodies keep
boxes of equal edges for as long as there are several along an axis.

Singular operators are welcome: pivots of the exact inverse that vanish are left out. All parts are
symmetric and not negative, and so is M^-1. Left out: particles of very different sizes.
References: [Xu1996], [Bramble1990] for the additive form.
"""

from __future__ import annotations

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.dense import invert
from lasersph.compute.graph import graph
from lasersph.compute.vectors import element
from lasersph.linear_solvers import grid_nodes
from lasersph.linear_solvers.cells import FilledCells
from lasersph.linear_solvers.grid_levels import GridLevel, products_of

COARSEST = 80
"""Grids are coarsened until there are at most as many nodes, where axes can be: three periods of an
odd number of cells keep up to 343."""
VANISHING = 1e-10
"""Pivot of the exact inverse over the largest diagonal element, below which a node is left out."""


class GridCorrection:
    """Diagonal and grids for one set of particles.

    Args:
        cells: of the finest grid, which follow the particles.

    Attributes:
        levels: grids, the finest first.
    """

    def __init__(self, backend: Backend, cells: FilledCells) -> None:
        self.backend, self.levels = backend, list[GridLevel]()
        self._cells, self._sorted_place = cells, backend.zeros(cells.place.shape)

    def prepare(self, volume: Array, boundary_coefficient: Array) -> None:
        """Make the grids for the particles that the cells hold now.

        Args:
            volume: (n,) V_i [m^d]. boundary_coefficient: (n,) a_i.
        """
        backend = self.backend
        # grids around the particles
        if not self.levels or self.levels[0].axes != self._cells.axes:
            self._make_levels()

        # K of all levels, and its inverse on the coarsest
        self.set_up_levels(volume, boundary_coefficient)
        backend.copy(backend.asarray(_inverse(self.levels[-1])), self._inverse)

    @graph
    def set_up_levels(self, volume: Array, boundary_coefficient: Array) -> None:
        """Volumes, boundary coefficients and diagonals of all levels."""
        places, place = {"place": self._cells.members.neighbor}, self._cells.place
        self.backend.pointwise(element, places, self._sorted_place, table=place)
        for values, name in ((volume, "C"), (boundary_coefficient, "a")):
            self._collect(values, (self.levels[0].at[name], None, None))
        for level, above in zip(self.levels, [*self.levels[1:], None], strict=True):
            level.prepare()
            if above:
                for name in ("C", "a"):
                    level.collect(above, name, (above.at[name], None, None))

    @graph
    def correct(self, r: Array, diagonal: Array, mask: Array, z: Array) -> None:
        """M^-1 r into z, 0 where the mask is 0; reduces r z.

        Args:
            diagonal: (n,) D, not 0.
        """
        finest, cells = self.levels[0], self._cells
        # B P^T r on the finest grid
        self._collect(r, finest.outputs("r", "x", "y"))
        self._cycle(0)

        # D^-1 r + P B P^T r
        fields = {"r": r, "d": diagonal, "mask": mask}
        fields |= {"place": cells.place, "cell": cells.number}
        self.backend.pointwise(
            grid_nodes.corrected,
            fields,
            (z, None),
            reduce=(None, "sum"),
            nodes=finest.all["x"],
            corners=self._corners,
        )

    def _make_levels(self) -> None:
        """Grids for cells along these axes, and the tables between cells and nodes."""
        backend, cells, axes = self.backend, self._cells.grid, self._cells.axes
        self._places = {"k": backend.asarray(np.arange(cells.count), "index")}

        # every other node, until few are left or no axis has every other one
        self.levels = [GridLevel(backend, axes)]
        while self.levels[-1].count > COARSEST and self.levels[-1].can_be_coarser:
            self.levels.append(self.levels[-1].coarser())
        self._inverse = backend.zeros(self.levels[-1].count ** 2)

        # the nodes at the corners of each cell, and the cells of which a node is a corner
        finest, ends = self.levels[0], products_of(0, 1, axes=len(axes))
        corners = finest.nodes.numbers(cells.index[:, None, :] + ends[:, :, None])
        around = cells.numbers(finest.nodes.index[:, None, :] - ends[:, :, None])
        self._corners = backend.asarray(corners, "index")
        finest.at["cells"] = backend.asarray(around, "index")
        self._sums = backend.zeros((2 ** len(axes), cells.count + 1))
        self._sums_of_cells = backend.head(self._sums, cells.count)

    def _collect(self, values: Array, out: tuple) -> None:
        """P^T of the particles' values into the finest grid, as `grid_nodes.started`."""
        backend, members = self.backend, self._cells.members
        # toward the corners of each cell, then from the cells around each node
        backend.pointwise(
            grid_nodes.corner_sums,
            self._places,
            self._sums_of_cells,
            values=values,
            order=members.neighbor,
            start=members.row_start,
            place=self._sorted_place,
            nothing=(0.0,) * self._sums.shape[0],
        )
        backend.pointwise(grid_nodes.from_cells, self.levels[0].at, out, sums=self._sums)

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
        level.smooth(grid_nodes.residual, level.at["residual"])
        level.collect(above, "residual", above.outputs("r", "x", "y"))
        self._cycle(k + 1)
        level.add(above)
        level.smooth(grid_nodes.sweep, level.at["x"])


def _inverse(level: GridLevel) -> np.ndarray:
    """(n n,) inverse of K on the coarsest grid, with 0 in rows and columns of vanishing pivots.

    Vanishing beside the largest: a node that particles touch by a rounding error has nothing else.
    """
    K = level.matrix()
    return invert(K, VANISHING * K.ravel()[:: level.count + 1].max(initial=0.0)).ravel()
