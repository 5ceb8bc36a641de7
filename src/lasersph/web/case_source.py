"""Source of the case of a new run: a shipped case, a case file, a text, or an earlier run.

A case file is named by its path below the folder that is served; nothing above it and no link is
read. A text that was pasted, and the case of an earlier run, are written into a folder of their own
that lasts as long as this server: from there an ordinary `lasersph run` reads them.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from lasersph.case import available_cases
from lasersph.input import CaseError
from lasersph.input.document import split_settings
from lasersph.output import OutputError
from lasersph.web.folder_list import FolderList, refuse_links

KINDS = ("case", "file", "text", "run")
"""Keys of a request, of which one says where the run begins."""
BUILT = "# Built in Python"
"""Begins the case.toml of a run whose case was no file."""


@dataclass(frozen=True)
class CaseSource:
    """A case before it is changed.

    Attributes:
        path: its file. settings: changes of an earlier run, as `--set` takes it.
        name: by which a run of it may be called. kept: a folder of this server's that holds the
            file as long as this object lives.
    """

    path: Path
    name: str
    settings: tuple[str, ...] = ()
    kept: TemporaryDirectory[str] | None = field(default=None, compare=False, repr=False)


def source_of(content: dict[str, Any], folders: FolderList) -> CaseSource:
    """Where a run begins that a request asks for.

    Raises:
        KeyError: no case of this name is shipped, or there is no such run. ValueError: the request
            names none or several, or a file that is not below the folder. OutputError: the run
            cannot be read, or has no case file.
    """
    # Exactly one source.
    given = [kind for kind in KINDS if content.get(kind) is not None]
    if len(given) != 1 or not isinstance(content[given[0]], str):
        raise ValueError(f"one of {', '.join(KINDS)} is wanted, a text")
    (kind,), value = given, content[given[0]]
    # Shipped cases and files as they lie; texts are written into a folder of this server's.
    if kind == "case":
        return CaseSource(available_cases()[value], value)
    if kind == "file":
        path = file_below(folders.root, value)
        return CaseSource(path, path.stem)
    if kind == "text":
        return _written(value, "own-case")
    # An earlier run: its case file, with the settings that it was started with.
    entry = folders.find(value, "run")
    refuse_links(entry.path)
    try:
        text = (entry.path / "case.toml").read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise OutputError(f"{entry.name} has no case file that can be read: {error}") from error
    if text.startswith(BUILT):
        raise OutputError(
            f"{entry.name} was made by a study or in Python and has no case file: start from the "
            "case of that study"
        )
    settings, without_settings = split_settings(text)
    return _written(without_settings, entry.path.name, tuple(settings))


def file_below(root: Path, name: str) -> Path:
    """A case file by its path below a folder.

    Raises:
        ValueError: the path leads out of the folder, through a link, or to no case file.
    """
    # The path may neither lead out of the folder nor through a link.
    try:
        path = Path(os.path.normpath(root / name))
        is_inside = path.resolve() == path and path.is_relative_to(root)
        is_case = path.suffix == ".toml" and path.is_file()
    except (OSError, ValueError):  # a name that no file can have
        is_inside = is_case = False
    if not is_inside:
        raise ValueError(f"a path below {root} is wanted, without links: my-case.toml")
    if not is_case:
        raise ValueError(f"{name}: no case file of this name lies below {root}")
    return path


def in_words(error: CaseError) -> str:
    """The first mistake of a case in one line, with its line in the file, and how many more."""
    # The first problem with its line; the file's name without its folder.
    first, more = error.problems[0], len(error.problems) - 1
    line = f"line {first.line}" if first.line else ""
    text = ": ".join(filter(None, (line, first.key, first.problem)))
    text += f"; {first.hint}" if first.hint else ""
    text = text.replace(first.file, Path(first.file).name) if first.file else text
    return " ".join(text.split()) + (f" (and {more} more)" if more else "")


def _written(text: str, name: str, settings: tuple[str, ...] = ()) -> CaseSource:
    kept = TemporaryDirectory(prefix="lasersph-case-")
    path = Path(kept.name).resolve() / f"{name}.toml"
    path.write_text(text, encoding="utf-8")
    return CaseSource(path, name, settings, kept)
