"""Strict reading of TOML files: UTF-8, bounded size, no duplicate keys, every key with its line."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from lasersph.input.errors import CaseError, Problem
from lasersph.input.key_lines import Path as KeyPath
from lasersph.input.key_lines import key_lines

LARGEST_FILE = 16 * 2**20
MOST_MISTAKES = 100
"""Mistakes of syntax after which a file is given up."""
SET = "# --set "
"""Begins the lines above the text of a case that tell the settings of the command."""


@dataclass
class Document:
    """Data of a TOML file with the place of every key.

    `origins` names keys that did not come from the file (overrides), by their path; `problems` are
    mistakes of syntax that were mended to read on.
    """

    data: dict[str, Any]
    file: str = ""
    text: str = ""
    lines: dict[KeyPath, int] = field(default_factory=dict)
    origins: dict[KeyPath, str] = field(default_factory=dict)
    problems: list[Problem] = field(default_factory=list)

    def place(self, path: KeyPath) -> tuple[str, int | None]:
        """(file, line) of a key, or of the nearest table around it."""
        # From the key itself outward, the first one whose place is known.
        for length in range(len(path), 0, -1):
            head = tuple(path[:length])
            if head in self.origins:
                return self.origins[head], None
            if head in self.lines:
                return self.file, self.lines[head]
            if within := self.origin_within(head):
                return within, None
        return self.file, None

    def origin_within(self, table: KeyPath) -> str:
        """Where the first key of a table comes from that the file does not have; empty for none."""
        own = (origin for path, origin in self.origins.items() if path[: len(table)] == table)
        return next(own, "")

    def at(self, path: KeyPath) -> Any:
        """The raw value at a path, or None."""
        value: Any = self.data
        for step in path:
            try:
                value = value[step]
            except (KeyError, IndexError, TypeError):
                return None
        return value


def _file_alike(path: Path) -> str:
    """' (do you mean "brass.toml"?)' where a TOML file of the folder is spelt alike, or nothing."""
    import difflib  # only this message needs it

    names = [one.stem for one in path.parent.glob("*.toml")] if path.parent.is_dir() else []
    near = difflib.get_close_matches(path.stem, names, n=1)
    return f' (do you mean "{near[0]}.toml"?)' if near else ""


def read_toml(file: str | Path, *, tolerant: bool = False) -> Document:
    """Read a TOML file; `tolerant` as in `parse_toml`.

    Raises:
        CaseError: missing, unreadable, not a file, larger than 16 MiB, not UTF-8, not TOML.
    """
    path = Path(file)
    # Refuse what cannot be a case before it is read into memory.
    try:
        if path.is_dir():
            raise CaseError("is a folder, not a file", file=str(file))
        if not path.is_file():
            raise CaseError("no such file" + _file_alike(path), file=str(file))
        if path.stat().st_size > LARGEST_FILE:
            raise CaseError("larger than 16 MiB, so hardly a case or material", file=str(file))
        raw = path.read_bytes()
    except (OSError, ValueError) as error:
        if isinstance(error, CaseError):
            raise
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise CaseError(f"cannot be read: {reason}", file=str(file)) from None
    return parse_toml(raw, str(file), tolerant=tolerant)


def parse_toml(raw: bytes | str, file: str = "", *, tolerant: bool = False) -> Document:
    """Read TOML text.

    Args:
        file: its name in messages.
        tolerant: keep what can be mended (text without quotes, a key given twice) as problems of
            the document, so that `build` says them along with all others.
    """
    # Windows writes a mark before UTF-8 text.
    text = _decode(raw, file) if isinstance(raw, bytes) else raw
    text = text.removeprefix("\ufeff")
    problems: list[Problem] = []
    mended = text
    # Read on past each mistake that can be mended in its line.
    while True:
        try:
            data, lines = tomllib.loads(mended), key_lines(mended)
            break
        except tomllib.TOMLDecodeError as error:
            mistake = _syntax_error(str(error), mended, file)
            problems += mistake.problems
            better = _mended(mended, mistake) if len(problems) < MOST_MISTAKES else None
            if better is None:
                raise CaseError(problems) from None
            mended = better
        except RecursionError:
            raise CaseError("brackets nested too deeply", file=file) from None
        except ValueError:  # Python's limit on the digits of an integer
            message = "not valid TOML: an integer of thousands of digits"
            raise CaseError(message, file=file) from None
    if problems and not tolerant:
        raise CaseError(problems)
    return Document(data, file, text, lines, problems=problems)


def with_settings(text: str, settings: Iterable[str]) -> str:
    """The text of a case file below its settings, "laser.fluence=0.8 J/cm^2", a comment each."""
    # The settings stand above the text as comments, so that the file is still the one given.
    return "".join(f"{SET}{setting}\n" for setting in settings) + text


def split_settings(case_text: str) -> tuple[list[str], str]:
    """The settings that a case.toml tells in its first lines, and the text below them."""
    lines = case_text.splitlines(keepends=True)
    count = next((k for k, line in enumerate(lines) if not line.startswith(SET)), len(lines))
    return [line.removeprefix(SET).strip() for line in lines[:count]], "".join(lines[count:])


def _decode(raw: bytes, file: str) -> str:
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        raise CaseError(
            f"byte 0x{raw[error.start]:02x} is not UTF-8 text",
            "save the file as UTF-8",
            file=file,
            line=line,
        ) from None


def _syntax_error(message: str, text: str, file: str) -> CaseError:
    """tomllib's message with its line; duplicate keys and text without quotes in our words."""
    # tomllib names the place at the end of its message.
    match = re.search(r" \(at line (\d+), column (\d+)\)$", message)
    line = int(match.group(1)) if match else None
    what = message[: match.start()] if match else message.removesuffix(" (at end of document)")
    if line is None:
        line = text.rstrip("\n").count("\n") + 1
    all_lines = text.split("\n")
    content = all_lines[line - 1].strip() if line <= len(all_lines) else ""
    # Its message is on the line after the key where that line is empty.
    if what in ("Cannot overwrite a value",) or "twice" in what or "Duplicate" in what:
        if not content and line > 1:
            line, content = line - 1, all_lines[line - 2].strip()
        key = content.split("=")[0].strip() if "=" in content else content
        return CaseError("given twice", "remove one", key=key, file=file, line=line)
    # Bare words and numbers with units, the most frequent mistakes.
    quoted = _quoted(content)
    if quoted != content:
        key = content.partition("=")[0].strip()
        number = re.search(r"=\s*[+-]?[\d.]", content) is not None
        problem = "a number with a unit is text in TOML" if number else "text needs quotes in TOML"
        hint = f"write {quoted.partition('#')[0].strip()}"
        return CaseError(problem, hint, key=key, file=file, line=line)
    # An odd number of quotation marks in a line.
    if content.count('"') % 2 and "=" in content:
        key, written = content.partition("=")[0].strip(), content.partition("#")[0].rstrip()
        problem = "text without its closing quotation mark"
        return CaseError(problem, f'write {written}"', key=key, file=file, line=line)
    what = what[0].lower() + what[1:] if what else "cannot be read"
    return CaseError(f"not valid TOML: {what}", file=file, line=line)


def _mended(text: str, mistake: CaseError) -> str | None:
    """The text without a mistake of syntax; None where it cannot be mended in its line."""
    lines, number = text.split("\n"), (mistake.line or 0) - 1
    if mistake.problem == "given twice" and "=" in lines[number]:
        lines[number] = ""
    elif _quoted(lines[number]) != lines[number]:
        lines[number] = _quoted(lines[number])
    else:
        return None
    return "\n".join(lines)


def _quoted(line: str) -> str:
    """A line with its bare words and its numbers with units in quotes."""

    # Values that TOML reads stay as they are.
    def quote(match: re.Match[str]) -> str:
        value = match.group(2)
        try:
            tomllib.loads(f"value = {value}")
        except (tomllib.TOMLDecodeError, ValueError):
            return f'{match.group(1)}"{value}"'
        return match.group(0)

    return re.sub(r"(=\s*)([\w+.-][^\"',=}\]{\[#\n]*?)(?=\s*(?:[,}#]|$))", quote, line)
