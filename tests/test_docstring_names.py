"""Names in backticks exist: docstrings and comments name no file, module or name that is gone.

Three rules. A path that ends in .py, or that begins with a room of the package and ends in .md or
.toml, is a file of the repository. A dotted name that begins with `lasersph` or a room resolves by
import. Any other name stands somewhere in the code: as a name, or as a word of a text such as a key
of a case file or a verb of the command line.
"""

import ast
import importlib
import re
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SOURCE = ROOT / "src" / "lasersph"
FILES = sorted(SOURCE.rglob("*.py"))
ROOMS = {folder.name for folder in SOURCE.iterdir() if folder.is_dir()}
BACKTICKS = re.compile(r"(?<!`)`([^`\n]+)`(?!`)")
COMMENT = re.compile(r"(?:^ *|  )#.*$", re.MULTILINE)
WORD = re.compile(r"[A-Za-z_]\w*")
PLACEHOLDER = re.compile(r"name_*[ij01]")
"""Stands for any field of a pair function: `name_i`, `name__0`."""
EXTERNAL = {"PyArrayObject_fields"}
"""Names of other programs, which no code here writes."""


@cache
def prose_and_words(text):
    """Docstrings and comments of a source text, and every word of its code."""
    lines, prose = text.splitlines(), []
    # docstrings, and texts that stand alone below a name
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.Expr(value=ast.Constant(value=str(found))):
                prose.append(found)
                assert node.end_lineno is not None
                for k in range(node.lineno - 1, node.end_lineno):
                    lines[k] = ""
    # comments, on lines of their own or two blanks behind the code
    code = "\n".join(lines)
    prose += COMMENT.findall(code)
    return prose, set(WORD.findall(COMMENT.sub("", code)))


@cache
def known_words():
    """Words of the code, of case files and of materials."""
    words = set()
    for file in FILES:
        words |= prose_and_words(file.read_text(encoding="utf-8"))[1]
    words |= EXTERNAL
    for file in SOURCE.rglob("*.toml"):
        words.update(WORD.findall(file.read_text(encoding="utf-8")))
    return words


@cache
def paths():
    """Files of the repository."""
    return {str(path.relative_to(ROOT)) for path in ROOT.rglob("*.*") if ".venv" not in path.parts}


def is_file(name):
    """Whether a path names a file of the repository, in full or from a folder on."""
    return any(path == name or path.endswith(f"/{name}") for path in paths())


def resolves(name):
    """Whether a dotted name of the package can be imported; rooms stand for `lasersph.room`."""
    parts = name.split(".")
    parts = parts if parts[0] == "lasersph" else ["lasersph", *parts]
    found, module = importlib.import_module("lasersph"), "lasersph"
    for k, part in enumerate(parts[1:], start=1):
        module = f"{module}.{part}"
        if hasattr(found, part):
            found = getattr(found, part)
            continue
        try:
            found = importlib.import_module(module)
        except ImportError:
            fields = getattr(found, "model_fields", {}) | getattr(found, "__annotations__", {})
            return part in fields and k == len(parts) - 1
    return True


def is_stale(name):
    """Whether a name in backticks names nothing."""
    name = name.strip().rstrip("()")
    if PLACEHOLDER.fullmatch(name):
        return False
    if re.fullmatch(r"[\w./<>-]+\.py", name):
        return not is_file(name)
    first = re.split(r"[./]", name)[0]
    if re.fullmatch(r"[\w./-]+\.(md|toml)", name) and "/" in name and first in ROOMS:
        return not is_file(name)
    if re.fullmatch(r"\w+(\.\w+)+", name) and first in {"lasersph", *ROOMS}:
        return not resolves(name) and not set(name.split(".")) <= known_words()
    if re.fullmatch(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*", name, re.ASCII):
        return not set(name.split(".")) <= known_words()
    return False


def test_names_in_backticks_exist():
    """In every docstring and comment of the package."""
    stale = {}
    for file in FILES:
        prose, _ = prose_and_words(file.read_text(encoding="utf-8"))
        names = {name for text in prose for name in BACKTICKS.findall(text)}
        if gone := sorted(name for name in names if is_stale(name)):
            stale[str(file.relative_to(SOURCE))] = gone
    assert not stale


def test_the_rules_catch_what_is_gone():
    """Two names that once were left behind, and names that are no names of the package."""
    assert is_stale("physics/continuities.py") and is_stale("plots/ablations_history.py")
    assert is_stale("lasersph.no_such_room") and is_stale("no_such_function_anywhere")
    assert not is_stale("observers.View") and not is_stale("tests/test_architecture.py")
    assert not is_stale("history.csv") and not is_stale("x_ij = x_i - x_j")
