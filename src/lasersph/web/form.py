"""A case while it is typed: its fields with units and help, checks, forecast."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isfinite
from typing import Any

from lasersph.case import Case, available_cases, load_case
from lasersph.case.loading import CaseFile
from lasersph.case.overrides import override
from lasersph.case.size import in_words, memories
from lasersph.compute.threads import chosen
from lasersph.input import CaseError, dotted, format_duration, format_quantity
from lasersph.input.key_lines import Path
from lasersph.input.quantity import kind_of
from lasersph.input.schema import Schema, as_toml
from lasersph.input.shown_unit import number_and_unit
from lasersph.input.units import UnitError, parse_unit
from lasersph.simulation.acceptance import accepted_forecast
from lasersph.web.case_source import CaseSource
from lasersph.web.changes import units_written

MOST_SETTINGS = 200


def form_of(source: CaseSource, settings: Sequence[str] = ()) -> dict[str, Any]:
    """Fields of a case: key, value with settings, value as given in its file, unit, help, choices;
    empty where not given.

    Units are those in which the case is written. A field whose key takes a list has a `list` as
    well, see `_list`. `is_left` is true of a key of the file that the kind of its table, which a
    setting has changed, does not have.

    Raises:
        CaseError: the file is no case, or a setting is not KEY=VALUE.
    """
    document = CaseFile(source.path).document
    fields = _Fields(document.data, override(document, settings).data)
    return {
        "name": source.name,
        "settings": list(source.settings),
        "cases": sorted(available_cases()),
        "fields": fields.all(),
    }


class _Fields:
    """The keys of a case with what its file says and what is set."""

    def __init__(self, written: dict[str, Any], data: dict[str, Any]) -> None:
        """Take the data of the file, and those with settings."""
        self._schema, self._data = Schema(Case), data
        self._written, self._now = dict(_given(written)), dict(_given(data))
        self._whole = written
        kinds: dict[str, str] = {}
        for unit in units_written(written):
            if kind := kind_of(parse_unit(unit)) if _is_unit(unit) else None:
                kinds.setdefault(kind.unit, unit)
        self._units = kinds

    def all(self) -> list[dict[str, Any]]:
        """Given keys, then those that may be given beside them."""
        paths = dict.fromkeys([*self._now, *self._written])
        fields = [self._field(path) for path in paths if not self._is_table(path)]
        known = {field["key"] for field in fields}
        for table in {path[:-1]: None for path in self._now}:
            for key in self._schema.keys(table, self._data):
                field = self._field((*table, key))
                is_plain = field["kind"] or field["choices"] or "list" in field
                if field["key"] not in known and is_plain:
                    fields.append(field)
        return fields

    def _is_table(self, path: Path) -> bool:
        """Whether a word of the file, as the name of a material, has become a table."""
        value: Any = self._data
        for step in path:
            value = value.get(step) if isinstance(value, dict) else None
        return isinstance(value, dict)

    def _field(self, path: Path) -> dict[str, Any]:
        schema, data = self._schema, self._data
        now, written = self._now.get(path, ""), self._written.get(path, "")
        field: dict[str, Any] = {
            "key": dotted(path),
            "value": _text(now),
            "given": _text(written),
            **_told(schema, path, data),
        }
        field["unit"] = self._unit(field["unit"], field["value"] or field["given"])
        is_known = bool(schema.parts(path, data))
        field["is_left"] = not is_known and bool(schema.parts(path, self._whole))
        if any(part.get("type") == "array" for part in schema.parts(path, data)):
            found = _list(schema, path, data, now or [])
            found["given"] = _list(schema, path, data, written or [])["rows"]
            for place, column in enumerate(found["columns"]):
                cells = (row[place] for row in found["rows"])
                column["unit"] = self._unit(column["unit"], next(filter(None, cells), ""))
            field |= {"value": "", "given": "", "list": found}
            field["help"] = field["help"] or schema.meaning((*path, 0), data)
        return field

    def _unit(self, si: str, text: str) -> str:
        """The unit of a field: that of its value, else that of others of its kind, else of SI."""
        own = number_and_unit(text)[1] if si else ""
        return own if own and _is_unit(own) else self._units.get(si, si)


def _given(data: dict[str, Any], above: tuple[str, ...] = ()) -> Iterator[tuple[Path, Any]]:
    """Values and lists of a case file with their paths."""
    for key, value in data.items():
        if isinstance(value, dict):
            yield from _given(value, (*above, key))
        elif key != "schema_version":
            yield (*above, key), value


def _is_unit(text: str) -> bool:
    try:
        parse_unit(text)
    except UnitError:
        return False
    return True


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


def checked(source: CaseSource, settings: Sequence[str]) -> dict[str, Any]:
    """Answer of `lasersph check` to a case with settings: problems by key and line, or the
    forecast with its warnings."""
    try:
        case = load_case(source.path, settings)
        threads = chosen(None)
        expected = accepted_forecast(case, threads=threads)
    except CaseError as error:
        problems = [
            {
                "key": one.key,
                "line": one.line,
                "text": "; ".join(filter(None, (one.problem, one.hint))),
            }
            for one in error.problems
        ]
        return {"problems": problems, "forecast": [], "warnings": []}
    there = [words.format(in_words(most)) for words, most in memories("cpu") if isfinite(most)]
    rows = [
        ("particles", str(expected.particles)),
        ("memory", ", ".join([f"about {in_words(expected.memory)}", *there])),
        ("steps", f"about {expected.steps} to {format_quantity(case.time.end, 's')}"),
        ("time", f"roughly {format_duration(expected.wall_time)} on {threads} threads"),
    ]
    return {"problems": [], "forecast": rows, "warnings": list(expected.warnings)}
