"""Translation of one function's statements and expressions into scalar code.

Understood: assignment, if, for over range(), while, return (tuples too), conditional expressions,
arithmetic, comparisons, calls of plain functions, helpers of `compute.vectors` and the functions in
`compute.intrinsics`. Conditions on literals such as `len(x_ij) == 3` are decided here, and a loop
over the axes of a vector, `for k in range(len(x))`, is written out axis by axis.
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
        # names that the generated file needs cannot be those of locals
        arguments = [a.arg for a in self.tree.args.args]
        reserved = RESERVED & {*arguments, *self.function.__code__.co_varnames}
        if reserved:
            raise LoopSourceError(f"{self._place()}: {', '.join(reserved)} cannot be a local name")
        if self.tree.args.vararg or self.tree.args.kwarg or self.tree.args.kwonlyargs:
            raise LoopSourceError(f"{self._place()}: only plain arguments are understood")
        # each argument as a parameter for each of its components
        self.locals = {a: named(kind, a) for a, kind in zip(arguments, kinds, strict=True)}
        heads = [
            p for a, k in zip(arguments, kinds, strict=True) for p in flat_parts(named(k, a), k)
        ]
        # translate the body; an error names the line that it is in
        try:
            returns = self.block(self.tree.body)
        except LoopSourceError as error:
            if not getattr(error, "placed", False):
                error = LoopSourceError(f"{self._place()}: {error}")
                error.placed = True  # type: ignore[attr-defined]
            raise error from None
        if not returns:
            raise LoopSourceError(f"{self._place()}: not every path returns a value")
        # one kind for the results of all returns: the one that holds each
        results = [line[0] for _, line in self.lines if isinstance(line, tuple)]
        kind = kind_of(results[0])
        for result in results:
            is_number = isinstance(result, Number) and is_integer(result)
            if not (is_number and kind == ("int", ())):  # a literal beside whole numbers is one
                kind = joined_kind(kind, kind_of(result))
        # write the lines, and the returns in that kind
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
            return self.loop(node)
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
        # a condition on literals is decided here; only its branch is written
        test = self.expression(node.test)
        if isinstance(test, Number):
            return self.block(node.body if test.value else node.orelse)
        self.put(f"if {boolean_text(test)}:")
        # both branches begin with the same locals, and those of either are known after
        before = dict(self.locals)
        returns = self.indented(node.body)
        after = self.locals
        self.locals = dict(before)
        if node.orelse:
            self.put("else:")
        otherwise = bool(node.orelse) and self.indented(node.orelse)
        self.locals = {**after, **self.locals}
        return returns and otherwise

    def loop(self, node: ast.For) -> bool:
        """for k in range(...); True where it is written out and a pass through it returns."""
        call = node.iter
        if not (
            isinstance(node.target, ast.Name)
            and isinstance(call, ast.Call)
            and isinstance(call.func, ast.Name)
            and call.func.id == "range"
            and not node.orelse
        ):
            raise LoopSourceError("only `for k in range(...)` is understood")
        # over the axes of a vector: a copy of the body for each k, now a literal
        name, ends = node.target.id, [self.expression(value) for value in call.args]
        if _is_over_axes(call) and all(isinstance(end, Number) for end in ends):
            if any(isinstance(one, ast.Break | ast.Continue) for one in ast.walk(node)):
                raise LoopSourceError("a loop over axes is written out and cannot break")
            for k in range(*(int(integer_text(end)) for end in ends)):
                self.locals[name] = Number(k)
                if self.block(node.body):
                    return True
            return False
        # any other range: a loop in the generated file
        self.locals[name] = scalar(name, "int")
        self.put(f"for {name} in range({', '.join(map(integer_text, ends))}):")
        self.indented(node.body)
        return False

    def assign(self, target: ast.expr, value: Term) -> None:
        """Store a value in a local name or in a tuple of names."""
        # values are copied before any name is set, as the right side comes first
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
        # literals become real unless the name is used as an index
        name = target.id
        if isinstance(value, Number) and not (is_integer(value) and name in self.whole_names):
            value = Value("real", (), real_parts(value))
        kind = ("int", ()) if isinstance(value, Number) else kind_of(value)
        # a name keeps the kind that it had at first
        if name in self.locals:
            old = kind_of(self.locals[name])
            if old != kind and (old[0], kind[0]) not in (("real", "int"), ("real", "bool")):
                raise LoopSourceError(f"{name} changes from {old} to {kind}")
            kind = old
        # components that are read after one is set go through temporary values
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


def _is_over_axes(call: ast.Call) -> bool:
    """Whether an end of a range() holds len()."""
    names = [node.func for node in ast.walk(call) if isinstance(node, ast.Call)]
    return any(isinstance(name, ast.Name) and name.id == "len" for name in names)
