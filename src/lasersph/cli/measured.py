"""`lasersph compare`: a measured profile or height map, or another run, beside ours."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from lasersph.cli.arguments import Out
from lasersph.cli.failures import WrongCommand
from lasersph.input.text_table import text_table

Ours = Annotated[
    Path, typer.Argument(metavar="DIR", help="The folder of a texture, or of a run of one period.")
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
    if profile.is_dir():
        return _compare_runs(folder, profile, out)
    from lasersph.output import OutputError
    from lasersph.output.atomic import replace_json, replace_text
    from lasersph.output.errors import clear_errors
    from lasersph.output.surface_files.read import read_surface
    from lasersph.plots import style
    from lasersph.plots.texture_comparison import comparison_figure, comparison_maps
    from lasersph.report.comparison_page import difference_rows, unknown_rows, write_comparison
    from lasersph.studies.texture import compare as comparing
    from lasersph.studies.texture import relief as ours
    from lasersph.studies.texture.measurement import NoComparison

    try:
        relief, surface = ours.read_relief(folder), read_surface(profile)
        found = comparing.compare(relief, surface)
    except (OutputError, NoComparison) as error:
        name = f"{profile}: " if isinstance(error, NoComparison) else ""
        raise WrongCommand(f"{name}{error}{_run_of(profile)}") from None
    content = comparing.answer(found)
    target = out or folder / f"compare-{profile.stem}"
    with clear_errors("write", target):
        target.mkdir(parents=True, exist_ok=True)
    replace_json(target / "comparison.json", content)
    columns = np.stack([found.x, found.y, found.measured, found.ours, found.residual], axis=1)
    lines = [",".join(f"{one:.9g}" for one in row) for row in columns]
    head = "x_m,y_m,measured_m,computed_m,difference_m"
    replace_text(target / "aligned.csv", "\n".join([head, *lines]) + "\n")
    width = 0.51 * surface.steps[1] if surface.y.size > 1 else np.inf
    near = np.abs(found.y - found.y[np.argmin(np.abs(found.y))]) < width
    picture = comparison_figure(found.x[near], found.measured[near], found.ours[near], content)
    file, maps = style.save(picture, target / "comparison.png"), None
    if surface.y.size > 1:
        picture = comparison_maps(found.x, found.y, found.measured, found.ours)
        maps = style.save(picture, target / "comparison-maps.png")
    print(
        text_table(unknown_rows(content), ("unknown", "value", "standard error", "95 %")),
        end="\n\n",
    )
    print(text_table(difference_rows(content)))
    print(content["sentence"])
    title = f"{profile.name} beside {relief.name}"
    print(write_comparison(target / "comparison.html", content, file, title, maps))


def _run_of(profile: Path) -> str:
    """A hint where a profile is that of a run, of which half a period may have been computed."""
    if not (profile.parent / "resolved.json").is_file():
        return ""
    return f"; to compare with the run that wrote it name its folder, {profile.parent}"


def _compare_runs(first: Path, second: Path, out: Path | None) -> None:
    """Print what two runs differ in, and write their figures and page."""
    from lasersph.output import OutputError
    from lasersph.report.run_comparison import compare_runs

    try:
        found = compare_runs(first, second)
    except OutputError as error:
        raise WrongCommand(str(error)) from None
    if found.settings:
        print(text_table([list(row) for row in found.settings], ("setting", *found.names)))
        print()
    print(text_table([list(row) for row in found.rows], ("", *found.names, "difference")))
    print(found.write(out or first / f"compare-{second.resolve().name}"))
