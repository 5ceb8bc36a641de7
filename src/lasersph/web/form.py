"""A case while it is typed: the fields of a shipped case with units and help, checks, forecast."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from lasersph.case import Case, available_cases, load_case, refuse_if_too_large
from lasersph.case.loading import CaseFile
from lasersph.case.size import Size, in_words
from lasersph.compute.threads import chosen
from lasersph.input import CaseError, dotted, format_duration, format_quantity
from lasersph.input.schema import Schema
from lasersph.simulation import forecast

MOST_SETTINGS = 200


def form_of(name: str) -> dict[str, Any]:
    """Fields of a shipped case: key, value as written, unit, help, choices; empty where not given.

    Raises KeyError where no case of this name is shipped.
    """
    data = CaseFile(available_cases()[name]).document.data
    schema = Schema(Case)
    fields = [_field(schema, path, data, value) for path, value in _given(data)]
    known = {field["key"] for field in fields}
    for table in {path[:-1]: None for path, _ in _given(data)}:
        for key in schema.keys(table, data):
            field = _field(schema, (*table, key), data, "")
            if field["key"] not in known and (field["kind"] or field["choices"]):
                fields.append(field)
    return {"case": name, "cases": sorted(available_cases()), "fields": fields}


def _given(data: dict[str, Any], above: tuple[str, ...] = ()) -> Iterator[tuple[tuple, Any]]:
    """Plain values of a case file with their paths; lists of tables are left out."""
    for key, value in data.items():
        if isinstance(value, dict):
            yield from _given(value, (*above, key))
        elif not isinstance(value, list) and key != "schema_version":
            yield (*above, key), value


def _field(schema: Schema, path: tuple, data: Any, value: Any) -> dict[str, Any]:
    parts = schema.parts(path, data)
    choices = [one for part in parts for one in part.get("enum", ())]
    if any(part.get("type") == "boolean" for part in parts):
        choices = ["true", "false"]
    first = {name: next((p[name] for p in parts if p.get(name)), "") for name in WORDS}
    return {
        "key": dotted(path),
        "value": str(value).lower() if isinstance(value, bool) else str(value),
        "help": first["description"],
        "unit": first["x-unit"],
        "kind": first["x-kind"],
        "choices": [str(one) for one in choices] if path[-1] != "kind" else [],
    }


WORDS = ("description", "x-unit", "x-kind")
"""What the schema says of a key."""


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
