"""Parts of all readers of plans: mistakes with their lines, keys with their paths, the case."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from lasersph.case.conversion import present_place
from lasersph.input import CaseError, Document, Problem, dotted, read_toml
from lasersph.input.findings import Finding, steps_of
from lasersph.sweeps.points import CaseTemplate

KeyPath = tuple[str | int, ...]
Entry = tuple[str, KeyPath, Any]
"""Key of the case, its path in the plan, and its raw value."""
RANGE_KEYS = ("from", "to", "count", "scale")
"""A table of these is the range of a key, and not a table of keys."""


class Mistakes:
    """Mistakes of a plan, each once."""

    def __init__(self, document: Document) -> None:
        self.document, self.found = document, list[Problem]()

    def add(self, path: KeyPath, problem: str, hint: str = "", *, key: str = "") -> None:
        """Add a mistake at a path in the plan; its line names the key of the case if one is given,
        else the path."""
        file, line = self.document.place(path)
        self._keep(Problem(problem, hint, key or dotted(path), file, line))

    def add_foreign(self, path: KeyPath, error: CaseError) -> None:
        """Add what another file that the plan names says of itself, or that there is none."""
        for problem in error.problems:
            self._keep(Finding(path, "", foreign=problem).located(self.document))

    def raise_any(self) -> None:
        """Raises CaseError with all mistakes in the order of their lines, if there are any."""
        if self.found:
            raise CaseError(sorted(self.found, key=lambda one: one.line or 0))

    def _keep(self, problem: Problem) -> None:
        if problem not in self.found:
            self.found.append(problem)


def read_plan_file(file: str | PathLike[str], kind: str) -> Document:
    """Content of the file of a plan of a kind ("sweep", "calibrate", "find").

    Raises:
        CaseError: it cannot be read, or holds a case.
    """
    document = read_toml(Path(file), tolerant=True)
    if "particles" in document.data and "case" not in document.data:
        right = f"write one for it: lasersph new {file} plan.toml --plan {kind}"
        raise CaseError("is a case, not a plan", right, file=str(file))
    return document


def entries_of(table: Mapping[str, Any], path: KeyPath) -> list[Entry]:
    """The keys of the case in a table of a plan, written with quotes or without."""
    found: list[Entry] = []
    for name, raw in table.items():
        here = (*path, name)
        # a table that is no range holds keys further down
        if isinstance(raw, dict) and not set(raw) & set(RANGE_KEYS):
            found += [(f"{name}.{key}", below, one) for key, below, one in entries_of(raw, here)]
        else:
            found.append((name, here, raw))
    return found


def refuse_twice(mistakes: Mistakes, entries: Iterable[Entry]) -> None:
    """Add a mistake for each key that an earlier entry gives as well."""
    seen: dict[KeyPath, KeyPath] = {}
    for key, path, _ in entries:
        # an old and a present name of a key are the same key
        place = present_place(steps_of(key))
        if place in seen:
            _, line = mistakes.document.place(seen[place])
            problem = f"given twice, in line {line} as well"
            mistakes.add(path, problem, "remove one", key=key)
        seen[place] = path


def read_template(mistakes: Mistakes, case: str, settings: Mapping[str, Any]) -> CaseTemplate:
    """The case that a plan names, with its settings: a shipped one, or a file beside the plan.

    Raises:
        CaseError: there is no such case, or its file cannot be read.
    """
    # a path is relative to the plan; anything else is the name of a shipped case
    is_file = case.endswith(".toml") or "/" in case
    try:
        folder = Path(mistakes.document.file).parent
        return CaseTemplate(folder / case if is_file else case, settings)
    except CaseError as error:
        mistakes.add_foreign(("case",), error)
        raise CaseError(mistakes.found) from None
