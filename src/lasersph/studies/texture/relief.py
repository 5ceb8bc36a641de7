"""Our relief beside which a measurement is put: that of a texture, or of a cell that repeats."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lasersph.lasers import InterferenceBeam
from lasersph.output import OutputError, open_run
from lasersph.output.height_map import HeightMap
from lasersph.output.image_file import read_maps
from lasersph.output.reader import read_json
from lasersph.output.symmetry import is_axisymmetric
from lasersph.studies.texture.cells import Cell
from lasersph.studies.texture.dot_cells import read_any_cell
from lasersph.studies.texture.dots import AnyTable, DotTable
from lasersph.studies.texture.measurement import refuse_odd
from lasersph.studies.texture.round_relief import RoundRelief, round_relief
from lasersph.studies.texture.table import CellTable

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Relief:
    """Our relief, of a texture or of a cell that repeats.

    Attributes:
        name: of the folder. table: cells. x, y: of the fluence of a texture (nx,), (ny,) [m].
        fluence: (ny, nx) [J/m^2]; of a cell that repeats one value.
        error: of the interpolation, rms [m]; 0 of a cell.
    """

    name: str
    table: AnyTable
    x: Array
    y: Array
    fluence: Array
    error: float = 0.0

    is_round = False

    @property
    def period(self) -> float:
        """Of the lines [m]."""
        return self.table.period

    @property
    def period_y(self) -> float | None:
        """Of dots along y [m]; None of lines."""
        return self.table.period_y if isinstance(self.table, DotTable) else None

    @property
    def tells_fluence(self) -> bool:
        """Whether its cells tell it at other fluences."""
        return self.is_spot

    @property
    def is_flat(self) -> bool:
        """Whether there is nothing to align to."""
        return float(np.ptp(self.table.values["height"])) == 0.0

    @property
    def family(self) -> int:
        """Number that reliefs which differ in their light alone have in common."""
        return id(self.table)

    def refuse(self, surface: HeightMap) -> None:
        """Refuse a measurement of other lines. Raises NoComparison."""
        refuse_odd(surface, self.period)

    @property
    def is_spot(self) -> bool:
        """Whether it is that of a spot, whose fluence changes."""
        return self.fluence.size > 1

    @property
    def largest_factor(self) -> float:
        """Largest factor on the fluence that the cells cover."""
        return float(self.table.fluence[-1] / self.fluence.max()) if self.is_spot else 1.0

    def at(self, x: Array, y: Array, factor: float) -> Array:
        """Heights at places [m], any shape, with a factor on the fluence."""
        if not self.is_spot:
            # a cell that repeats: any fluence has the same one
            return self.table.repeating("height", x, y)
        # a spot: the cell of the local fluence, of lines from edge to edge of their melt
        local = linear_map(self.x, self.y, factor * self.fluence)
        return self.table.in_spot("height", local, x, y)

    def sampled(self, factor: float, step: float) -> Callable[[Array, Array], Array]:
        """Heights that are linear between places about a step [m] apart, for many looks."""
        if not self.is_spot:
            return lambda x, y: self.at(x, y, factor)
        x, y = (
            np.linspace(side[0], side[-1], 1 + int(np.ceil(np.ptp(side) / step)))
            for side in (self.x, self.y)
        )
        return linear_map(x, y, self.at(x[None, :], y[:, None], factor))


def linear_map(x: Array, y: Array, values: Array) -> Callable[[Array, Array], Array]:
    """Values (ny, nx) at even places x (nx,) and y (ny,), linear between them and 0 outside."""
    from scipy.ndimage import map_coordinates

    steps = [(side[-1] - side[0]) / (side.size - 1) for side in (y, x)]

    def at(along: Array, across: Array) -> Array:
        places = [(across - y[0]) / steps[0], (along - x[0]) / steps[1]]
        return map_coordinates(values, places, order=1, mode="constant")

    return at


def read_relief(folder: Path) -> Relief | RoundRelief:
    """Our relief in the folder of a texture, or of a run of one period or of a section (r, z).

    Raises:
        OutputError: it holds neither.
    """
    if (folder / "texture.json").exists():
        # a texture keeps its cells and the map of its fluence
        content, maps = read_json(folder / "texture.json"), read_maps(folder / "maps.vtkhdf")
        if content["pulses"] > 1:
            raise OutputError(f"{folder} has pulses that are moved: compare one spot")
        cells = content["cells"]
        fluence, x = np.array(cells["fluence_J_m2"]), np.array(cells["x_m"])
        values, period = {"height": np.array(cells["height_m"])}, content["period_m"]
        table = (
            DotTable(fluence, x, period, values, 0.0, np.array(cells["y_m"]))
            if "y_m" in cells
            else CellTable(fluence, x, period, values, 0.0)
        )
        error = content["interpolation_error"]["height"]["rms"]
        return Relief(folder.name, table, maps.x, maps.y, maps.fields["fluence"], error)
    run = open_run(folder)
    if is_axisymmetric(run.case):
        return round_relief(run)
    if not run.is_complete:
        raise OutputError(f"{folder} is not complete")
    # a run of one period is a relief that repeats
    beam = (run.case.get("laser") or {}).get("beam", {})
    is_pattern = beam.get("kind") == "interference"
    period = InterferenceBeam.model_validate(beam).lateral_period if is_pattern else None
    if period is None:
        raise OutputError(f"{folder} has no pattern with a period, and is no texture")
    return repeating_relief(read_any_cell(run, period), period, folder.name)


@lru_cache(maxsize=256)
def repeating_relief(cell: Cell, period: float, name: str = "") -> Relief:
    """The relief of a cell that repeats, the same one for the same cell."""
    values = {"height": np.array(3 * [cell.values["height"]])}  # the same at any fluence
    fluence = np.array([0.5, 1.0, 2.0])
    table = (
        CellTable(fluence, cell.x, period, values, 0.0)
        if cell.y is None
        else DotTable(fluence, cell.x, period, values, 0.0, cell.y)
    )
    return Relief(name, table, np.zeros(1), np.zeros(1), np.ones((1, 1)))
