"""The runs and sweeps below one folder, found by looking, never by joining a path to an address.

An address is a hash of the path below the folder, so that it is the same after a restart and holds
nothing that leads elsewhere. Links are not followed, neither to folders nor inside of them.
"""

from __future__ import annotations

import hashlib
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from lasersph.output import OutputError
from lasersph.sweeps.folder import POINTS, RUNS
from lasersph.web.study_folder import kind_of_study

RESOLVED = "resolved.json"
DEEPEST = 3
"""Levels of folders that are looked through: DIR/series/sweep/runs."""


@dataclass(frozen=True)
class Entry:
    """A run or a sweep.

    Attributes:
        id: in addresses. path: its folder. name: path below the folder that is shown.
        kind: "run" or "sweep". sweep: id of the sweep or study that a run belongs to, else empty.
        study: kind of the study whose runs lie there; a sweep has none.
    """

    id: str
    path: Path
    name: str
    kind: Literal["run", "sweep"]
    sweep: str = ""
    study: str = ""

    def runs(self) -> Path:
        """The folder in which the runs of a sweep or of a study lie."""
        return self.path if self.study else self.path / RUNS


def id_of(name: str) -> str:
    """The address of a path below the folder."""
    return hashlib.sha256(name.encode("utf-8", "surrogateescape")).hexdigest()[:12]


class FolderList:
    """List of the runs, sweeps and studies that lie below a folder now.

    Attributes:
        root: the folder.
    """

    def __init__(self, root: Path) -> None:
        self.root = root.resolve()
        self._known: dict[str, Entry] = {}

    def entries(self) -> list[Entry]:
        """All runs and sweeps, sweeps before their runs."""
        found: list[Entry] = []
        self._scan(self.root, "", 0, found)
        self._known = {entry.id: entry for entry in found}
        return found

    def find(self, id: str, kind: Literal["run", "sweep"]) -> Entry:
        """The entry with an address.

        Raises:
            KeyError: there is none. OutputError: its folder has become a link.
        """
        # A folder that appeared since the last look.
        if id not in self._known:
            self.entries()
        entry = self._known[id]
        if entry.kind != kind:
            raise KeyError(id)
        # The folder may have become a link since then.
        if entry.path.resolve() != entry.path:
            raise OutputError(f"{entry.name} is reached through a link, which is not followed")
        return entry

    def run_of(self, path: Path) -> str:
        """Address of a folder below the root."""
        return id_of(path.relative_to(self.root).as_posix())

    def _scan(self, folder: Path, sweep: str, depth: int, found: list[Entry]) -> None:
        # Names of what lies in the folder; a run has no runs below it.
        try:
            with os.scandir(folder) as scan:
                inside = sorted(scan, key=lambda one: one.name)
        except OSError:
            return  # one that cannot be read spoils nothing else
        names = {one.name for one in inside}
        name = folder.relative_to(self.root).as_posix()
        shown = self.root.name if name == "." else name
        if RESOLVED in names:
            found.append(Entry(id_of(name), folder, shown, "run", sweep))
            return

        # A sweep has its points, a study runs of its names; their runs belong to them.
        is_sweep = POINTS in names
        inside = [
            one
            for one in inside
            if one.is_dir(follow_symlinks=False) and not one.name.startswith(".")
        ]
        study = "" if is_sweep or not depth else _study(folder, [one.name for one in inside])
        if is_sweep or (study and any((folder / one.name / RESOLVED).exists() for one in inside)):
            sweep = id_of(name)
            found.append(Entry(sweep, folder, shown, "sweep", study=study))
            inside = [one for one in inside if study or one.name == RUNS]

        # Deeper folders; the folder `runs` of a sweep counts as no level.
        if depth == DEEPEST:
            return
        for one in inside:
            is_part = sweep and one.name == RUNS
            self._scan(folder / one.name, sweep, depth + (not is_part), found)


def _study(folder: Path, inside: list[str]) -> str:
    """The kind of study whose runs lie in a folder; empty where none, or its mark is damaged."""
    try:
        return kind_of_study(folder, inside)
    except OutputError:
        return ""


def refuse_links(folder: Path) -> None:
    """Refuse a run folder that holds a link, which could lead anywhere. Raises OutputError."""
    # Figures are served from their own folder.
    for place in (folder, folder / "figures"):
        try:
            with os.scandir(place) as scan:
                links = sorted(one.name for one in scan if one.is_symlink())
        except FileNotFoundError:
            continue
        except OSError as error:
            raise OutputError(f"{place.name} cannot be read: {error.strerror}") from error
        if links:
            raise OutputError(f"the folder holds a link, {links[0]}, which is not followed")
