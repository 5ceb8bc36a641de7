"""Plan of a calibration: unknowns of a case, measured values, how many runs it may take.

An unknown is a key of the case, a factor that `scales` a key, or `complements` a key: 1 less the
key, such as the absorptivity of laser.reflectivity.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from lasersph.studies.calibration_spot import SpotCells
from lasersph.studies.calibration_target import ProfileTarget
from lasersph.studies.measured_value import Measured
from lasersph.studies.run_budget import RunBudget
from lasersph.studies.texture.make import FEWEST, USUAL
from lasersph.sweeps import CaseTemplate, Study

Array = NDArray[np.float64]
Relation = Literal["key", "scales", "complements"]


class NoCalibration(ValueError):
    """The runs allow no answer; the text says why."""


class CalibrationBudget(RunBudget):
    """How many runs a calibration may take: of the design, and whether the best point is run as
    well, also at half the spacing; of how many cells a spot is assembled."""

    check: bool = True
    cells: int = Field(default=USUAL, ge=FEWEST, strict=True)


@dataclass(frozen=True)
class Unknown:
    """Something that the data shall tell.

    Attributes:
        key: of the case. relation: whether the unknown is that key, scales it, or is 1 less it.
        low, high: between which it lies, evenly probable, in SI. unit: SI, "" for a number.
        known: what is known of it beside, a normal distribution.
    """

    name: str
    key: str
    relation: Relation
    low: float
    high: float
    unit: str
    known: Measured | None = None


@dataclass(frozen=True)
class Condition:
    """Settings (SI, by key) of one measurement, and what was measured, by number of summaries
    or as a profile."""

    settings: Mapping[str, float]
    values: Mapping[str, Measured]
    profile: ProfileTarget | None = None


@dataclass(frozen=True)
class CalibrationPlan:
    """A plan that the case takes.

    Attributes:
        text: the file as given. template: the case with what all runs have in common.
        units: SI unit of each key that varies from run to run.
        spot: cells of which the measured spots are assembled; None where none is measured.
    """

    text: str
    template: CaseTemplate
    unknowns: tuple[Unknown, ...]
    conditions: tuple[Condition, ...]
    units: Mapping[str, str]
    runs: CalibrationBudget
    spot: SpotCells | None = None

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys that vary from run to run."""
        return tuple(self.units)

    @property
    def study(self) -> Study:
        """Study that a folder must belong to for this plan to go on in it."""
        if self.spot is not None:
            cells = self.spot
            return Study.of("calibration", cells.cell_template, cells.cell_units, self.text)
        return Study.of("calibration", self.template, self.units, self.text)

    @property
    def first_runs(self) -> int:
        """Runs before the first look at the data."""
        return self.runs.first_runs(len(self.units))

    def inputs(self, unknowns: Array, condition: Condition) -> Array:
        """Keys of the runs (n, keys) in SI that a measurement is, were the unknowns (n, p) so."""
        columns = []
        for key in self.units:
            column = np.full(len(unknowns), condition.settings.get(key, np.nan))
            # a key of the case, changed by the unknown that belongs to it
            for unknown, values in zip(self.unknowns, unknowns.T, strict=True):
                if unknown.key == key:
                    column = related(unknown.relation, column, values)
            columns.append(column)
        return np.column_stack(columns)

    def box(self) -> tuple[Array, Array]:
        """Lowest and highest keys (keys,) that the bounds of the unknowns reach, in SI."""
        # relations are monotone in the unknowns, so that the corners reach farthest
        corners = np.array(list(product(*((one.low, one.high) for one in self.unknowns))))
        corner_keys = np.vstack([self.inputs(corners, one) for one in self.conditions])
        return corner_keys.min(axis=0), corner_keys.max(axis=0)


def related(relation: Relation, setting: Array, unknown: Array) -> Array:
    """Key of the case with some setting and unknown."""
    if relation == "scales":
        return setting * unknown
    return unknown if relation == "key" else 1.0 - unknown
