"""Native code of generated texts: LLVM's text of a small typed part of Python.

A text has constants and functions of numbers, addresses and arrays. A function is written for the
types of its arguments when it is first called with them. See `native_functions` for what functions
may contain, `native_calls` for what they may call.
"""

from __future__ import annotations

import ast
import math
from typing import Any

import numpy as np

from lasersph.compute.native_calls import CAPACITY
from lasersph.compute.native_expressions import Widened
from lasersph.compute.native_functions import NativeFunction
from lasersph.compute.native_signatures import kinds_of, parameters
from lasersph.compute.native_values import UINT64, Item, Number
from lasersph.compute.values import LoopSourceError


class NativeText:
    """LLVM's text of what the function `loop` of a text needs.

    Args:
        text: constants and functions. symbol: LLVM's name of `loop`. is_fast: whether sums may be
            rearranged.

    Attributes:
        constants: numbers, types and packages by the names that the text gives them.
    """

    def __init__(self, text: str, symbol: str, *, is_fast: bool) -> None:
        self.is_fast, self._symbol = is_fast, symbol
        self.constants: dict[str, Any] = {"np": np, "math": math, "CAPACITY": CAPACITY}
        self._trees: dict[str, ast.FunctionDef] = {}
        self._written: dict[tuple, tuple[str, Any]] = {}
        self._lines: list[str] = []
        self._declared: set[str] = set()
        for node in ast.parse(text).body:
            if isinstance(node, ast.FunctionDef):
                self._trees[node.name] = node
            elif isinstance(node, ast.Assign):
                exec(compile(ast.Module([node], []), "<loop>", "exec"), self.constants)

    def written(self) -> str:
        """All functions; the arguments of `loop` are unsigned integers."""
        count = len(self._trees["loop"].args.args)
        self._write("loop", [Number(UINT64, "")] * count, self._symbol)
        return "\n".join([*sorted(self._declared), *self._lines])

    def has(self, name: str) -> bool:
        """Whether the text has a function of this name."""
        return name in self._trees

    def function(self, name: str, given: list[Item]) -> tuple[str, Any]:
        """LLVM's name of a function for arguments of some types, and the types of its result."""
        key = (name, *map(kinds_of, given))
        if key not in self._written:
            symbol = f"{self._symbol}.{name}.{len(self._written)}"
            self._written[key] = symbol, self._write(name, given, symbol)
        return self._written[key]

    def _write(self, name: str, given: list[Item], symbol: str) -> Any:
        """Write a function; returns the types of its result."""
        tree, names, result = self._trees[name], {}, None
        while True:
            function = NativeFunction(self, tree, names, result)
            try:
                function.write(given)
            except Widened:  # a name or the result needs a type that holds more: write it anew
                names, result = function.types, function.result
                continue
            except LoopSourceError as error:
                raise LoopSourceError(f"{name}(): {error}") from None
            break
        linkage = "" if name == "loop" else "internal "
        code, heads = function.code, ", ".join(parameters(given)[1])
        self._lines += [f"define {linkage}{function.result_text} @{symbol}({heads}) {{", "start:"]
        self._lines += [*code.places, *code.lines, "}"]
        self._declared |= code.declared
        return function.result
