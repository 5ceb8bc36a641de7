"""Translation of one function's statements and expressions into scalar code.

Understood: assignment, if, for over range(), while, return (tuples too), conditional expressions,
arithmetic, comparisons, calls of plain functions, helpers of `compute.vectors` and the functions in
`compute.intrinsics`. Conditions on literals such as `len(x_ij) == 3` are decided here.
"""

from __future__ import annotations

import ast
import inspect
import types
from typing import TYPE_CHECKING
from typing import Any as AnyObject

from lasersph.compute import algebra
from lasersph.compute.intrinsics import intrinsic, is_helper
from lasersph.compute.tensors import HELPERS
from lasersph.compute.values import (
    Any,
    Group,
    LoopSourceError,
    Number,
    Value,
    boolean_text,
    flat_parts,
    integer_text,
    is_atom,
    is_integer,
    joined_kind,
    kind_of,
    named,
    real_parts,
    scalar,
    shape_of,
)

if TYPE_CHECKING:
    from lasersph.compute.source import SourceUnit

_BINARY = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.FloorDiv: "//", ast.Mod: "%",
    ast.Pow: "**",
}  # fmt: skip
_COMPARE = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}
RESERVED = {"np", "math", "real", "njit", "prange", "min", "max", "abs", "range"}


class FunctionWriter:
    """Writes one function, specialized for the kinds of its arguments."""

    def __init__(
        self, unit: SourceUnit, function: types.FunctionType, tree: ast.FunctionDef, place: tuple
    ) -> None:
        self.unit, self.function, self.tree = unit, function, tree
        self.file, self.first_line = place
        self.line = 1
        self.lines: list[tuple[int, AnyObject]] = []
        self.indent = 1
        self.locals: dict[str, Any] = {}
        self.count = 0
        self.whole_names = {
            name.id
            for node in ast.walk(tree)
            if isinstance(node, ast.Subscript)
            for name in ast.walk(node.slice)
            if isinstance(name, ast.Name)
        }

    def written(self, name: str, kinds: tuple) -> tuple[str, AnyObject]:
        """Text of the whole function and kind of its result."""
        arguments = [a.arg for a in self.tree.args.args]
        reserved = RESERVED & {*arguments, *self.function.__code__.co_varnames}
        if reserved:
            raise LoopSourceError(f"{self._place()}: {', '.join(reserved)} cannot be a local name")
        if self.tree.args.vararg or self.tree.args.kwarg or self.tree.args.kwonlyargs:
            raise LoopSourceError(f"{self._place()}: only plain arguments are understood")
        self.locals = {a: named(kind, a) for a, kind in zip(arguments, kinds, strict=True)}
        heads = [p for a, k in zip(arguments, kinds, strict=True) for p in self._parts(a, k)]
        try:
            returns = self.block(self.tree.body)
        except LoopSourceError as error:
            if not getattr(error, "placed", False):
                error = LoopSourceError(f"{self._place()}: {error}")
                error.placed = True  # type: ignore[attr-defined]
            raise error from None
        if not returns:
            raise LoopSourceError(f"{self._place()}: not every path returns a value")
        results = [line[0] for _, line in self.lines if isinstance(line, tuple)]
        kind = kind_of(results[0])
        for result in results:
            kind = joined_kind(kind, kind_of(result) if not _is_flag(result, kind) else kind)
        body = [
            "    " * level + (line if isinstance(line, str) else self._returned(line[0], kind))
            for level, line in self.lines
        ]
        return "\n".join([f"def {name}({', '.join(heads)}):", *body]) + "\n", kind

    def _place(self) -> str:
        line = self.first_line + self.line - 1
        return f"{self.function.__qualname__}() at {self.file}:{line}"

    def _parts(self, name: str, kind: AnyObject) -> tuple[str, ...]:
        return flat_parts(named(kind, name), kind)

    def _returned(self, value: Any, kind: AnyObject) -> str:
        return "return " + ", ".join(flat_parts(value, kind))

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

    def block(self, statements: list[ast.stmt]) -> bool:
        """Translate statements; True where every path through them returns."""
        for statement in statements:
            self.line = statement.lineno
            if self.statement(statement):
                return True
        return False

    def indented(self, statements: list[ast.stmt]) -> bool:
        """Translate an inner block."""
        self.indent += 1
        self.put("pass")
        returns = self.block(statements)
        self.indent -= 1
        return returns

    def statement(self, node: ast.stmt) -> bool:
        """Translate one statement; True where it always returns."""
        if isinstance(node, ast.Return):
            if node.value is None:
                raise LoopSourceError("return without a value")
            self.lines.append((self.indent, (self.expression(node.value),)))
            return True
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            self.assign(node.targets[0], self.expression(node.value))
        elif isinstance(node, ast.AnnAssign) and node.value is not None:
            self.assign(node.target, self.expression(node.value))
        elif isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name):
            old = self.expression(ast.Name(node.target.id, ast.Load()))
            op = self._operator(node.op)
            self.assign(node.target, algebra.binary(self, op, old, self.expression(node.value)))
        elif isinstance(node, ast.If):
            return self.branch(node)
        elif isinstance(node, ast.For):
            self.loop(node)
        elif isinstance(node, ast.While):
            self.put("while True:")
            self.indent += 1
            self.put(f"if not {boolean_text(self.expression(node.test))}:")
            self.lines.append((self.indent + 1, "break"))
            self.indent -= 1
            self.indented(node.body)
        elif isinstance(node, ast.Break | ast.Continue | ast.Pass):
            self.put(type(node).__name__.lower())
        elif not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)):
            raise LoopSourceError(f"a loop cannot contain `{ast.unparse(node)}`")
        return False

    def branch(self, node: ast.If) -> bool:
        """if / elif / else."""
        test = self.expression(node.test)
        if isinstance(test, Number):
            return self.block(node.body if test.value else node.orelse)
        self.put(f"if {boolean_text(test)}:")
        before = dict(self.locals)
        returns = self.indented(node.body)
        after = self.locals
        self.locals = dict(before)
        if node.orelse:
            self.put("else:")
        otherwise = bool(node.orelse) and self.indented(node.orelse)
        self.locals = {**after, **self.locals}
        return returns and otherwise

    def loop(self, node: ast.For) -> None:
        """for k in range(...)."""
        call = node.iter
        if not (
            isinstance(node.target, ast.Name)
            and isinstance(call, ast.Call)
            and isinstance(call.func, ast.Name)
            and call.func.id == "range"
            and not node.orelse
        ):
            raise LoopSourceError("only `for k in range(...)` is understood")
        bounds = ", ".join(integer_text(self.expression(value)) for value in call.args)
        self.locals[node.target.id] = scalar(node.target.id, "int")
        self.put(f"for {node.target.id} in range({bounds}):")
        self.indented(node.body)

    def assign(self, target: ast.expr, value: Any) -> None:
        """Store a value in a local name or in a tuple of names."""
        if isinstance(target, ast.Tuple):
            items = self._items(value)
            if len(items) != len(target.elts):
                raise LoopSourceError(f"{len(items)} values for {len(target.elts)} names")
            copies = [self.copied(item) for item in items]
            for element, item in zip(target.elts, copies, strict=True):
                self.assign(element, item)
            return
        if not isinstance(target, ast.Name):
            raise LoopSourceError("only names can be assigned")
        name = target.id
        if isinstance(value, Number) and not (is_integer(value) and name in self.whole_names):
            value = Value("real", (), real_parts(value))
        kind = ("int", ()) if isinstance(value, Number) else kind_of(value)
        if name in self.locals:
            old = kind_of(self.locals[name])
            if old != kind and (old[0], kind[0]) not in (("real", "int"), ("real", "bool")):
                raise LoopSourceError(f"{name} changes from {old} to {kind}")
            kind = old
        parts = flat_parts(value, kind)
        self.locals[name] = named(kind, name)
        names = flat_parts(self.locals[name], kind)
        if len(parts) > 1 and set(parts) & set(names):
            parts = tuple(self.atom(f"({part})") for part in parts)
        elif len(parts) > 1:
            parts = tuple(self.atom(part) for part in parts)
        for left, right in zip(names, parts, strict=True):
            self.put(f"{left} = {right}")

    def copied(self, value: Any) -> Any:
        """The same value in fresh locals (so that `a, b = b, a` works)."""
        if isinstance(value, Number):
            return value
        kind = kind_of(value)
        self.count += 1
        copy = named(kind, f"t__{self.count}")
        pairs = zip(flat_parts(copy, kind), flat_parts(value, kind), strict=True)
        for left, right in pairs:
            self.put(f"{left} = {right}")
        return copy

    def _items(self, value: Any) -> tuple[Any, ...]:
        if isinstance(value, Group):
            return value.items
        if isinstance(value, Value) and len(shape_of(value)) >= 1:
            return tuple(algebra.component(self, value, [Number(k)]) for k in range(value.shape[0]))
        raise LoopSourceError("a scalar cannot be unpacked")

    def _operator(self, node: ast.operator) -> str:
        if type(node) not in _BINARY:
            raise LoopSourceError(f"operator {type(node).__name__} is not understood")
        return _BINARY[type(node)]

    def expression(self, node: ast.expr) -> Any:
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

    def name(self, node: ast.expr) -> Any:
        """Local variable or module constant."""
        from lasersph.compute.source import constant

        if isinstance(node, ast.Name) and node.id in self.locals:
            return self.locals[node.id]
        found = constant(self.resolved(node))
        if found is None:
            raise LoopSourceError(f"{ast.unparse(node)} is no number; use constants only")
        return found

    def resolved(self, node: ast.expr) -> AnyObject:
        """Python object that a global name or dotted name means."""
        if isinstance(node, ast.Name):
            if node.id in self.locals:
                raise LoopSourceError(f"local {node.id} is no function or module")
            return self.unit.look_up(self.function, node.id)
        if isinstance(node, ast.Attribute):
            return self.unit.attribute(self.resolved(node.value), node.attr)
        raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")

    def comparison(self, node: ast.Compare) -> Any:
        """Comparison, chains included."""
        values = [self.expression(value) for value in (node.left, *node.comparators)]
        results: list[Any] = []
        for k, op in enumerate(node.ops):
            if type(op) not in _COMPARE:
                raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")
            results.append(algebra.compare(_COMPARE[type(op)], values[k], values[k + 1]))
        if len(results) == 1:
            return results[0]
        return scalar("(" + " and ".join(boolean_text(r) for r in results) + ")", "bool")

    def joined(self, word: str, stop: bool, nodes: list[ast.expr]) -> Any:
        """and / or; a literal operand decides at once or drops out."""
        first = self.expression(nodes[0])
        if len(nodes) == 1:
            return first
        if isinstance(first, Number):
            return first if bool(first.value) is stop else self.joined(word, stop, nodes[1:])
        start = len(self.lines)
        result = f"t__{self.count + 1}"
        self.count += 1
        self.indent += 1
        rest = boolean_text(self.joined(word, stop, nodes[1:]))
        self.indent -= 1
        if len(self.lines) == start:
            return scalar(f"({boolean_text(first)} {word} {rest})", "bool")
        test = f"not {boolean_text(first)}" if stop else boolean_text(first)
        self.lines.insert(start, (self.indent, f"if {test}:"))
        self.lines.insert(start, (self.indent, f"{result} = {stop}"))
        self.lines.append((self.indent + 1, f"{result} = {rest}"))
        return scalar(result, "bool")

    def conditional(self, node: ast.IfExp) -> Any:
        """a if test else b: a select where both are plain, else branches."""
        test = self.expression(node.test)
        if isinstance(test, Number):
            return self.expression(node.body if test.value else node.orelse)
        start = len(self.lines)
        self.indent += 1
        first = self.expression(node.body)
        middle = len(self.lines)
        second = self.expression(node.orelse)
        self.indent -= 1
        if len(self.lines) == start:
            return algebra.select(self, test, first, second)
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
            head, *self.lines[start:middle], copies[0], (self.indent, "else:"), *tail, copies[1],
        ]  # fmt: skip
        return result

    def call(self, node: ast.Call) -> Any:
        """Call of a mathematical function, a helper or another plain function."""
        target = self.resolved(node.func)
        values = [self.expression(argument) for argument in node.args]
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

    def function_call(
        self, target: types.FunctionType, values: list[Any], options: dict[str, Any]
    ) -> Any:
        """Call of a plain Python function, which is written into the same file."""
        from lasersph.compute.source import constant

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
        kinds = tuple(kind_of(value) for value in ordered)
        name, result = self.unit.add(target, kinds)
        parts = [p for v, k in zip(ordered, kinds, strict=True) for p in flat_parts(v, k)]
        text = f"{name}({', '.join(parts)})"
        self.count += 1
        value = named(result, f"t__{self.count}")
        names = flat_parts(value, result)
        self.put(f"{', '.join(names)} = {text}")
        return value


def _is_flag(value: Any, kind: AnyObject) -> bool:
    """Whether a literal integer can be returned beside integer results."""
    return is_integer(value) and isinstance(value, Number) and kind == ("int", ())
