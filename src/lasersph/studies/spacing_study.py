"""Convergence of a case: run it at several spacings and assess every number of its summary.

For each number: observed order p, Richardson's value at vanishing spacing and the grid convergence
index of the finest run (see `analytic.convergence`; Roache). Three spacings are needed; of more,
the three finest count. What the case sets and what counts the computation's work is left out.

Sizes of a pool are counted in whole cells. Their uncertainty is at least one cell of the finest run
(two for a width of which half is computed), however well the runs agree.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from lasersph.analytic.convergence import Convergence, assess
from lasersph.input import format_quantity
from lasersph.studies.variation import Run, changed, simulate

NOT_ANSWERS = re.compile(
    r"(dimensions|particles|schema_version|spacing_m|spacing_requested_m|steps|threads|time_s"
    r"|wall_time_s|time_step\..*|iterations\..*|material\..*|dimensionless\..*|energy\.imbalance_relative"
    r"|surface\.(symmetry_factor|depth_of_particle_m)"
    r"|probes\..*\.(depth_m|x_m|y_m|depth_used_m))"
)
"""Numbers of the summary that the case sets or that belong to the computation."""
WHOLE_CELLS = re.compile(r"(melt|vaporization)\.(depth|width)(_any|_half)?_max_m")
INTERPOLATED = "melt.width_half_max_m"


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

    def table(self) -> list[list[str]]:
        """Header and rows as text: number, values, kind, order, extrapolated value, GCI."""
        header = ["number", *(format_quantity(d, "m") for d in self.spacings)]
        lines = [[*header, "behavior", "order", "at zero spacing", "GCI"]]
        for row in self.rows:
            c = row.convergence
            texts = [row.name, *(_shown(v) for v in row.values), c.kind, _shown(c.order, "{:.2f}")]
            lines.append([*texts, _shown(c.extrapolated), _shown(100.0 * c.gci, "{:.2g} %")])
        return lines

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
    spacings: Sequence[float],
    out: Path,
    *,
    run: Run = simulate,
    report: Callable[[str], None] | None = None,
) -> SpacingStudy:
    """Run a case at each spacing [m] and assess its summary.

    Args:
        case: the case; its particles.spacing is replaced.
        spacings: three or more, in any order. A run may round them: what counts is the spacing
            that its summary reports ("spacing_m"), else the one asked for.
        out: folder that receives one run folder for each spacing.
        run: how a case is run. report: called with one line before each run.

    Raises:
        ValueError: fewer than three different spacings, or two that a run rounds to the same.
    """
    wanted = sorted(set(spacings))
    if len(wanted) < 3:
        raise ValueError(
            f"an order needs three different spacings, got {len(wanted)}; give e.g. 32nm,16nm,8nm"
        )
    used, numbers, cells = [], [], 1
    for number, spacing in enumerate(reversed(wanted), start=1):
        if report:
            report(f"run {number} of {len(wanted)}: spacing {format_quantity(spacing, 'm')}")
        folder = out / f"spacing-{1e9 * spacing:.4g}nm"
        summary = run(changed(case, "particles.spacing", spacing), folder).summary
        used.insert(0, float(summary.get("spacing_m", spacing)))
        numbers.insert(0, dict(_numbers(summary)))
        cells = summary.get("surface", {}).get("symmetry_factor", 1)
    if len(set(used)) < len(used):
        raise ValueError(
            "two of the spacings were rounded to the same; choose spacings farther apart"
        )
    names = dict.fromkeys(name for each in numbers for name in each)
    rows = (
        _row(name, [each.get(name, math.nan) for each in numbers], used, cells) for name in names
    )
    return SpacingStudy(tuple(used), tuple(rows))


def _row(name: str, values: list[float], spacings: list[float], cells: int) -> StudyRow:
    """`cells`: how many cells a width grows by at once."""
    if any(math.isnan(value) for value in values[:3]):
        nothing = Convergence("incomplete", math.nan, math.nan, math.nan)
        return StudyRow(name, tuple(values), nothing)
    found = assess(values, spacings)
    if WHOLE_CELLS.fullmatch(name) and name != INTERPOLATED and values[0] > 0.0:
        step = spacings[0] * (cells if "width" in name else 1) / values[0]
        found = replace(found, gci=step if math.isnan(found.gci) else max(found.gci, step))
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


def _shown(value: float, form: str = "{:.6g}") -> str:
    return "-" if math.isnan(value) else form.format(value)
