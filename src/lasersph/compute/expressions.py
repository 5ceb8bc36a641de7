"""Translation of expressions into scalar code; `compute.translate` adds the statements.

Understood: arithmetic, comparisons, conditional expressions, components by literal index, entries
of tables by whole numbers, calls of plain functions, of the helpers of `compute.vectors` and of the
functions in `compute.intrinsics`. Arguments `*(f(x[k]) for k in range(len(x)))` are written out.
"""

from __future__ import annotations

import ast
import inspect
import types
from typing import Any, Protocol

from lasersph.compute import algebra
from lasersph.compute.intrinsics import intrinsic, is_helper
from lasersph.compute.operators import ARITHMETIC, COMPARISONS
from lasersph.compute.tensors import HELPERS
from lasersph.compute.values import (
    Group,
    LoopSourceError,
    Number,
    Term,
    boolean_text,
    constant,
    flat_parts,
    is_atom,
    is_integer,
    joined_kind,
    kind_of,
    named,
    scalar,
)


class Unit(Protocol):
    """Names that functions read, and texts of those that they call: `SourceUnit`."""

    def add(self, function: types.FunctionType, kinds: tuple) -> tuple[str, Any]:
        """Name in the generated file and kind of the result."""
        ...

    def look_up(self, function: types.FunctionType, name: str) -> Any:
        """Object that a global name means inside a function."""
        ...

    def attribute(self, owner: Any, name: str) -> Any:
        """Attribute of a module or of a constant object."""
        ...


class ExpressionWriter:
    """Writes the expressions of one function, and the statements that they need before them."""

    def __init__(
        self, unit: Unit, function: types.FunctionType, tree: ast.FunctionDef, place: tuple
    ) -> None:
        self.unit, self.function, self.tree = unit, function, tree
        self.file, self.first_line = place
        self.line = 1
        self.lines: list[tuple[int, Any]] = []
        self.indent = 1
        self.locals: dict[str, Term] = {}
        self.count = 0
        self.whole_names = {
            name.id
            for node in ast.walk(tree)
            if isinstance(node, ast.Subscript)
            for name in ast.walk(node.slice)
            if isinstance(name, ast.Name)
        }

    def put(self, text: str) -> None:
        """Append a statement."""
        self.lines.append((self.indent, text))

    def atom(self, text: str) -> str:
        """Name of a local that holds the expression."""
        if is_atom(text):
            return text
        self.count += 1
        self.put(f"t__{self.count} = {text}")
        return f"t__{self.count}"

    def _operator(self, node: ast.operator) -> str:
        if type(node) not in ARITHMETIC:
            raise LoopSourceError(f"operator {type(node).__name__} is not understood")
        return ARITHMETIC[type(node)]

    def expression(self, node: ast.expr) -> Term:
        """Value of an expression."""
        if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
            return Number(node.value)
        if isinstance(node, ast.Name | ast.Attribute):
            return self.name(node)
        if isinstance(node, ast.BinOp):
            left, right = self.expression(node.left), self.expression(node.right)
            return algebra.binary(self, self._operator(node.op), left, right)
        if isinstance(node, ast.UnaryOp):
            value = self.expression(node.operand)
            if isinstance(node.op, ast.Not):
                return algebra.invert(value)
            return algebra.negative(value) if isinstance(node.op, ast.USub) else value
        if isinstance(node, ast.Compare):
            return self.comparison(node)
        if isinstance(node, ast.BoolOp):
            word, stop = ("and", False) if isinstance(node.op, ast.And) else ("or", True)
            return self.joined(word, stop, node.values)
        if isinstance(node, ast.IfExp):
            return self.conditional(node)
        if isinstance(node, ast.Tuple):
            return Group(tuple(self.expression(item) for item in node.elts))
        if isinstance(node, ast.Subscript):
            index = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
            owner = self.expression(node.value)
            return algebra.component(self, owner, [self.expression(k) for k in index])
        if isinstance(node, ast.Call):
            return self.call(node)
        raise LoopSourceError(f"a loop cannot contain `{ast.unparse(node)}`")

    def name(self, node: ast.expr) -> Term:
        """Local variable or module constant."""
        if isinstance(node, ast.Name) and node.id in self.locals:
            return self.locals[node.id]
        found = constant(self.resolved(node))
        if found is None:
            raise LoopSourceError(f"{ast.unparse(node)} is no number; use constants only")
        return found

    def resolved(self, node: ast.expr) -> Any:
        """Python object that a global name or dotted name means."""
        if isinstance(node, ast.Name):
            if node.id in self.locals:
                raise LoopSourceError(f"local {node.id} is no function or module")
            return self.unit.look_up(self.function, node.id)
        if isinstance(node, ast.Attribute):
            return self.unit.attribute(self.resolved(node.value), node.attr)
        raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")

    def comparison(self, node: ast.Compare) -> Term:
        """Comparison, chains included."""
        # a < b < c: each comparison of two, joined by `and`
        values = [self.expression(value) for value in (node.left, *node.comparators)]
        results: list[Term] = []
        for k, op in enumerate(node.ops):
            if type(op) not in COMPARISONS:
                raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")
            results.append(algebra.compare(COMPARISONS[type(op)], values[k], values[k + 1]))
        if len(results) == 1:
            return results[0]
        return scalar("(" + " and ".join(boolean_text(r) for r in results) + ")", "bool")

    def joined(self, word: str, stop: bool, nodes: list[ast.expr]) -> Term:
        """and / or; a literal operand decides at once or drops out."""
        # conditions on literals, such as `len(x) == 3 and ...`, are decided while they are written
        first = self.expression(nodes[0])
        if len(nodes) == 1:
            return first
        if isinstance(first, Number):
            return first if bool(first.value) is stop else self.joined(word, stop, nodes[1:])
        # write the other operands one level deeper, to see whether they need statements
        start = len(self.lines)
        result = f"t__{self.count + 1}"
        self.count += 1
        self.indent += 1
        others = boolean_text(self.joined(word, stop, nodes[1:]))
        self.indent -= 1
        # none needed: an expression; else they are run only where the first does not decide
        if len(self.lines) == start:
            return scalar(f"({boolean_text(first)} {word} {others})", "bool")
        test = f"not {boolean_text(first)}" if stop else boolean_text(first)
        self.lines.insert(start, (self.indent, f"if {test}:"))
        self.lines.insert(start, (self.indent, f"{result} = {stop}"))
        self.lines.append((self.indent + 1, f"{result} = {others}"))
        return scalar(result, "bool")

    def conditional(self, node: ast.IfExp) -> Term:
        """a if test else b: a select where both are plain, else branches."""
        # a test of literals leaves one branch
        test = self.expression(node.test)
        if isinstance(test, Number):
            return self.expression(node.body if test.value else node.orelse)
        # write both values one level deeper, to see whether they need statements
        start = len(self.lines)
        self.indent += 1
        first = self.expression(node.body)
        middle = len(self.lines)
        second = self.expression(node.orelse)
        self.indent -= 1
        # no statements: a select between two expressions
        if len(self.lines) == start:
            return algebra.select(self, test, first, second)
        # statements: each branch runs its own and sets the components of the result
        kind = joined_kind(kind_of(first), kind_of(second))
        self.count += 1
        result = named(kind, f"t__{self.count}")
        names = flat_parts(result, kind)
        copies = [
            (self.indent + 1, f"{', '.join(names)} = {', '.join(flat_parts(value, kind))}")
            for value in (first, second)
        ]
        head = (self.indent, f"if {boolean_text(test)}:")
        tail = self.lines[middle:]
        self.lines[start:] = [
            head,
            *self.lines[start:middle],
            copies[0],
            (self.indent, "else:"),
            *tail,
            copies[1],
        ]
        return result

    def call(self, node: ast.Call) -> Term:
        """Call of a mathematical function, a helper or another plain function."""
        # plain functions, then helpers of vectors, then functions of numbers
        target = self.resolved(node.func)
        values = [value for argument in node.args for value in self.arguments(argument)]
        options = {k.arg: self.expression(k.value) for k in node.keywords if k.arg is not None}
        if isinstance(target, types.FunctionType) and not is_helper(target):
            return self.function_call(target, values, options)
        if options:
            raise LoopSourceError(f"`{ast.unparse(node)}`: keywords are for plain functions")
        if is_helper(target):
            return HELPERS[target.__name__](self, *values)
        value = intrinsic(self, target, values)
        if value is None:
            raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")
        return value

    def arguments(self, node: ast.expr) -> list[Term]:
        """Values of an argument: one, or those of `*(... for k in range(...))` one by one."""
        if not isinstance(node, ast.Starred):
            return [self.expression(node)]
        match node.value:
            case ast.GeneratorExp(
                elt=each,
                generators=[
                    ast.comprehension(
                        target=ast.Name(id=name),
                        iter=ast.Call(func=ast.Name(id="range"), args=bounds),
                        ifs=[],
                    )
                ],
            ) if name not in self.locals:
                # an argument for each k, which is a literal in it
                ends = [self.expression(bound) for bound in bounds]
                if all(isinstance(end, Number) and is_integer(end) for end in ends):
                    found = []
                    for k in range(*(int(end.value) for end in ends)):  # type: ignore[union-attr]
                        self.locals[name] = Number(k)
                        found.append(self.expression(each))
                    self.locals.pop(name, None)
                    return found
        raise LoopSourceError(
            f"`{ast.unparse(node)}`: only `*(... for k in range(...))` with a new name and literal "
            "bounds is understood"
        )

    def function_call(
        self, target: types.FunctionType, values: list[Term], options: dict[str, Term]
    ) -> Term:
        """Call of a plain Python function, which is written into the same file."""
        # bind as Python does, with defaults as literals
        try:
            bound = inspect.signature(target).bind(*values, **options)
        except TypeError as error:
            raise LoopSourceError(f"{target.__qualname__}(): {error}") from None
        defaults = {
            name: constant(parameter.default)
            for name, parameter in inspect.signature(target).parameters.items()
            if parameter.default is not inspect.Parameter.empty
        }
        arguments = {**defaults, **bound.arguments}
        ordered = [arguments[name] for name in inspect.signature(target).parameters]
        if any(value is None for value in ordered):
            raise LoopSourceError(f"{target.__qualname__}() has a default that is no number")
        # specialize the function for the kinds of its arguments
        kinds = tuple(kind_of(value) for value in ordered)
        name, result = self.unit.add(target, kinds)
        # hand over components one by one, and name those of the result
        parts = [p for v, k in zip(ordered, kinds, strict=True) for p in flat_parts(v, k)]
        text = f"{name}({', '.join(parts)})"
        self.count += 1
        value = named(result, f"t__{self.count}")
        names = flat_parts(value, result)
        self.put(f"{', '.join(names)} = {text}")
        return value
