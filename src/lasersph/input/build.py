"""Building a model from a document, and everything that is wrong with it in one round.

A model is checked in stages: a value that cannot be read hides what does not fit together. So each
mistake is mended in a copy as its own hint says, and the copy is checked again, until nothing new
is found. What depends on a value that the reader did not write is left out.
"""

from __future__ import annotations

import copy
import re
import tomllib
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from lasersph.input.document import Document
from lasersph.input.errors import CaseError, Problem
from lasersph.input.findings import Finding, dotted, findings_of
from lasersph.input.key_lines import Path
from lasersph.input.schema import Schema

M = TypeVar("M", bound=BaseModel)
OtherWords = Callable[[], Mapping[str, str]]

MOST_ROUNDS = 12
"""Checks of one file; hand-written ones take two to five."""
_LINE = re.compile(
    r'write (?:e\.g\. )?([a-z_0-9.]+) = ("[^"]*"|\{[^}]*\}|[\w.+-]+)(?:[^\[;]*? in \[([\w.]+)\])?'
)
_LEAVE = re.compile(r"leave (?:it|\[\w+\]) out")
_VALUE = re.compile(r'write (?:e\.g\. )?("[^"]*")')
_CHOICE = re.compile(r'^do you mean ("[^"]*")\?')


def build(
    model: type[M],
    document: Document,
    context: dict[str, Any] | None = None,
    other_words: OtherWords | None = None,
) -> M:
    """Validate a document as a model, with units required on every quantity.

    Args:
        model: the class to build. document: from `read_toml` or `parse_toml`.
        context: pydantic's validation context, for validators that look beyond the data.
        other_words: returns what other programs call the keys, asked where something is wrong; see
            `findings.Misplaced`.

    Raises:
        CaseError: one problem per mistake, with file, line and key.
    """
    context = {"strict_units": True, **(context or {})}
    try:
        # A document that is right is validated once.
        if not document.problems:
            return model.model_validate(document.data, context=context)
    except ValidationError:
        pass
    except RecursionError:
        raise CaseError("brackets nested too deeply", file=document.file) from None
    raise CaseError(_all_problems(model, document, context, other_words() if other_words else {}))


def _all_problems(
    model: type[BaseModel],
    document: Document,
    context: dict[str, Any],
    other_words: Mapping[str, str],
) -> list[Problem]:
    """Every problem, in the order of the file."""
    # Check, note what concerns the reader, mend the copy, and check again.
    schema, trial = Schema(model), _Trial(document)
    problems = {str(problem): problem for problem in document.problems}
    for _ in range(MOST_ROUNDS):
        try:
            model.model_validate(trial.document.data, context=context)
            break
        except ValidationError as error:
            found = findings_of(error, trial.document, schema, other_words)
        for finding in found:
            if trial.concerns_reader(finding):
                problem = finding.located(trial.document)
                problems.setdefault(str(problem), problem)
        # Every finding is mended before the next check, also where an earlier one changed
        # something.
        if not any([trial.mend(finding, schema) for finding in found]):
            break
    return sorted(problems.values(), key=lambda problem: problem.line or 0)


class _Trial:
    """A copy of the document in which hints are followed."""

    def __init__(self, document: Document) -> None:
        self.document = replace(
            document,
            data=copy.deepcopy(document.data),
            lines=dict(document.lines),
            origins=dict(document.origins),
        )
        self._written: set[Path] = set()
        self._shortened: set[Path] = set()
        self._values: set[str] = set()
        self._attempts: Counter[Path] = Counter()

    def concerns_reader(self, finding: Finding) -> bool:
        """Whether a mistake is the reader's: neither at a key nor about a value written here."""
        # By place: at a key that was written here, or below it, or at an array that has lost a row
        # here. By text: about its value.
        if finding.path in self._shortened:
            return False
        if any(finding.path[: len(path)] == path for path in self._written):
            return False
        text = f"{finding.foreign or ''}; {finding.problem}; {finding.hint}"
        return not any(value in text for value in self._values)

    def mend(self, finding: Finding, schema: Schema) -> bool:
        """Follow the hint; where that did not help, leave the key out or write an example.

        Returns:
            Whether anything changed.
        """
        path, attempt = finding.path, self._attempts[finding.path]
        self._attempts[path] += 1
        # First as the hint says: move, write, leave out, or the line that it names.
        if attempt == 0:
            if finding.target is not None:
                return self._move(path, finding.target)
            if finding.value is not None:
                return self._write(path, finding.value)
            if finding.problem == "unknown key" or _LEAVE.search(finding.hint):
                return self._remove(path) and self._drop_emptied(finding)
            line = _line_of(finding, isinstance(self.document.at(path), dict))
            if line is not None and self._write(*line):
                return True
        # Then an example of the schema, where the key is needed; else without the key.
        if attempt > 1 or not path:
            return False
        data = self.document.data
        if schema.has_example(path, data) or schema.needs(path, data):
            return self._write(path, schema.example(path, data))
        self._written.add(path)
        return self._remove(path)

    def _write(self, path: Path, value: Any) -> bool:
        table = self._table(path[:-1])
        if table is None:
            return False
        try:
            table[path[-1]] = value
        except IndexError:  # a row that an earlier mending of the same round took out
            return False
        self._written.add(path)
        # Short texts such as "x" would be found in every message.
        if isinstance(value, str) and len(value) > 2:
            self._values.add(value)
        return True

    def _move(self, path: Path, target: Path) -> bool:
        value = self.document.at(path)
        table = self._table(target[:-1])
        if table is None or not self._remove(path):
            return False
        # A table of some keys, as overrides write it, joins the one that is there.
        there = self.document.at(target)
        if isinstance(there, dict) and isinstance(value, dict):
            value = {**there, **value}
        table[target[-1]] = value
        # A key that moved keeps its line, or the setting that it comes from.
        _move_keys(self.document.lines, path, target)
        _move_keys(self.document.origins, path, target)
        return True

    def _remove(self, path: Path) -> bool:
        around = self.document.at(path[:-1])
        try:
            del around[path[-1]]
        except (KeyError, IndexError, TypeError):
            return False
        if isinstance(around, list):
            self._shortened.add(path[:-1])
        return True

    def _drop_emptied(self, finding: Finding) -> bool:
        """Leave out a table whose only key belongs elsewhere; what it lacks now concerns nobody."""
        table = finding.path[:-1]
        if table and finding.hint.startswith("write") and self.document.at(table) == {}:
            self._written.add(table)
            self._remove(table)
        return True

    def _table(self, path: Path) -> Any:
        """The table at a path, made where it is missing; None where something else stands."""
        table: Any = self.document.data
        for step in path:
            # Missing tables are made; anything else in their place is the reader's.
            if isinstance(table, dict):
                table = table.setdefault(step, {})
            elif isinstance(table, list) and isinstance(step, int) and step < len(table):
                table = table[step]
            else:
                return None
        return table if isinstance(table, dict | list) else None


def _move_keys(places: dict[Path, Any], path: Path, target: Path) -> None:
    """Note the place of each key below a path below its target too."""
    for key, place in places.copy().items():
        if key[: len(path)] == path:
            places.setdefault((*target, *key[len(path) :]), place)


def _line_of(finding: Finding, is_table: bool) -> tuple[Path, Any] | None:
    """Path and value of the line that a hint tells to write."""
    path, text = finding.path, f"{finding.problem}; {finding.hint}"
    # A whole line: key, value, and the table that it belongs to.
    line = _LINE.search(text)
    if line is not None:
        key, value, table = line.groups()
        around = tuple(table.split(".")) if table else path if is_table else path[:-1]
        around = () if table is None and dotted(path) == key else around
        return (*around, *key.split(".")), _read(value)
    # Else a value alone, which stands at the key of the finding.
    value = _CHOICE.search(finding.hint) or _VALUE.search(text)
    return None if value is None else (path, _read(value.group(1)))


def _read(value: str) -> Any:
    try:
        return tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return value
