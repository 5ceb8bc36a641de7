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
from lasersph.simulation.acceptance import accepted_forecast, refuse_unresolved
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
    # The file as written, and the same with settings.
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
        # Units that the file uses, by the SI unit that they stand for.
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
        # Given keys in their order, then those that their tables may have as well.
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
        # What the schema says of the key, with the value and the unit in which it is written.
        schema, data = self._schema, self._data
        now, written = self._now.get(path, ""), self._written.get(path, "")
        field: dict[str, Any] = {
            "key": dotted(path),
            "value": _text(now),
            "given": _text(written),
            **_key_description(schema, path, data),
        }
        field["unit"] = self._unit(field["unit"], field["value"] or field["given"])
        # A key that another kind of its table had is left over.
        is_known = bool(schema.parts(path, data))
        field["is_left"] = not is_known and bool(schema.parts(path, self._whole))
        # Lists have rows and columns, each column a unit of its own.
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
        # Its own unit first, then that of the file for this kind.
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


def _key_description(schema: Schema, path: Path, data: Any) -> dict[str, Any]:
    """Description of a key by its schema: help, unit, kind, choices, and whether a number or a text
    may stand there."""
    # Choices are words, or true and false.
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
    # The shape of the list, from what the schema allows inside.
    array = next(part for part in schema.parts(path, data) if part.get("type") == "array")
    inside: Path = (*path, 0)
    item = schema.parts(inside, data)
    if "prefixItems" in array:
        shape = "row"
        places = [(*path, k) for k in range(array["maxItems"])]
        rows = [value]
    elif names := schema.keys(inside, data):
        shape, places = "tables", [(*inside, name) for name in names]
        rows = [[one.get(name, "") for name in names] for one in value]
    elif row := next((part["prefixItems"] for part in item if "prefixItems" in part), None):
        shape = "rows"
        places = [(*inside, k) for k in range(len(row))]
        rows = value
    else:
        shape = "values"
        places = [inside]
        rows = [[one] for one in value]
    columns = [
        {"name": place[-1] if shape == "tables" else "", **_key_description(schema, place, data)}
        for place in places
    ]

    # An empty row stands for a list that must have one.
    filled = rows if any(rows) else [[""] * len(places)] if shape == "row" else []
    return {
        "shape": shape,
        "columns": columns,
        "rows": [[_text(one) for one in row] for row in filled],
    }


def _from_browser(text: str, source: CaseSource) -> str:
    """A problem without the folder into which a text was written, beside which no file lies."""
    folder = f"{source.path.parent}/"
    if source.kept is None or folder not in text:
        return text
    return f"{text.replace(folder, '')} here: write its whole path"


def checked(source: CaseSource, settings: Sequence[str]) -> dict[str, Any]:
    """Answer of `lasersph check` to a case with settings: problems by key and line, or the
    forecast with its warnings."""
    # The same checks as `lasersph check`, problems by their keys.
    try:
        case = load_case(source.path, settings)
        threads = chosen(None)
        expected = accepted_forecast(case, threads=threads)
        refuse_unresolved(expected.flow)
    except CaseError as error:
        problems = [
            {
                "key": one.key,
                "line": one.line,
                "text": _from_browser("; ".join(filter(None, (one.problem, one.hint))), source),
            }
            for one in error.problems
        ]
        return {"problems": problems, "forecast": [], "warnings": []}
    # The forecast in four rows.
    there = [words.format(in_words(most)) for words, most in memories("cpu") if isfinite(most)]
    counted = f"{threads} thread{'s' * (threads > 1)}"
    rows = [
        ("particles", str(expected.particles)),
        ("memory", ", ".join([f"about {in_words(expected.memory)}", *there])),
        ("steps", f"about {expected.steps} to {format_quantity(case.time.end, 's')}"),
        ("time", f"roughly {format_duration(expected.wall_time)} on {counted}"),
    ]
    return {"problems": [], "forecast": rows, "warnings": list(expected.warnings)}
