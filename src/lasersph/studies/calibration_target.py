"""A measured profile or height map that a calibration has to explain, and what is refused."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt
from pathlib import Path
from typing import Annotated

from pydantic import Field

from lasersph.case.contents import CaseContents
from lasersph.input import Fraction, Length, Model
from lasersph.output.height_map import HeightMap
from lasersph.output.surface_files.read import read_surface
from lasersph.studies.texture.compare import SCALE_ERROR
from lasersph.studies.texture.make import period_of_pattern, spot_of
from lasersph.studies.texture.measurement import (
    NoComparison,
    point_noise,
    refuse_coarse,
    refuse_odd,
)


class ProfileEntry(Model):
    """A file with a measured profile or height map across the lines.

    Attributes:
        error: standard error of a point; None for its noise from point to point.
        scale_error: standard error of the lateral scale.
    """

    file: str
    error: Annotated[Length, Field(gt=0)] | None = None
    scale_error: Annotated[Fraction, Field(gt=0)] = SCALE_ERROR


@dataclass(frozen=True, eq=False)
class ProfileTarget:
    """A measured profile or height map across lines that repeat, or of a spot.

    Attributes:
        file: its name. surface: its heights. period: of the lines, or diameter of the light of a
            round spot [m]. error: standard error of a point [m]. scale_error: of its lateral scale,
            1 beforehand. is_round: whether it is that of a section (r, z).
    """

    file: str
    surface: HeightMap
    period: float
    error: float
    scale_error: float
    is_round: bool = False


def read_target(entry: ProfileEntry, folder: Path, contents: CaseContents) -> ProfileTarget:
    """The measurement in a file, relative to a folder, beside the case of the runs.

    Raises:
        NoTexture: the case computes neither lines nor a spot of them.
        NoComparison: pulses that are moved, or the measurement cannot be right.
        OutputError: the file cannot be read.
    """
    laser = contents.laser
    if contents.geometry.is_axisymmetric:
        return _round_target(entry, folder, contents)
    is_spot = laser is not None and laser.spot is not None
    period = spot_of(contents)[1] if is_spot else period_of_pattern(contents)
    if is_spot and laser is not None and laser.displacement and laser.pulse.count > 1:
        raise NoComparison(
            "the spot of the case moves from pulse to pulse: what is measured is one spot; leave "
            "laser.spot.shift and scan_speed out"
        )
    # heights that cannot be those of the case are refused before any run
    surface = read_surface(folder / entry.file)
    refuse_odd(surface, period)
    error = entry.error or point_noise(surface.z)
    return ProfileTarget(entry.file, surface, period, error, entry.scale_error)


def _round_target(entry: ProfileEntry, folder: Path, contents: CaseContents) -> ProfileTarget:
    """The measurement of a round spot. Raises NoComparison, OutputError."""
    area = None if contents.laser is None else contents.laser.area
    if not contents.surface_moves or area is None:
        raise NoComparison(
            "the case leaves no relief of a spot: a profile needs light that ends, and "
            'solver.flow.surface = "moving"'
        )
    # a spot wider than what was measured is refused before any run
    surface, diameter = read_surface(folder / entry.file), 2.0 * sqrt(area / pi)
    refuse_coarse(surface, diameter, "the spot")
    error = entry.error or point_noise(surface.z)
    return ProfileTarget(entry.file, surface, diameter, error, entry.scale_error, is_round=True)
