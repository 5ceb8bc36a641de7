"""Convergence of a case: run it at several spacings and assess every number of its summary.

For each number: observed order p, Richardson's value at vanishing spacing and the grid convergence
index of the finest run (see `analytic.convergence`; Roache). Three spacings are needed; of more,
the three finest count.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from lasersph.analytic.convergence import Convergence, assess
from lasersph.studies.variation import Run, changed, simulate

NOT_PHYSICS = (
    "dimensions", "particles", "schema_version", "spacing_m", "spacing_requested_m", "steps",
    "threads", "time_step", "wall_time_s",
)  # fmt: skip
"""Numbers of the summary that belong to the computation, not to the answer."""


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
        header = ["number", *(f"{1e9 * d:.4g} nm" for d in self.spacings)]
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
    used, numbers = [], []
    for number, spacing in enumerate(reversed(wanted), start=1):
        if report:
            report(f"run {number} of {len(wanted)}: spacing {1e9 * spacing:.4g} nm")
        folder = out / f"spacing-{1e9 * spacing:.4g}nm"
        summary = run(changed(case, "particles.spacing", spacing), folder).summary
        used.insert(0, float(summary.get("spacing_m", spacing)))
        numbers.insert(0, dict(_numbers(summary)))
    if len(set(used)) < len(used):
        raise ValueError(
            "two of the spacings were rounded to the same; choose spacings farther apart"
        )
    names = dict.fromkeys(name for each in numbers for name in each)
    rows = (_row(name, [each.get(name, math.nan) for each in numbers], used) for name in names)
    return SpacingStudy(tuple(used), tuple(rows))


def _row(name: str, values: list[float], spacings: list[float]) -> StudyRow:
    if any(math.isnan(value) for value in values[:3]):
        nothing = Convergence("incomplete", math.nan, math.nan, math.nan)
        return StudyRow(name, tuple(values), nothing)
    return StudyRow(name, tuple(values), assess(values, spacings))


def _numbers(summary: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, float]]:
    """Every number of the summary with its dotted key."""
    for key, value in summary.items():
        if not prefix and key in NOT_PHYSICS:
            continue
        if isinstance(value, dict):
            yield from _numbers(value, f"{prefix}{key}.")
        elif isinstance(value, bool) or not isinstance(value, int | float):
            continue
        else:
            yield prefix + key, float(value)


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and math.isnan(value) else value


def _shown(value: float, form: str = "{:.6g}") -> str:
    return "-" if math.isnan(value) else form.format(value)
