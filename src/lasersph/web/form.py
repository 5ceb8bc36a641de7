"""A case while it is typed: the fields of a shipped case with units and help, checks, forecast."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from lasersph.case import Case, available_cases, load_case, refuse_if_too_large
from lasersph.case.loading import CaseFile
from lasersph.case.overrides import override
from lasersph.case.size import Size, in_words
from lasersph.compute.threads import chosen
from lasersph.input import CaseError, dotted, format_duration, format_quantity
from lasersph.input.key_lines import Path
from lasersph.input.schema import Schema, as_toml
from lasersph.simulation import forecast

MOST_SETTINGS = 200


def form_of(name: str, settings: Sequence[str] = ()) -> dict[str, Any]:
    """Fields of a shipped case: key, value as written, unit, help, choices; empty where not given.

    A field whose key takes a list has a `list` as well, see `_list`. `is_known` is false of a key
    that the kind of its table, which a setting may have changed, does not have.

    Raises:
        KeyError: no case of this name is shipped. CaseError: a setting is not KEY=VALUE.
    """
    data = override(CaseFile(available_cases()[name]).document, settings).data
    schema = Schema(Case)
    given = list(_given(data))
    fields = [_field(schema, path, data, value) for path, value in given]
    known = {field["key"] for field in fields}
    for table in {path[:-1]: None for path, _ in given}:
        for key in schema.keys(table, data):
            field = _field(schema, (*table, key), data, "")
            is_plain = field["kind"] or field["choices"] or "list" in field
            if field["key"] not in known and is_plain:
                fields.append(field)
    return {"case": name, "cases": sorted(available_cases()), "fields": fields}


def _given(data: dict[str, Any], above: tuple[str, ...] = ()) -> Iterator[tuple[tuple, Any]]:
    """Values and lists of a case file with their paths."""
    for key, value in data.items():
        if isinstance(value, dict):
            yield from _given(value, (*above, key))
        elif key != "schema_version":
            yield (*above, key), value


def _field(schema: Schema, path: Path, data: Any, value: Any) -> dict[str, Any]:
    field = {"key": dotted(path), "value": _text(value), **_told(schema, path, data)}
    field["is_known"] = bool(schema.parts(path, data))
    if any(part.get("type") == "array" for part in schema.parts(path, data)):
        field |= {"value": "", "list": _list(schema, path, data, value or [])}
        field["help"] = field["help"] or schema.meaning((*path, 0), data)
    return field


def _told(schema: Schema, path: Path, data: Any) -> dict[str, Any]:
    """What the schema says of a key: help, unit, kind, choices, whether a number may stand there
    and whether a text may."""
    parts = schema.parts(path, data)
    choices = [str(one) for part in parts for one in part.get("enum", ())]
    if any(part.get("type") == "boolean" for part in parts):
        choices = ["true", "false"]
    first = {name: next((p[name] for p in parts if p.get(name)), "") for name in UNIT}
    types = {part.get("type") for part in parts}
    return {
        "help": schema.meaning(path, data),
        "unit": first["x-unit"],
        "kind": first["x-kind"],
        "choices": schema.kinds(path[:-1], "kind") if path[-1] == "kind" else choices,
        "is_text": bool(types & {"string", None}),
        "is_number": bool(types & {"number", "integer"}),
    }


UNIT = ("x-unit", "x-kind")
"""By which the schema says what a quantity is."""


def _text(value: Any) -> str:
    return value if isinstance(value, str) else as_toml(value)


def _list(schema: Schema, path: Path, data: Any, value: list[Any]) -> dict[str, Any]:
    """A list as rows of cells.

    Returns:
        `shape`: "tables", a row each; "rows", lists of a length; "values", a cell each; "row", one
        list of a length. `columns`: `name`, and what the schema says of each. `rows`: texts.
    """
    array = next(part for part in schema.parts(path, data) if part.get("type") == "array")
    inside: Path = (*path, 0)
    item = schema.parts(inside, data)
    if "prefixItems" in array:
        shape, places, rows = "row", [(*path, k) for k in range(array["maxItems"])], [value]
    elif names := schema.keys(inside, data):
        shape, places = "tables", [(*inside, name) for name in names]
        rows = [[one.get(name, "") for name in names] for one in value]
    elif row := next((part["prefixItems"] for part in item if "prefixItems" in part), None):
        shape, places, rows = "rows", [(*inside, k) for k in range(len(row))], value
    else:
        shape, places, rows = "values", [inside], [[one] for one in value]
    columns = [
        {"name": place[-1] if shape == "tables" else "", **_told(schema, place, data)}
        for place in places
    ]
    filled = rows if any(rows) else [[""] * len(places)] if shape == "row" else []
    return {
        "shape": shape,
        "columns": columns,
        "rows": [[_text(one) for one in row] for row in filled],
    }


def checked(name: str, settings: Sequence[str]) -> dict[str, Any]:
    """What `lasersph check` says of a case with settings: problems by key, or the forecast.

    Raises KeyError where no case of this name is shipped.
    """
    available_cases()[name]
    try:
        case = load_case(name, settings)
        refuse_if_too_large(case)
        threads = chosen(None)
        expected = forecast(case, threads=threads)
        refuse_if_too_large(case, "cpu", Size(expected.particles, expected.memory))
    except CaseError as error:
        problems = [
            {"key": one.key, "text": "; ".join(filter(None, (one.problem, one.hint)))}
            for one in error.problems
        ]
        return {"problems": problems, "forecast": [], "warnings": []}
    rows = [
        ("particles", str(expected.particles)),
        ("memory", in_words(expected.memory)),
        ("steps", f"about {expected.steps} to {format_quantity(case.time.end, 's')}"),
        ("time", f"roughly {format_duration(expected.wall_time)} on {threads} threads"),
    ]
    return {"problems": [], "forecast": rows, "warnings": list(expected.warnings)}
