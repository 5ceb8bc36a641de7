"""A measured profile or height map that a calibration has to explain, and what is refused."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from pydantic import Field

from lasersph.case.contents import CaseContents
from lasersph.input import Fraction, Length, Model
from lasersph.lasers import InterferenceBeam
from lasersph.output.height_map import HeightMap
from lasersph.output.surface_files.read import read_surface
from lasersph.studies.texture.cells import PERIOD_FITS
from lasersph.studies.texture.compare import SCALE_ERROR
from lasersph.studies.texture.measurement import NoComparison, point_noise, refuse_odd


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
    """A measured profile or height map across lines that repeat.

    Attributes:
        file: its name. surface: its heights. period: of the lines [m].
        error: standard error of a point [m]. scale_error: of its lateral scale, 1 beforehand.
    """

    file: str
    surface: HeightMap
    period: float
    error: float
    scale_error: float


def read_target(entry: ProfileEntry, folder: Path, contents: CaseContents) -> ProfileTarget:
    """The measurement in a file, relative to a folder, beside the case of the runs.

    Raises:
        NoComparison: the case computes no such profile, or the measurement cannot be right.
        OutputError: the file cannot be read.
    """
    laser, width = contents.laser, contents.domain.width or 0.0
    beam = None if laser is None else laser.beam
    period = beam.lateral_period if isinstance(beam, InterferenceBeam) else None
    if laser is None or period is None or laser.spot is not None or contents.solver.dimensions != 2:
        raise NoComparison(
            "a profile is one across lines of the same fluence, which a case in 2-D of interfering "
            "beams without laser.spot computes; for that of a whole spot take lasersph texture "
            "and compare"
        )
    if not contents.surface_moves:
        raise NoComparison(
            'the surface of the case does not move; write "solver.flow.surface" = "moving" in [set]'
        )
    if abs(width - period) > PERIOD_FITS * period:
        raise NoComparison(
            f'the case is {1e6 * width:.6g} um wide; write "domain.width" = '
            f'"{1e6 * period:.6g} um", one period'
        )
    surface = read_surface(folder / entry.file)
    refuse_odd(surface, period)
    error = entry.error or point_noise(surface.z)
    return ProfileTarget(entry.file, surface, period, error, entry.scale_error)
