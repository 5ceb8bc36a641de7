"""The page of numbers that are not physics, from the docstrings beside them.

A constant of a module, or a default of a setting, has a docstring below it: what it is with its
unit, then a kind of reason and the reason, "Least gap over the spacing [1]. Guard: rows would ...".
What a setting is says its description.
"""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from references_page import anchor, entries, short_name

from lasersph.plots import style

ROOMS = {
    "solvers": "Solvers",
    "sph": "Operators",
    "physics": "Physics",
    "boundaries": "Boundaries",
    "irradiation": "Light",
    "simulation": "Building, forecast and time loop",
}
"""Rooms whose numbers may change a result, with the heads of their tables."""
KINDS = {
    "Source": "printed in a paper or a standard",
    "Exact": "follows from a definition",
    "Derived": "follows from what is said",
    "Study": "measured, beside other values",
    "Stability": "a larger one lets errors grow",
    "Accuracy": "sets an error that is said",
    "Geometry": "follows from how particles lie",
    "Rounding": "tells what differs from what only rounds otherwise",
    "Guard": "ends or refuses what cannot be right, and changes no step that succeeds",
    "Format": "names something, or ends a table where nothing is",
    "Cost": "changes times, and results by rounding or within a tolerance",
    "Forecast": "is only what `lasersph check` estimates",
    "Display": "is only what is shown while a run goes on",
}
REASON = re.compile(rf"\b({'|'.join(KINDS)}): ")
CITATION = re.compile(r"\[([A-Z]\w+?\d{4})(?:, ([^\]]+))?\]")
CITATION_OR_SIGN = re.compile(rf"{CITATION.pattern}|([|*<>$\[\]^_])")
WORKS = entries((Path(__file__).parents[1] / "references.bib").read_text(encoding="utf-8"))
UNIT = re.compile(r" ?\[(?![A-Z]\w+?\d{4})([^\]]+)\]")


class Constant(NamedTuple):
    """A number of the code: file and names, its values, unit, what it is, kind of its reason, and
    the reason; empty where the docstring does not say."""

    file: str
    name: str
    values: list[float]
    unit: str
    meaning: str
    kind: str
    reason: str


def constants_of(package: Path, rooms: Iterable[str] = ROOMS) -> list[Constant]:
    """All numbers of some rooms, in the order of files and lines."""
    return [
        constant
        for room in rooms
        for path in sorted((package / room).rglob("*.py"))
        for constant in constants_in(
            ast.parse(path.read_text("utf-8")), path.relative_to(package).as_posix()
        )
    ]


def constants_in(tree: ast.Module, file: str = "") -> Iterator[Constant]:
    """Constants of a module, and defaults other than 0 and 1 of its models and functions."""
    for node, text in _with_docstrings(tree.body):
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]).isupper():
            target, values = node.targets[0], numbers_of(node.value)
            names = target.elts if isinstance(target, ast.Tuple) else [target]
            if values:
                yield _constant(file, ", ".join(map(ast.unparse, names)), values, text)
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            for line, text in _with_docstrings(node.body):
                if isinstance(line, ast.AnnAssign):
                    values = numbers_of(_keyword(line.value, "default") or line.value)
                    said = _keyword(line.value, "description")
                    name = f"{node.name}.{ast.unparse(line.target)}"
                    if set(values) - {0.0, 1.0}:
                        yield _constant(
                            file, name, values, text, ast.literal_eval(said) if said else ""
                        )
        elif isinstance(node, ast.FunctionDef):
            for name, default in _defaults(node.args):
                values = numbers_of(default)
                if set(values) - {0.0, 1.0}:
                    yield _constant(file, f"{node.name}({name})", values, "")


def numbers_of(node: ast.AST | None) -> list[float]:
    """Numbers that an expression holds; none where it holds anything but numbers."""
    try:
        value = ast.literal_eval(node) if node is not None else ()
    except ValueError:
        if isinstance(node, ast.BinOp):  # such as 1.0 - 1e-9
            parts = [numbers_of(side) for side in (node.left, node.right)]
            return [eval(ast.unparse(node))] if all(parts) else []
        return []
    items = value.values() if isinstance(value, dict) else value
    found = list(items) if isinstance(value, (tuple, dict)) else [value]
    return [float(one) for one in found] if all(type(one) in (int, float) for one in found) else []


def _constant(
    file: str, name: str, values: list[float], docstring: str, description: str = ""
) -> Constant:
    """The number with the parts of its docstring."""
    text = " ".join(docstring.split())
    found = REASON.search(text)
    meaning, reason = (text[: found.start()], text[found.end() :]) if found else (text, "")
    unit = UNIT.search(meaning)
    said = CITATION.sub("", description).replace(" ;", ";").strip()
    meaning = UNIT.sub("", meaning, count=1).strip(" .") or said[:1].upper() + said[1:]
    kind = found[1] if found else ""
    return Constant(file, name, values, unit[1] if unit else "1", meaning, kind, reason)


def _with_docstrings(body: list[ast.stmt]) -> Iterator[tuple[ast.stmt, str]]:
    """Statements, each with the docstring below it, if there is one."""
    for node, following in zip(body, [*body[1:], None], strict=True):
        is_text = isinstance(following, ast.Expr) and isinstance(following.value, ast.Constant)
        yield node, str(following.value.value) if is_text else ""  # type: ignore[union-attr]


def _keyword(call: ast.expr | None, name: str) -> ast.expr | None:
    """Value that `Field(name=...)` gives."""
    if isinstance(call, ast.Call) and ast.unparse(call.func) == "Field":
        return next((word.value for word in call.keywords if word.arg == name), None)
    return None


def _defaults(a: ast.arguments) -> list[tuple[str, ast.expr | None]]:
    """Arguments of a function that have a default."""
    last = (*a.posonlyargs, *a.args)[-len(a.defaults) :] if a.defaults else ()
    pairs = (*zip(last, a.defaults, strict=True), *zip(a.kwonlyargs, a.kw_defaults, strict=True))
    return [(argument.arg, default) for argument, default in pairs]


def constants_page(constants: Iterable[Constant]) -> str:
    """Meaning of the kinds of reasons, and a table a room, folded."""
    found = list(constants)
    parts = ["| kind | a number of it |", "|---|---|"]
    parts += [f"| *{kind}* | {text} |" for kind, text in KINDS.items()]
    for room, head in ROOMS.items():
        rows = [_row(one, room) for one in found if one.file.startswith(f"{room}/")]
        parts += ["", f"## {head}", "", f"<details><summary>{len(rows)} rows</summary>", ""]
        parts += ["| number | value | unit | what and why |", "|---|---|---|---|", *rows]
        parts += ["", "</details>"]
    return "\n".join(parts) + "\n"


def _row(one: Constant, room: str) -> str:
    """A row of the table."""
    place = one.file.removeprefix(f"{room}/")
    values = ", ".join(f"{value:.13g}" for value in one.values)
    said = f"{_prose(one.meaning)}. *{one.kind}*: {_prose(one.reason)}"
    unit = "" if one.unit == "1" else _prose(one.unit)
    return f"| `{place}: {one.name}` | {values} | {unit} | {said} |"


def _prose(text: str) -> str:
    """A docstring as Markdown: citations as links, and no bar that would end a cell."""

    def written(found: re.Match[str]) -> str:
        key, equation, sign = found.groups()
        # a sign of Markdown stands for itself
        if sign:
            return f"\\{sign}"
        link = f"[{short_name(WORKS[key])}](../references.md#{anchor(key)})"
        return link + (f", {equation}" if equation else "")

    parts = text.split("`")
    plain = (CITATION_OR_SIGN.sub(written, part) for part in parts[::2])
    code = iter(parts[1::2])
    return "".join(part + (f"`{inner}`" if (inner := next(code, "")) else "") for part in plain)


def draw_kinds(constants: Iterable[Constant], file: Path) -> None:
    """How many numbers there are of each kind of reason."""
    counts = Counter(one.kind for one in constants for _ in one.values)
    figure, (axes,) = style.new_figure(height=3.4)
    names = list(KINDS)[::-1]
    bars = axes.barh(names, [counts[name] for name in names], color=style.COLORS[0])
    axes.bar_label(bars, padding=3, fontsize=9)
    axes.grid(False, axis="y")
    style.label(axes, "constants and defaults", "")
    figure.savefig(file)
