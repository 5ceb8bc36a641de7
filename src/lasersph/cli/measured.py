"""`lasersph compare`: a measured profile or height map, or another run, beside ours."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lasersph.cli.arguments import Out
from lasersph.cli.failures import WrongCommand

Ours = Annotated[
    Path,
    typer.Argument(
        metavar="DIR", help="The folder of a texture, or of a run of one period or a round spot."
    ),
]
Profile = Annotated[
    Path,
    typer.Argument(
        metavar="PROFILE|RUN",
        help="A measured profile or height map: csv, x3p, sdf; or the folder of another run.",
    ),
]


def compare(folder: Ours, profile: Profile, out: Out = None) -> None:
    """Say how a run or texture differs from a measured profile or height map, or a run."""
    from lasersph.output import OutputError
    from lasersph.studies.comparison import compare
    from lasersph.studies.texture.measurement import NoComparison

    try:
        found = compare(folder, profile)
    except (OutputError, NoComparison) as error:
        raise WrongCommand(f"{error}{_run_of(profile)}") from None
    # The folder of the answer has the name of the other side.
    other = profile.resolve().name if profile.is_dir() else profile.stem
    print(found)
    print(found.write(out or folder / f"compare-{other}"))


def _run_of(profile: Path) -> str:
    """A hint where a profile is that of a run, of which half a period may have been computed."""
    # The file of a run is known by its neighbor.
    if not (profile.parent / "resolved.json").is_file():
        return ""
    return f"; to compare with the run that wrote it name its folder, {profile.parent}"
