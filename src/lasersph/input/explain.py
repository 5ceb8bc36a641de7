"""Building models from documents, and pydantic's errors in one clear line per problem."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from lasersph.input.document import Document
from lasersph.input.errors import CaseError, Problem
from lasersph.input.key_lines import Path
from lasersph.input.model import nearest

M = TypeVar("M", bound=BaseModel)

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


def build(model: type[M], document: Document, context: dict[str, Any] | None = None) -> M:
    """Validate a document as a model, with units required on every quantity.

    Args:
        model: the class to build.
        document: from `read_toml` or `parse_toml`.
        context: pydantic's validation context, for validators that look beyond the data.

    Raises:
        CaseError: one problem per mistake, with file, line and key.
    """
    try:
        context = {"strict_units": True, **(context or {})}
        return model.model_validate(document.data, context=context)
    except ValidationError as error:
        raise CaseError(_placed_elsewhere(explain(error, document), model)) from None
    except RecursionError:
        raise CaseError("brackets nested too deeply", file=document.file) from None


def explain(error: ValidationError, document: Document) -> list[Problem]:
    """Turn every error of pydantic into a `Problem` with the place of its key."""
    problems: dict[str, Problem] = {}
    for each in error.errors(include_url=False):
        cause = (each.get("ctx") or {}).get("error")
        if isinstance(cause, CaseError):
            problems.update((str(p), p) for p in _foreign(cause, each["loc"], document))
            continue
        for path, text, hint in _say(dict(each), document):
            file, line = document.place(path)
            problem = Problem(text, hint, dotted(path), file, line)
            problems.setdefault(str(problem), problem)
    return sorted(problems.values(), key=lambda problem: problem.line or 0)


def _foreign(cause: CaseError, location: tuple[Any, ...], document: Document) -> list[Problem]:
    """Problems of another file, or of the key that names it."""
    path = _data_path(location, document.data, "")
    file, line = document.place(path)
    return [
        problem if problem.line else replace(problem, key=dotted(path), file=file, line=line)
        for problem in (
            replace(p, problem=f"{p.file}: {p.problem}") if p.file and not p.line else p
            for p in cause.problems
        )
    ]


def _placed_elsewhere(problems: list[Problem], model: type[BaseModel]) -> list[Problem]:
    """Unknown keys that belong into another table are sent there."""
    if not any(problem.problem == "unknown key" for problem in problems):
        return problems
    keys = _all_keys(model.model_json_schema())
    return [
        replace(problem, hint=hint)
        if problem.problem == "unknown key"
        and not problem.hint.startswith("do you mean")
        and (hint := _hint_at_place(problem.key, keys))
        else problem
        for problem in problems
    ]


def _hint_at_place(key: str, keys: dict[str, list[str]]) -> str:
    """Where a key belongs: into another table, or to another kind of its own table."""
    if keys.get(key):
        return "belongs to " + " or ".join(f'kind = "{kind}"' for kind in keys[key])
    place = _place_of(key.rpartition(".")[2], list(keys))
    return f'do you mean "{place}"?' if place else ""


def _place_of(key: str, keys: list[str]) -> str | None:
    """The full key whose last part is nearest, or None."""
    last = {known.rpartition(".")[2]: known for known in reversed(keys)}
    near = nearest(key, last)
    return last[near] if near else None


def _all_keys(schema: dict[str, Any]) -> dict[str, list[str]]:
    """Every dotted key of a JSON Schema, the outer ones first, with the kinds that have it."""
    definitions: dict[str, Any] = schema.get("$defs", {})
    found: dict[str, list[str]] = {}
    waiting = [("", schema)]
    while waiting:
        path, part = waiting.pop(0)
        if "$ref" in part:
            part = definitions[part["$ref"].rpartition("/")[2]]
        branches = [*part.get("anyOf", ()), *part.get("oneOf", ()), *part.get("allOf", ())]
        waiting += [(path, branch) for branch in branches]
        properties = part.get("properties", {})
        kind = properties.get("kind", {}).get("const")
        for name, value in properties.items():
            where = f"{path}.{name}" if path else name
            if where.count(".") < 5:
                found.setdefault(where, [])
                found[where] += [kind] if kind else []
                waiting.append((where, value))
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


def _say(error: dict[str, Any], document: Document) -> list[tuple[Path, str, str]]:
    """(path, what is wrong, what would be right) of one pydantic error."""
    kind, context = error["type"], error.get("ctx") or {}
    path = _data_path(error["loc"], document.data, kind)
    given = _shown(document.at(path))
    if kind == "unknown_keys":
        return [_unknown(path, key, context["known"]) for key in context["keys"]]
    if kind == "extra_forbidden":
        return [_unknown(path[:-1], str(path[-1]), [])]
    if kind == "at_key":
        found = ((key, *text.partition("; ")) for key, text in context["problems"])
        return [((*path, *_steps(key)), text, hint) for key, text, _, hint in found]
    if kind == "missing":
        return [(path, "missing", "")]
    if kind == "quantity":
        return [(path, context["message"], "")]
    if kind in _BOUNDS:
        words, bound = _BOUNDS[kind]
        return [(path, f"must be {words} {_number(context[bound])}, got {given}", "")]
    if kind in ("literal_error", "enum"):
        return [(path, *_choice(given, str(context.get("expected", ""))))]
    if kind == "union_tag_invalid":
        return [((*path, _tag(context)), *_choice(f'"{context["tag"]}"', context["expected_tags"]))]
    if kind == "union_tag_not_found":
        return [((*path, _tag(context)), "missing", "")]
    if kind in ("too_short", "too_long", "string_too_short", "string_too_long"):
        return [(path, error["msg"][0].lower() + error["msg"][1:], "")]
    if kind in _EXPECTED:
        return [(path, f"must be {_EXPECTED[kind]}, got {given}", "")]
    if kind in ("value_error", "assertion_error"):
        text, _, hint = str(context.get("error", error["msg"])).partition("; ")
        return [(path, text, hint)]
    return [(path, error["msg"], "")]


def _unknown(table: Path, key: str, known: list[str]) -> tuple[Path, str, str]:
    near = nearest(key, known)
    hint = f'do you mean "{near}"?' if near else ""
    if not near and 0 < len(known) <= 12:
        hint = "known here: " + ", ".join(known)
    return (*table, key), "unknown key", hint


def _data_path(location: tuple[Any, ...], data: Any, kind: str) -> Path:
    """pydantic's location without the steps that are not keys (union tags, validator names)."""
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


def _steps(key: str) -> Path:
    """The path of a key as `dotted` writes it."""
    steps = re.findall(r"([^.\[\]]+)|\[(\d+)\]", key)
    return tuple(name or int(index) - 1 for name, index in steps)


def _tag(context: dict[str, Any]) -> str:
    return str(context.get("discriminator", "kind")).strip("'()")


def _choice(given: str, expected: str) -> tuple[str, str]:
    """Text for a word that is none of the allowed ones."""
    choices = [word.strip().strip("'\"") for word in expected.replace(" or ", ", ").split(",")]
    near = nearest(given.strip('"'), choices)
    listed = " or ".join(f'"{word}"' for word in choices)
    hint = f'do you mean "{near}"?' if near else ""
    return f"must be {listed}, got {given}", hint


def _number(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


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
