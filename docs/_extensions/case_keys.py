"""Markdown tables of every key of a case file, made from the JSON Schema of `lasersph.case.Case`.

One section a table of the file, in the order of the model. Where a table is one of several models
told apart by `kind`, each has a section of its own. Nothing is written twice: names, types,
defaults, units and descriptions all come from the models.
"""

import json
from collections.abc import Iterator
from typing import Any

from lasersph.input import KINDS, format_quantity
from lasersph.input.schema import described

Schema = dict[str, Any]


def case_keys(schema: Schema) -> str:
    """The sections for all keys of a case file."""
    definitions = schema.get("$defs", {})
    return "\n\n".join(_sections(schema, "", definitions)) + "\n"


def _resolve(schema: Schema, definitions: Schema) -> Schema:
    """The schema a `$ref` stands for, with the model's own description."""
    if "$ref" not in schema:
        return schema
    return schema | _resolve(definitions[schema["$ref"].rsplit("/", 1)[1]], definitions)


def _alternatives(schema: Schema, definitions: Schema) -> list[Schema]:
    """What a value may be: every branch of anyOf/oneOf, `null` left away."""
    schema = _resolve(schema, definitions)
    if "x-kind" in schema or not ("anyOf" in schema or "oneOf" in schema):
        return [schema]
    branches = schema.get("anyOf", []) + schema.get("oneOf", [])
    found = [choice for branch in branches for choice in _alternatives(branch, definitions)]
    return [choice for choice in found if choice.get("type") != "null"]


def _sections(
    schema: Schema, path: str, definitions: Schema, *, array: bool = False
) -> Iterator[str]:
    """The section of a table, then those of the tables in it."""
    rows, inner = [], []
    meanings = described(schema)[1]
    for name, raw in schema.get("properties", {}).items():
        where = f"{path}.{name}" if path else name
        choices = _alternatives(raw, definitions)
        tables = [(choice, False) for choice in choices if "properties" in choice]
        tables += [
            (item, True)
            for choice in choices
            if choice.get("type") == "array"
            for item in _alternatives(choice.get("items", {}), definitions)
            if "properties" in item
        ]
        inner += [(where, *table) for table in tables]
        if path and name == "kind" and "const" in raw:
            continue  # the heading says it
        row = {"description": meanings.get(name, "")} | raw
        rows.append(_row(name, row, choices, where, name in schema.get("required", [])))
    yield _heading(schema, path, array) + (_table(rows) if rows else "")
    for where, table, is_array in inner:
        yield from _sections(table, where, definitions, array=is_array)


def _heading(schema: Schema, path: str, array: bool) -> str:
    text, _ = described(schema)
    title = f"`[[{path}]]`" if array else f"`[{path}]`" if path else "Top of the file"
    kind = schema.get("properties", {}).get("kind", {})
    if path and "const" in kind:
        title += f' with `kind = "{kind["const"]}"`'
    return f"### {title}\n\n" + (f"{text}\n\n" if text else "")


def _table(rows: list[str]) -> str:
    return "\n".join(["| key | value | default | meaning |", "|---|---|---|---|", *rows])


def _row(name: str, raw: Schema, choices: list[Schema], where: str, required: bool) -> str:
    kinds = dict.fromkeys(_kind_of_value(choice, where) for choice in choices)
    default = "**required**" if required else _default(raw, choices)
    meaning = raw["description"] or ("" if "properties" in choices[0] else described(choices[0])[0])
    cells = [f"`{name}`", " or ".join(kinds), default, " ".join(meaning.split())]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _kind_of_value(choice: Schema, where: str) -> str:
    if "x-kind" in choice:
        kind = KINDS[choice["x-kind"]]
        return f'{kind.name.replace("_", " ")}, `"{kind.example}"`'
    if "const" in choice:
        return f"`{json.dumps(choice['const'])}`"
    if "enum" in choice:
        return ", ".join(f"`{json.dumps(value)}`" for value in choice["enum"])
    if "properties" in choice:
        return f"table `[{where}]`"
    if choice.get("type") == "array":
        items = choice.get("items") or {}
        if "prefixItems" in choice:
            entries = dict.fromkeys(_kind_of_value(entry, where) for entry in choice["prefixItems"])
            return f"list of {len(choice['prefixItems'])}: " + ", ".join(entries)
        return "list of tables" if "$ref" in items else f"list of {_kind_of_value(items, where)}"
    words = {"boolean": "true or false", "integer": "whole number", "string": "text"}
    kind = str(choice.get("type", "any"))
    return words.get(kind, kind)


def _default(raw: Schema, choices: list[Schema]) -> str:
    if "default" not in raw:
        return "see its table"
    value = raw["default"]
    if value is None:
        return "none"
    if isinstance(value, dict):
        return "see its table"
    return f"`{_shown(value, choices[0])}`"


def _shown(value: Any, schema: Schema) -> str:
    """A default as one would write it in the file."""
    unit = schema.get("x-unit", "1")
    if isinstance(value, list):
        entries = schema.get("prefixItems") or [schema.get("items", {})] * len(value)
        shown = (_shown(*pair) for pair in zip(value, entries, strict=True))
        return f"[{', '.join(shown)}]"
    if unit != "1" and isinstance(value, int | float):
        return f'"{format_quantity(value, unit, digits=12)}"'
    return json.dumps(value, ensure_ascii=False)
