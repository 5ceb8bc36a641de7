"""docs/keys.md: tables of every key of a case file, from the JSON Schema of `lasersph.case.Case`.

One section a table of the file, in the order of the model. Where a table is one of several models
told apart by `kind`, each has a section of its own. Nothing is written twice: names, types,
defaults, units and descriptions all come from the models.

    python docs/_extensions/case_keys.py        # writes docs/keys.md anew
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lasersph.case import Case
from lasersph.input import KINDS, Density, format_quantity
from lasersph.input.schema import described
from lasersph.materials.optics import SpectralOptics
from lasersph.materials.property import Property
from lasersph.materials.surface_tension import SulfurAdsorption

PAGE = Path(__file__).resolve().parents[1] / "keys.md"
HEAD = """# Every key

All keys of a [case file](cases.md), table by table. *Value* shows the kind of a value with an \
example: a quantity is text with a unit, and any unit of its kind will do. *Default* is what holds \
where a key is left out. `python docs/_extensions/case_keys.py` writes this page from the models \
that read a case.

"""
LAW = "[law](#a-property-as-a-law)"
"""Stands beside each property of a material: how it may depend on temperature."""
LAW_HEAD = """## A property as a law

Where a property of `[material]` depends on temperature, a table stands for the number:

```toml
[material]
base = "steel-304"
viscosity = { table = [["1700 K", "6 mPa s"], ["3000 K", "2 mPa s"]], source = "my measurement" }
```

*Quantity* is one of the property's kind; a case may leave the source out, a material file may not.

"""
INNER = {
    "material.surface_tension.adsorption": SulfurAdsorption,
    'material.optics.by_wavelength."1064 nm"': SpectralOptics,
}
"""Tables inside those of a material."""
DEFAULT = re.compile(r"(?:^|; )default:? ((?:\([^)]*\)|; else|[^;(])+)")
"""What a description says of the default, to the next semicolon that is neither in brackets nor
before an else: it goes into the column of defaults."""

Schema = dict[str, Any]


def keys_page() -> str:
    """All of docs/keys.md."""
    parts = [case_keys(Case.model_json_schema())]
    for path, model in INNER.items():
        schema = model.model_json_schema()
        parts += _sections(schema, path, schema.get("$defs", {}))
    law = Property[Density].model_json_schema()
    parts.append(LAW_HEAD + _table(list(_law_rows(law))))
    return HEAD + "\n\n".join(part.rstrip() for part in parts) + "\n"


def case_keys(schema: Schema) -> str:
    """The sections for all keys of a case file."""
    definitions = schema.get("$defs", {})
    return "\n\n".join(_sections(schema, "", definitions)) + "\n"


def _law_rows(schema: Schema) -> Iterator[str]:
    """The keys of a law, which has the kind of its property in place of a kind of its own."""
    definitions = schema.get("$defs", {})
    for name, raw in schema["properties"].items():
        choices = _alternatives(raw, definitions)
        row = _row(name, raw, choices, f"material.viscosity.{name}", False)
        yield re.sub(r'density, `"[^"]*"`', "quantity", row)


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
        if path not in INNER:
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
    return f"## {title}\n\n" + (f"{text}\n\n" if text else "")


def _table(rows: list[str]) -> str:
    return "\n".join(["| key | value | default | meaning |", "|---|---|---|---|", *rows])


def _row(name: str, raw: Schema, choices: list[Schema], where: str, required: bool) -> str:
    example = {"examples": raw["examples"]} if raw.get("examples") else {}
    kinds = dict.fromkeys(_kind_of_value(choice | example, where) for choice in choices)
    meaning = raw["description"] or ("" if "properties" in choices[0] else described(choices[0])[0])
    meaning = " ".join(meaning.split())
    said = DEFAULT.search(meaning)
    if "x-needed" in raw:
        default = _default_of_material(raw, said)
    elif required:
        default = "**required**"
    else:
        default = said[1] if said else _default(raw, choices)
    if said and not required:
        meaning = (meaning[: said.start()] + meaning[said.end() :]).removeprefix("; ")
    cells = [f"`{name}`", " or ".join(kinds), default, meaning]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _default_of_material(raw: Schema, said: re.Match[str] | None) -> str:
    """Default where a table of a material leaves a key out: the number of the base."""
    if raw["x-needed"]:
        return "that of `base`; **required** without"
    other = f"`{_shown(raw['x-default'], raw)}`" if "x-default" in raw else "none"
    return f"that of `base`, else {said[1] if said else other}"


def _kind_of_value(choice: Schema, where: str) -> str:
    if "x-kind" in choice:
        kind = KINDS[choice["x-kind"]]
        example = next(iter(choice.get("examples", ())), kind.example)
        text = f'{kind.name.replace("_", " ")}, `"{example}"`'
        return f"{text}, or a {LAW}" if choice.get("x-law") else text
    if "x-value" in choice:
        return choice["x-value"]
    if "const" in choice:
        return f"`{json.dumps(choice['const'])}`"
    if "enum" in choice:
        return ", ".join(f"`{json.dumps(value)}`" for value in choice["enum"])
    if "properties" in choice:
        if "polynomial" in choice["properties"] and not where.startswith("material.viscosity."):
            value = choice["properties"]["value"]["anyOf"][0]
            return f"{_kind_of_value(value, where)}, or a {LAW}"
        return f"table `[{where}]`"
    if choice.get("type") == "array":
        items = choice.get("items") or {}
        if "prefixItems" in choice:
            entries = dict.fromkeys(_kind_of_value(entry, where) for entry in choice["prefixItems"])
            return f"list of {len(choice['prefixItems'])}: " + ", ".join(entries)
        return "list of tables" if "$ref" in items else f"list of {_kind_of_value(items, where)}"
    words = {
        "boolean": "true or false",
        "integer": "whole number",
        "string": "text",
        "object": "table",
    }
    return words.get(str(choice.get("type")), str(choice["type"]))


def _default(raw: Schema, choices: list[Schema]) -> str:
    value = raw.get("default")
    if value is None or value == "":
        return "none"
    if isinstance(value, dict):
        plain = choices[0].get("enum", ())
        kind = value.get("kind")
        if kind in plain:
            return f'`"{kind}"`'
        return f'`{{ kind = "{kind}" }}`' if kind else "its keys' defaults"
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
    if isinstance(value, float):
        return json.dumps(float(f"{value:.6g}"))  # seven ninths has no end
    return json.dumps(value, ensure_ascii=False)


if __name__ == "__main__":
    PAGE.write_text(keys_page(), encoding="utf-8")
    print(f"wrote {PAGE}")
