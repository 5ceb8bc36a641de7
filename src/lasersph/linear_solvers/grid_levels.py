"""`GridLevel`: one grid of nodes in d axes with its couplings, and the way to the next coarser one.

Multilinear elements on boxes of edges h_a couple a node with the 3^d - 1 nodes around it. Along
each axis the element has the stiffness (-1, 2, -1) / h^2 and the mass (1, 4, 1) / 6 per volume, and
a node that is stepped to along the axes S has

    k_S = - sum_a [a in S ? -1 : 2] / h_a^2  prod_{b != a} [b in S ? 1 : 4] / 6        [Strang1973]

where axes of a single node are left out, and what is negative on long boxes counts as 0. Every
other node is one of the next coarser grid; P is the mean of the nodes that a node lies between.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property, lru_cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.cell_grid import CellGrid, steps_around
from lasersph.linear_solvers import grid_nodes
from lasersph.linear_solvers.cells import Axis

DAMPING = 8.0 / 9.0
"""Of the Jacobi sweeps. Derived: in 2-D it reduces all that the next grid does not resolve to a
third, in 3-D to five ninths."""
SHARES = {2: (0.5, 1.0, 0.5), 1: (0.0, 1.0, 0.0), 0: (0.0, 1.0, 1.0)}
"""Shares that the nodes -1, 0 and 1 after a coarser one's own have of it, by the step of the axis:
two joined nodes count whole."""


def couplings(axes: Sequence[Axis]) -> tuple[float, ...]:
    """k_IJ [1/m^2] toward the 3^d - 1 nodes around, in the order of `steps_around`."""
    return _couplings(tuple(axis.spacing if axis.nodes > 1 else 0.0 for axis in axes))


@lru_cache(maxsize=64)
def _couplings(edges: tuple[float, ...]) -> tuple[float, ...]:
    """Those of boxes with these edges [m], 0 along axes of one node."""
    wide = [k for k, edge in enumerate(edges) if edge > 0.0]
    found = []
    for step in steps_around(len(edges)).T:
        total = 0.0
        for a in wide:
            # stiffness along axis a times the mass along all others, times 6 for each of these
            factor = 1.0 if step[a] else -2.0
            for b in wide:
                factor *= 1.0 if b == a or step[b] else 4.0
            total += factor * edges[a] ** -2
        found.append(max(0.0, total / 6.0 ** max(len(wide) - 1, 0)))
    return tuple(found)


@lru_cache(maxsize=64)
def _shares(steps: tuple[int, ...]) -> tuple[float, ...]:
    """Shares of a coarser node that the 3^d finer ones around it have, by the steps of the axes."""
    return tuple(float(np.prod(one)) for one in product(*(SHARES[step] for step in steps)))


def products_of(*along: int, axes: int) -> NDArray[np.int64]:
    """Every choice of one of the numbers for each axis, the last axis fastest, (axes, choices)."""
    return np.array(list(product(along, repeat=axes))).T


class GridLevel:
    """One grid with its work arrays, which are one longer than its nodes and end with 0.

    Attributes:
        nodes: the grid, whose cells are the nodes. count: of nodes. all: arrays by name; `at`
            without the last place, with the tables of the nodes around each one.
    """

    def __init__(self, backend: Backend, axes: tuple[Axis, ...]) -> None:
        self.backend, self.axes = backend, axes
        d, inverse = len(axes), [1.0 / axis.spacing for axis in axes]
        shape, repeats = [axis.nodes for axis in axes], [axis.wraps for axis in axes]
        self.nodes = CellGrid((0.0,) * d, shape, inverse, repeats)
        self.count = self.nodes.count
        names = ("C", "s", "a", "d", "v", "r", "x", "y", "residual")
        self.all = {name: backend.zeros(self.count + 1) for name in names}
        self.at = {name: backend.head(array, self.count) for name, array in self.all.items()}
        self.at["k"] = backend.asarray(np.arange(self.count), "index")
        self.at["around"] = backend.asarray(self.nodes.around(), "index")
        self.couplings = couplings(axes)

    def outputs(self, *names: str) -> tuple:
        """Arrays to be written."""
        return tuple(self.at[name] for name in names)

    @property
    def can_be_coarser(self) -> bool:
        """Whether the next coarser grid has fewer nodes."""
        return any(axis.step != 1 for axis in self.axes)

    def coarser(self) -> GridLevel:
        """The next coarser grid, with the tables of the way there and back."""
        above = GridLevel(self.backend, tuple(axis.coarser() for axis in self.axes))
        steps = np.array([axis.step for axis in self.axes])[:, None, None]

        # nodes of this grid around each coarser one, with their shares
        near = products_of(-1, 0, 1, axes=steps.size)
        finer = self.nodes.numbers(steps * above.nodes.index[:, None, :] + near[:, :, None])
        above.at["finer"] = self.backend.asarray(finer, "index")
        self._shares = _shares(tuple(axis.step for axis in self.axes))

        # the 2^d coarser nodes that each of this grid lies between, the same twice where it is one
        ends = products_of(0, 1, axes=steps.size)
        place = self.nodes.index[:, None, :] + ends[:, :, None] * (steps - 1)
        between = np.where(steps > 0, place // np.maximum(steps, 1), 0)
        self.at["coarser"] = self.backend.asarray(above.nodes.numbers(between), "index")
        self._ends = (0.5**steps.size,) * 2**steps.size
        return above

    def prepare(self) -> None:
        """Diagonal of K from the volumes C and the boundary coefficients a."""
        run, at = self.backend.pointwise, self.at
        run(grid_nodes.root, at, at["s"])
        given = {"couplings": self.couplings, "damping": DAMPING}
        run(grid_nodes.diagonal, at, self.outputs("d", "v"), all_s=self.all["s"], **given)

    def smooth(self, function: Callable, out: Array) -> None:
        """`residual` or `sweep` of the present x and y = s x."""
        given = {"all_y": self.all["y"], "couplings": self.couplings}
        self.backend.pointwise(function, self.at, out, **given)

    def collect(self, above: GridLevel, name: str, out: tuple) -> None:
        """P^T of an array of this level into those of the next, as `grid_nodes.started`."""
        given = {"all_r": self.all[name], "shares": self._shares}
        self.backend.pointwise(grid_nodes.collected, above.at, out, **given)

    def add(self, above: GridLevel) -> None:
        """x + P e with the x of the next level for e."""
        given = {"coarse_x": above.all["x"], "shares": self._ends}
        self.backend.pointwise(grid_nodes.added, self.at, self.outputs("x", "y"), **given)

    @cached_property
    def _pairs(self) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
        """Both nodes of all that are coupled, and their couplings."""
        around = self.nodes.around()
        is_inside = around < self.count
        first = np.broadcast_to(np.arange(self.count), around.shape)[is_inside]
        k = np.broadcast_to(np.array(self.couplings)[:, None], around.shape)[is_inside]
        return first, around[is_inside], k

    @cached_property
    def _places(self) -> NDArray[np.int64]:
        """Places in the matrix of its diagonal, of what couplings add to it, and of themselves."""
        n, (first, second, _) = self.count, self._pairs
        return np.concatenate([np.arange(n) * (n + 1), first * (n + 1), first * n + second])

    def matrix(self) -> NDArray[np.float64]:
        """K of the present volumes and boundary coefficients, on the host, (count, count)."""
        n, (first, second, k) = self.count, self._pairs
        s, a = (
            np.asarray(self.backend.host_view(self.at[name]), np.float64) for name in ("s", "a")
        )
        g = k * s[first] * s[second]
        K = np.bincount(self._places, np.concatenate([a, g, -g]), n * n)
        return K.astype(np.float64, copy=False).reshape(n, n)
