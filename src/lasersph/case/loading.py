"""Finding and reading cases: files, shipped cases by name, overrides, new case files."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from lasersph.case.case import Case
from lasersph.case.contents import SCHEMA_VERSION, CaseContents
from lasersph.case.conversion import convert
from lasersph.case.overrides import moved_settings, named_files, override
from lasersph.input import CaseError, Document, Problem, build, nearest, read_toml
from lasersph.input.document import split_settings, with_settings
from lasersph.input.findings import dotted, steps_of

M = TypeVar("M", bound=CaseContents)
LIBRARY = Path(__file__).parent / "cases"
CASE_FILE = "case.toml"
"""File of a run folder with the case and, in its first lines, the settings of the run."""
MOST_SETTINGS = 3
"""Settings that are named before a problem. Format: four fill a line."""


def available_cases() -> dict[str, Path]:
    """Files of the shipped cases, by name.

        list(lasersph.available_cases())  # as `lasersph cases`

    Each begins with a comment that says what it shows; `load_case` reads one.
    """
    return {path.stem: path for path in sorted(LIBRARY.glob("*.toml"))}


def case_file(name_or_path: str | os.PathLike[str]) -> Path:
    """File of a case given by its shipped name, by a path, or by the folder of its run.

    A shipped name is recognized first, unless it ends in ".toml" or holds a path separator.

    Raises:
        CaseError: neither a shipped case nor a file; says the nearest name.
    """
    text = os.fspath(name_or_path)
    # A shipped name first, then a path.
    if not isinstance(name_or_path, Path) and text in available_cases():
        return available_cases()[text]
    path = Path(text).expanduser()
    # A name can be no path at all, of a null character or too long.
    try:
        exists = path.exists()
    except (OSError, ValueError):
        exists = False
    if exists and (path / CASE_FILE).is_file():
        return path / CASE_FILE
    if exists or text.endswith(".toml") or os.sep in text:
        return path
    # Neither: the nearest shipped name, or all of them.
    near = nearest(text, available_cases())
    hint = f'do you mean "{near}"?' if near else "shipped: " + ", ".join(available_cases())
    raise CaseError(f'no case "{text}"', hint)


class CaseFile:
    """A case file, a shipped case or that of a run folder, read once: cases of it differ by their
    overrides.

    Attributes:
        document: its data, not yet validated, keys at their present places. name: of the case.
    """

    def __init__(self, name_or_path: str | os.PathLike[str]) -> None:
        file = case_file(name_or_path)
        document, self._moved = convert(read_toml(file, tolerant=True))
        self.name, self._settings = file.stem, list[str]()
        # A run folder stands for its case with the settings of the run.
        if file != Path(name_or_path).expanduser() and file.name == CASE_FILE:
            self.name = file.absolute().parent.name
            self._settings, text = split_settings(document.text)
            document = override(replace(document, text=text), self._settings)
        self.document = document
        # A plan names a case; the verbs for many runs read it.
        if "case" in self.document.data and "particles" not in self.document.data:
            right = f"lasersph sweep, calibrate or find {document.file} computes it"
            raise CaseError("is a plan for many runs, not a case", right, file=document.file)

    def contents(self, overrides: Sequence[str] = ()) -> CaseContents:
        """The keys of a case, each right by itself, not checked together. Raises CaseError."""
        return self._built(CaseContents, overrides)

    def case(self, overrides: Sequence[str] = ()) -> Case:
        """The case with overrides like "laser.fluence=0.8 J/cm^2"; later ones win.

        Raises:
            CaseError: every problem of the case in one line: file, line, key, what is wrong.
        """
        case = self._built(Case, overrides)
        moved = [*self._moved, *moved_settings(overrides)]
        note = f"read as schema version {SCHEMA_VERSION}: {', '.join(moved)}" if moved else ""
        settings = [*self._settings, *overrides, *self._files(override(self.document, overrides))]
        return case.named(self.name, with_settings(self.document.text, settings), note)

    def _files(self, document: Document) -> Iterator[str]:
        """Settings that name files beside the case, or given by settings, by their whole paths:
        what is kept of the case is read elsewhere."""
        folder = Path(document.file).absolute().parent
        for path, name in named_files((), document.data):
            is_beside = not name.startswith(("/", "~")) and (folder / name).is_file()
            if is_beside or name != self.document.at(path):
                yield f"{dotted(path)}={folder / name}"

    def _built(self, model: type[M], overrides: Sequence[str]) -> M:
        document = override(self.document, overrides)
        context = {"folder": Path(document.file).parent}
        try:
            return build(model, document, context, _other_words)
        except CaseError as error:
            # A file that is right without its settings is not what is wrong.
            if not overrides or not self._is_right(model):
                raise
            raise CaseError([_blamed(one, document) for one in error.problems]) from None

    def _is_right(self, model: type[M]) -> bool:
        """Whether the file alone, without any settings, can be read."""
        try:
            build(model, self.document, {"folder": Path(self.document.file).parent})
        except CaseError:
            return False
        return True


def _blamed(problem: Problem, document: Document) -> Problem:
    """A problem at a line of a file that is right by itself, with the settings that make it wrong:
    those within the table of the problem, or all; their number where they are many."""
    if problem.file != document.file:
        return problem
    table = steps_of(problem.key)
    within = [where for path, where in document.origins.items() if path[: len(table)] == table]
    settings = list(dict.fromkeys(within or document.origins.values()))
    shown = ", ".join(settings) if len(settings) <= MOST_SETTINGS else f"{len(settings)} settings"
    return replace(problem, file=f"{shown} on {problem.file}")


def _other_words() -> Mapping[str, str]:
    """Words of other programs for the keys of a case; loaded where a message needs it."""
    from lasersph.case.other_words import OTHER_WORDS

    return OTHER_WORDS


def load_case(
    name_or_path: str | os.PathLike[str], overrides: Sequence[str] = (), *, quick: bool = False
) -> Case:
    """Read a case file or a shipped case.

        case = lasersph.load_case("dlip-steel", ["laser.fluence=0.8 J/cm^2"])
        case.laser.fluence, case.material.name  # 8000.0 J/m^2

    Args:
        name_or_path: "dlip-steel" or "my-case.toml".
        overrides: settings like "laser.fluence=0.8 J/cm^2"; later ones win.
        quick: coarser, see `case.quick`, where `overrides` do not say otherwise.

    Raises:
        CaseError: every problem of the case in one line: file, line, key, what is wrong.
    """
    file = CaseFile(name_or_path)
    # Coarser values follow from the case with its overrides, which win over them.
    if quick:
        from lasersph.case.quick import quick_settings

        overrides = [*quick_settings(file.case(overrides)), *overrides]
    return file.case(overrides)


def write_new_case(name_or_path: str | os.PathLike[str], target: str | os.PathLike[str]) -> Path:
    """Write a commented case file to start from: the text of a shipped case or of a file.

    Raises:
        CaseError: no such case, the target exists already or cannot be written.
    """
    return write_new_file(read_toml(case_file(name_or_path)).text, target)


def write_new_file(text: str, target: str | os.PathLike[str]) -> Path:
    """Write a file that must not exist yet. Raises CaseError."""
    path = Path(target).expanduser()
    if not path.parent.is_dir():
        raise CaseError(f"there is no folder {path.parent}", "make it first", file=str(target))
    try:
        with path.open("x", encoding="utf-8") as stream:
            stream.write(text)
    except FileExistsError:
        raise CaseError("exists already", "choose another name", file=str(target)) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise CaseError(f"cannot be written: {reason}", file=str(target)) from None
    return path
