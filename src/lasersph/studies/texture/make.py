"""From a case with a spot to the maps of the whole spot, by the runs of some tens of cells.

Cells lie evenly in fluence, from just below what melts by the estimate of the case to the fluence
at the center of the spot. They are runs of the case without its spot, as a sweep over laser.fluence
makes them, and lie in a folder of that kind: `cells/runs`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.case import Case
from lasersph.case.contents import CaseContents
from lasersph.input import CaseError
from lasersph.lasers import SpotFluence
from lasersph.observers.areal_parameters import areal_parameters
from lasersph.output import OutputError, open_run
from lasersph.output.atomic import replace_json, replace_text
from lasersph.output.errors import clear_errors
from lasersph.output.height_map import HeightMap
from lasersph.output.image_file import Maps, write_maps
from lasersph.simulation.layers import expected_melt
from lasersph.studies.texture.cells import PERIOD_FITS, UNITS
from lasersph.studies.texture.dot_cells import read_any_cell
from lasersph.studies.texture.dots import AnyTable, DotTable, table_of
from lasersph.studies.texture.fluence_table import FEWEST_CELLS
from lasersph.studies.texture.spot import NoTexture, refuse_common_melt, texture_maps
from lasersph.sweeps import CaseTemplate, SweepPlan, Table, build_plan
from lasersph.sweeps.folder import RUNS, SweepFolder
from lasersph.sweeps.points import Value

ANSWER, MAPS, HEIGHTS, PROFILE, CELLS = (
    "texture.json",
    "maps.vtkhdf",
    "height.x3p",
    "profile.csv",
    "cells",
)
SCHEMA = 1
KEY = "laser.fluence"
LIGHT = (KEY, "laser.spot", "laser.pulse_energy", "laser.power", "laser.intensity")
"""First letters of keys that say how bright and how large a spot is, which no cell depends on."""
FEWEST, USUAL = 6, 24
"""Cells at least, which leaves four to be left out; and where nothing is said, a first guess: the
answer states the error of the interpolation, 20 % of the height with 8 cells of 50 nm."""
BELOW = 0.97
"""Fluence of the lowest cell over that at which the estimate melts, which is an upper bound of
heat: it melts earlier than the case by some percent."""
BISECTIONS = 8
PIXELS_A_PERIOD = 40
HEIGHT_DECIMALS = 15
"""Of heights in meters: a femtometer, so that maps of dots stay some megabytes."""
DIGITS = 6
"""Of the fluences, as a user may write them in a plan."""


@dataclass(frozen=True)
class TexturePlan:
    """Plan of a texture: its case, cells and spot.

    Attributes:
        case: with its spot. cells: the sweep of the case without it, over `KEY`.
        spot: local fluence. period: of the pattern along x [m].
        pulses, shift: pulses that are moved, and by how much along x [m]; one where they stay at
            one place.
    """

    case: Case
    cells: SweepPlan
    spot: SpotFluence
    period: float
    pulses: int
    shift: float


def plan_texture(
    name: str | PathLike[str], settings: Mapping[str, Value] | None = None, cells: int = USUAL
) -> TexturePlan:
    """The plan of a texture.

    Args:
        name: case file, or name of a shipped case. settings: keys of the case, as `--set`.
        cells: number of fluences.

    Raises:
        CaseError: what is wrong with the case. NoTexture: what a texture needs and it does not
            have.
    """
    given = dict(settings or {})
    template = CaseTemplate(name, given)
    # the spot, and the case of a cell without it
    case = template.file.case(template.overrides({}))
    spot, period = spot_of(case)
    laser, bare = case.laser, cell_settings(given)
    assert laser is not None
    moves = laser.displacement is not None and laser.pulse.count > 1
    pulses, shift = (laser.pulse.count, float(laser.displacement or 0.0)) if moves else (1, 0.0)
    if moves and case.pause != "remove":
        raise NoTexture(
            f'time.pause is "{case.pause}", and a pulse finds the heat of those before: cells of '
            "one pulse begin cold; leave it out, with a laser.pulse.period after which all is solid"
        )
    if moves and laser.beam.lateral_period_y is not None:
        raise NoTexture(
            "pulses that are moved make textures of lines; leave out laser.spot.shift, or write "
            "two beams"
        )
    if moves:  # a cell has one pulse, and the time after it that the last one has
        end = case.time.end - (pulses - 1) * float(laser.pulse.interval or 0.0)
        bare |= {"laser.pulse.count": 1, "time.end": f"{end:.9g} s"}
        bare |= dict.fromkeys(("laser.pulse.period", "laser.pulse.repetition_rate"), "")
        bare["time.pause"] = ""

    # fluences of the cells, and whether pulses meet the melt of others
    fluences = cell_fluences(CaseTemplate(name, {**bare, KEY: "1 J/cm^2"}), spot.center, cells)
    if moves:
        refuse_common_melt(spot, period, fluences[0] / BELOW, pulses, shift)
    vary = {KEY: [f"{one!r} J/m^2" for one in fluences]}
    plan = build_plan(str(name), vary, set=bare)
    return TexturePlan(case, plan, spot, period, pulses, shift)


def period_of_pattern(case: CaseContents) -> float:
    """Period along x [m] of the lines or dots that a case of one cell computes.

    Raises:
        NoTexture: what it lacks for that.
    """
    beam = None if case.laser is None else case.laser.beam
    # exactly one period along x, of dots along y as well, of a surface that moves
    period = None if beam is None else beam.lateral_period
    if beam is None or period is None:
        raise NoTexture("the case has no pattern of interfering beams to texture with")
    period_y = beam.lateral_period_y
    if case.solver.dimensions != (2 if period_y is None else 3):
        raise NoTexture(
            "a texture is of lines along y, of two beams along x in 2-D, or of dots, of three or "
            f"four beams in 3-D; write solver.dimensions = {2 if period_y is None else 3}"
        )
    if not case.surface_moves:
        raise NoTexture(
            'the surface of the case does not move; write solver.flow.surface = "moving"'
        )
    width = case.domain.width or 0.0
    sides = {"width": (width, period, "wide")}
    if period_y is not None:
        sides["breadth"] = (case.domain.breadth or width, period_y, "long along y")
    for key, (side, wanted, word) in sides.items():
        if abs(side - wanted) > PERIOD_FITS * wanted:
            raise NoTexture(
                f'a cell is one period {word}: write domain.{key} = "{1e6 * wanted:.6g} um", not '
                f"{1e6 * side:.6g} um"
            )
    return period


def spot_of(case: CaseContents) -> tuple[SpotFluence, float]:
    """Local fluence of a case with a spot, and the period of its lines [m].

    Raises:
        NoTexture: what a texture needs and the case does not have.
    """
    period, laser = period_of_pattern(case), case.laser
    if laser is None or laser.spot is None:
        raise NoTexture(
            'the case has no spot; write e.g. spot = { diameter = "50 um", definition = "1/e^2" } '
            "in [laser]"
        )
    if laser.spot.extent != "cell":
        raise NoTexture('laser.spot.extent is "whole"; write extent = "cell": cells make the spot')
    if laser.displacement is not None and laser.beam.pulse_shift:
        raise NoTexture(
            "laser.beam.shift moves the lines from pulse to pulse, and the spot moves as well: "
            "cells of one pulse know neither; leave one of the two out"
        )
    if laser.fluence_kind == "peak":
        raise NoTexture('laser.fluence_kind is "peak", cells count their mean; write "mean"')
    return laser.spot_fluence, period


def cell_settings(settings: Mapping[str, Value]) -> dict[str, Value]:
    """Settings of a case with a spot for its cells, whose light is set by `KEY` alone."""
    kept = {key: value for key, value in settings.items() if not key.startswith(LIGHT)}
    return {**kept, **dict.fromkeys(LIGHT[1:], ""), "laser.fluence_kind": "mean"}


def cell_fluences(template: CaseTemplate, highest: float, cells: int) -> tuple[float, ...]:
    """Fluences of the cells [J/m^2], rising from just below what melts to the highest.

    Raises:
        CaseError: the case refuses the highest fluence. NoTexture: that melts nothing, by the
            estimate.
    """

    def melts(fluence: float) -> bool:
        point = template.point({KEY: fluence})
        if point.case is None:
            raise CaseError(f"the case refuses a cell of {fluence:g} J/m^2: {point.reason}")
        found = expected_melt(point.case)
        return found is not None and found.depth > 0.0

    if not melts(highest):
        raise NoTexture(
            f"{1e-4 * highest:.4g} J/cm^2 at the center melt nothing, by the estimate of the case"
        )
    # bisection for the fluence that just melts, then even steps up to the center
    dark, bright = 0.0, highest
    for _ in range(BISECTIONS):
        middle = 0.5 * (dark + bright)
        dark, bright = (dark, middle) if melts(middle) else (middle, bright)
    *rising, _ = np.linspace(BELOW * bright, highest, cells)
    return (*(float(f"{one:.{DIGITS}g}") for one in rising), highest)


def assemble(plan: TexturePlan, folder: Path, pixel: float | None = None) -> dict[str, Any]:
    """Make the maps of the spot from complete cells in `folder`/cells.

    Args:
        folder: receives maps.vtkhdf, height.x3p, profile.csv and texture.json.
        pixel: side of a pixel [m]; a fortieth of the period where it is not given.

    Returns:
        Content of texture.json.

    Raises:
        NoTexture: see `texture_maps`. OutputError: a folder cannot be read or written.
    """
    # cells to maps, then all files
    table = read_table(folder / CELLS, plan.period)
    pixel = plan.period / PIXELS_A_PERIOD if pixel is None else pixel
    maps = texture_maps(plan.spot, table, pixel, pulses=plan.pulses, shift=plan.shift)
    content = answer(plan, table, maps, pixel)
    write_maps(folder / MAPS, maps)
    height = HeightMap(maps.x, maps.y, maps.fields["height"], time=plan.case.time.end)
    height.write(folder / HEIGHTS)
    replace_text(folder / PROFILE, profile_text(maps))
    replace_json(folder / ANSWER, content)
    return content


def link_runs(plan: SweepPlan, folder: Path, share: Sequence[Path]) -> int:
    """Link complete runs of other sweeps, whose cases are equal, into a folder of runs; how many.

    Raises:
        OutputError: one of the folders holds no runs, or ours cannot be written.
    """
    for other in share:
        if not (other / RUNS).is_dir():
            raise OutputError(f"{other} holds no runs to share: it has no folder {RUNS}")
    if not share:
        return 0
    points, count = plan.points(), 0
    with SweepFolder(folder, plan.study) as home, clear_errors("write", folder):
        # a run is ours where the hash of its case is, under the name that it has here
        names = dict(zip((point.hash for point in points), home.list_points(points), strict=True))
        for run in (run for other in share for run in sorted((other / RUNS).iterdir())):
            ours = folder / RUNS / names.get(run.name.partition("-")[2], run.name)
            is_wanted = ours.name in names.values() and not ours.exists()
            if is_wanted and open_run(run).is_complete:
                ours.symlink_to(run.absolute())
                count += 1
    return count


def read_table(folder: str | PathLike[str], period: float) -> AnyTable:
    """The table of the complete cells in a folder of runs over the fluence.

    Raises:
        OutputError: no runs, or runs that are no cells of this period [m].
    """
    rows = [row for row in Table.read(folder).rows if row.status == "complete"]
    if len(rows) < FEWEST_CELLS:
        raise OutputError(f"{folder} holds {len(rows)} complete cells, fewer than three")
    runs = [open_run(Path(folder) / RUNS / row.run) for row in rows]
    cells = [
        (float(row.settings[KEY]), read_any_cell(run, period))
        for row, run in zip(rows, runs, strict=True)
    ]
    return table_of(cells, period, float(runs[0].case["initial_temperature"]))


def answer(plan: TexturePlan, table: AnyTable, maps: Maps, pixel: float) -> dict[str, Any]:
    """Content of texture.json, SI."""
    # error by leaving out each cell but those at the ends
    height = maps.fields["height"]
    errors = {name: table.leave_one_out(name) for name in UNITS}
    interpolation = {
        name: {
            "unit": unit,
            "largest": float(errors[name].max()),
            "rms": float(np.sqrt(np.mean(errors[name] ** 2))),
            "largest_value": float(np.abs(table.values[name]).max()),
        }
        for name, unit in UNITS.items()
    }
    return {
        "schema_version": SCHEMA,
        "case": plan.case.name,
        "title": plan.case.title,
        "period_m": plan.period,
        "pixel_m": pixel,
        "pulses": plan.pulses,
        "shift_m": plan.shift,
        "spot": {
            "shape": plan.spot.shape,
            "diameter_m": plan.spot.diameter,
            "pulse_energy_J": plan.spot.energy,
            "fluence_at_center_J_m2": plan.spot.center,
            "fluence_over_spot_J_m2": plan.spot.mean,
        },
        "cells": {
            "key": KEY,
            "fluence_J_m2": table.fluence.tolist(),
            "x_m": table.x.tolist(),
            "height_m": np.round(table.values["height"], HEIGHT_DECIMALS).tolist(),
            **({"y_m": table.y.tolist()} if isinstance(table, DotTable) else {}),
        },
        "interpolation_error": interpolation,
        "areal_parameters": areal_parameters(height, pixel, pixel)._asdict(),
        "depth_max_m": float(max(-height.min(), 0.0)),
        "rim_height_max_m": float(max(height.max(), 0.0)),
        "melt_depth_max_m": float(maps.fields["melt_depth"].max()),
        "temperature_max_K": float(maps.fields["temperature"].max()),
        "speed_max_m_s": float(maps.fields["speed"].max()),
        "notes": notes_of(plan, table),
    }


def notes_of(plan: TexturePlan, table: AnyTable) -> list[str]:
    """Lines that a user should know of the texture."""
    found = []
    if np.any(table.values["melt_depth"][0] > 0.0):
        found.append(
            f"the lowest cell, of {1e-4 * table.fluence[0]:.4g} J/cm^2, melts: the edge of the "
            "texture is interpolated to no melt without light"
        )
    # steepest slope of a Gaussian, over the fluence at its center
    change = 2.4 * plan.period / plan.spot.diameter
    found.append(
        f"the fluence changes by up to {100.0 * change:.2g} % of that at the center over a period; "
        "cells know no slope of it"
    )
    return found


def profile_text(maps: Maps) -> str:
    """The line of the spot along x through its center as CSV, SI."""
    # the row of pixels next to the axis
    row = int(np.argmin(np.abs(maps.y)))
    names = [
        f"{name}_{maps.units[name].replace('/', '_').replace('^', '')}" for name in maps.fields
    ]
    lines = [",".join(["x_m", *names])]
    columns = [maps.x, *(field[row] for field in maps.fields.values())]
    lines += [",".join(f"{one:.9g}" for one in line) for line in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"
