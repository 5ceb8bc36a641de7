"""Strict reading of TOML files: UTF-8, bounded size, no duplicate keys, every key with its line."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from lasersph.input.errors import CaseError
from lasersph.input.key_lines import Path as KeyPath
from lasersph.input.key_lines import key_lines

LARGEST_FILE = 16 * 2**20


@dataclass
class Document:
    """Data of a TOML file with the place of every key.

    `origins` names keys that did not come from the file (overrides), by their path.
    """

    data: dict[str, Any]
    file: str = ""
    text: str = ""
    lines: dict[KeyPath, int] = field(default_factory=dict)
    origins: dict[KeyPath, str] = field(default_factory=dict)

    def place(self, path: KeyPath) -> tuple[str, int | None]:
        """(file, line) of a key, or of the nearest table around it."""
        for length in range(len(path), 0, -1):
            head = tuple(path[:length])
            if head in self.origins:
                return self.origins[head], None
            if head in self.lines:
                return self.file, self.lines[head]
        return self.file, None

    def at(self, path: KeyPath) -> Any:
        """The raw value at a path, or None."""
        value: Any = self.data
        for step in path:
            try:
                value = value[step]
            except (KeyError, IndexError, TypeError):
                return None
        return value


def read_toml(file: str | Path) -> Document:
    """Read a TOML file.

    Raises:
        CaseError: missing, unreadable, not a file, larger than 16 MiB, not UTF-8, not TOML.
    """
    path = Path(file)
    try:
        if path.is_dir():
            raise CaseError("is a folder, not a file", file=str(file))
        if not path.is_file():
            raise CaseError("no such file", file=str(file))
        if path.stat().st_size > LARGEST_FILE:
            raise CaseError("larger than 16 MiB, so hardly a case or material", file=str(file))
        raw = path.read_bytes()
    except (OSError, ValueError) as error:
        if isinstance(error, CaseError):
            raise
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise CaseError(f"cannot be read: {reason}", file=str(file)) from None
    return parse_toml(raw, str(file))


def parse_toml(raw: bytes | str, file: str = "") -> Document:
    """Read TOML text, as `read_toml` does; `file` is its name in messages."""
    text = _decode(raw, file) if isinstance(raw, bytes) else raw
    text = text.removeprefix("\ufeff")
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _syntax_error(str(error), text, file) from None
    except RecursionError:
        raise CaseError("brackets nested too deeply", file=file) from None
    except ValueError:  # Python's limit on the digits of an integer
        raise CaseError("not valid TOML: an integer of thousands of digits", file=file) from None
    try:
        lines = key_lines(text)
    except RecursionError:
        raise CaseError("brackets nested too deeply", file=file) from None
    return Document(data, file, text, lines)


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
    """tomllib's message with its line; duplicate keys and unquoted quantities in our words."""
    match = re.search(r" \(at line (\d+), column (\d+)\)$", message)
    line = int(match.group(1)) if match else None
    what = message[: match.start()] if match else message.removesuffix(" (at end of document)")
    if line is None:
        line = text.rstrip("\n").count("\n") + 1
    all_lines = text.split("\n")
    content = all_lines[line - 1].strip() if line <= len(all_lines) else ""
    if what in ("Cannot overwrite a value",) or "twice" in what or "Duplicate" in what:
        previous = content or (all_lines[line - 2].strip() if line > 1 else "")
        key = previous.split("=")[0].strip() if "=" in previous else previous
        return CaseError("given twice", "remove one", key=key, file=file, line=line)
    key, equals, value = content.partition("=")
    value = value.split("#")[0].strip()
    if equals and re.match(r"[+-]?[\d.]+\s*(?!e[+-]?\d)[^\s\d._,\]#]", value):
        return CaseError(
            "a number with a unit is text in TOML",
            f'write {key.strip()} = "{value}"',
            key=key.strip(),
            file=file,
            line=line,
        )
    what = what[0].lower() + what[1:] if what else "cannot be read"
    return CaseError(f"not valid TOML: {what}", file=file, line=line)
