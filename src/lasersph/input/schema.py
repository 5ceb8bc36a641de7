"""The keys of a model as its JSON Schema tells them, for hints: where a key goes, what to write."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from typing import Any

from pydantic import BaseModel

from lasersph.input.key_lines import Path
from lasersph.input.quantity import fits_kind

DEEPEST = 5
"""Steps of a key; no model of lasersph nests deeper, but a schema may refer to itself."""


@cache
def schema_of(model: type[BaseModel]) -> dict[str, Any]:
    """JSON Schema of a model, made once: that of a case takes a tenth of a second. Read only."""
    return model.model_json_schema()


class Schema:
    """Questions to the JSON Schema of a model.

    Where a table has several kinds, only those count that agree with the `kind` in the data.
    """

    def __init__(self, model: type[BaseModel]) -> None:
        self._root = schema_of(model)
        self._definitions: dict[str, Any] = self._root.get("$defs", {})

    def parts(self, path: Path, data: Any) -> list[dict[str, Any]]:
        """The alternatives that the schema allows at a path."""
        # Step by step, with the kinds that the data allow at each.
        found, value = self._alternatives(self._root), data
        for step in path:
            found = [leaf for part in found for leaf in self._below(part, step)]
            value = _at(value, step)
            found = _of_kind(found, value)
        return found

    def keys(self, path: Path, data: Any) -> list[str]:
        """Keys of the table at a path."""
        parts = self.parts(path, data)
        return list(dict.fromkeys(key for part in parts for key in part.get("properties", {})))

    def kinds(self, path: Path, key: str) -> list[str]:
        """The kinds of the table at a path that know a key."""
        parts = [part.get("properties", {}) for part in self.parts(path, None)]
        known = [part["kind"].get("const") for part in parts if key in part and "kind" in part]
        return [kind for kind in known if kind]

    def meaning(self, path: Path, data: Any) -> str:
        """Meaning of a key, empty where the schema has none: of the key itself, of the table
        around it, or of the tables that stand there."""
        parts, around = self.parts(path, data), self.parts(path[:-1], data)
        # The key in its table first, then the table that stands at the key.
        meanings = [described(part)[1].get(str(path[-1]), "") for part in around]
        meanings += [described(part)[0] for part in parts]
        if path[-1] == "kind" and len(around) == 1:  # the kind that stands there
            meanings.append(described(around[0])[0])
        return next(filter(None, meanings), "")

    def needs(self, path: Path, data: Any) -> bool:
        """Whether the table around a key cannot do without."""
        around = self.parts(path[:-1], data)
        return any(path[-1] in part.get("required", ()) for part in around)

    def has_example(self, path: Path, data: Any) -> bool:
        """Whether the model gives an example for a key itself."""
        return any("examples" in part for part in self.parts(path, data))

    def allows(self, path: Path, data: Any, *, table: bool) -> bool:
        """Whether a table may stand at a path, or a value."""
        return any(("properties" in part) == table for part in self.parts(path, data))

    def best_kind(self, path: Path, data: Any, tag: str) -> str:
        """The kind of the table at a path that knows most of the keys given there."""
        # The kind with most of the given keys is the one that is meant.
        given = set(_inside(data, path))
        kinds = {
            part["properties"][tag]["const"]: given & set(part["properties"])
            for part in self.parts(path, data)
            if "const" in part.get("properties", {}).get(tag, {})
        }
        return max(kinds, key=lambda kind: len(kinds[kind]))

    def places(self, data: Any) -> list[Path]:
        """Every key that the kinds in the data allow, the outer ones first."""
        # Breadth first, so that outer places come before inner ones.
        found: list[Path] = []
        waiting: list[Path] = [()]
        while waiting:
            path = waiting.pop(0)
            below = [(*path, key) for key in self.keys(path, data)]
            found += below
            waiting += below if len(path) + 1 < DEEPEST else []
        return found

    def example(self, path: Path, data: Any) -> Any:
        """Line that might stand at a path, None where the schema does not say."""
        parts = self.parts(path, data)
        return self._example(parts[0]) if parts else None

    def table_for(self, path: Path, value: Any, data: Any) -> dict[str, Any]:
        """Table that might stand at a path; in it, as `kind` or `value`, a value that fits.

        Empty where the schema does not say.
        """
        # The table of the kind that the value names; of a law, one with the value in it.
        tables = [part for part in self.parts(path, None) if part.get("properties")]
        if not tables:
            return {}
        table = _of_kind(tables, {"kind": value})[0]
        keys = table["properties"]
        if not keys.keys() >= {"value", "source"}:
            return self._example(table)
        leaves = self._alternatives(keys["value"])
        fits = any(_is_value_of(leaf, value) for leaf in leaves)
        shown = value if fits else self._example(leaves[0])
        return {"value": shown, "source": self._example(keys["source"])}

    def _example(self, part: dict[str, Any]) -> Any:
        # An example of the model, a fixed value, or what the type needs at least.
        if "examples" in part:
            return part["examples"][0]
        if "const" in part or "enum" in part:
            return part.get("const", (part.get("enum") or [None])[0])
        leaf = self._alternatives(part)[0]
        if "properties" in leaf:
            needed = ["kind"] if "const" in leaf["properties"].get("kind", {}) else []
            needed += [key for key in leaf.get("required", ()) if key not in needed]
            return {key: self._example(leaf["properties"][key]) for key in needed}
        if leaf.get("type") == "array":
            rows = leaf.get("prefixItems") or [leaf.get("items", {})]
            return [self._example(row) for row in rows]
        if leaf.get("type") in ("integer", "number"):
            return leaf.get("minimum", 1)
        return {"string": "name", "boolean": False}.get(str(leaf.get("type")))

    def _below(self, part: dict[str, Any], step: str | int) -> list[dict[str, Any]]:
        if isinstance(step, int):
            rows = part.get("prefixItems", ())
            item = rows[step] if step < len(rows) else part.get("items")
        else:
            item = part.get("properties", {}).get(step)
        return self._alternatives(item) if isinstance(item, dict) else []

    def _alternatives(self, part: dict[str, Any]) -> list[dict[str, Any]]:
        """A part with references resolved, one for each branch but null."""
        # A reference stands for its definition, with what is said beside it.
        if "$ref" in part:
            beside = {key: value for key, value in part.items() if key != "$ref"}
            part = self._definitions[part["$ref"].rpartition("/")[2]] | beside
        branches = [branch for name in ("anyOf", "oneOf", "allOf") for branch in part.get(name, ())]
        if not branches:
            return [part]
        # What is said of the key holds for each branch, but a kind describes itself.
        shown = {key: part[key] for key in ("examples", "description") if part.get(key)}
        leaves = [leaf for branch in branches for leaf in self._alternatives(branch)]
        found = [shown | leaf if _is_one_kind(leaf) else leaf | shown for leaf in leaves]
        return [leaf for leaf in found if leaf.get("type") != "null"]


def _is_one_kind(part: dict[str, Any]) -> bool:
    """Whether a part is one of several kinds of a table: what it is, is said of itself."""
    return "const" in part.get("properties", {}).get("kind", {})


def _is_value_of(leaf: dict[str, Any], value: Any) -> bool:
    """Whether a text or number may stand where a part of a schema tells of a quantity."""
    if isinstance(value, str):
        return leaf.get("type") != "number" and fits_kind(value, leaf.get("x-kind", "fraction"))
    return leaf.get("type") == "number" and isinstance(value, int | float)


def described(part: dict[str, Any]) -> tuple[str, dict[str, str]]:
    """The description in a part of a schema without, and by key, what its "Attributes:" say."""
    text, _, attributes = part.get("description", "").partition("\n\nAttributes:\n")
    # "Attributes:" have several names to a meaning, over several lines.
    meanings = {}
    for names, meaning in re.findall(
        r"^    ([\w, ]+): (.+(?:\n     +.+)*)", attributes, re.MULTILINE
    ):
        meanings |= dict.fromkeys(names.split(", "), " ".join(meaning.split()))
    return text.strip(), meanings


def as_toml(value: Any) -> str:
    """A value as it stands in a TOML file, tables inline."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {as_toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(as_toml(item) for item in value) + "]"
    return json.dumps(value, ensure_ascii=False)


def _of_kind(parts: list[dict[str, Any]], value: Any) -> list[dict[str, Any]]:
    """The parts that agree with the kind in the data; all where none does."""
    kind = value.get("kind") if isinstance(value, dict) else None
    same = [
        part for part in parts if part.get("properties", {}).get("kind", {}).get("const") == kind
    ]
    return same or parts


def _at(value: Any, step: str | int) -> Any:
    try:
        return value[step]
    except (KeyError, IndexError, TypeError):
        return None


def _inside(data: Any, path: Path) -> Iterator[str]:
    for step in path:
        data = _at(data, step)
    return iter(data if isinstance(data, dict) else ())
