"""Expressions of native code: instructions for what a text computes.

Understood are arithmetic, comparisons, conditional expressions, elements of arrays, and the calls
of `native_calls`. A name keeps one type, in which all that it is given fits; arrays and tuples are
given once. Nothing raises: a division by zero gives infinity or NaN.
"""

from __future__ import annotations

import ast
from typing import Any, Protocol

import numpy as np

from lasersph.compute.native_calls import called
from lasersph.compute.native_code import Code
from lasersph.compute.native_signatures import flat_texts, result_text
from lasersph.compute.native_values import (
    BOOL,
    LLVM,
    Item,
    Number,
    Pointer,
    View,
    joined,
    literal,
    number,
)
from lasersph.compute.operators import ARITHMETIC, COMPARISONS
from lasersph.compute.values import LoopSourceError

_OPERATORS = ARITHMETIC | {ast.BitAnd: "&", ast.BitOr: "|"} | COMPARISONS


class Text(Protocol):
    """The text that a function stands in, see `native_text.NativeText`."""

    is_fast: bool
    constants: dict[str, Any]

    def has(self, name: str) -> bool:
        """Whether it has a function of this name."""
        ...

    def function(self, name: str, given: list[Item]) -> tuple[str, Any]:
        """LLVM's name of a function for arguments of some types, and the types of its result."""
        ...


class Widened(Exception):
    """A name or a result that has a type needs one that holds more."""


class NativeExpressions:
    """Writes the expressions of one function.

    Args:
        text: that it stands in. types: of its names, as far as they are known.

    Attributes:
        code: its instructions.
    """

    def __init__(self, text: Text, types: dict[str, np.dtype]) -> None:
        self._text, self.types = text, dict(types)
        self.code = Code(is_fast=text.is_fast)
        self._places: dict[str, str] = {}
        self._items: dict[str, Item] = {}

    def set_name(self, name: str, item: Item) -> None:
        """Give a value to a name."""
        if not isinstance(item, Number):
            self._items[name] = item
            return
        # one type for all that the name is given
        known = self.types.get(name)
        dtype = item.dtype if known is None else joined(known, item.dtype)
        self.types[name] = dtype
        if known is not None and dtype != known:
            raise Widened(name)
        if name not in self._places:
            self._places[name] = self.code.place(LLVM[dtype.name])
        self.code.put(f"store {self.code.cast(item, dtype).typed}, ptr {self._places[name]}")

    def expression(self, node: ast.expr) -> Item:
        """Value of an expression."""
        if isinstance(node, ast.Constant):
            return [] if isinstance(node.value, str) else literal(node.value)
        if isinstance(node, ast.Name):
            return self._named(node.id)
        if isinstance(node, ast.Tuple):
            return [self.expression(one) for one in node.elts]
        if isinstance(node, ast.BinOp):
            return self.arithmetic(node.op, *map(self.expression, (node.left, node.right)))
        if isinstance(node, ast.UnaryOp):
            return self._unary(node)
        if isinstance(node, ast.Compare):
            return self._compared(node)
        if isinstance(node, ast.BoolOp):
            return self._joined(node)
        if isinstance(node, ast.IfExp):
            return self._chosen(node)
        if isinstance(node, ast.Subscript):
            return self._element(node)
        if isinstance(node, ast.Attribute):
            return self._attribute(node)
        if isinstance(node, ast.Call):
            return self._call(node)
        raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")

    def _named(self, name: str) -> Item:
        """Value of a name."""
        if name in self._places:
            dtype = self.types[name]
            text = self.code.register(f"load {LLVM[dtype.name]}, ptr {self._places[name]}")
            return Number(dtype, text)
        if name in self._items:
            return self._items[name]
        if name in self._text.constants:
            return literal(self._text.constants[name])
        raise LoopSourceError(f"{name} has no value")

    def arithmetic(self, op: ast.operator, a: Item, b: Item) -> Number:
        if type(op) not in _OPERATORS:
            raise LoopSourceError(f"operator {type(op).__name__} is not understood")
        return self.code.arithmetic(_OPERATORS[type(op)], number(a), number(b))

    def _unary(self, node: ast.UnaryOp) -> Number:
        """-x, +x and not x."""
        if isinstance(node.op, ast.Not):
            test = self.truth(node.operand)
            if test.is_literal:
                return literal(test.text != "true")
            return Number(BOOL, self.code.register(f"xor i1 {test.text}, true"))
        if isinstance(node.op, ast.USub) and isinstance(node.operand, ast.Constant):
            return literal(-node.operand.value)  # type: ignore[operator]
        value = number(self.expression(node.operand))
        if isinstance(node.op, ast.USub):
            return self.code.negated(value)
        if isinstance(node.op, ast.UAdd):
            return value
        raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")

    def _compared(self, node: ast.Compare) -> Number:
        """a < b; of a < b < c both must hold."""
        values = [number(self.expression(one)) for one in (node.left, *node.comparators)]
        found = None
        for k, op in enumerate(node.ops):
            if type(op) not in _OPERATORS:
                raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")
            test = self.code.compare(_OPERATORS[type(op)], values[k], values[k + 1])
            both = f"and i1 {found.text}, {test.text}" if found else ""
            found = Number(BOOL, self.code.register(both)) if both else test
        assert found is not None
        return found

    def truth(self, node: ast.expr) -> Number:
        """Whether an expression is true."""
        return self.code.cast(number(self.expression(node)), BOOL)

    def _joined(self, node: ast.BoolOp) -> Number:
        """a and b, a or b: the second only where the first leaves it open."""
        code, is_or = self.code, isinstance(node.op, ast.Or)
        end, ways = code.new_label(), []
        for k, one in enumerate(node.values):
            test = self.truth(one)
            ways.append(f"[ {test.text}, %{code.label} ]")
            if k == len(node.values) - 1:
                break
            following = code.new_label()
            code.branch(test, *((end, following) if is_or else (following, end)))
            code.begin(following)
        code.begin(end)
        return Number(BOOL, code.register(f"phi i1 {', '.join(ways)}"))

    def _chosen(self, node: ast.IfExp) -> Item:
        """a if test else b: only one of both is computed, and given to a name of its own."""
        test = self.truth(node.test)
        if test.is_literal:
            return self.expression(node.body if test.text == "true" else node.orelse)
        name = f"{node.lineno}:{node.col_offset}"
        yes, no, end = (self.code.new_label() for _ in range(3))
        self.code.branch(test, yes, no)
        for label, value in ((yes, node.body), (no, node.orelse)):
            self.code.begin(label)
            self.set_name(name, self.expression(value))
            self.code.jump(end)
        self.code.begin(end)
        return self._named(name)

    def _element(self, node: ast.Subscript) -> Item:
        """Element of an array, at an address or of a tuple."""
        one = self.expression(node.value)
        index = self.index(node)
        if isinstance(one, Pointer | View):
            return self.code.load(one, index)
        if isinstance(one, list) and index[0].is_literal:
            return one[int(index[0].text)]
        raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")

    def elements(self, node: ast.Subscript) -> Pointer | View:
        one = self.expression(node.value)
        if not isinstance(one, Pointer | View):
            raise LoopSourceError(f"`{ast.unparse(node)}` takes no value")
        return one

    def index(self, node: ast.Subscript) -> list[Number]:
        places = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        return [number(self.expression(place)) for place in places]

    def _attribute(self, node: ast.Attribute) -> Item:
        """Shape and size of an array, or a number of `math` or `numpy`."""
        name = ast.unparse(node)
        if isinstance(node.value, ast.Name) and node.value.id in ("np", "math"):
            return literal(eval(name, {}, self._text.constants))
        one = self.expression(node.value)
        if isinstance(one, View) and node.attr == "shape":
            return list(one.shape)
        if isinstance(one, View) and node.attr == "size":
            size = one.shape[0]
            for length in one.shape[1:]:
                size = self.code.arithmetic("*", size, length)
            return size
        raise LoopSourceError(f"`{name}` is not understood")

    def _call(self, node: ast.Call) -> Item:
        """A function of the text, a type, or what `native_calls` knows."""
        name = ast.unparse(node.func)
        given = [self.expression(one) for one in node.args]
        if self._text.has(name):
            return self._called(name, given)
        dtype = self._type(name)
        if dtype is not None:
            return self.code.cast(number(given[0]), dtype)
        value = called(self.code, name, given)
        if value is None:
            raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")
        return value

    def _type(self, name: str) -> np.dtype | None:
        """The type that a name stands for."""
        package, _, attribute = name.rpartition(".")
        found = getattr(np, attribute, None) if package == "np" else self._text.constants.get(name)
        is_number = isinstance(found, type) and issubclass(found, np.generic)
        return np.dtype(found) if is_number else None

    def _called(self, name: str, given: list[Item]) -> Item:
        """Call a function of the text."""
        symbol, result = self._text.function(name, given)
        texts = ", ".join(text for one in given for text in flat_texts(one))
        call = f"call {result_text(result)} @{symbol}({texts})"
        if result is None:
            self.code.put(call)
            return []
        whole = self.code.register(call)
        if not isinstance(result, list):
            return Number(result, whole)
        kind = result_text(result)
        return [
            Number(one, self.code.register(f"extractvalue {kind} {whole}, {k}"))
            for k, one in enumerate(result)
        ]
