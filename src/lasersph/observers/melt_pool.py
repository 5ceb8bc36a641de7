"""Width, depth, surface and life of the melt pool.

A cell counts as fluid where its melt fraction reaches a level: 1 (completely fluid; the size of
the pool in the paper), 0.5 (which depends least on the cell size) or anything above 0. The depth
is where melt of that level ends below the original surface; the width is that of the surface cells
that are connected to the hottest one, doubled where half a period or half a spot is computed and
the pool lies on its symmetry plane. [Demuth2020, Sec. 5] Surface cells meet half way between their
particles, also where these move: at rest widths are whole cells, but at f_m = 0.5, where they are
interpolated. What has been ejected belongs to no pool.

Depths lie between the centers of the hottest cell of the deepest row that is fluid (1) and of the
one below (2), at the mean of two places; a row is half a cell high, as flow moves its particles.
That where f_m falls to 0.5 rests at the face while cell 1 is molten and cell 2 still warms up; that
where T falls to the temperature of the level rests at a center while that cell melts; their mean
always moves:

    z = z_1 + (z_2 - z_1) (s_f + s_T) / 2,   s_f = (f_1 - 1/2) / (f_1 - f_2)
    s_T = (T_1 - T_L) / (T_1 - T_2),         T_L = T_solidus + L (T_liquidus - T_solidus)

with L = 1/2. Fractions do not tell where L = 1 or L = 0 is passed: they are 1 all through the
liquid and 0 all through the solid. There T alone does, within both places of f_m = 0.5,

    z(1) = (min(z_T1, z_f) + min(z_T1, z_T)) / 2,   z(0) = (max(z_T0, z_f) + max(z_T0, z_T)) / 2

so that fluid metal is never deeper than half molten metal, and this never than any melt. The paper
takes the lower face of the deepest cell instead, which is half a cell from these at most, and jumps
by whole cells.

In 3-D the width is taken along x through the hottest surface cell; where rows are as hot as each
other, as under an even spot, through the one with most melt. The area is that of all surface cells
that reach the level, of all dots in the domain.

Left out: pools that wrap around a periodic boundary.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from lasersph.observers.ablation_view import EJECTED
from lasersph.observers.observer import Observer, Row
from lasersph.observers.peak import Span
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View, largest_depth, lower_faces

FULL, HALF = 1.0 - 1e-9, 0.5
LEVELS = {
    "": (FULL, "completely fluid metal (f_m = 1)"),
    "_half": (HALF, "half molten metal (f_m = 0.5)"),
    "_any": (0.0, "melt of any fraction (f_m > 0)"),
}
"""Part of a key, the melt fraction that a fluid cell has at least (any: above 0), and its name."""

EQUALLY_HOT = 0.01
"""Part of the rise of temperature along the surface within which rows are equally hot. Guard: cells
at the boiling point, or in the middle of an even spot, differ by rounding alone, and the hottest of
them is anywhere; in a Gaussian spot it is a twentieth of the radius."""


def sizes(name: str, cells: Mapping[str, float]) -> tuple[Quantity, ...]:
    """A size of the pool at each level, and by how many cells it jumps there."""
    return tuple(
        Quantity(
            f"melt_{name}{level}_m",
            "m",
            f"{name} of {words}",
            largest=f"melt.{name}{level}_max_m",
            is_main=level != "_any",
            cells=cells[level],
        )
        for level, (_, words) in LEVELS.items()
    )


DEPTHS = sizes("depth", {"": 0.5, "_half": 0.5, "_any": 0.5})
WIDTHS = sizes("width", {"": 2.0, "_half": 1.0, "_any": 2.0})
AREAS = tuple(
    Quantity(
        f"melt_area{level}_m2",
        "m^2",
        f"area of {words}",
        largest=f"melt.area{level}_max_m2",
        is_main=level != "_any",
    )
    for level, (_, words) in LEVELS.items()
)
VOLUME = Quantity(
    "melt_volume_m3",
    "m^3",
    "volume of molten metal",
    largest="melt.volume_max_m3",
    is_main=True,
)


class MeltPool(Observer):
    """Observes the melt pool; in 1-D it has a depth and no width, in 3-D also an area."""

    title = "melt pool"
    note = (
        "Depth: below the original surface, interpolated between cells. Width: full width of one"
        " pool at the surface, in whole cells, at f_m = 0.5 interpolated between them. Area: of the"
        " surface. Volume: of all cells, each with its melt fraction. Of half a period, half or a"
        " quarter of a spot all of them are those of the whole."
    )
    columns = (*DEPTHS, *WIDTHS, *AREAS, VOLUME)
    results = (
        *(
            Quantity(f"melt.{name}{level}_s", "s", f"{text} {words}", is_main=level == "")
            for level, (_, words) in LEVELS.items()
            for name, text in (("start", "first"), ("end", "last"))
        ),
        Quantity("melt.molten_at_end", "", "still fluid at the end of the run"),
        *(
            Quantity(f"melt.radius{level}_max_m", "m", f"largest radius of {words}")
            for level, (_, words) in LEVELS.items()
        ),
    )
    kept = ("span", "end_time")

    def __init__(self, dimension: int, *, is_section: bool = False) -> None:
        """
        Args:
            dimension: 1, 2 or 3. is_section: whether the run is a section (r, z), whose pool has a
                radius, half of its width.
        """
        if dimension < 3:
            self.columns = (*DEPTHS, *(WIDTHS if dimension == 2 else ()), VOLUME)
        super().__init__()
        self.dimension, self.is_section = dimension, is_section
        self.span = {level: Span() for level in LEVELS}
        self.end_time = 0.0

    def observe(self, view: View) -> Row:
        """Sizes of the pool at this step [m]; 0 where nothing is fluid."""
        # melt fraction that has not left; none at all is most of a run
        fraction = remaining_fraction(view)
        largest = float(np.max(fraction))
        width, area = dict.fromkeys(LEVELS, 0.0), dict.fromkeys(LEVELS, 0.0)
        depth = pool_depths(view, fraction) if largest > 0.0 else dict.fromkeys(LEVELS, 0.0)
        # levels in turn: seen, how wide, how large
        for level, (least, _) in LEVELS.items():
            exists = largest > 0.0 and largest >= least
            self.span[level].update(exists, view.time)
            if exists:
                width[level] = pool_width(view, least) if self.dimension > 1 else 0.0
                area[level] = pool_area(view, fraction, least) if self.dimension > 2 else 0.0
        self.end_time = view.time
        volume = float(np.sum(fraction * view.volume)) if largest > 0.0 else 0.0
        widths = width.values() if self.dimension > 1 else ()
        areas = area.values() if self.dimension > 2 else ()
        return self.record(view.time, (*depth.values(), *widths, *areas, volume))

    def values(self) -> dict[str, object]:
        """Times, None where no such cell was seen; in 1-D there are no widths."""
        # a 1-D run has no widths
        absent = (one for column in WIDTHS for one in (column.largest, column.largest_at))
        found: dict[str, object] = {one: None for one in absent if self.dimension == 1}
        for level, span in self.span.items():
            found |= {f"melt.start{level}_s": span.first, f"melt.end{level}_s": span.last}
            if self.is_section:
                widest = self.peak[f"melt_width{level}_m"].value
                found[f"melt.radius{level}_max_m"] = 0.5 * widest
        return {**found, "melt.molten_at_end": self.span[""].last == self.end_time}

    def summary(self) -> dict[str, object]:
        """`melt`: times and largest sizes; nothing where nothing began to melt.

        `end_s` is the last time at which it was seen; `molten_at_end` says that the run ended
        before it was solid.
        """
        return super().summary() if self.span["_any"].first is not None else {}


def remaining_fraction(view: View) -> np.ndarray:
    """Melt fraction of what has not been ejected, (n,); 0 of what has."""
    if view.ablation is None or view.ablation.ejected_count == 0:
        return view.melt_fraction
    return np.where(view.ablation.stage < EJECTED, view.melt_fraction, 0.0)


def is_fluid(fraction: np.ndarray, least: float) -> np.ndarray:
    """Where a melt fraction reaches a level of `LEVELS`."""
    return fraction > 0.0 if least == 0.0 else fraction >= least


def pool_depths(view: View, fraction: np.ndarray) -> dict[str, float]:
    """Depth of the pool at each of `LEVELS` [m], as the head of this file says; 0 where none is.

    Args:
        fraction: (n,) melt fractions without what has been ejected.
    """
    # lower faces of the cells, and where each level ends there
    faces = lower_faces(view)
    ends = {level: melt_ends(view, fraction, faces, least) for level, (least, _) in LEVELS.items()}
    half = ends["_half"]
    found = {"_half": 0.5 * sum(half) if half else 0.0}
    # at 1 and above 0 the temperature tells, within both places of f_m = 0.5
    for level, nearer in (("", min), ("_any", max)):
        _, by_temperature = ends[level] or (0.0, 0.0)
        bounds = half or (by_temperature, by_temperature)
        found[level] = 0.5 * sum(nearer(by_temperature, bound) for bound in bounds)
    return {level: max(found[level], 0.0) for level in LEVELS}


def melt_ends(
    view: View, fraction: np.ndarray, faces: np.ndarray, least: float
) -> tuple[float, float] | None:
    """Depths at which melt of a level ends [m], by fraction (where it falls to 0.5) and by
    temperature, below the hottest of its deepest cells; None where no cell is fluid.

    Args:
        fraction: (n,) melt fractions. faces: (n,) depths of the lower faces of the cells [m].
        least: melt fraction that a fluid cell has at least; 0: any above 0.
    """
    fluid = is_fluid(fraction, least)
    if not np.any(fluid):
        return None
    # lowest cell of the level, and the hottest of its row
    deepest = largest_depth(faces, fluid)
    half_cell = 0.5 * float(np.min(view.width[-1]))
    # particles of the lowest row, which flow moves up and down by a part of a cell
    lowest = np.flatnonzero(fluid & (faces >= max(deepest - half_cell, 0.0)))
    if lowest.size == 0:  # all of it on a rim, above the original surface
        return 0.0, 0.0

    # the cell below it in its column, between which the end lies
    upper = int(lowest[np.argmax(view.enthalpy[lowest])])
    lower = cell_below(view, faces, upper, ~fluid)
    if lower is None or view.solidus is None or view.liquidus is None:
        return float(faces[upper]), float(faces[upper])
    # where f_m falls to 0.5 between them
    share = by_fraction = (fraction[upper] - HALF) / (fraction[upper] - fraction[lower])
    hot, cold = view.temperature[upper], view.temperature[lower]

    # where the temperature passes the level's own, of what is linear between both
    if hot > cold:  # else both are at the melting point, and the fractions alone tell
        passed = view.solidus + least * (view.liquidus - view.solidus)
        share = (hot - passed) / (hot - cold)
    by_temperature = min(max(share, 0.0), 1.0)
    # places along the line between both cells
    top, step = view.position[-1, upper], view.position[-1, lower] - view.position[-1, upper]
    return float(-(top + by_fraction * step)), float(-(top + by_temperature * step))


def cell_below(view: View, faces: np.ndarray, upper: int, chosen: np.ndarray) -> int | None:
    """The highest of some cells (n,) that lies below a cell in its column; None where none does."""
    is_below = (faces > faces[upper]) & chosen
    # beside the cell along each lateral axis
    for axis in range(view.dimension - 1):
        side = np.abs(view.position[axis] - view.position[axis, upper])
        is_below = is_below & (side < 0.5 * view.width[axis])
    below = np.flatnonzero(is_below)
    return int(below[np.argmin(faces[below])]) if below.size else None


def pool_width(view: View, least: float) -> float:
    """Full width at the surface of the pool around the hottest surface cell [m].

    Args:
        view: the state, 2-D or 3-D.
        least: melt fraction that a fluid cell has at least; 0: any above 0.
    """
    row = surface_row(view)
    # the pool around the hottest cell, out to the next solid one at either side
    fluid = is_fluid(view.melt_fraction[row], least)
    seed = int(np.argmax(view.enthalpy[row]))
    if not fluid[seed]:
        return 0.0
    solid = np.flatnonzero(~fluid)
    after = int(np.searchsorted(solid, seed))
    first = int(solid[after - 1]) + 1 if after > 0 else 0
    last = int(solid[after]) - 1 if after < solid.size else row.size - 1
    edge = cell_edges(view, row)
    # whole cells, and at f_m = 0.5 the interpolated parts beyond them
    total = float(edge[last + 1] - edge[first])
    if least == HALF:
        total += _beyond_edge(view, row, first, first - 1) + _beyond_edge(view, row, last, last + 1)
    # both halves of a pool whose mirror is the edge of the domain
    mirrors = (True, True) if view.symmetry_factor == 2 else view.halves_spot
    is_half = (first == 0 and mirrors[0]) or (last == row.size - 1 and mirrors[1])
    return 2.0 * total if is_half else total


def pool_area(view: View, fraction: np.ndarray, least: float) -> float:
    """Area of the surface cells that are fluid [m^2], of the whole where a part is computed.

    Args:
        view: the state in 3-D. fraction: (n,) melt fractions. least: as of `pool_width`.
    """
    cells = view.surface[is_fluid(fraction[view.surface], least)]
    area = view.width[0, cells] * view.width[1, cells]
    return view.mirror_images * float(np.sum(area))


def cell_edges(view: View, row: np.ndarray) -> np.ndarray:
    """Where the cells of a row (m,) in order of x begin and end, (m + 1,) [m].

    Half a period begins at x = 0.
    """
    x, half = view.position[0, row], 0.5 * view.width[0, row]
    # half way between the faces of neighbors, the plane of symmetry at 0
    between = 0.5 * ((x[:-1] + half[:-1]) + (x[1:] - half[1:]))
    first = 0.0 if view.symmetry_factor == 2 else x[0] - half[0]
    return np.concatenate([[first], between, [x[-1] + half[-1]]])


def _beyond_edge(view: View, row: np.ndarray, last: int, beyond: int) -> float:
    """How far half fluid material reaches beyond the edge of the last fluid cell of a row [m].

    Less than half a cell in or out; 0 at the end of the row.
    """
    if not 0 <= beyond < row.size:
        return 0.0
    inner, outer = view.melt_fraction[row[last]], view.melt_fraction[row[beyond]]
    # f_m = 0.5 between the centers of both cells
    distance = abs(view.position[0, row[beyond]] - view.position[0, row[last]])
    return float(((inner - HALF) / (inner - outer) - 0.5) * distance)


def surface_row(view: View) -> np.ndarray:
    """Indices of the surface cells along x of the hottest row, in order of x; in 3-D that with most
    melt of those that are equally hot.
    """
    cells = view.surface
    if view.dimension == 3:
        # number of each cell's row along y
        y, width = view.position[1, cells], view.width[1, cells]
        row = np.rint((y - np.min(y)) / np.min(width)).astype(int)
        # rows with a cell that is as hot as the hottest
        temperature = view.temperature[cells]
        least = np.max(temperature) - EQUALLY_HOT * np.ptp(temperature)
        # most melt among these
        melt = np.bincount(row, weights=view.melt_fraction[cells])
        melt[np.setdiff1d(np.arange(melt.size), row[temperature >= least])] = -1.0
        cells = cells[row == np.argmax(melt)]
    return cells[np.argsort(view.position[0, cells], kind="stable")]
