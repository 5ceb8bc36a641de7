"""Engines, which make run folders exist: the tasks that they take and the events they report.

The folders on disk are the truth. An engine may lose anything else: a task of a run that is
complete costs nothing, one of a run that was killed goes on from its checkpoint.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal, Protocol

from lasersph.case import Case

EventKind = Literal[
    "started", "progress", "waiting", "retry", "complete", "failed", "wrong", "stopped"
]
DONE, FAILED, WRONG, STOPPED = 0, 1, 2, 143
"""Exit codes of a run, as those of `lasersph run`."""


@dataclass(frozen=True)
class Task:
    """A run folder that has to exist: name of the run, its case, its folder."""

    run: str
    case: Case
    folder: Path

    def as_dict(self) -> dict[str, Any]:
        """Plain data for another process."""
        return {
            "run": self.run,
            "folder": str(self.folder.absolute()),
            "name": self.case.name,
            "text": self.case.text,
            "case": self.case.resolved(),
        }

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Task:
        """The same task again; its case has the same hash and gives the same bits."""
        case = Case.model_validate(data["case"]).named(data["name"], data["text"])
        return cls(data["run"], case, Path(data["folder"]))


@dataclass(frozen=True)
class Event:
    """Something that happened to a run.

    Attributes:
        kind: "started"; "progress"; "waiting" for another process that still writes the folder;
            "retry": it failed or its worker ended, as `message` says, and it is tried again;
            "complete"; "failed"; "wrong": the case is refused; "stopped", with a checkpoint.
        worker: name of the process that computes. exit_code: as of `lasersph run`.
        work_done: part of the run, 0 to 1. remaining_s: expected wall time to its end.
        is_final: whether trying again would give the same.
    """

    run: str
    kind: EventKind
    worker: str = ""
    message: str = ""
    exit_code: int | None = None
    work_done: float = 0.0
    remaining_s: float | None = None
    is_final: bool = False

    def as_dict(self) -> dict[str, Any]:
        """Plain data for another process."""
        return asdict(self)


Report = Callable[[Event], None]


class Engine(Protocol):
    """Computes many runs."""

    def make(self, tasks: Sequence[Task], report: Report, should_stop: Callable[[], bool]) -> None:
        """Make the folders of all tasks exist.

        It returns when every task has been reported complete, failed, wrong or stopped. A run that
        fails stops no other.

        Args:
            report: called with each event, from the thread that called `make`.
            should_stop: asked several times a second; True ends all runs with their checkpoints.
        """
        ...
