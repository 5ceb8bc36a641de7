"""The folder of many runs, of which everything else is made anew.

plan.toml        the plan as given
points.json      what is wanted: the runs with their settings, the units, the kind of study
runs/0001-<hash of the case>/    ordinary run folders
table.csv        one row a run, always made from the folders and points.json
sweep.jsonl      what happened, one JSON object a line
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Self

from lasersph.output.atomic import replace_json, replace_text
from lasersph.output.errors import FolderRefused, clear_errors, read_json
from lasersph.output.folder_lock import FolderLock, is_lock
from lasersph.sweeps.engine import Event
from lasersph.sweeps.points import CaseTemplate, Point

POINTS, PLAN, RUNS = "points.json", "plan.toml", "runs"
LOG, TABLE = "sweep.jsonl", "table.csv"
SCHEMA = 1


@dataclass(frozen=True)
class Study:
    """Whose folder it is, and what its table shows: only the same study goes on in it.

    Attributes:
        title: in words, "sweep of dlip-steel over laser.fluence". case_hash: of what all runs
            have in common. Both must be the same for a study to go on in a folder.
        units: SI unit of each key that varies, see `CaseTemplate.unit`.
        columns: numbers that table.csv shows; all where empty.
        plan: text of plan.toml, if there is one.
    """

    title: str
    case_hash: str
    units: Mapping[str, str] = field(default_factory=dict)
    columns: Sequence[str] = ()
    plan: str = ""

    @classmethod
    def of(
        cls,
        kind: str,
        template: CaseTemplate,
        units: Mapping[str, str],
        plan: str,
        columns: Sequence[str] = (),
    ) -> Self:
        """The study of a kind ("sweep") that varies keys of a case, which have these units."""
        name = Path(template.file.document.file).stem
        title = f"{kind} of {name} over {', '.join(units)}"
        return cls(title, template.hash_without(units), units, columns, plan)


class SweepFolder:
    """The open folder of many runs; one process at a time writes into it.

    Raises:
        FolderRefused: it holds something else, or another study; nothing was written.
        FolderLocked: another process makes its runs.
    """

    def __init__(self, path: Path, study: Study) -> None:
        self.path = path
        # nothing is written before it is known whose folder it is
        refuse_other_content(path, study)
        with clear_errors("write", path, FolderRefused):
            (path / RUNS).mkdir(parents=True, exist_ok=True)
        self.study, self._lock = study, FolderLock(path)
        with clear_errors("write", path / LOG):
            self._log = (path / LOG).open("a", encoding="utf-8")

    def __enter__(self) -> Self:
        """The folder itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Let other processes use the folder."""
        self._log.close()
        self._lock.release()

    def list_points(self, points: Sequence[Point]) -> list[str]:
        """Write down which runs are wanted; their names, by number and hash of the case.

        A case that has a folder keeps its name, whatever its number is now. A refused point has
        a number alone.
        """
        # names there are: hash to name, and the numbers that are taken
        there = {entry.name.partition("-")[2]: entry.name for entry in (self.path / RUNS).iterdir()}
        taken = {name.partition("-")[0] for name in there.values()}
        names: list[str] = []
        numbers = (f"{number:04d}" for number in range(1, len(points) + len(taken) + 1))
        free = (number for number in numbers if number not in taken)
        # a case with a folder keeps its name, others take the next free number
        for point in points:
            if not point.hash:
                names.append(next(free))
                continue
            if point.hash not in there:
                there[point.hash] = f"{next(free)}-{point.hash}"
            names.append(there[point.hash])
        rows = [
            {
                "run": name,
                "settings": dict(point.settings),
                "overrides": list(point.overrides),
                "refused": point.reason,
            }
            for name, point in zip(names, points, strict=True)
        ]
        content = {
            "schema_version": SCHEMA,
            "study": {"title": self.study.title, "case_hash": self.study.case_hash},
            "units": dict(self.study.units),
            "columns": list(self.study.columns),
            "points": rows,
        }
        # written whole: readers find the old or the new list
        replace_json(self.path / POINTS, content)
        if self.study.plan:
            replace_text(self.path / PLAN, self.study.plan)
        return names

    def log(self, event: Event) -> None:
        """Add an event to sweep.jsonl. Raises OutputError."""
        entry = {
            "clock": datetime.now(UTC).isoformat(timespec="milliseconds"),
            "run": event.run,
            "worker": event.worker,
            "event": event.kind,
            "exit_code": event.exit_code,
            "message": event.message,
        }
        with clear_errors("write", self.path / LOG):
            self._log.write(json.dumps(entry, ensure_ascii=False) + "\n")
            self._log.flush()


def read_points(folder: Path) -> dict[str, Any]:
    """Content of points.json. Raises FolderRefused without one, OutputError where it is damaged."""
    if not (folder / POINTS).exists():
        raise FolderRefused(f"{folder} holds no sweep: it has no {POINTS}")
    return read_json(folder / POINTS)


def refuse_other_content(path: Path, study: Study) -> None:
    """Raise FolderRefused where a folder holds something else than runs of a study."""
    with clear_errors("read", path, FolderRefused):
        if path.exists() and not path.is_dir():
            raise FolderRefused(f"{path} is a file, not a folder: choose another name")
        # points.json makes it ours; without it only what a killed sweep leaves may lie there
        is_ours = (path / POINTS).exists()
        foreign = set() if is_ours or not path.is_dir() else _foreign(path)
    if foreign:
        raise FolderRefused(f"{path} is not empty and holds no sweep: choose another folder")
    if is_ours:
        _refuse_other(path, read_points(path)["study"], study)


def complete_hashes(folder: Path, study: Study) -> set[str]:
    """Hashes of the cases whose runs are complete; none where there is no folder yet.

    Raises:
        FolderRefused: it holds something else.
    """
    refuse_other_content(folder, study)
    finished = (folder / RUNS).glob("*/summary.json")
    return {summary.parent.name.partition("-")[2] for summary in finished}


def last_events(folder: Path) -> dict[str, dict[str, Any]]:
    """The last event of each run in sweep.jsonl; a line cut by a kill is left out."""
    found: dict[str, dict[str, Any]] = {}
    if not (folder / LOG).exists():
        return found
    with clear_errors("read", folder / LOG):
        lines = (folder / LOG).read_text(encoding="utf-8", errors="replace").splitlines()
    for line in lines:
        try:
            entry = json.loads(line)
            found[entry["run"]] = entry
        except (ValueError, KeyError, TypeError):
            continue
    return found


def _foreign(path: Path) -> set[str]:
    """Entries of a folder but those of a sweep that was killed before it wrote its points."""
    runs = {entry.name for entry in (path / RUNS).iterdir()} if (path / RUNS).is_dir() else set()
    # lock, log and half-written points of a sweep that was killed
    left = {entry.name for entry in path.iterdir() if not is_lock(entry)}
    return runs | (left - {LOG, RUNS, POINTS + ".writing"})


def _refuse_other(path: Path, found: Mapping[str, str], study: Study) -> None:
    if found["title"] != study.title:
        raise FolderRefused(
            f"{path} holds another study ({found['title']}, not {study.title}): choose another "
            "folder"
        )
    if found["case_hash"] != study.case_hash:
        raise FolderRefused(
            f"{path} holds a {study.title} with other settings of the case: choose another folder"
        )
