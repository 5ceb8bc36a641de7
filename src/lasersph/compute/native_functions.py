"""One function of native code: statements and expressions of a text as LLVM's instructions.

Understood are assignment, if, for over range(), while, break, continue, return, arithmetic,
comparisons and conditional expressions. A name keeps one type, in which all that it is given fits;
arrays and tuples are given once. Nothing raises: a division by zero gives infinity or NaN.
"""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.compute.native_calls import called
from lasersph.compute.native_code import Code
from lasersph.compute.native_values import (
    BOOL,
    INT64,
    LLVM,
    Item,
    Number,
    Pointer,
    View,
    joined,
    literal,
)
from lasersph.compute.values import LoopSourceError

if TYPE_CHECKING:
    from lasersph.compute.native_text import NativeText

_OPERATORS: dict[type, str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.FloorDiv: "//",
    ast.Mod: "%",
    ast.BitAnd: "&",
    ast.BitOr: "|",
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
}


class Widened(Exception):
    """A name or a result that has a type needs one that holds more."""


class NativeFunction:
    """Writes one function for the types of its arguments.

    Args:
        text: that it stands in. tree: its syntax. types: of its names, as far as they are known.
        result: types of what it returns, None where they are not known.

    Attributes:
        code: its instructions.
    """

    def __init__(
        self, text: NativeText, tree: ast.FunctionDef, types: dict[str, np.dtype], result: Any
    ) -> None:
        self._text, self._tree = text, tree
        self.types, self.result = dict(types), result
        self.code = Code(is_fast=text.is_fast)
        self._places: dict[str, str] = {}
        self._items: dict[str, Item] = {}
        self._exits: list[tuple[str, str]] = []

    @property
    def result_text(self) -> str:
        """LLVM's type of the result."""
        return _result_text(self.result)

    def write(self, given: list[Item]) -> None:
        """Write it for arguments of the types of those that are given.

        Raises:
            Widened: types of names or of the result were found too narrow.
        """
        names = [argument.arg for argument in self._tree.args.args]
        if len(names) != len(given):
            raise LoopSourceError(f"{len(given)} arguments for {len(names)}")
        for name, item in zip(names, parameters(given)[0], strict=True):
            self._set(name, item)
        self._block(self._tree.body)
        if not self.code.ended:
            if self.result is not None:
                raise LoopSourceError("not every path returns a value")
            self.code.end("ret void")

    # ---------------------------------------------------------------------------- statements

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
            value = self._arithmetic(node.op, old, self.expression(node.value))
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
            self._set(target.id, value)
        elif isinstance(target, ast.Subscript):
            self.code.store(self._elements(target), self._index(target), _number(value))
        elif isinstance(target, ast.Tuple) and isinstance(value, tuple):
            for one, item in zip(target.elts, value, strict=True):
                self._assign(one, item)
        else:
            raise LoopSourceError(f"`{ast.unparse(target)}` takes no value")

    def _set(self, name: str, item: Item) -> None:
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

    def _branches(self, node: ast.If) -> None:
        """if / else; a condition that is known leaves one of both."""
        test = self._truth(node.test)
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
        given = [_number(self.expression(one)) for one in call.args]
        dtype = given[0].dtype
        for one in given:
            dtype = dtype if one.is_literal else one.dtype if given[0].is_literal else joined(dtype, one.dtype)
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
        number = Number(dtype, code.register(f"load {kind}, ptr {place}"))
        is_down = step.text.startswith("-")
        code.branch(code.compare(">" if is_down else "<", number, stop), body, end)
        # the body, then the next number
        code.begin(body)
        self._set(name, number)
        self._exits.append((after, end))
        self._block(node.body)
        self._exits.pop()
        code.begin(after)
        wraps = "nuw" if dtype.kind == "u" else "nsw"
        following = code.register(f"add {wraps} {number.typed}, {step.text}")
        code.put(f"store {kind} {following}, ptr {place}")
        code.jump(test)
        code.begin(end)

    def _while(self, node: ast.While) -> None:
        """while condition."""
        test, body, end = (self.code.new_label() for _ in range(3))
        self.code.begin(test)
        self.code.branch(self._truth(node.test), body, end)
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
        numbers = [_number(one) for one in value] if type(value) is tuple else [_number(value)]
        found = [one.dtype for one in numbers]
        known = self.result
        old = found if known is None else known if isinstance(known, list) else [known]
        kinds = [joined(a, b) for a, b in zip(old, found, strict=True)]
        self.result = kinds if type(value) is tuple else kinds[0]
        if known is not None and self.result != known:
            raise Widened("return")
        # several numbers go back as one structure
        cast = [self.code.cast(one, kind) for one, kind in zip(numbers, kinds, strict=True)]
        if type(value) is not tuple:
            self.code.end(f"ret {cast[0].typed}")
            return
        kind, whole = self.result_text, "undef"
        for k, one in enumerate(cast):
            whole = self.code.register(f"insertvalue {kind} {whole}, {one.typed}, {k}")
        self.code.end(f"ret {kind} {whole}")

    # --------------------------------------------------------------------------- expressions

    def expression(self, node: ast.expr) -> Item:
        """Value of an expression."""
        if isinstance(node, ast.Constant):
            return () if isinstance(node.value, str) else literal(node.value)
        if isinstance(node, ast.Name):
            return self._named(node.id)
        if isinstance(node, ast.Tuple):
            return tuple(self.expression(one) for one in node.elts)
        if isinstance(node, ast.BinOp):
            return self._arithmetic(node.op, *map(self.expression, (node.left, node.right)))
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

    def _arithmetic(self, op: ast.operator, a: Item, b: Item) -> Number:
        if type(op) not in _OPERATORS:
            raise LoopSourceError(f"operator {type(op).__name__} is not understood")
        return self.code.arithmetic(_OPERATORS[type(op)], _number(a), _number(b))

    def _unary(self, node: ast.UnaryOp) -> Number:
        """-x, +x and not x."""
        if isinstance(node.op, ast.Not):
            test = self._truth(node.operand)
            if test.is_literal:
                return literal(test.text != "true")
            return Number(BOOL, self.code.register(f"xor i1 {test.text}, true"))
        if isinstance(node.op, ast.USub) and isinstance(node.operand, ast.Constant):
            return literal(-node.operand.value)  # type: ignore[operator]
        value = _number(self.expression(node.operand))
        if isinstance(node.op, ast.USub):
            return self.code.negated(value)
        if isinstance(node.op, ast.UAdd):
            return value
        raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")

    def _compared(self, node: ast.Compare) -> Number:
        """a < b; of a < b < c both must hold."""
        values = [_number(self.expression(one)) for one in (node.left, *node.comparators)]
        found = None
        for k, op in enumerate(node.ops):
            if type(op) not in _OPERATORS:
                raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")
            test = self.code.compare(_OPERATORS[type(op)], values[k], values[k + 1])
            both = f"and i1 {found.text}, {test.text}" if found else ""
            found = Number(BOOL, self.code.register(both)) if both else test
        assert found is not None
        return found

    def _truth(self, node: ast.expr) -> Number:
        """Whether an expression is true."""
        return self.code.cast(_number(self.expression(node)), BOOL)

    def _joined(self, node: ast.BoolOp) -> Number:
        """a and b, a or b: the second only where the first leaves it open."""
        code, is_or = self.code, isinstance(node.op, ast.Or)
        end, ways = code.new_label(), []
        for k, one in enumerate(node.values):
            test = self._truth(one)
            ways.append(f"[ {test.text}, %{code.label} ]")
            if k == len(node.values) - 1:
                break
            following = code.new_label()
            code.branch(test, *((end, following) if is_or else (following, end)))
            code.begin(following)
        code.begin(end)
        return Number(BOOL, code.register(f"phi i1 {', '.join(ways)}"))

    def _chosen(self, node: ast.IfExp) -> Item:
        """a if test else b: only one of both is computed."""
        code, test = self.code, self._truth(node.test)
        if test.is_literal:
            return self.expression(node.body if test.text == "true" else node.orelse)
        yes, no, end = (code.new_label() for _ in range(3))
        code.branch(test, yes, no)
        code.begin(yes)
        first = _number(self.expression(node.body))
        yes_end, yes_line = code.label, len(code.lines)
        code.ended = True
        code.begin(no)
        second = _number(self.expression(node.orelse))
        dtype = joined(first.dtype, second.dtype)
        second = code.cast(second, dtype)
        no_end = code.label
        code.jump(end)
        # the first value in the type of both, at the end of its own block
        rest = code.lines[yes_line:]
        del code.lines[yes_line:]
        code.ended = False
        first = code.cast(first, dtype)
        code.jump(end)
        code.lines += rest
        code.begin(end)
        ways = f"[ {first.text}, %{yes_end} ], [ {second.text}, %{no_end} ]"
        return Number(dtype, code.register(f"phi {LLVM[dtype.name]} {ways}"))

    def _element(self, node: ast.Subscript) -> Item:
        """Element of an array, at an address or of a tuple."""
        one = self.expression(node.value)
        index = self._index(node)
        if isinstance(one, Pointer | View):
            return self.code.load(one, index)
        if type(one) is tuple and index[0].is_literal:
            return one[int(index[0].text)]
        raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")

    def _elements(self, node: ast.Subscript) -> Pointer | View:
        one = self.expression(node.value)
        if not isinstance(one, Pointer | View):
            raise LoopSourceError(f"`{ast.unparse(node)}` takes no value")
        return one

    def _index(self, node: ast.Subscript) -> list[Number]:
        places = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        return [_number(self.expression(place)) for place in places]

    def _attribute(self, node: ast.Attribute) -> Item:
        """Shape and size of an array, or a number of `math` or `numpy`."""
        name = ast.unparse(node)
        if isinstance(node.value, ast.Name) and node.value.id in ("np", "math"):
            return literal(eval(name, {}, self._text.constants))
        one = self.expression(node.value)
        if isinstance(one, View) and node.attr == "shape":
            return one.shape
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
            return self.code.cast(_number(given[0]), dtype)
        value = called(self.code, name, given)
        if value is None:
            raise LoopSourceError(f"`{ast.unparse(node)}` is not understood")
        return value

    def _type(self, name: str) -> np.dtype | None:
        """The type that a name stands for."""
        package, _, attribute = name.rpartition(".")
        found = getattr(np, attribute, None) if package == "np" else self._text.constants.get(name)
        return np.dtype(found) if isinstance(found, type) and issubclass(found, np.generic) else None

    def _called(self, name: str, given: list[Item]) -> Item:
        """Call a function of the text."""
        symbol, result = self._text.function(name, given)
        texts = ", ".join(text for one in given for text in _flat(one))
        call = f"call {_result_text(result)} @{symbol}({texts})"
        if result is None:
            self.code.put(call)
            return ()
        whole = self.code.register(call)
        if not isinstance(result, list):
            return Number(result, whole)
        kind = _result_text(result)
        return tuple(
            Number(one, self.code.register(f"extractvalue {kind} {whole}, {k}"))
            for k, one in enumerate(result)
        )


def _result_text(result: Any) -> str:
    """LLVM's type of a result of no, one or several types."""
    if result is None:
        return "void"
    if isinstance(result, list):
        return "{ " + ", ".join(LLVM[one.name] for one in result) + " }"
    return LLVM[result.name]


def _number(item: Item) -> Number:
    if not isinstance(item, Number):
        raise LoopSourceError("a number is asked for")
    return item


def kinds_of(item: Item) -> Any:
    """Types of an argument, by which functions of other arguments are told apart."""
    if isinstance(item, Number):
        return item.dtype
    if isinstance(item, Pointer):
        return ("address", item.dtype)
    if isinstance(item, View):
        return ("array", item.dtype, len(item.shape))
    return tuple(map(kinds_of, item))


def _flat(item: Item) -> list[str]:
    """Numbers and addresses of an argument, with their types."""
    if isinstance(item, Number):
        return [item.typed]
    if isinstance(item, Pointer):
        return [f"ptr {item.text}"]
    if isinstance(item, View):
        return [f"ptr {item.text}", *(length.typed for length in item.shape)]
    return [text for one in item for text in _flat(one)]


def parameters(given: list[Item]) -> tuple[list[Item], list[tuple[str, str]]]:
    """Parameters for arguments of some types, and the name and text of each of their parts."""
    heads: list[tuple[str, str]] = []

    def part(kind: str) -> str:
        heads.append((f"%a{len(heads)}", f"{kind} %a{len(heads)}"))
        return heads[-1][0]

    def renamed(item: Item) -> Item:
        if isinstance(item, Number):
            return Number(item.dtype, part(LLVM[item.dtype.name]))
        if isinstance(item, Pointer):
            return Pointer(item.dtype, part("ptr"))
        if isinstance(item, View):
            return View(item.dtype, part("ptr"), tuple(Number(INT64, part("i64")) for _ in item.shape))
        return tuple(map(renamed, item))

    return [renamed(item) for item in given], heads
