"""Every number that solvers and physics contain stands in `docs/methods/numbers.md` with a reason.

Looked at are constants of modules, defaults of settings and defaults of arguments; none of them
may be missing in the table, have another value there, or be there without being in the code.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "lasersph"
PAGE = ROOT / "docs" / "methods" / "numbers.md"
ROOMS = ("solvers", "sph", "physics", "boundaries", "irradiation", "simulation")
ROW = re.compile(r"^\| `(?P<key>[^`]+)` \| (?P<value>[^|]+) \| (?P<reason>[^|]+) \|$", re.MULTILINE)


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


def default_of(call: ast.expr | None) -> ast.expr | None:
    """What `Field(default=...)` says."""
    if isinstance(call, ast.Call) and ast.unparse(call.func) == "Field":
        return next((word.value for word in call.keywords if word.arg == "default"), None)
    return None


def in_file(tree: ast.Module) -> dict[str, list[float]]:
    """Constants of the module and defaults other than 0 and 1 of its models and functions."""
    found: dict[str, list[float]] = {}
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]).isupper():
            names, values = node.targets[0], numbers_of(node.value)
            if isinstance(names, ast.Tuple) and values:
                found |= {ast.unparse(n): [v] for n, v in zip(names.elts, values, strict=True)}
            elif values:
                found[ast.unparse(names)] = values
    for node in ast.walk(tree):
        pairs: list[tuple[str, ast.expr | None]] = []
        if isinstance(node, ast.ClassDef):
            pairs = [
                (f"{node.name}.{ast.unparse(line.target)}", default_of(line.value) or line.value)
                for line in node.body
                if isinstance(line, ast.AnnAssign)
            ]
        elif isinstance(node, ast.FunctionDef):
            a = node.args
            last = (*a.posonlyargs, *a.args)[-len(a.defaults) :] if a.defaults else ()
            given = (
                *zip(last, a.defaults, strict=True),
                *zip(a.kwonlyargs, a.kw_defaults, strict=True),
            )
            pairs = [(f"{node.name}({one.arg})", default) for one, default in given]
        values = {name: numbers_of(default) for name, default in pairs}
        found |= {name: v for name, v in values.items() if v and set(v) - {0.0, 1.0}}
    return found


def in_code() -> dict[str, list[float]]:
    """Numbers by "file: name"."""
    found = {}
    for room in ROOMS:
        for path in sorted((PACKAGE / room).rglob("*.py")):
            name = path.relative_to(PACKAGE).as_posix()
            for key, values in in_file(ast.parse(path.read_text("utf-8"))).items():
                found[f"{name}: {key}"] = values
    return found


def on_page() -> dict[str, tuple[list[float], str]]:
    """Numbers and reason by "file: name"."""
    rows = ROW.finditer(PAGE.read_text("utf-8"))
    return {
        row["key"]: ([float(one) for one in row["value"].split(",")], row["reason"].strip())
        for row in rows
    }


def test_every_number_stands_on_the_page():
    """With its value and a reason, and nothing that is not in the code."""
    code, page = in_code(), on_page()
    assert {key: page.get(key, ([], ""))[0] for key in code} == code
    assert set(page) == set(code)
    assert all(len(reason) > 10 for _, reason in page.values())


def test_what_counts_as_a_number():
    """Constants, tuples and sums of them, tables, defaults; neither 0 and 1 nor words."""
    text = """
A, B = 0.6, 2
C = 1.0 - 1e-9
D = {1: 0.64, 2: 1.5}
E = ("a", "b")
class Model:
    share: float = Field(default=0.25, description="of it")
    count: int = 0
    other: int = 7
def solve(b, tolerance=1e-4, *, most=200, at_least=1):
    pass
"""
    assert in_file(ast.parse(text)) == {
        "A": [0.6], "B": [2.0], "C": [1.0 - 1e-9], "D": [0.64, 1.5], "Model.share": [0.25],
        "Model.other": [7.0], "solve(tolerance)": [1e-4], "solve(most)": [200.0],
    }  # fmt: skip
