"""One function of native code: the statements of a text as LLVM's instructions.

Understood are assignment, if, for over range(), while, break, continue and return; see
`native_expressions` for the rest.
"""

from __future__ import annotations

import ast
from functools import reduce
from typing import Any

import numpy as np

from lasersph.compute.native_expressions import NativeExpressions, Text, Widened
from lasersph.compute.native_signatures import parameters, result_text
from lasersph.compute.native_values import LLVM, Item, Number, joined, literal, number
from lasersph.compute.values import LoopSourceError


class NativeFunction(NativeExpressions):
    """Writes one function for the types of its arguments.

    Args:
        text: that it stands in. tree: its syntax. types: of its names, as far as they are known.
        result: types of what it returns, None where they are not known.
    """

    def __init__(
        self, text: Text, tree: ast.FunctionDef, types: dict[str, np.dtype], result: Any
    ) -> None:
        super().__init__(text, types)
        self._tree, self.result = tree, result
        self._exits: list[tuple[str, str]] = []

    @property
    def result_text(self) -> str:
        """LLVM's type of the result."""
        return result_text(self.result)

    def write(self, given: list[Item]) -> None:
        """Write it for arguments of the types of those that are given.

        Raises:
            Widened: types of names or of the result were found too narrow.
        """
        names = [argument.arg for argument in self._tree.args.args]
        if len(names) != len(given):
            raise LoopSourceError(f"{len(given)} arguments for {len(names)}")
        for name, item in zip(names, parameters(given)[0], strict=True):
            self.set_name(name, item)
        self._block(self._tree.body)
        if not self.code.ended:
            if self.result is not None:
                raise LoopSourceError("not every path returns a value")
            self.code.end("ret void")

    def _block(self, statements: list[ast.stmt]) -> None:
        """Statements up to the first jump."""
        for statement in statements:
            if self.code.ended:
                return
            self._statement(statement)

    def _statement(self, node: ast.stmt) -> None:
        """One statement."""
        if isinstance(node, ast.Assign):
            value = self.expression(node.value)
            for target in node.targets:
                self._assign(target, value)
        elif isinstance(node, ast.AugAssign):
            old = self.expression(node.target)
            value = self.arithmetic(node.op, old, self.expression(node.value))
            self._assign(node.target, value)
        elif isinstance(node, ast.If):
            self._branches(node)
        elif isinstance(node, ast.For):
            self._counted(node)
        elif isinstance(node, ast.While):
            self._while(node)
        elif isinstance(node, ast.Return):
            self._return(node)
        elif isinstance(node, ast.Break):
            self.code.jump(self._exits[-1][1])
        elif isinstance(node, ast.Continue):
            self.code.jump(self._exits[-1][0])
        elif isinstance(node, ast.Expr):
            self.expression(node.value)
        elif not isinstance(node, ast.Pass):
            raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")

    def _assign(self, target: ast.expr, value: Item) -> None:
        """Give a value to a name, an element or a tuple of these."""
        if isinstance(target, ast.Name):
            self.set_name(target.id, value)
        elif isinstance(target, ast.Subscript):
            self.code.store(self.elements(target), self.index(target), number(value))
        elif isinstance(target, ast.Tuple) and isinstance(value, list):
            for one, item in zip(target.elts, value, strict=True):
                self._assign(one, item)
        else:
            raise LoopSourceError(f"`{ast.unparse(target)}` takes no value")

    def _branches(self, node: ast.If) -> None:
        """if / else; a condition that is known leaves one of both."""
        test = self.truth(node.test)
        if test.is_literal:
            self._block(node.body if test.text == "true" else node.orelse)
            return
        yes, no, after = (self.code.new_label() for _ in range(3))
        self.code.branch(test, yes, no)
        self.code.begin(yes)
        self._block(node.body)
        is_open = not self.code.ended
        self.code.jump(after)
        self.code.begin(no)
        self._block(node.orelse)
        is_open = is_open or not self.code.ended
        # where both return, nothing comes after
        if is_open:
            self.code.begin(after)

    def _counted(self, node: ast.For) -> None:
        """for k in range(...)."""
        call, name = node.iter, node.target
        if not (
            isinstance(name, ast.Name)
            and isinstance(call, ast.Call)
            and ast.unparse(call.func) == "range"
            and not node.orelse
        ):
            raise LoopSourceError("only `for k in range(...)` is understood")
        # all in one type, to which literals adapt
        given = [number(self.expression(one)) for one in call.args]
        kinds = [one.dtype for one in given if not one.is_literal] or [one.dtype for one in given]
        dtype = reduce(joined, kinds)
        ends = [self.code.cast(one, dtype) for one in given]
        start, stop = (literal(dtype.type(0)), ends[0]) if len(ends) == 1 else ends[:2]
        step = ends[2] if len(ends) > 2 else literal(dtype.type(1))
        self._loop(node, name.id, start, stop, step)

    def _loop(self, node: ast.For, name: str, start: Number, stop: Number, step: Number) -> None:
        """Run the body for each number from start to stop."""
        code, dtype = self.code, start.dtype
        place, kind = code.place(LLVM[dtype.name]), LLVM[dtype.name]
        test, body, after, end = (code.new_label() for _ in range(4))
        code.put(f"store {start.typed}, ptr {place}")
        code.begin(test)
        current = Number(dtype, code.register(f"load {kind}, ptr {place}"))
        is_down = step.text.startswith("-")
        code.branch(code.compare(">" if is_down else "<", current, stop), body, end)
        # the body, then the next number
        code.begin(body)
        self.set_name(name, current)
        self._exits.append((after, end))
        self._block(node.body)
        self._exits.pop()
        code.begin(after)
        wraps = "nuw" if dtype.kind == "u" else "nsw"
        following = code.register(f"add {wraps} {current.typed}, {step.text}")
        code.put(f"store {kind} {following}, ptr {place}")
        code.jump(test)
        code.begin(end)

    def _while(self, node: ast.While) -> None:
        """while condition."""
        test, body, end = (self.code.new_label() for _ in range(3))
        self.code.begin(test)
        self.code.branch(self.truth(node.test), body, end)
        self.code.begin(body)
        self._exits.append((test, end))
        self._block(node.body)
        self._exits.pop()
        self.code.jump(test)
        self.code.begin(end)

    def _return(self, node: ast.Return) -> None:
        """Return numbers, in one type for all returns of the function."""
        if node.value is None:
            self.code.end("ret void")
            return
        value = self.expression(node.value)
        numbers = [number(one) for one in value] if isinstance(value, list) else [number(value)]
        found = [one.dtype for one in numbers]
        known = self.result
        old = found if known is None else known if isinstance(known, list) else [known]
        kinds = [joined(a, b) for a, b in zip(old, found, strict=True)]
        self.result = kinds if isinstance(value, list) else kinds[0]
        if known is not None and self.result != known:
            raise Widened("return")
        # several numbers go back as one structure
        cast = [self.code.cast(one, kind) for one, kind in zip(numbers, kinds, strict=True)]
        if not isinstance(value, list):
            self.code.end(f"ret {cast[0].typed}")
            return
        kind, whole = self.result_text, "undef"
        for k, one in enumerate(cast):
            whole = self.code.register(f"insertvalue {kind} {whole}, {one.typed}, {k}")
        self.code.end(f"ret {kind} {whole}")
