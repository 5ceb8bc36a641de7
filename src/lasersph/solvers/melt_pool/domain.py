"""The domain of a flow: its faces and surface, and the block of particles that may move in it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot
from lasersph.input import format_quantity
from lasersph.particles.ghosts import MIRROR, TANGENT
from lasersph.particles.layers import Layers
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.block_layers import SKIN, StaticParticleData
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds
from lasersph.solvers.melt_pool.passing_block import RestingBlock
from lasersph.solvers.melt_pool.ring_block import RingBlock, RingTangentBlock
from lasersph.solvers.melt_pool.tangent_block import TangentBlock
from lasersph.solvers.step_control import StepFailed
from lasersph.surface.surface import Surface

GROWTH = 16
"""Layers by which a block grows. Cost: how often arrays grow."""
RESTING_LAYERS = 8.0
"""Resting layers below the moving rows, in units of the finest spacing. Geometry: two supports of
3.75."""
MELT_MARGIN = 2.0
"""Depth of the rows below the deepest melt, in support radii. Geometry: edge and dummy particles
lie within the first and second below the melt."""
BLOCKS = {MIRROR: Block, TANGENT: TangentBlock}
RESTING_BLOCKS: dict[str, type[Block]] = {MIRROR: RestingBlock}
RING_BLOCKS: dict[str, type[Block]] = {MIRROR: RingBlock, TANGENT: RingTangentBlock}
"""Blocks by how ghosts lie beyond the surface: of particles that move, of those that rest in a
plane or in space, and of rings."""


class PoolTooDeep(StepFailed):
    """The melt reaches layers that are too coarse for its flow."""


class PoolTooWide(StepFailed):
    """The melt comes too close to columns that are too coarse for its flow."""


def fluid_depth(x, fluid):
    """Depth of a fluid particle below the top of the layers [m]."""
    return -fluid * x[-1]


def fluid_reach(x, fluid, along, low, high):
    """How far a fluid particle is beyond a lower, and beyond an upper end along an axis [m]."""
    if fluid > 0.0:
        return low - dot(x, along), dot(x, along) - high
    return low - high, low - high


def resting(mark, free):
    """A mark where pairs may be found anew, else 0."""
    return mark * free


class PoolDomain:
    """Conditions at the faces, surface and blocks.

    Args:
        rests: whether particles keep their columns and the melt passes between them.

    Attributes:
        box: lower and upper end of each axis [m].
        layers: of the fine columns. spacing, support: of the particles that move [m].
            block_layers: layers of the present block but for its margin. volume: (n,) of the
            particles [m^2].
    """

    def __init__(
        self,
        backend: Backend,
        layers: Layers,
        lattice: StaticParticleData,
        conditions: FaceConditions,
        surface: Surface,
        potential: Callable[[np.ndarray], np.ndarray],
        enthalpy: Callable[[np.ndarray], np.ndarray],
        volume: Array,
        free: Array | None = None,
        *,
        rests: bool = False,
    ) -> None:
        self.backend, self.lattice, self._free = backend, lattice, free
        self.layers, self._ends = layers.fine_only, self._fluid_ends(layers)
        self.conditions, self.surface = conditions, surface
        self.potential, self.enthalpy = potential, enthalpy
        self.volume = volume
        self.is_box = conditions.flow is not None
        self.spacing, self.support = layers.spacing, float(lattice.support.min())
        self.box = conditions.box
        self._bottom = np.cumsum(layers.thickness)
        self.fine_depth = layers.fine_depth
        self._starts = np.concatenate([[0], np.cumsum(np.prod(layers.columns, axis=0))])
        blocks = RESTING_BLOCKS if rests else BLOCKS
        if lattice.geometry.is_axisymmetric:
            blocks = RING_BLOCKS
        self._block_type = blocks[surface.crossing]
        self.block_layers = 0
        self._block: Block | None = None

    @property
    def bounds(self) -> tuple[tuple[float, float], ...]:
        """The box up to the top of the surface [m]."""
        *sides, (bottom, _) = self.box
        return (*sides, (bottom, self.surface.top))

    @property
    def width(self) -> float:
        """Of the domain [m]."""
        return self.box[0][1] - self.box[0][0]

    @property
    def surface_grid(self) -> tuple[tuple[float, ...], tuple[float, ...], tuple[int, ...]]:
        """Lower ends [m], widths [m] and numbers of the columns below the surface, one for each
        particle of the uppermost layer, along each axis."""
        counts = tuple(int(n) for n in self.layers.columns[:, 0])
        low = tuple(low for low, _ in self.box[:-1])
        sizes = (high - low for low, high in self.box[:-1])
        return low, tuple(size / n for size, n in zip(sizes, counts, strict=True)), counts

    def find_depth(self, position: Array, out: Array) -> None:
        """Depth of the particles below the surface, or the top of a box without one [m]."""
        self.surface.find_depth(position, out)

    def cover_fine_layers(self) -> None:
        """Let the block hold all of the finest layers, with room below them."""
        self._grow(self.fine_depth)

    def _grow(self, deepest: float) -> None:
        """Let the block hold what lies as deep as that [m]."""
        # no melt flows below the finest layers: those below grow thick, and see far
        needed, most = self._layers_below(deepest), self._layers_below(self.fine_depth)
        if self.is_box:
            needed = most = self._bottom.size
        if needed > self.block_layers:
            self.block_layers = min(needed + GROWTH, most)

    def _layers_below(self, depth: float) -> int:
        """Layers down to MELT_MARGIN supports below a depth [m]."""
        lowest = int(np.searchsorted(self._bottom, depth + MELT_MARGIN * self.support)) + 1
        return min(lowest, self._bottom.size)

    def _last_layer(self) -> int:
        """Layers of the block with the resting ones below, in which all of its rows are complete:
        else coarse ones would keep pairs with finest ones that have moved away."""
        below, total = self._bottom[self.block_layers - 1], self._bottom.size
        below = (below + RESTING_LAYERS * self.spacing) * (1.0 + 1e-9)
        last = min(int(np.searchsorted(self._bottom, below)) + 1, total)
        while self._complete_layers(last) < self.block_layers:
            last += 1
        return last

    def _complete_layers(self, last: int) -> int:
        """Layers all of whose neighbors lie in a block of `last` layers.

        Layers below the finest grow, and so does the support of their pairs, between particles of
        two layers at most the mean of both.
        """
        if last == self._bottom.size:
            return self.block_layers

        # reach of each layer's pairs, against the last layer of the block
        center = self._bottom - 0.5 * self.layers.thickness
        support = self.lattice.support[self._starts[:-1]]
        reach = SKIN * 0.5 * (support[:last] + support[last])
        complete = int(np.count_nonzero(center[:last] + reach <= center[last]))
        return min(self.block_layers, complete)

    def block_for(self, position: Array, kinds: ParticleKinds) -> Block:
        """Block that holds what flows, with room below it; it grows and never shrinks.

        Raises:
            PoolTooDeep: a particle below the finest layers flows. PoolTooWide: one does close to
                coarse columns.
        """
        # depth of the deepest particle that flows
        fields = {"x": position, "fluid": kinds.fluid}
        (deepest,) = self.backend.pointwise(fluid_depth, fields, (None,), reduce=("max",))
        if deepest > self.fine_depth and not self.is_box:
            raise PoolTooDeep(
                f"the melt is {format_quantity(deepest, 'm')} deep and flows into layers coarser "
                f"than {format_quantity(self.spacing, 'm')}, which begin at "
                f"{format_quantity(self.fine_depth, 'm')}; give "
                f'particles.fine_depth = "{1.3e9 * deepest:.0f} nm" or more'
            )

        self._refuse_wide(position, kinds)

        # another block where it has grown, with resting layers below
        self._grow(deepest)
        total = self._bottom.size
        if self._block is None or self._block.complete_layers != self.block_layers:
            last = self._last_layer()
            self._block = self._block_type(
                self.backend,
                self.lattice,
                self.conditions,
                self.surface,
                self.volume,
                fine_depth=self.fine_depth,
                complete_layers=self.block_layers,
                complete_rows=int(self._starts[self._complete_layers(last)]),
                count=int(self._starts[last]),
                bottom=-float(self._bottom[last - 1]),
                has_bottom=last == total,
                potential=self.potential,
                enthalpy=self.enthalpy,
            )
        assert self._block is not None
        return self._block

    def keep_resting(self, has_row: Array) -> Array:
        """Marks (count,) of rows, set to 0 in place where pairs reach coarse columns, and stay."""
        if self._free is None:
            return has_row
        fields = {"mark": has_row, "free": self.backend.head(self._free, has_row.shape[0])}
        self.backend.pointwise(resting, fields, has_row)
        return has_row

    def _fluid_ends(self, layers: Layers) -> tuple[tuple[float, float], ...]:
        """Ends along x (and y) within which what flows must stay [m], infinite where no columns are
        coarse.

        A row whose pairs reach coarse columns stays as it is, so that it must not see what moves.
        """
        if not layers.beside:
            return ()
        margin = SKIN * layers.solid_margin(self.lattice.weighing.ratio)
        return tuple(
            (low + margin if below.size else -np.inf, high - margin if above.size else np.inf)
            for (low, high), (below, above) in zip(layers.fine_bounds, layers.beside, strict=True)
        )

    def _refuse_wide(self, position: Array, kinds: ParticleKinds) -> None:
        """Raise PoolTooWide where what flows comes close to coarse columns."""
        if self._free is None:
            return
        fields = {"x": position, "fluid": kinds.fluid}
        out, reduce = (None, None), ("max", "max")
        for axis, (low, high) in enumerate(self._ends):
            along = tuple(float(other == axis) for other in range(len(self.box)))
            place: Constants = {"along": along, "low": low, "high": high}
            beyond = self.backend.pointwise(fluid_reach, fields, out, reduce=reduce, **place)
            if max(beyond) <= 0.0:
                continue
            x = low - beyond[0] if beyond[0] > 0.0 else high + beyond[1]
            end = self.box[axis][0 if beyond[0] > 0.0 else 1]
            needed = abs(x) + 1.3 * abs(end - (low if beyond[0] > 0.0 else high))
            raise PoolTooWide(
                f"the melt at {'xy'[axis]} = {format_quantity(x, 'm')} flows too close to columns "
                f"coarser than {format_quantity(self.spacing, 'm')}, which begin at "
                f"{format_quantity(end, 'm')}; give "
                f'particles.fine_width = "{1e9 * needed:.0f} nm" or more'
            )
