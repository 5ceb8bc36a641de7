"""pydantic's errors in plain words: what is wrong at which key, and what would be right."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from pydantic import ValidationError

from lasersph.input.document import Document
from lasersph.input.errors import CaseError, Problem
from lasersph.input.key_lines import Path
from lasersph.input.model import nearest
from lasersph.input.quantity import KINDS, fits_kind
from lasersph.input.schema import Schema, as_toml

_BOUNDS = {
    "greater_than": ("greater than", "gt"),
    "greater_than_equal": ("at least", "ge"),
    "less_than": ("less than", "lt"),
    "less_than_equal": ("at most", "le"),
}
_EXPECTED = {
    "string_type": "text in quotes",
    "int_type": "a whole number",
    "int_parsing": "a whole number",
    "int_from_float": "a whole number",
    "float_type": "a number",
    "float_parsing": "a number",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "finite_number": "a finite number",
    "list_type": "an array [...]",
    "tuple_type": "an array [...]",
    "dict_type": "a table",
    "model_type": "a table",
    "model_attributes_type": "a table",
}
MOST_KEYS = 12
"""Keys that a hint lists."""


@dataclass(frozen=True)
class Finding:
    """One mistake: where, what is wrong, what would be right.

    `value` is what the hint writes at `path`, where that is certain; `target` where it moves to.
    """

    path: Path
    problem: str
    hint: str = ""
    value: Any = None
    target: Path | None = None
    foreign: Problem | None = None

    def located(self, document: Document) -> Problem:
        """The mistake with its file, line and key."""
        file, line = document.place(self.path)
        # A mistake in another file, of a material, has its own place; without a line it stands
        # here.
        if self.foreign is not None:
            other = self.foreign
            if other.file and not other.line:
                other = replace(other, problem=f"{other.file}: {other.problem}")
            here = replace(other, key=dotted(self.path), file=file, line=line)
            return other if other.line else here
        return Problem(self.problem, self.hint, dotted(self.path), file, line)


def findings_of(
    error: ValidationError,
    document: Document,
    schema: Schema,
    other_words: Mapping[str, str],
) -> list[Finding]:
    """Every mistake that pydantic found."""
    found: list[Finding] = []
    for each in error.errors(include_url=False):
        # Errors of files that a validator read keep their own place.
        cause = (each.get("ctx") or {}).get("error")
        if isinstance(cause, CaseError):
            path = _data_path(each["loc"], document.data, "")
            found += [Finding(path, p.problem, p.hint, foreign=p) for p in cause.problems]
        else:
            found += _say(dict(each), document, schema, other_words)
    return found


def dotted(path: Path) -> str:
    """A key path as people write it: ("probes", 0, "name") is "probes[1].name"."""
    text = ""
    for step in path:
        if isinstance(step, int):
            text += f"[{step + 1}]"
        else:
            text += f".{step}" if text else str(step)
    return text


def steps_of(key: str) -> Path:
    """The path of a key as `dotted` writes it."""
    steps = re.findall(r"([^.\[\]]+)|\[(\d+)\]", key)
    return tuple(name or int(index) - 1 for name, index in steps)


def _say(
    error: dict[str, Any], document: Document, schema: Schema, other_words: Mapping[str, str]
) -> list[Finding]:
    kind, context = error["type"], error.get("ctx") or {}
    path = _data_path(error["loc"], document.data, kind)

    # Errors of this package's validators: unknown keys, and problems at named keys.
    given = _shown(document.at(path))
    if kind == "unknown_keys":
        misplaced = Misplaced(document, schema, other_words)
        return [_unknown((*path, key), misplaced) for key in context["keys"]]
    if kind == "extra_forbidden":
        return [_unknown(path, Misplaced(document, schema, other_words))]
    if kind == "at_key":
        found = ((key, *text.partition("; ")) for key, text in context["problems"])
        return [Finding((*path, *steps_of(key)), text, hint) for key, text, _, hint in found]

    # Errors of pydantic: missing keys, choices, values, types.
    if kind == "missing":
        return [_missing(path, schema.example(path, document.data))]
    if kind == "union_tag_not_found":
        tag = _tag(context)
        return [_missing((*path, tag), schema.best_kind(path, document.data, tag))]
    if kind == "union_tag_invalid":
        text, hint = _choice(f'"{context["tag"]}"', context["expected_tags"])
        return [Finding((*path, _tag(context)), text, hint)]
    if kind in ("literal_error", "enum"):
        return [Finding(path, *_choice(given, str(context.get("expected", ""))))]
    if kind in ("value_error", "assertion_error"):
        text, _, hint = str(context.get("error", error["msg"])).partition("; ")
        return [Finding(path, text, hint)]
    if kind == "too_short" and len(document.at(path) or ()) >= context["min_length"]:
        return []  # it counts the rows without mistakes
    if _EXPECTED.get(kind) == "a table":
        return [_no_table(path, given, document, schema)]

    # A single table where several belong is written with double brackets.
    is_one = kind in ("list_type", "tuple_type") and given == "a table" and len(path) == 1
    hint = f"write [[{path[0]}]]" if is_one else ""
    return [Finding(path, _problem_with_value(kind, context, error["msg"], given), hint)]


def _problem_with_value(kind: str, context: dict[str, Any], message: str, given: str) -> str:
    """Problem of a value that has its right place, in words."""
    if kind == "quantity":
        return context["message"]
    if kind in _BOUNDS:
        words, bound = _BOUNDS[kind]
        limit = context[bound]
        shown = f"{limit:g}" if isinstance(limit, float) else str(limit)
        return f"must be {words} {shown}, got {given}"
    if kind in _EXPECTED:
        return f"must be {_EXPECTED[kind]}, got {given}"
    if kind in ("too_short", "too_long"):
        limit = f"at least {context['min_length']}" if kind == "too_short" else ""
        limit = limit or f"at most {context['max_length']}"
        return f"must have {limit} entries, got {context['actual_length']}"
    if kind in ("string_too_short", "string_too_long"):
        return message[0].lower() + message[1:]
    return message


def _missing(path: Path, example: Any) -> Finding:
    """A key that must be there, with the line to write."""
    hint = ""
    # The whole table, where it is one of the first level.
    if isinstance(example, dict) and len(path) == 1:
        lines = [f"{key} = {as_toml(value)}" for key, value in example.items()]
        hint = f"write [{path[0]}] with {', '.join(lines)}" if lines else f"write [{path[0]}]"
    elif example is not None and isinstance(path[-1], int):
        hint = f"the row needs this entry, such as {as_toml(example)}"
    elif example is not None:
        hint = f"write {path[-1]} = {as_toml(example)}"
    return Finding(path, "missing", hint, value=example)


def _no_table(path: Path, given: str, document: Document, schema: Schema) -> Finding:
    """A value where a table belongs, with the table to write; the value in it where it fits."""
    example = schema.table_for(path, document.at(path), document.data)
    hint = f"write {path[-1]} = {as_toml(example)}" if example else ""
    return Finding(path, f"must be a table, got {given}", hint, value=example or None)


def _unknown(path: Path, misplaced: Misplaced) -> Finding:
    hint, target = place_of_unknown(path, misplaced)
    return Finding(path, "unknown key", hint, target=target)


def _data_path(location: tuple[Any, ...], data: Any, kind: str) -> Path:
    """pydantic's location without the steps that are not keys (union tags, validator names)."""
    # Steps that the data have are keys; others are tags of unions and names of validators.
    path: list[str | int] = []
    for number, step in enumerate(location):
        is_last = number == len(location) - 1
        is_key = isinstance(data, dict) and step in data
        is_index = isinstance(data, list) and isinstance(step, int) and step < len(data)
        if is_key or is_index:
            data = data[step]
            path.append(step)
        elif is_last and kind == "missing":
            path.append(step)
    return tuple(path)


def _tag(context: dict[str, Any]) -> str:
    return str(context.get("discriminator", "kind")).strip("'()")


def _choice(given: str, expected: str) -> tuple[str, str]:
    """Text for a word that is none of the allowed ones."""
    # The choices as pydantic lists them.
    choices = [word.strip().strip("'\"") for word in expected.replace(" or ", ", ").split(",")]
    near = nearest(given.strip('"'), choices)
    listed = " or ".join(word if word.isdigit() else f'"{word}"' for word in choices)
    hint = f'do you mean "{near}"?' if near else ""
    return f"must be {listed}, got {given}", hint


def _shown(value: Any) -> str:
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list):
        return "an array"
    if isinstance(value, bool):
        return str(value).lower()
    text = f'"{value}"' if isinstance(value, str) else str(value)
    text = text.replace("\n", " ")
    return text if len(text) <= 60 else text[:57] + "..."


@dataclass(frozen=True)
class Misplaced:
    """Sources that are asked for the place of an unknown key.

    `other_words` has words of other programs: the keys that they mean here, separated by spaces,
    and behind a semicolon what to do where none of them fits. A word may name its table before a
    dot.
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

    # 1. Words of other programs, with their table or alone.
    table, key = path[:-1], str(path[-1])
    known = schema.keys(table, document.data)
    word = key.lower().replace("-", "_")
    meant = asked.other_words.get(f"{table[-1]}.{word}" if table else word, "")
    meant = meant or asked.other_words.get(word, "")
    keys, _, advice = meant.partition(";")

    # 2. Places where the key, or one spelt alike, is known.
    candidates = [_path_of(word, table) for word in keys.split()]
    # rows are meant for the only key of a table
    is_array = isinstance(document.at(path), list)
    candidates += [(*table, known[0])] if is_array and len(known) == 1 else []
    candidates += [] if advice else _alike(key, table, asked)

    # 3. The first of them that the data leave free, and whose kind of quantity fits.
    for target in candidates:
        fits = target in schema.places(document.data) and _fits(path, target, asked)
        fits = fits and not _is_of_other_kind(document.at(path), target, asked)
        if fits and (document.at(target) is None or document.origin_within(path)):
            shown = target[-1] if target[:-1] == table else ".".join(map(str, target))
            return f'do you mean "{shown}"?', target
        if fits:
            return f"leave it out: {'.'.join(map(str, target))} is given", None

    # 4. What to do instead; another kind of the same table knows the key; the keys known here.
    if advice:
        return advice.strip(), None
    kinds = schema.kinds(table, key)
    if kinds:
        owners = "belongs to " + " or ".join(f'kind = "{kind}"' for kind in kinds)
        return owners + _left_out(path, document), None
    shown = ", ".join(known)
    return (f"known here: {shown}" if 0 < len(known) <= MOST_KEYS else "leave it out"), None


def _alike(key: str, table: Path, asked: Misplaced) -> list[Path]:
    """Places of the key itself in other tables, and of keys that are spelt alike."""
    schema, data = asked.schema, asked.document.data
    near = nearest(key, schema.keys(table, data))
    here = [(*table, near)] if near else []
    # A key of another kind of this table stays here.
    if schema.kinds(table, key):
        return here
    alike = nearest(key, {str(place[-1]) for place in schema.places(data)})
    elsewhere = _named(alike, table, asked) if alike else []
    return [*_named(key, table, asked), *here, *elsewhere]


def _left_out(path: Path, document: Document) -> str:
    """How to be rid of a key of the file whose table has been given another kind by a setting."""
    kind = (*path[:-1], "kind")
    if not document.origin_within(kind) or document.origin_within(path):
        return ""
    return f'; leave it out with --set {dotted(path)}= or, in a plan, "{dotted(path)}" = ""'


def _path_of(word: str, table: Path) -> Path:
    """A key written in full, or beginning with a dot inside the table."""
    return (*table, *word[1:].split(".")) if word.startswith(".") else tuple(word.split("."))


def _named(key: str, table: Path, asked: Misplaced) -> list[Path]:
    """Keys of that name in other tables: below the own table first, then outer ones.

    The word that names the kind of a table elsewhere says nothing of this one, nor does a key of a
    table within a table that the file does not have.
    """
    schema, data = asked.schema, asked.document.data
    same = [place for place in schema.places(data) if place[-1] == key and place[:-1] != table]
    below = [place for place in same if place[: len(table)] == table]
    outer = [
        place
        for place in same
        if place not in below
        and not any("const" in part for part in schema.parts(place, data))
        and (len(place) <= 2 or asked.document.at(place[:-1]) is not None)
    ]
    return sorted(below, key=len) + sorted(outer, key=len)


def _is_of_other_kind(value: Any, target: Path, asked: Misplaced) -> bool:
    """Whether a text is a quantity, but of none of the kinds that a key takes."""
    # Kinds that the key takes; a plain number takes a fraction.
    parts = asked.schema.parts(target, asked.document.data)
    is_number = any(part.get("type") == "number" for part in parts)
    kinds = [part["x-kind"] for part in parts if "x-kind" in part] + ["fraction"] * is_number
    if not isinstance(value, str) or not kinds or any(fits_kind(value, kind) for kind in kinds):
        return False
    return any(fits_kind(value, kind) for kind in KINDS)


def _fits(path: Path, target: Path, asked: Misplaced) -> bool:
    """Whether a table goes to a table, an array to an array and a value to a value, and not into a
    text or number."""
    document, schema = asked.document, asked.schema
    # A place below the key itself, or inside a value, is no place.
    if path[: len(target)] == target:
        return False
    for length in range(1, len(target)):
        around = document.at(target[:length])
        if around is not None and not isinstance(around, dict):
            return False
    value = document.at(path)
    return schema.allows(target, document.data, table=isinstance(value, dict)) and (
        isinstance(value, list) == any(map(_is_array, schema.parts(target, document.data)))
    )


def _is_array(part: dict[str, Any]) -> bool:
    return part.get("type") == "array"
