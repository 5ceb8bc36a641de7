"""`texture`: the relief that a pulse leaves in its whole spot, from plan to figure."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lasersph.output import OutputError
from lasersph.output.image_file import read_maps
from lasersph.output.reader import read_json
from lasersph.plots import style
from lasersph.plots.texture import texture_figure
from lasersph.studies.calibration_run import make_or_stop
from lasersph.studies.texture.make import (
    ANSWER,
    CELLS,
    MAPS,
    USUAL,
    TexturePlan,
    assemble,
    link_runs,
    plan_texture,
)
from lasersph.sweeps import Engine, LocalEngine, Table
from lasersph.sweeps.points import Value

if TYPE_CHECKING:
    from lasersph.plots.notebook_figure import Figure

FIGURE = "texture.png"


def texture(
    case: str | PathLike[str],
    out: str | PathLike[str],
    *,
    set: Mapping[str, Value] | None = None,
    cells: int = USUAL,
    pixel: float | None = None,
    share: Sequence[str | PathLike[str]] = (),
    workers: int | None = None,
    threads: int | None = None,
    retries: int = 2,
    engine: Engine | None = None,
    report: Callable[[str], None] | None = None,
    should_stop: Callable[[], bool] | None = None,
) -> dict[str, Any]:
    """Compute the relief that a pulse leaves in its whole spot, from cells of the pattern.

        spot = {"laser.spot": {"diameter": "50 um", "definition": "1/e^2"}}
        found = lasersph.texture("texture-steel", "runs/spot", set=spot)
        found["depth_max_m"], found["areal_parameters"]["Sa"]

    The same call again goes on where it was stopped.

    Args:
        case: a case file with a spot, or the name of a shipped case. out: folder of the runs and
            of texture.json, height.x3p, maps.vtkhdf, profile.csv, texture.png.
        set: keys of the case, as `--set`. cells: fluences that are computed, 6 or more.
        pixel: of the maps [m]; a fortieth of the period if not given.
        share: folders of sweeps whose equal runs are taken.
        workers, threads, retries: of the engine of this machine; see `sweeps.LocalEngine`.
        engine: another one in its place. report: called with lines on how far it is.
        should_stop: asked several times a second; True ends all runs with their checkpoints.

    Returns:
        Content of texture.json, SI.

    Raises:
        CaseError: what is wrong with the case. NoTexture: what a texture needs and it lacks.
        FolderRefused: the folder holds something else. OutputError: a cell failed.
        Stopped: `should_stop` said so.
    """
    plan, folder = plan_texture(case, set, cells), Path(out)
    link_runs(plan.cells, folder / CELLS, [Path(one) for one in share])
    chosen = engine or LocalEngine(workers, threads, retries)
    study = plan.cells.study
    table = make_or_stop(plan.cells.points(), folder / CELLS, study, chosen, report, should_stop)
    return finish_texture(plan, folder, table, pixel)


def finish_texture(
    plan: TexturePlan, folder: Path, table: Table, pixel: float | None = None
) -> dict[str, Any]:
    """Make maps, numbers and figure from the table of the cells; content of texture.json.

    Raises:
        OutputError: not all cells are complete. NoTexture: see `assemble`.
    """
    missing = [f"{row.run} {row.status} {row.reason}".strip() for row in table.rows
               if row.status != "complete"]  # fmt: skip
    if missing:
        raise OutputError(f"not all cells are complete, so no texture: {'; '.join(missing)}")
    content = assemble(plan, folder, pixel)
    style.save(figure_of_texture(folder), folder / FIGURE)
    return content


def figure_of_texture(folder: str | PathLike[str]) -> Figure:
    """Maps of height and melt of a texture, and both along x through its center.

    Args:
        folder: of a texture that is complete.

    Raises:
        OutputError: there is none.
    """
    return texture_figure(read_maps(Path(folder) / MAPS), read_json(Path(folder) / ANSWER))
