"""The spots of a calibration: each is assembled from cells, which spots of other light share.

A setting of the keys is a whole spot. Light and size of the spot decide where in it which cell lies
and change no cell; so spots that differ in nothing else come from the same cells, whose fluences
reach the brightest center that the bounds allow. Another value of any other key asks for cells of
its own.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np

from lasersph.case import Case
from lasersph.studies.texture.cells import Cell
from lasersph.studies.texture.dots import AnyTable, table_of
from lasersph.studies.texture.fluence_table import FEWEST_CELLS, ROUNDING
from lasersph.studies.texture.make import KEY, LIGHT, cell_fluences, cell_settings, spot_of
from lasersph.studies.texture.relief import Relief
from lasersph.studies.texture.spot import half_sizes
from lasersph.sweeps import CaseTemplate, Point
from lasersph.sweeps.points import Value

Settings = Mapping[str, float]
Name = tuple[tuple[str, float], ...]
PIXELS_A_PERIOD = 40
"""Of the local fluence, which is linear between them: to 1e-5 in a spot of ten periods."""


@dataclass(frozen=True, eq=False)
class SpotCells:
    """Cells of the spots of a calibration.

    Attributes:
        template: the case with its spot. units: SI unit of each key that varies.
        low, high: bounds of the keys, by key, in SI. count: of cells for one spot.
        _points, _tables, _reliefs: what was made, by the settings that it depends on.
    """

    template: CaseTemplate
    units: Mapping[str, str]
    low: Settings
    high: Settings
    count: int
    _points: dict[Name, list[Point]] = field(default_factory=dict)
    _tables: dict[Name, AnyTable] = field(default_factory=dict)
    _reliefs: dict[Name, Relief] = field(default_factory=dict)

    @property
    def cell_template(self) -> CaseTemplate:
        """The case of a cell, without the spot."""
        return CaseTemplate(self.template.name, cell_settings(self.template.settings))

    @property
    def cell_units(self) -> dict[str, str]:
        """SI unit of each key that varies from cell to cell."""
        others = {key: unit for key, unit in self.units.items() if not key.startswith(LIGHT)}
        return {KEY: "J/m^2", **others}

    def points(self, settings: Settings) -> list[Point]:
        """Cells of a spot with these settings, from dark to bright.

        Raises:
            NoTexture: the brightest one melts nothing. CaseError: the case refuses it.
        """
        # spots that differ in their light alone share cells, made by the first of them
        others, name = self._others(settings)
        if name not in self._points:
            template, units = self.cell_template, self.cell_units
            fixed: dict[str, Value] = {}
            for key, value in others.items():
                unit = units[key] if key in units else template.unit(key)
                fixed[key] = f"{value!r} {unit}".strip()
            template.learn_kinds({**fixed, KEY: "1 J/cm^2"})
            # cells from what just melts up to the brightest center
            bright = CaseTemplate(template.name, {**template.settings, **fixed, KEY: "1 J/cm^2"})
            fluences = cell_fluences(bright, self._brightest(others), self.count)
            self._points[name] = [template.point({KEY: one, **others}) for one in fluences]
        return self._points[name]

    def relief(self, settings: Settings, cells: Sequence[Cell | None]) -> Relief | None:
        """The relief of a spot from its cells, None of those that failed; None where those that
        are complete do not reach its center. The same one for the same settings.

        Raises:
            NoTexture: nothing melts.
        """
        whole, name = tuple(sorted(settings.items())), self._others(settings)[1]
        if whole in self._reliefs:
            return self._reliefs[whole]
        # complete cells, which have to reach the center of the spot
        case = self._case(settings)
        spot, period = spot_of(case)
        done = [
            (float(point.settings[KEY]), cell)
            for point, cell in zip(self.points(settings), cells, strict=True)
            if cell is not None
        ]
        if len(done) < FEWEST_CELLS or done[-1][0] * (1.0 + ROUNDING) < spot.center:
            return None
        if name not in self._tables:
            self._tables[name] = table_of(done, period, case.initial_temperature)
        table = self._tables[name]
        # local fluence on a grid over all that the cells change
        x, y = (
            np.linspace(-size, size, 1 + 2 * int(np.ceil(PIXELS_A_PERIOD * size / period)))
            for size in half_sizes(spot, table)
        )
        found = Relief("spot", table, x, y, spot.at(*np.meshgrid(x, y)))
        return self._reliefs.setdefault(whole, found)

    @staticmethod
    def _others(settings: Settings) -> tuple[dict[str, float], Name]:
        """Settings that cells depend on, and their name."""
        others = {key: value for key, value in settings.items() if not key.startswith(LIGHT)}
        return others, tuple(sorted(others.items()))

    def _brightest(self, others: Settings) -> float:
        """Fluence of the brightest center within the bounds [J/m^2]."""
        light = [key for key in self.units if key.startswith(LIGHT)]
        # the fluence at the center is monotone in size and energy: it is largest at a corner
        ends = product(*((self.low[key], self.high[key]) for key in light))
        return max(
            spot_of(self._case({**others, **dict(zip(light, end, strict=True))}))[0].center
            for end in ends
        )

    def _case(self, settings: Settings) -> Case:
        """The case with its spot. Raises CaseError."""
        return self.template.file.case(self.template.overrides(settings))
