"""Convergence of a case: run it at several spacings and assess every number of its summary.

For each number: observed order p, Richardson's value at vanishing spacing and the grid convergence
index of the finest run (see `analytic.convergence`; Roache). Three spacings are needed; of more,
the three finest count. What the case sets and what counts the computation's work is left out.

Widths of a pool are counted in whole cells and times in steps. Their uncertainty is at least one
cell (two for a width of which half is computed) or step of the finest run, however well runs agree.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any

from lasersph.analytic.convergence import Convergence, assess
from lasersph.input import format_quantity
from lasersph.input.key_units import unit_of
from lasersph.observers.energy_budget import NUMERICAL
from lasersph.report.tables import in_words
from lasersph.studies.variation import Prepare, Run, changed, simulate

NOT_ANSWERS = re.compile(
    r"(dimensions|mirror_images|particles|schema_version|spacing_m|spacing_requested_m|steps|threads|time_s"
    r"|wall_time_s|numerical_sd\..*|time_step\..*|iterations\..*|material\..*|dimensionless\..*|energy\.imbalance_relative(_at_s)?"
    rf"|energy\.({'|'.join(NUMERICAL)})_(J|max_J|max_at_s)"
    r"|surface\.(symmetry_factor|depth_of_particle_m)"
    r"|probes\..*\.(depth_m|x_m|y_m|depth_used_m))"
)
"""Numbers of the summary that the case sets or that belong to the computation."""
WHOLE_CELLS = re.compile(r"(melt\.width|vaporization\.depth)(_any)?_max_m")
TIMES = re.compile(r".*(?<!_m)(?<!_m2)(?<!_K)_s")
"""Keys whose unit is s, not m/s, m^2/s or K/s."""


@dataclass(frozen=True)
class StudyRow:
    """One number: its key in the summary ("melt.depth_max_m"), its values finest first (nan where
    a run has none), and what they say."""

    name: str
    values: tuple[float, ...]
    convergence: Convergence


@dataclass(frozen=True)
class SpacingStudy:
    """Spacings used [m], finest first, and one row for each number."""

    spacings: tuple[float, ...]
    rows: tuple[StudyRow, ...]

    def __getitem__(self, name: str) -> StudyRow:
        """The row of one number; KeyError where there is none."""
        for row in self.rows:
            if row.name == name:
                return row
        raise KeyError(name)

    def table(self) -> tuple[list[list[str]], list[str]]:
        """Rows and head as text: number, values, kind, order, extrapolated value, GCI."""
        spacings = [format_quantity(d, "m") for d in self.spacings]
        head, lines = ["number", *spacings, "behavior", "order", "at zero spacing", "GCI"], []
        for row in self.rows:
            c = row.convergence
            # values at the spacings, then what they tend to
            shown = [_in_its_unit(row.name, value) for value in (*row.values, c.extrapolated)]
            texts = [row.name, *shown[:-1], c.kind, _shown(c.order, "{:.2f}"), shown[-1]]
            lines.append([*texts, _shown(100.0 * c.gci, "{:.2g} %")])
        return lines, head

    def as_dict(self) -> dict[str, Any]:
        """The study as plain data for JSON; nan becomes None."""
        return {
            "spacings_m": list(self.spacings),
            "numbers": {
                row.name: {
                    "values": [_plain(v) for v in row.values],
                    **{key: _plain(value) for key, value in asdict(row.convergence).items()},
                }
                for row in self.rows
            },
        }


def converge(
    case: Any,
    spacing: Sequence[float],
    out: str | PathLike[str],
    *,
    run: Run | None = None,
    prepare: Prepare | None = None,
    report: Callable[[str], None] | None = None,
) -> SpacingStudy:
    """Run a case at each spacing [m] and assess its summary.

        case = lasersph.load_case("dlip-steel")
        found = lasersph.converge(case, [32e-9, 16e-9, 8e-9], "runs/converge")
        found["melt.depth_max_m"].convergence.gci

    Args:
        case: the case; its particles.spacing is replaced.
        spacing: three or more [m], in any order. A run may round them: what counts is the spacing
            that its summary reports ("spacing_m"), else the one asked for.
        out: folder that receives one run folder for each spacing.
        run: how a case is run; None computes it. prepare: makes several runs at a time before
            their turn.
        report: called with one line before each run.

    Raises:
        ValueError: fewer than three different spacings, or two that a run rounds to the same.
    """
    wanted, home = sorted(set(spacing)), Path(out)
    if len(wanted) < 3:
        raise ValueError(
            f"an order needs three different spacings, got {len(wanted)}; give e.g. 32nm,16nm,8nm"
        )
    used, summaries = [], []
    # coarsest first: cheap runs show soonest what is wrong
    folders = {size: home / f"spacing-{1e9 * size:.4g}nm" for size in reversed(wanted)}
    cases = {size: changed(case, "particles.spacing", size) for size in folders}
    if prepare is not None:
        prepare({folders[size]: each for size, each in cases.items()})
    for number, (size, folder) in enumerate(folders.items(), start=1):
        if report:
            report(f"run {number} of {len(wanted)}: spacing {format_quantity(size, 'm')}")
        summary = (run or simulate)(cases[size], folder).summary
        used.insert(0, float(summary.get("spacing_m", size)))
        summaries.insert(0, summary)
    return assess_summaries(summaries, used)


def assess_summaries(summaries: Sequence[dict[str, Any]], spacings: list[float]) -> SpacingStudy:
    """Every number of runs of one case at several spacings [m], finest first.

    Raises:
        ValueError: two spacings are the same.
    """
    if len(set(spacings)) < len(spacings):
        raise ValueError(
            "two of the spacings were rounded to the same; choose spacings farther apart"
        )
    # every number that any run has
    numbers = [numbers_of(summary) for summary in summaries]
    names = dict.fromkeys(name for each in numbers for name in each)
    rows = []
    for name in names:
        values = [each.get(name, math.nan) for each in numbers]
        least = resolution(name, values[0], summaries[0], spacings[0])
        rows.append(_row(name, values, spacings, least))
    return SpacingStudy(tuple(spacings), tuple(rows))


def resolution(name: str, value: float, summary: dict[str, Any], spacing: float) -> float:
    """Least jump of a number of a run: a cell for sizes counted in whole cells (two for a
    width of which half is computed), the smallest step for a time, 0 for others and for nothing."""
    # a width of which half is computed jumps by two cells
    if WHOLE_CELLS.fullmatch(name) and value > 0.0:
        cells = summary.get("surface", {}).get("symmetry_factor", 1)
        return spacing * (cells if "width" in name else 1)
    if TIMES.fullmatch(name) and 0.0 < value < summary.get("time_s", math.inf):
        return summary.get("time_step", {}).get("min_s", 0.0)
    return 0.0


def numbers_of(summary: dict[str, Any]) -> dict[str, float]:
    """The numbers of a summary that answer something, by dotted key."""
    return dict(_numbers(summary))


def _row(name: str, values: list[float], spacings: list[float], least: float) -> StudyRow:
    """`least`: the uncertainty is never smaller."""
    if any(math.isnan(value) for value in values[:3]):
        return StudyRow(name, tuple(values), Convergence("incomplete", *[math.nan] * 4))
    # no surer than a cell or a step
    found = assess(values, spacings)
    if found.uncertainty < least:
        found = replace(found, uncertainty=least, gci=least / abs(values[0]))
    return StudyRow(name, tuple(values), found)


def _numbers(summary: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, float]]:
    """Every number of the summary with its dotted key."""
    for key, value in summary.items():
        name = prefix + key
        if isinstance(value, dict):
            yield from _numbers(value, f"{name}.")
        elif isinstance(value, bool) or not isinstance(value, int | float):
            continue
        elif not NOT_ANSWERS.fullmatch(name):
            yield name, float(value)


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and math.isnan(value) else value


def _in_its_unit(name: str, value: float) -> str:
    """A number of a summary by its key, with its unit."""
    return "-" if math.isnan(value) else in_words(value, unit_of(name), typographic=False)


def _shown(value: float, form: str) -> str:
    return "-" if math.isnan(value) else form.format(value)
