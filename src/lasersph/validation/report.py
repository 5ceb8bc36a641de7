"""`Report`: the rows, figures and remarks of one validation, as a table or as plain data."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from math import isfinite
from pathlib import Path
from typing import Any

from lasersph.input.text_table import text_table
from lasersph.validation.comparison import Row

HEAD = ("quantity", "unit", "published", "reference", "computed", "tolerance", "verdict")


@dataclass(frozen=True)
class Report:
    """Result of one validation.

    Attributes:
        name: as in `lasersph validate NAME`. title: the question, in one line.
        rows: compared numbers. figures: files drawn. remarks: sentences on the numbers.
        quick: whether it ran shortened. seconds: that it took, with those of runs that were kept.
        cases, solvers: as of `Study`.
    """

    name: str
    title: str
    rows: tuple[Row, ...]
    figures: tuple[Path, ...] = ()
    remarks: tuple[str, ...] = ()
    quick: bool = False
    seconds: float = 0.0
    cases: tuple[str, ...] = ()
    solvers: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether there are judged numbers and all of them lie within their tolerance."""
        verdicts = [row.verdict for row in self.rows if row.verdict is not None]
        return bool(verdicts) and all(verdicts)

    @property
    def failures(self) -> tuple[Row, ...]:
        """Rows outside their tolerance."""
        return tuple(row for row in self.rows if row.verdict is False)

    def as_dict(self) -> dict[str, Any]:
        """Everything as plain data for JSON, SI or the unit of each row; NaN becomes None."""
        return {
            "name": self.name,
            "title": self.title,
            "passed": self.passed,
            "quick": self.quick,
            "rows": [
                {key: _finite(value) for key, value in asdict(row).items()} for row in self.rows
            ],
            "figures": [str(path) for path in self.figures],
            "remarks": list(self.remarks),
        }

    def table(self) -> str:
        """Plain text: title, one line per number, remarks, verdict."""
        # Title, numbers, remarks, changes, figures, verdict.
        lines = [f"{self.name}: {self.title}" + (" (quick)" if self.quick else ""), ""]
        lines += [text_table(map(_cells, self.rows), HEAD)]
        lines += ["", *(f"- {text}" for text in self.remarks)]
        lines += [f"- changed: {text}" for text in unique(row.changed for row in self.rows)]
        lines += [f"figure {path}" for path in self.figures]
        judged = sum(row.verdict is not None for row in self.rows)
        verdict = "passed" if self.passed else f"FAILED: {len(self.failures)}"
        lines.append(f"{self.name} {verdict} of {judged} judged, {len(self.rows)} numbers")
        return "\n".join(lines)


def unique(texts: Iterable[str]) -> list[str]:
    """Texts that are not empty, each once."""
    return [text for text in dict.fromkeys(texts) if text]


def _cells(row: Row) -> tuple[str, ...]:
    return (
        row.quantity,
        row.unit,
        _text(row.published),
        _text(row.reference),
        _text(row.computed),
        "" if row.tolerance is None else f"{row.tolerance:.3g}",
        row.judgement,
    )


def _text(value: float | str | None) -> str:
    if value is None:
        return ""
    return value if isinstance(value, str) else f"{value:.7g}"


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not isfinite(value) else value
