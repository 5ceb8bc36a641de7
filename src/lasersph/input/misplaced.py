"""Where a key belongs that its table does not know."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from lasersph.input.document import Document
from lasersph.input.key_lines import Path
from lasersph.input.model import nearest
from lasersph.input.schema import Schema

MOST_KEYS = 12
"""Keys that a hint lists."""


@dataclass(frozen=True)
class Misplaced:
    """What is asked for the place of an unknown key.

    `other_words` has words of other programs: the keys that they mean here, separated by spaces,
    or, with a semicolon before it, what to do instead. A word may name its table before a dot.
    """

    document: Document
    schema: Schema
    other_words: Mapping[str, str]


def place_of_unknown(path: Path, asked: Misplaced) -> tuple[str, Path | None]:
    """The hint for an unknown key, and where its value goes if that is known.

    Tried in turn: words of other programs, the key in another table, a key spelt alike in the same
    table or in another, another kind of the table. A place that is taken or that the kinds in the
    file refuse is no place.
    """
    document, schema = asked.document, asked.schema
    table, key = path[:-1], str(path[-1])
    known = schema.keys(table, document.data)
    word = key.lower().replace("-", "_")
    meant = asked.other_words.get(f"{table[-1]}.{word}" if table else word, "")
    meant = meant or asked.other_words.get(word, "")
    if meant.startswith(";"):
        return meant[1:].strip(), None
    near = nearest(key, known)
    candidates = [_path_of(word, table) for word in meant.split()]
    is_of_kind = bool(schema.kinds(table, key))
    candidates += [] if is_of_kind else _named(key, table, asked)
    candidates += [(*table, near)] if near else []
    alike = nearest(key, {str(place[-1]) for place in schema.places(document.data)})
    candidates += _named(alike, table, asked) if alike and not is_of_kind else []
    for target in candidates:
        fits = target in schema.places(document.data) and _fits(path, target, asked)
        if fits and (document.at(target) is None or path in document.origins):
            shown = target[-1] if target[:-1] == table else ".".join(map(str, target))
            return f'do you mean "{shown}"?', target
        if fits:
            return f"leave it out: {'.'.join(map(str, target))} is given", None
    kinds = schema.kinds(table, key)
    if kinds:
        return "belongs to " + " or ".join(f'kind = "{kind}"' for kind in kinds), None
    shown = ", ".join(known)
    return (f"known here: {shown}" if 0 < len(known) <= MOST_KEYS else "leave it out"), None


def _path_of(word: str, table: Path) -> Path:
    """A key written in full, or beginning with a dot inside the table."""
    return (*table, *word[1:].split(".")) if word.startswith(".") else tuple(word.split("."))


def _named(key: str, table: Path, asked: Misplaced) -> list[Path]:
    """Keys of that name in other tables: below the own table first, then outer ones."""
    places = asked.schema.places(asked.document.data)
    same = [place for place in places if place[-1] == key and place[:-1] != table]
    return sorted(same, key=lambda place: (place[: len(table)] != table, len(place)))


def _fits(path: Path, target: Path, asked: Misplaced) -> bool:
    """Whether a table goes to a table and a value to a value, and not into a text or number."""
    document, schema = asked.document, asked.schema
    if path[: len(target)] == target:
        return False
    for length in range(1, len(target)):
        around = document.at(target[:length])
        if around is not None and not isinstance(around, dict):
            return False
    is_table = isinstance(document.at(path), dict)
    return schema.allows(target, document.data, table=is_table)
