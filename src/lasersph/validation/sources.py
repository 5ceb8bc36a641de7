"""The modules that a computation runs through, by their imports, with a hash of what each computes.

Comments and docstrings do not count: a better sentence makes no record stale.

Imports are read from the text of the modules and followed name by name: `from lasersph.case import
load_case` leads to the module that `lasersph/case/__init__.py` takes it from and to nothing else
of that room. What is loaded while a run is made would say less: the model of a case and the list
of recipes load all three solvers, whichever is asked for.
"""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable
from functools import cache
from pathlib import Path

PACKAGE = "lasersph"
ROOT = Path(__file__).parents[1]
NO_NUMBERS = {"cli", "plots", "report", "studies"}
"""Rooms that cannot change a computed number."""
ONLY_WORDS = {"case.other_words", "input.findings", "materials.other_words"}
"""Files that cannot either: what they say is said of a case that is not computed."""
NUMBERS_OF_VALIDATION = {"comparison", "lattices", "tables"}
"""Files of this room that can, beside those in the folder of a validation."""
JUDGE = f"{PACKAGE}.validation.comparison"
TIME_LOOP = f"{PACKAGE}.simulation.time_loop"
STRING = ast.Constant | ast.JoinedStr
RECIPES = f"{PACKAGE}.simulation.recipes"
"""A list that imports every solver; which of them runs is said by the case."""


def recipe_module(kind: str) -> str:
    """Module of the recipe of a kind of solver."""
    return f"{RECIPES}.{kind.replace('-', '_')}"


def hashes(modules: Iterable[str]) -> dict[str, str]:
    """Hash of the code of `modules` and of all that they import, by name; "" of one that is gone.

    A text is read once a process: what was loaded counts, though files are edited meanwhile.
    """
    found: dict[str, str] = {}
    # Follow imports until no module is new.
    left = list(modules)
    while left:
        module = left.pop()
        if module not in found and not _has_no_numbers(module):
            found[module] = _hash(module)
            left += _imports(module) if module != RECIPES else ()
    return dict(sorted(found.items()))


def _has_no_numbers(module: str) -> bool:
    # Only some files of this room judge; figures never do.
    path = module.removeprefix(f"{PACKAGE}.")
    room, *inner = [*path.split("."), ""]
    if room == "validation" and len(inner) == 2:
        return inner[0] not in NUMBERS_OF_VALIDATION
    return room in NO_NUMBERS or path in ONLY_WORDS or module.endswith(".figures")


@cache
def _hash(module: str) -> str:
    text, tree = _parsed(module)
    return hashlib.sha256(code_of(text, tree).encode()).hexdigest()[:16] if text else ""


@cache
def _parsed(module: str) -> tuple[str, ast.Module]:
    """Text of a module, "" of one that is gone, and its syntax tree."""
    file = _file(module)
    text = file.read_text(encoding="utf-8") if file.is_file() else ""
    return text, ast.parse(text)


def code_of(text: str, tree: ast.Module) -> str:
    """The lines of a module that compute: without docstrings, lines of comments and empty ones."""
    words, quoted = set[int](), set[int]()
    for node in ast.walk(tree):
        if not isinstance(node, ast.Expr | STRING):
            continue
        lines = range(node.lineno, (node.end_lineno or node.lineno) + 1)
        # a string that stands alone says something; in others a # is no comment
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            words |= set(lines)
        elif isinstance(node, STRING):
            quoted |= set(lines[1:])
    kept = [
        line
        for number, line in enumerate(text.splitlines(), 1)
        if number not in words
        and (number in quoted or (line.strip() and not line.lstrip().startswith("#")))
    ]
    return "\n".join(kept)


def _file(module: str) -> Path:
    """File of a module of the package; of a package its `__init__.py`."""
    place = ROOT.joinpath(*module.split(".")[1:])
    return place / "__init__.py" if place.is_dir() else place.with_suffix(".py")


@cache
def _imports(module: str) -> frozenset[str]:
    """Modules of the package that define the names that a module imports when it runs."""
    return frozenset(_definer(source, name) for name, source in _imported(module, runs=True))


@cache
def _imported(module: str, *, runs: bool) -> tuple[tuple[str, str], ...]:
    """(name, module it comes from) of all imports; `runs`: but for those of type checkers."""
    # Walk through the syntax tree: imports inside of functions count as well.
    left: list[ast.AST] = [_parsed(module)[1]]
    found = []
    while left:
        node = left.pop()
        if isinstance(node, ast.ImportFrom) and str(node.module).split(".")[0] == PACKAGE:
            found += [(alias.name, str(node.module)) for alias in node.names]
        elif isinstance(node, ast.Import):
            found += [("", a.name) for a in node.names if a.name.split(".")[0] == PACKAGE]
        elif not (runs and isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)):
            left += ast.iter_child_nodes(node)
    return tuple(found)


def _definer(module: str, name: str) -> str:
    """Module that defines what is imported by a name from a module or a package."""
    # A package gives the name from one of its files, or from elsewhere.
    file = _file(module)
    if not name or file.name != "__init__.py":
        return module
    if _file(f"{module}.{name}").is_file():
        return f"{module}.{name}"
    for given, source in _imported(module, runs=False):
        if given == name and source != module:
            return _definer(source, name)
    return module
