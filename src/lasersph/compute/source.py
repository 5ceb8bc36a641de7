"""Source compiler: from plain Python pair and pointwise functions to scalar code in one file.

A `SourceUnit` collects the functions that one generated file needs. Each function is read from its
source text, specialized for the kinds and shapes of its arguments, and written as scalar code;
functions that it calls follow it into the same file, and module constants enter as literals, so
the text of the file holds everything that its result depends on. `is_current()` tells whether each
global name that was read still means the same object.
"""

from __future__ import annotations

import ast
import inspect
import linecache
import textwrap
import types
from functools import cache
from typing import Any

from lasersph.compute.translate import FunctionWriter
from lasersph.compute.values import LoopSourceError


class SourceUnit:
    """Functions of one generated file, in the order in which they must be defined."""

    def __init__(self) -> None:
        self.texts: list[str] = []
        self._names: dict[Any, tuple[str, Any]] = {}
        self._open: set[Any] = set()
        self._used: set[str] = set()
        self._watched: dict[tuple[int, str], tuple[Any, str, Any]] = {}
        self._codes: list[tuple[types.FunctionType, types.CodeType]] = []

    def add(self, function: types.FunctionType, kinds: tuple) -> tuple[str, Any]:
        """Name in the generated file and kind of the result, for these kinds of arguments.

        Raises:
            LoopSourceError: the function contains something that a loop cannot; the message names
                the function, file and line.
        """
        key = (function, kinds)
        if key in self._names:
            return self._names[key]
        if key in self._open:
            raise LoopSourceError(f"{function.__qualname__}() calls itself")
        # a name of its own for each function and kinds of arguments
        self._open.add(key)
        tree, file, first_line = parsed(function)
        self._codes.append((function, function.__code__))
        name = f"f__{function.__name__}"
        number = 1
        while name in self._used:
            number += 1
            name = f"f__{function.__name__}_{number}"
        self._used.add(name)
        # what it calls is written before it, by this same method
        writer = FunctionWriter(self, function, tree, (file, first_line))
        text, result = writer.written(name, kinds)
        self.texts.append(text)
        self._open.discard(key)
        self._names[key] = (name, result)
        return self._names[key]

    def look_up(self, function: types.FunctionType, name: str) -> Any:
        """Object that a global name means inside `function`."""
        for space in (function.__globals__, function.__builtins__):
            if name in space:
                self._watched[(id(space), name)] = (space, name, space[name])
                return space[name]
        raise LoopSourceError(f"name {name} is not defined")

    def attribute(self, owner: Any, name: str) -> Any:
        """Attribute of a module or of a constant object."""
        if not hasattr(owner, name):
            raise LoopSourceError(f"{owner!r} has no attribute {name}")
        value = getattr(owner, name)
        if isinstance(owner, types.ModuleType):
            self._watched[(id(owner.__dict__), name)] = (owner.__dict__, name, value)
        return value

    def watched(self) -> tuple[tuple[Any, str, Any], ...]:
        """Global names read so far: (namespace, name, object)."""
        return tuple(self._watched.values())

    def is_current(self) -> bool:
        """Whether all that was read is as it was: what names mean, and the code of functions."""
        has_same_code = all(function.__code__ is code for function, code in self._codes)
        return has_same_code and is_current(self.watched())


def is_current(watched: tuple[tuple[Any, str, Any], ...]) -> bool:
    """Whether every watched name still means the same object."""
    return not [name for space, name, value in watched if space.get(name) is not value]


def parsed(function: Any) -> tuple[ast.FunctionDef, str, int]:
    """Syntax tree, file and first line of a plain function.

    Raises:
        LoopSourceError: it is no plain `def`, reads enclosing variables, has no source text, or
            its file was edited since it was imported.
    """
    name = getattr(function, "__qualname__", repr(function))
    if not isinstance(function, types.FunctionType):
        raise LoopSourceError(f"{name} is not a plain Python function")
    if function.__code__.co_freevars:
        free = ", ".join(function.__code__.co_freevars)
        raise LoopSourceError(f"{name}() reads {free} of an enclosing function; pass constants")
    # its text, as the file has it now
    try:
        lines, first = inspect.getsourcelines(function)
    except (OSError, TypeError) as error:
        raise LoopSourceError(f"{name}() has no source text: {error}") from error
    try:
        tree = next(iter(ast.parse(textwrap.dedent("".join(lines))).body), None)
    except SyntaxError as error:
        raise LoopSourceError(f"{name}(): {error}") from error
    # that must be the function which was imported
    if function.__name__ == "<lambda>":
        raise LoopSourceError(f"{name} is not written as a plain `def`")
    if not isinstance(tree, ast.FunctionDef) or not _is_up_to_date(function):
        raise LoopSourceError(
            f"{name}() is not what its file says now: {function.__code__.co_filename} was edited "
            "while the program runs; start it again"
        )
    return tree, function.__code__.co_filename, first


def _is_up_to_date(function: types.FunctionType) -> bool:
    """Whether the text of the function's file still gives the function that was imported.

    A text that is no Python as a whole, such as a notebook cell with magics, counts as unchanged.
    """
    file = function.__code__.co_filename
    try:
        found = _compiled("".join(linecache.getlines(file, function.__globals__)), file)
    except SyntaxError:
        return True
    return _content(function.__code__) in found


@cache
def _compiled(text: str, file: str) -> frozenset[tuple]:
    """Content of every function in a text."""
    codes, found = [compile(text, file, "exec", 0, True)], set()
    while codes:
        code = codes.pop()
        found.add(_content(code))
        codes += [value for value in code.co_consts if isinstance(value, types.CodeType)]
    return frozenset(found)


def _content(code: types.CodeType) -> tuple:
    """Code and constants of a function, whatever its line numbers."""
    constants = [repr(value) for value in code.co_consts if not isinstance(value, types.CodeType)]
    return code.co_qualname, code.co_code, code.co_names, code.co_varnames, tuple(constants)
