"""Line numbers of the keys of a TOML text, which `tomllib` does not give.

Works on a text that `tomllib` has accepted, so it follows the structure (headers, dotted keys,
strings of four kinds, arrays, inline tables, comments) without checking it again. The result maps
the path of a key, for example ("probes", 0, "position"), to the line it stands in.
"""

from __future__ import annotations

import re

Path = tuple[str | int, ...]
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_ESCAPES = dict(zip('btnfr"\\e', '\b\t\n\f\r"\\\x1b', strict=True))


def key_lines(text: str) -> dict[Path, int]:
    """Map every key path of a valid TOML text to its line (from 1).

    Tables map to the line of their first mention, elements of arrays to the line they start in.
    """
    return _Scanner(text).scan()


class _Scanner:
    def __init__(self, text: str) -> None:
        self.text = text.replace("\r\n", "\n")
        self.place = 0
        self.line = 1
        self.lines: dict[Path, int] = {}
        self.array_lengths: dict[Path, int] = {}

    def scan(self) -> dict[Path, int]:
        # Headers set the table, all else are assignments in it.
        table: Path = ()
        while self._skip_blank(newlines=True):
            if self._peek() == "[":
                table = self._header()
            else:
                self._assignment(table)
        return self.lines

    def _peek(self, length: int = 1) -> str:
        return self.text[self.place : self.place + length]

    def _advance(self, count: int) -> None:
        self.line += self.text.count("\n", self.place, self.place + count)
        self.place += count

    def _skip_blank(self, *, newlines: bool) -> bool:
        """Skip spaces and comments (and line ends); whether text remains."""
        while self.place < len(self.text):
            char = self.text[self.place]
            # A comment ends with its line.
            if char == "#":
                end = self.text.find("\n", self.place)
                self.place = len(self.text) if end < 0 else end
            elif char in " \t" or (newlines and char == "\n"):
                self._advance(1)
            else:
                return True
        return False

    def _header(self) -> Path:
        is_array = self._peek(2) == "[["
        self._advance(2 if is_array else 1)
        line = self.line
        path = self._resolve(self._key())
        # Each [[header]] begins the next element of its array.
        if is_array:
            index = self.array_lengths.get(path, 0)
            self.array_lengths[path] = index + 1
            self.lines.setdefault(path, line)
            path = (*path, index)
        self._advance(2 if is_array else 1)
        self._note(path, line)
        return path

    def _resolve(self, names: tuple[str, ...]) -> Path:
        """A header's path, entering the latest element of each array of tables before the last."""
        path: Path = ()
        for number, name in enumerate(names):
            path = (*path, name)
            if number < len(names) - 1 and path in self.array_lengths:
                path = (*path, self.array_lengths[path] - 1)
        return path

    def _note(self, path: Path, line: int) -> None:
        # The first mention of a table is its line.
        for length in range(1, len(path) + 1):
            self.lines.setdefault(path[:length], line)

    def _assignment(self, table: Path) -> None:
        line = self.line
        path = (*table, *self._key())
        self._note(path, line)
        self._advance(1)  # the "="
        self._value(path)

    def _key(self) -> tuple[str, ...]:
        names = []
        # Names between dots: quoted, or bare.
        while True:
            self._skip_blank(newlines=False)
            if self._peek() in ("'", '"'):
                names.append(self._string())
            else:
                match = _BARE.match(self.text, self.place)
                if match is None:  # not valid TOML after all: stop without looping
                    self.place = len(self.text)
                    return tuple(names)
                names.append(match.group())
                self.place = match.end()
            self._skip_blank(newlines=False)
            if self._peek() != ".":
                return tuple(names)
            self._advance(1)

    def _value(self, path: Path) -> None:
        self._skip_blank(newlines=False)
        # Strings, arrays and inline tables hold keys or separators; plain values end at one.
        char = self._peek()
        if char in ("'", '"'):
            self._string()
        elif char == "[":
            self._array(path)
        elif char == "{":
            self._inline_table(path)
        else:
            while self.place < len(self.text) and self.text[self.place] not in ",]}#\n":
                self.place += 1

    def _array(self, path: Path) -> None:
        self._advance(1)
        index = 0
        while self._skip_blank(newlines=True) and self._peek() != "]":
            # An element begins where its first character stands.
            self.lines.setdefault((*path, index), self.line)
            self._value((*path, index))
            index += 1
            self._skip_blank(newlines=True)
            if self._peek() == ",":
                self._advance(1)
        self._advance(1)

    def _inline_table(self, path: Path) -> None:
        self._advance(1)
        while self._skip_blank(newlines=True) and self._peek() != "}":
            self._assignment(path)
            self._skip_blank(newlines=True)
            if self._peek() == ",":
                self._advance(1)
        self._advance(1)

    def _string(self) -> str:
        # Three quotes begin a text over several lines.
        quote = self._peek()
        delimiter = quote * 3 if self._peek(3) == quote * 3 else quote
        self._advance(len(delimiter))
        start, escaped = self.place, False
        # A backslash escapes in double quotes only.
        while self.place < len(self.text):
            if quote == '"' and self._peek() == "\\":
                escaped = True
                self._advance(2)
            elif self._peek(len(delimiter)) == delimiter:
                break
            else:
                self._advance(1)
        content = self.text[start : self.place]
        self._advance(len(delimiter))
        while len(delimiter) == 3 and self._peek() == quote:  # up to two quotes before the end
            self._advance(1)
        return _unescape(content) if escaped else content


def _unescape(content: str) -> str:
    def replace(match: re.Match[str]) -> str:
        code = match.group(1)
        if code[0] in "uU":
            return chr(int(code[1:], 16))
        return _ESCAPES.get(code, code)

    return re.sub(r"\\(u[0-9a-fA-F]{4}|U[0-9a-fA-F]{8}|.)", replace, content)
