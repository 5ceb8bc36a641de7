"""Rooms explain themselves: docstrings name a quantity, comments name steps, no word is private.

Each room is held to the same numbers.
"""

import ast
import io
import re
import tokenize
from functools import cache
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parent.parent / "src" / "lasersph"
ROOMS = sorted(folder.name for folder in SOURCE.iterdir() if any(folder.rglob("*.py")))

MOST_CODE = 40
"""Lines of code to a line of comment at most; codes of this field that read well have 6 to 60."""
PRAGMA = re.compile(r"#\s*(noqa|type:|pyright:|fmt:|pragma)")

WORDS = {
    # word in the code: what to write instead
    "Drives": "SurfaceForcing",
    "EVEN": "a noun with the quantity, GRID_TOLERANCE",
    "FAR": "a noun with the quantity",
    "GAP": "a noun with the quantity",
    "NOUGHT": "a noun with the quantity, ZERO_TOLERANCE",
    "Phase": "LoopGraph, RunStage, PhaseProperties",
    "ROOM": "capacity, bounds, growth, margin",
    "SAME": "a noun with the quantity, EDGE_TOLERANCE",
    "STILLS": "a noun with the quantity, TELLING_FIGURES",
    "WORN": "a noun with the quantity, MIN_VOLUME_RATIO",
    "Wish": "Target",
    "World": "ParameterSample",
    "_across": "crosses_surface",
    "_beyond": "surface_ghosts",
    "_within": "stays_inside",
    "bearable": "allowed_recession",
    "current_block": "block",
    "doubt": "emulator_share",
    "enter": "set_block, add_incoming_light",
    "even_out_flux": "normalize_surface_flux",
    "follow": "the quantity that is updated",
    "look": "to_host, options, a measurement",
    "loose": "unidentified",
    "renew": "redraw, rebuild, update",
    "rest": "remaining, residual, decay, at_rest: a word each",
    "routine": "compiled_iteration",
    "stretch": "length_ratio, tangential_strain_rate, exaggeration",
    "take": "run_step, fetch, acquire",
    "told": "description, answer, meaning",
    "told_apart": "separability",
    "trouble": "validity_error",
    "turn": "new_direction",
    "way": "advection_time, displacement",
}
"""Words that only this code knew in their meaning; with a leading underscore they are the same."""


@cache
def files_of(room):
    """Path below the package and syntax tree of each file of a room."""
    return [
        (file, ast.parse(file.read_text("utf-8"))) for file in sorted((SOURCE / room).rglob("*.py"))
    ]


def docstrings_of(tree):
    """Docstrings of modules, classes, functions and of names below which one stands."""
    for node in ast.walk(tree):
        match node:
            case ast.Expr(value=ast.Constant(value=str())):
                yield node


def lines_of(file, tree):
    """Numbers of lines of code, and of lines that are a comment; pragmas are neither."""
    text = file.read_text("utf-8")
    prose = {n for one in docstrings_of(tree) for n in range(one.lineno, one.end_lineno + 1)}
    comments, pragmas = set(), set()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and token.line.lstrip().startswith("#"):
            (pragmas if PRAGMA.match(token.string) else comments).add(token.start[0])
    numbered = enumerate(text.splitlines(), start=1)
    code = {n for n, line in numbered if line.strip()} - prose - comments - pragmas
    return len(code), len(comments)


def names_bound_in(tree):
    """Names of classes, functions, arguments, variables and attributes that a file makes."""
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
                yield name, node.lineno
            case ast.ClassDef(name=name) | ast.Name(id=name, ctx=ast.Store()):
                yield name, node.lineno
            case ast.arg(arg=name) | ast.Attribute(attr=name, ctx=ast.Store()):
                yield name, node.lineno


def listed_word(name):
    """The listed word that a name is, with or without a leading underscore; None of others."""
    return next((word for word in (name, name.removeprefix("_")) if word in WORDS), None)


@pytest.mark.parametrize("room", ROOMS)
def test_docstrings_begin_with_a_verb_or_the_quantity(room):
    """None begins with "What", which tells a reader nothing before its second half."""
    found = [
        f"{file.relative_to(SOURCE)}:{node.lineno}"
        for file, tree in files_of(room)
        for node in docstrings_of(tree)
        if re.match(r"\s*What\b", node.value.value)
    ]
    assert not found


@pytest.mark.parametrize("room", ROOMS)
def test_steps_have_comments(room):
    """A room has a line of comment to 40 lines of code."""
    counts = [lines_of(file, tree) for file, tree in files_of(room)]
    code, comments = map(sum, zip(*counts, strict=True))
    assert code <= MOST_CODE * max(comments, 1), f"{code} lines of code, {comments} of comments"


@pytest.mark.parametrize("room", ROOMS)
def test_no_private_words(room):
    """No name is one of the listed words."""
    found = [
        f'{file.relative_to(SOURCE)}:{line}: {name}, write "{WORDS[word]}"'
        for file, tree in files_of(room)
        for name, line in names_bound_in(tree)
        if (word := listed_word(name))
    ]
    assert not found, "\n".join(found)


def test_the_rules_catch_what_they_are_for(tmp_path):
    """Some words, a docstring that begins with "What", one comment, one pragma."""
    text = (
        '"""What it is."""\n\n# Step one.\n# noqa: E501\ndef _take(way):\n'
        '    """Verb first."""\n    self.doubt = rest = 1  # behind code\n'
    )
    file = tmp_path / "one.py"
    file.write_text(text)
    tree = ast.parse(text)
    assert [node.value.value for node in docstrings_of(tree)] == ["What it is.", "Verb first."]
    assert lines_of(file, tree) == (2, 1)
    words = {listed_word(name) for name, _ in names_bound_in(tree)}
    assert words == {"take", "way", "doubt", "rest"}
