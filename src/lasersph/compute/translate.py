"""Translation of one function's statements and expressions into scalar code.

Understood: assignment, if, for over range(), while, return (tuples too), conditional expressions,
arithmetic, comparisons, calls of plain functions, helpers of `compute.vectors` and the functions in
`compute.intrinsics`. Conditions on literals such as `len(x_ij) == 3` are decided here.
"""

from __future__ import annotations

import ast
from typing import Any

from lasersph.compute import algebra
from lasersph.compute.expressions import ExpressionWriter
from lasersph.compute.values import (
    Group,
    LoopSourceError,
    Number,
    Term,
    Value,
    boolean_text,
    flat_parts,
    integer_text,
    is_integer,
    joined_kind,
    kind_of,
    named,
    real_parts,
    scalar,
    shape_of,
)

RESERVED = {"np", "math", "real", "njit", "dispatch_blocks", "min", "max", "abs", "range"}


class FunctionWriter(ExpressionWriter):
    """Writes one function, specialized for the kinds of its arguments."""

    def written(self, name: str, kinds: tuple) -> tuple[str, Any]:
        """Text of the whole function and kind of its result."""
        arguments = [a.arg for a in self.tree.args.args]
        reserved = RESERVED & {*arguments, *self.function.__code__.co_varnames}
        if reserved:
            raise LoopSourceError(f"{self._place()}: {', '.join(reserved)} cannot be a local name")
        if self.tree.args.vararg or self.tree.args.kwarg or self.tree.args.kwonlyargs:
            raise LoopSourceError(f"{self._place()}: only plain arguments are understood")
        self.locals = {a: named(kind, a) for a, kind in zip(arguments, kinds, strict=True)}
        heads = [
            p for a, k in zip(arguments, kinds, strict=True) for p in flat_parts(named(k, a), k)
        ]
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
            is_number = isinstance(result, Number) and is_integer(result)
            if not (is_number and kind == ("int", ())):  # a literal beside whole numbers is one
                kind = joined_kind(kind, kind_of(result))
        body = []
        for level, line in self.lines:
            if not isinstance(line, str):
                line = f"return {', '.join(flat_parts(line[0], kind))}"
            body.append("    " * level + line)
        return "\n".join([f"def {name}({', '.join(heads)}):", *body]) + "\n", kind

    def _place(self) -> str:
        line = self.first_line + self.line - 1
        return f"{self.function.__qualname__}() at {self.file}:{line}"

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

    def assign(self, target: ast.expr, value: Term) -> None:
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

    def copied(self, value: Term) -> Term:
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

    def _items(self, value: Term) -> tuple[Term, ...]:
        if isinstance(value, Group):
            return value.items
        if isinstance(value, Value) and len(shape_of(value)) >= 1:
            return tuple(algebra.component(self, value, [Number(k)]) for k in range(value.shape[0]))
        raise LoopSourceError("a scalar cannot be unpacked")
