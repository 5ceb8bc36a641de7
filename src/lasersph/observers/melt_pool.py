"""Width, depth, surface and life of the melt pool.

A cell counts as fluid where its melt fraction reaches a level: 1 (completely fluid; the size of
the pool in the paper), 0.5 (which depends least on the cell size) or anything above 0. The depth
is that of the lower face of the deepest fluid cell below the original surface; the width is that
of the surface cells that are connected to the hottest one, doubled where half a period or half
a spot is computed and the pool lies on its symmetry plane. [Demuth2020, Sec. 5] Surface cells meet
half way between their particles, also where these move: at rest sizes are whole cells. What has
been ejected belongs to no pool.

At f_m = 0.5 both are interpolated. Where melt is deepest the depth lies between the centers of the
deepest such cell (1) and of the one below (2). The place where f_m falls to 0.5 rests at the face
while cell 1 is molten and cell 2 still warms up; the place where T falls to the middle of the
melting range rests at a center while that cell melts. So their mean is taken, which always moves:

    z = z_1 + (z_2 - z_1) (s_f + s_T) / 2,   s_f = (f_1 - 1/2) / (f_1 - f_2)
    s_T = (T_1 - T_m) / (T_1 - T_2),         T_m = (T_solidus + T_liquidus) / 2

In 3-D the width is taken along x through the hottest surface cell, and the area is that of all
surface cells that reach the level, of all dots in the domain.

Left out: pools that wrap around a periodic boundary.
"""

from __future__ import annotations

import numpy as np

from lasersph.observers.ablation_view import EJECTED
from lasersph.observers.observer import Observer, Row
from lasersph.observers.peak import SAME, Span
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View, hottest_surface_cell, largest_depth, lower_faces

FULL, HALF = 1.0 - 1e-9, 0.5
LEVELS = {
    "": (FULL, "completely fluid metal (f_m = 1)"),
    "_half": (HALF, "half molten metal (f_m = 0.5)"),
    "_any": (0.0, "melt of any fraction (f_m > 0)"),
}
"""Part of a key, the melt fraction that a fluid cell has at least (any: above 0), and its name."""


def sizes(name: str, cells: float) -> tuple[Quantity, ...]:
    """A size of the pool at each level, and by how many cells it jumps."""
    return tuple(
        Quantity(
            f"melt_{name}{level}_m",
            "m",
            f"{name} of {words}",
            largest=f"melt.{name}{level}_max_m",
            is_main=level != "_any",
            cells=0.5 * cells if level == "_half" else cells,
        )
        for level, (_, words) in LEVELS.items()
    )


DEPTHS, WIDTHS = sizes("depth", 1.0), sizes("width", 2.0)
AREAS = tuple(
    Quantity(
        f"melt_area{level}_m2",
        "m^2",
        f"area at the surface of {words}; both halves where one is computed",
        largest=f"melt.area{level}_max_m2",
        is_main=level != "_any",
    )
    for level, (_, words) in LEVELS.items()
)
VOLUME = Quantity(
    "melt_volume_m3",
    "m^3",
    "volume of molten metal, cells with their melt fractions",
    largest="melt.volume_max_m3",
    is_main=True,
)


class MeltPool(Observer):
    """Observes the melt pool; in 1-D it has a depth and no width, in 3-D also an area."""

    title = "melt pool"
    note = (
        "Depth: lower face of the deepest such cell below the original surface. Width: full"
        " width of one pool at the surface. Sizes are whole cells, but those at f_m = 0.5 are"
        " interpolated between cells."
    )
    columns = (*DEPTHS, *WIDTHS, *AREAS, VOLUME)
    results = (
        *(
            Quantity(f"melt.{name}{level}_s", "s", f"{text} {words}", is_main=level == "")
            for level, (_, words) in LEVELS.items()
            for name, text in (("start", "first"), ("end", "last"))
        ),
        Quantity("melt.molten_at_end", "", "still fluid at the end of the run"),
    )
    kept = ("span", "end_time")

    def __init__(self, dimension: int) -> None:
        if dimension < 3:
            self.columns = (*DEPTHS, *(WIDTHS if dimension == 2 else ()), VOLUME)
        super().__init__()
        self.dimension = dimension
        self.span = {level: Span() for level in LEVELS}
        self.end_time = 0.0

    def observe(self, view: View) -> Row:
        """Sizes of the pool at this step [m]; 0 where nothing is fluid."""
        fraction = remaining_fraction(view)
        largest = float(np.max(fraction))
        faces = lower_faces(view) if largest > 0.0 else np.zeros(0)
        depth, width, area = (dict.fromkeys(LEVELS, 0.0) for _ in range(3))
        for level, (least, _) in LEVELS.items():
            exists = largest > 0.0 and largest >= least
            self.span[level].update(exists, view.time)
            if exists:
                depth[level] = pool_depth(view, fraction, faces, least)
                width[level] = pool_width(view, least) if self.dimension > 1 else 0.0
                area[level] = pool_area(view, fraction, least) if self.dimension > 2 else 0.0
        self.end_time = view.time
        volume = float(np.sum(fraction * view.volume)) if largest > 0.0 else 0.0
        widths = width.values() if self.dimension > 1 else ()
        areas = area.values() if self.dimension > 2 else ()
        return self.record(view.time, (*depth.values(), *widths, *areas, volume))

    def values(self) -> dict[str, object]:
        """Times, None where no such cell was seen; in 1-D there are no widths."""
        absent = (one for column in WIDTHS for one in (column.largest, column.largest_at))
        found: dict[str, object] = {one: None for one in absent if self.dimension == 1}
        for level, span in self.span.items():
            found |= {f"melt.start{level}_s": span.first, f"melt.end{level}_s": span.last}
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


def pool_depth(view: View, fraction: np.ndarray, faces: np.ndarray, least: float) -> float:
    """Depth of the pool [m]; at f_m = 0.5 below the hottest of the deepest cells, interpolated as
    the head of this file says.

    Args:
        fraction: (n,) melt fractions without what has been ejected; one at least is fluid.
        faces: (n,) depths of the lower faces of the cells [m].
        least: melt fraction that a fluid cell has at least; 0: any above 0.
    """
    fluid = is_fluid(fraction, least)
    deepest = largest_depth(faces, fluid)
    if least != HALF:
        return deepest
    lowest = np.flatnonzero(fluid & (faces >= deepest * (1.0 - SAME)))
    if lowest.size == 0:  # all of it on a rim, above the original surface
        return 0.0
    upper = int(lowest[np.argmax(view.enthalpy[lowest])])
    is_below = (faces > faces[upper]) & ~fluid
    for axis in range(view.dimension - 1):
        side = np.abs(view.position[axis] - view.position[axis, upper])
        is_below = is_below & (side < 0.5 * view.width[axis])
    below = np.flatnonzero(is_below)
    if below.size == 0 or view.solidus is None or view.liquidus is None:
        return float(faces[upper])
    lower = int(below[np.argmin(faces[below])])
    melting = 0.5 * (view.solidus + view.liquidus)
    share = (fraction[upper] - HALF) / (fraction[upper] - fraction[lower])
    hot, cold = view.temperature[upper], view.temperature[lower]
    if hot > cold:  # both at the melting point: the fractions alone tell
        share = 0.5 * (share + min(max((hot - melting) / (hot - cold), 0.0), 1.0))
    z = view.position[-1]
    return float(-(z[upper] + share * (z[lower] - z[upper])))


def pool_width(view: View, least: float) -> float:
    """Full width at the surface of the pool around the hottest surface cell [m].

    Args:
        view: the state, 2-D or 3-D.
        least: melt fraction that a fluid cell has at least; 0: any above 0.
    """
    row = surface_row(view)
    fluid = is_fluid(view.melt_fraction[row], least)
    seed = int(np.argmax(view.enthalpy[row]))
    if not fluid[seed]:
        return 0.0
    solid = np.flatnonzero(~fluid)
    after = int(np.searchsorted(solid, seed))
    first = int(solid[after - 1]) + 1 if after > 0 else 0
    last = int(solid[after]) - 1 if after < solid.size else row.size - 1
    edge = cell_edges(view, row)
    total = float(edge[last + 1] - edge[first])
    if least == HALF:
        total += _beyond_edge(view, row, first, first - 1) + _beyond_edge(view, row, last, last + 1)
    mirrors = (True, True) if view.symmetry_factor == 2 else view.halves_spot
    is_half = (first == 0 and mirrors[0]) or (last == row.size - 1 and mirrors[1])
    return 2.0 * total if is_half else total


def pool_area(view: View, fraction: np.ndarray, least: float) -> float:
    """Area of the surface cells that are fluid [m^2], twice that of half a period.

    Args:
        view: the state in 3-D. fraction, least: as of `pool_depth`.
    """
    cells = view.surface[is_fluid(fraction[view.surface], least)]
    area = view.width[0, cells] * view.width[1, cells]
    return view.symmetry_factor * float(np.sum(area))


def cell_edges(view: View, row: np.ndarray) -> np.ndarray:
    """Where the cells of a row (m,) in order of x begin and end, (m + 1,) [m].

    Half a period begins at x = 0.
    """
    x, half = view.position[0, row], 0.5 * view.width[0, row]
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
    distance = abs(view.position[0, row[beyond]] - view.position[0, row[last]])
    return float(((inner - HALF) / (inner - outer) - 0.5) * distance)


def surface_row(view: View) -> np.ndarray:
    """Indices of the surface cells along x through the hottest one, in order of x."""
    cells = view.surface
    if view.dimension == 3:
        hottest = cells[hottest_surface_cell(view)]
        distance = np.abs(view.position[1, cells] - view.position[1, hottest])
        cells = cells[distance < 0.5 * view.width[1, hottest]]
    return cells[np.argsort(view.position[0, cells], kind="stable")]
