"""`lasersph export`: the surface of a crater as a file for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from lasersph.cli.arguments import RunFolder, read_quantity
from lasersph.cli.failures import WrongCommand
from lasersph.cli.results import opened

Format = Annotated[
    Literal["csv", "stl", "ply"],
    typer.Option(help="csv: x, y, z in m; stl, ply: triangles in um, of 3-D runs."),
]
At = Annotated[
    str | None,
    typer.Option("--at", metavar="TIME", help="Take the closest snapshot; default: the last."),
]


def export(folder: RunFolder, format: Format = "csv", at: At = None) -> None:
    """Write the height map of a crater to DIR/crater.FORMAT."""
    from lasersph.output import OutputError
    from lasersph.output.height_map import height_map

    run = opened(folder)
    if not len(run.snapshots):
        raise WrongCommand(f"{folder} has no snapshots yet")
    time = None if at is None else read_quantity("--at", at, "time")
    step = run.snapshots[-1] if time is None else run.snapshots.nearest(time)
    try:
        surface = height_map(step)
    except OutputError as error:
        raise WrongCommand(f"{folder}: {error}") from None
    print(surface.write(Path(folder) / f"crater.{format}"))
