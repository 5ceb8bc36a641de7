"""`compare`: a relief of ours beside a measured one, or a run beside another run."""

from __future__ import annotations

from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.input.text_table import text_table
from lasersph.output.atomic import replace_json, replace_text
from lasersph.output.errors import clear_errors
from lasersph.output.height_map import HeightMap
from lasersph.output.surface_files.read import read_surface
from lasersph.plots import style
from lasersph.plots.texture_comparison import comparison_figure, comparison_maps
from lasersph.report.comparison_page import difference_rows, unknown_rows, write_comparison
from lasersph.report.run_comparison import RunComparison, compare_runs
from lasersph.studies.texture import compare as alignment
from lasersph.studies.texture import relief as reliefs
from lasersph.studies.texture.measurement import NoComparison
from lasersph.studies.texture.round_relief import mean_over_angle

if TYPE_CHECKING:
    from lasersph.plots.notebook_figure import Figure

COLUMNS = "x_m,y_m,measured_m,computed_m,difference_m"
"""Head of aligned.csv."""


@dataclass(frozen=True, eq=False)
class MeasuredComparison:
    """A measured profile or height map beside a relief of ours; printed, its tables.

    Attributes:
        names: of the measurement and of our folder. surface: as measured.
        aligned: x, y (n,) in our coordinates, measured and our heights, their residual (n,) [m].
        content: of comparison.json, SI.
    """

    names: tuple[str, str]
    surface: HeightMap = field(repr=False)
    aligned: alignment.Comparison = field(repr=False)
    content: dict[str, Any] = field(repr=False)

    def __str__(self) -> str:
        """Alignment, differences of the heights, and what they mean."""
        content = self.content
        head = ("unknown", "value", "standard error", "95 %")
        aligned = text_table(unknown_rows(content), head)
        return f"{aligned}\n\n{text_table(difference_rows(content))}\n{content['sentence']}"

    def figures(self) -> dict[str, Figure]:
        """By name: "comparison", both profiles and their difference (of a map the line at y = 0, of
        a round spot means over the angle), and of a map "comparison-maps"."""
        found, (_, step) = self.aligned, self.surface.steps
        is_map = self.surface.y.size > 1
        width = 0.51 * step if is_map else np.inf
        near = np.abs(found.y - found.y[np.argmin(np.abs(found.y))]) < width
        x, measured, ours = found.x[near], found.measured[near], found.ours[near]
        across = "x"
        if rings := self.content.get("over_r"):
            x, measured, ours = (
                np.array(rings[f"{name}_m"]) for name in ("r", "measured", "computed")
            )
            across = "r"
        drawn = {"comparison": comparison_figure(x, measured, ours, self.content, across)}
        if is_map:
            maps = comparison_maps(found.x, found.y, found.measured, found.ours)
            drawn["comparison-maps"] = maps
        return drawn

    def write(self, folder: str | PathLike[str]) -> Path:
        """Write figures, comparison.json, aligned.csv and a page into a folder, give the page.

        Raises:
            OutputError: the folder cannot be written.
        """
        target, found = Path(folder), self.aligned
        with clear_errors("write", target):
            target.mkdir(parents=True, exist_ok=True)
        replace_json(target / "comparison.json", self.content)
        columns = np.stack([found.x, found.y, found.measured, found.ours, found.residual], axis=1)
        lines = [",".join(f"{one:.9g}" for one in row) for row in columns]
        replace_text(target / "aligned.csv", "\n".join([COLUMNS, *lines]) + "\n")
        files = {
            name: style.save(drawn, target / f"{name}.png")
            for name, drawn in self.figures().items()
        }
        title, maps = " beside ".join(self.names), files.get("comparison-maps")
        page = target / "comparison.html"
        return write_comparison(page, self.content, files["comparison"], title, maps)


def compare(
    folder: str | PathLike[str], profile: str | PathLike[str]
) -> MeasuredComparison | RunComparison:
    """How a run or a texture differs from a measured profile or height map, or from another run.

        found = lasersph.compare("runs/texture-steel", "measured.csv")
        print(found)                                  # as `lasersph compare`
        found.figures()["comparison"].savefig("beside.png")
        found.write("runs/beside")                    # all figures, numbers, a page

    Args:
        folder: of a texture, or of a run of one period or of a round spot, a section (r, z).
            profile: a measured profile or height map (csv, x3p, sdf), which is leveled and aligned;
            or the folder of another run, for which see `compare_runs`.

    Raises:
        OutputError: a folder or file cannot be read, or a run is not complete.
        NoComparison: the measurement cannot be aligned, and why.
    """
    ours, theirs = Path(folder), Path(profile)
    if theirs.is_dir():
        return compare_runs(ours, theirs)
    relief, surface = reliefs.read_relief(ours), read_surface(theirs)
    try:
        found = alignment.compare(relief, surface)
    except NoComparison as error:
        raise NoComparison(f"{theirs}: {error}") from None
    names = theirs.name, relief.name
    content = alignment.answer(found)
    if relief.is_round:
        content["over_r"] = rings_of(found, surface.steps[0])
    return MeasuredComparison(names, surface, found, content)


def rings_of(found: alignment.Comparison, step: float) -> dict[str, list[float]]:
    """Means over the angle of measured and computed heights [m], and by how much what they differ
    by scatters on each ring, which tells how round the spot is.

    Args:
        step: width of the rings [m].
    """
    heights = np.array([found.measured, found.ours, found.residual])
    r, measured, _, computed, _, _, spread = mean_over_angle(found.x, found.y, heights, step)
    named = {"r_m": r, "measured_m": measured, "computed_m": computed, "spread_m": spread}
    return {name: values.tolist() for name, values in named.items()}
