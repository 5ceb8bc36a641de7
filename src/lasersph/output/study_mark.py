"""The mark of a folder whose runs belong to one study: study.json.

A sweep has its points.json; the runs of `threshold`, `converge` and `spot`, which follow from each
other or lie side by side without a table, are told to belong together by this file.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from lasersph.input import in_field_units
from lasersph.output.atomic import replace_json
from lasersph.output.errors import OutputError, clear_errors, read_json

STUDY = "study.json"


@dataclass(frozen=True)
class StudyMark:
    """A study of several runs.

    Attributes:
        kind: "threshold", "converge", "spot". title: in words, "threshold of dlip-steel to melt".
        key: of the case, which changes from run to run. unit: SI unit of its values.
    """

    kind: str
    title: str
    key: str
    unit: str

    def write(self, folder: Path) -> None:
        """Mark a folder, which is made if need be. Raises OutputError."""
        with clear_errors("write", folder):
            folder.mkdir(parents=True, exist_ok=True)
        replace_json(folder / STUDY, {"schema_version": 1, **asdict(self)})

    def changed(self, run: Path) -> str:
        """The key of a run of the study with its value, "fluence 0.44 J/cm²"; empty where its case
        has none. Raises OutputError where its resolved.json cannot be read."""
        # Value at the dotted key.
        value: Any = read_json(run / "resolved.json").get("case", {})
        for name in self.key.split("."):
            value = value.get(name) if isinstance(value, dict) else None
        if not isinstance(value, int | float):
            return ""
        return f"{self.key.rpartition('.')[2].replace('_', ' ')} {in_field_units(value, self.unit)}"


def read_mark(folder: Path) -> StudyMark | None:
    """The mark of a folder; None where it has none. Raises OutputError where it is damaged."""
    if not (folder / STUDY).exists():
        return None
    content = read_json(folder / STUDY)
    try:
        return StudyMark(*(str(content[name]) for name in ("kind", "title", "key", "unit")))
    except (KeyError, TypeError) as error:
        raise OutputError(f"cannot read {folder / STUDY}: it misses {error}") from None
