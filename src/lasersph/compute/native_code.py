"""Instructions of one function of native code, written one after the other as LLVM's text.

Names are places in memory, which LLVM turns into registers. A block of instructions that ends in a
jump takes no more of them.
"""

from __future__ import annotations

import numpy as np

from lasersph.compute.native_values import (
    BOOL,
    FLOAT64,
    INT64,
    LLVM,
    UINT64,
    Number,
    Pointer,
    View,
    arithmetic,
    joined,
    literal,
)
from lasersph.compute.values import LoopSourceError

FAST = "reassoc nsz arcp contract "
"""Liberties with sums and products; NaN and infinity stay."""
_REAL = {"+": "fadd", "-": "fsub", "*": "fmul", "/": "fdiv", "%": "frem"}
_WHOLE = {"+": "add", "-": "sub", "*": "mul", "&": "and", "|": "or"}
_COMPARED = {"<": "lt", "<=": "le", ">": "gt", ">=": "ge", "==": "eq", "!=": "ne"}


class Code:
    """Receives the instructions of a function.

    Args:
        is_fast: whether sums may be rearranged.

    Attributes:
        ended: whether the block has its jump. declared: functions of others that it calls.
    """

    def __init__(self, *, is_fast: bool) -> None:
        self.fast = FAST if is_fast else ""
        self.places: list[str] = []
        self.lines: list[str] = []
        self.declared: set[str] = set()
        self.ended = False
        self.label = "start"
        self._count = 0

    def register(self, instruction: str) -> str:
        """Register of what an instruction gives."""
        self._count += 1
        self.lines.append(f"  %r{self._count} = {instruction}")
        return f"%r{self._count}"

    def put(self, instruction: str) -> None:
        """An instruction that gives nothing."""
        self.lines.append(f"  {instruction}")

    def place(self, kind: str) -> str:
        """Address of memory of the function itself."""
        self._count += 1
        self.places.append(f"  %m{self._count} = alloca {kind}")
        return f"%m{self._count}"

    def new_label(self) -> str:
        """Name of a block to come."""
        self._count += 1
        return f"b{self._count}"

    def begin(self, label: str) -> None:
        """Begin a block, to which the one before goes on unless it has its jump."""
        self.jump(label)
        self.lines.append(f"{label}:")
        self.ended, self.label = False, label

    def jump(self, label: str) -> None:
        """Go on at a label."""
        self.end(f"br label %{label}")

    def branch(self, test: Number, yes: str, no: str) -> None:
        """Go on at one of two labels."""
        self.end(f"br i1 {test.text}, label %{yes}, label %{no}")

    def end(self, instruction: str) -> None:
        """The jump of a block, unless it has one."""
        if not self.ended:
            self.put(instruction)
        self.ended = True

    def cast(self, value: Number, dtype: np.dtype) -> Number:
        """The number in another type."""
        old = value.dtype
        if old == dtype:
            return value
        if dtype == BOOL:
            return self.compare("!=", value, Number(old, "0" if old.kind != "f" else "0.0"))
        if value.is_literal and old.kind in "iu" and dtype.kind in "iu":
            return Number(dtype, value.text)
        source, target = LLVM[old.name], LLVM[dtype.name]
        signed = "s" if old.kind == "i" else "u"
        if dtype.kind == "f":
            how = "fpext" if dtype.itemsize > old.itemsize else "fptrunc"
            how = how if old.kind == "f" else f"{signed}itofp"
        elif old.kind == "f":
            how = "fptosi" if dtype.kind == "i" else "fptoui"
        elif source == target:
            return Number(dtype, value.text)
        elif old == BOOL or dtype.itemsize > old.itemsize:
            how = "sext" if old.kind == "i" else "zext"
        else:
            how = "trunc"
        return Number(dtype, self.register(f"{how} {source} {value.text} to {target}"))

    def arithmetic(self, op: str, a: Number, b: Number) -> Number:
        """a op b of + - * / // % & |."""
        dtype = arithmetic(a.dtype, b.dtype)
        if op == "/" and dtype.kind != "f":
            dtype = FLOAT64
        a, b = self.cast(a, dtype), self.cast(b, dtype)
        if dtype.kind == "f" and op in _REAL:
            how = f"{_REAL[op]} {self.fast}"
        elif dtype.kind != "f" and op in _WHOLE:
            how = f"{_WHOLE[op]} "
        elif dtype == UINT64 and op in ("//", "%"):
            how = "udiv " if op == "//" else "urem "
        elif dtype == INT64 and op in ("//", "%"):
            return self._floored(op, a, b)
        else:
            raise LoopSourceError(f"operator {op} of {a.dtype} and {b.dtype}")
        return Number(dtype, self.register(f"{how}{a.typed}, {b.text}"))

    def _floored(self, op: str, a: Number, b: Number) -> Number:
        """Quotient of whole numbers toward minus infinity, or its remainder, which has b's sign."""
        quotient = Number(INT64, self.register(f"sdiv {a.typed}, {b.text}"))
        remainder = Number(INT64, self.register(f"srem {a.typed}, {b.text}"))
        # one less where something is left whose sign is not that of b
        zero = literal(0)
        left = self.compare("!=", remainder, zero)
        signs = Number(INT64, self.register(f"xor {remainder.typed}, {b.text}"))
        apart = self.compare("<", signs, zero)
        lower = Number(BOOL, self.register(f"and i1 {left.text}, {apart.text}"))
        if op == "//":
            return self.arithmetic("-", quotient, self.cast(lower, INT64))
        return self.select(lower, self.arithmetic("+", remainder, b), remainder)

    def negated(self, value: Number) -> Number:
        """-value."""
        if value.dtype.kind == "f":
            return Number(value.dtype, self.register(f"fneg {self.fast}{value.typed}"))
        return self.arithmetic("-", literal(0), value)

    def compare(self, op: str, a: Number, b: Number) -> Number:
        """a op b; false of NaN but for !=."""
        how, kinds = _COMPARED[op], {a.dtype.kind, b.dtype.kind}
        if "f" in kinds:
            dtype = joined(a.dtype, b.dtype)
            a, b = self.cast(a, dtype), self.cast(b, dtype)
            how = "une" if op == "!=" else f"o{how}"
            return Number(BOOL, self.register(f"fcmp {self.fast}{how} {a.typed}, {b.text}"))
        if kinds == {"i", "u"}:
            return self._compared_signed(op, a, b)
        dtype = joined(a.dtype, b.dtype)
        a, b = self.cast(a, dtype), self.cast(b, dtype)
        sign = "" if how in ("eq", "ne") else "s" if dtype.kind == "i" else "u"
        return Number(BOOL, self.register(f"icmp {sign}{how} {a.typed}, {b.text}"))

    def _compared_signed(self, op: str, a: Number, b: Number) -> Number:
        """Comparison of a signed number and one without sign, by their values."""
        for one, other in ((a, b), (b, a)):  # a literal that is not negative needs no sign
            if one.is_literal and one.dtype == INT64 and not one.text.startswith("-"):
                one = Number(other.dtype, one.text)
                return self.compare(op, *((one, other) if other is b else (other, one)))
        wide = [
            self.register(f"{'sext' if one.dtype.kind == 'i' else 'zext'} {one.typed} to i128")
            for one in (a, b)
        ]
        how = _COMPARED[op]
        sign = "" if how in ("eq", "ne") else "s"
        return Number(BOOL, self.register(f"icmp {sign}{how} i128 {wide[0]}, {wide[1]}"))

    def select(self, test: Number, yes: Number, no: Number) -> Number:
        """One of two numbers of a type."""
        return Number(yes.dtype, self.register(f"select i1 {test.text}, {yes.typed}, {no.typed}"))

    def extreme(self, op: str, values: list[Number]) -> Number:
        """The first of the numbers than which no later one is less (op <) or larger (op >)."""
        best = values[0]
        for value in values[1:]:
            dtype = joined(best.dtype, value.dtype)
            best, value = self.cast(best, dtype), self.cast(value, dtype)
            best = self.select(self.compare(op, value, best), value, best)
        return best

    def absolute(self, value: Number) -> Number:
        """|value|."""
        if value.dtype.kind == "f":
            return self.intrinsic("fabs", [value])
        if value.dtype.kind == "i":
            return self.select(self.compare("<", value, literal(0)), self.negated(value), value)
        return value

    def intrinsic(self, name: str, values: list[Number], fast: str | None = None) -> Number:
        """A function that LLVM knows, of real numbers of one type."""
        dtype = self._real(values)
        kind = LLVM[dtype.name]
        letter = "f64" if kind == "double" else "f32"
        return self._called(f"llvm.{name}.{letter}", kind, values, dtype, fast)

    def library(self, name: str, values: list[Number]) -> Number:
        """A function of the system's mathematical library."""
        dtype = self._real(values)
        suffix = "" if dtype.itemsize == 8 else "f"
        return self._called(name + suffix, LLVM[dtype.name], values, dtype, None)

    def _real(self, values: list[Number]) -> np.dtype:
        """Type of real numbers that holds all."""
        dtype = values[0].dtype
        for value in values[1:]:
            dtype = joined(dtype, value.dtype)
        return dtype if dtype.kind == "f" else FLOAT64

    def _called(
        self, name: str, kind: str, values: list[Number], dtype: np.dtype, fast: str | None
    ) -> Number:
        arguments = ", ".join(self.cast(value, dtype).typed for value in values)
        self.declared.add(f"declare {kind} @{name}({', '.join([kind] * len(values))})")
        flags = self.fast if fast is None else fast
        return Number(dtype, self.register(f"call {flags}{kind} @{name}({arguments})"))

    def pointer(self, address: Number, dtype: np.dtype) -> Pointer:
        """Elements at an address."""
        return Pointer(dtype, self.register(f"inttoptr {address.typed} to ptr"))

    def element(self, one: Pointer | View, index: list[Number]) -> str:
        """Address of an element; whole numbers with a sign count from the end where negative."""
        if isinstance(one, Pointer):
            if len(index) != 1:
                raise LoopSourceError("an address takes one index")
            place = index[0]
        else:
            if len(index) != len(one.shape):
                raise LoopSourceError(f"{len(index)} indices for {len(one.shape)} axes")
            place = literal(0)
            for k, length in zip(index, one.shape, strict=True):
                step = self.cast(self._from_start(k, length), INT64)
                place = self.arithmetic("+", self.arithmetic("*", place, length), step)
        kind = LLVM[one.dtype.name]
        place = self.cast(place, INT64)
        return self.register(f"getelementptr inbounds {kind}, ptr {one.text}, {place.typed}")

    def _from_start(self, k: Number, length: Number) -> Number:
        if k.dtype.kind != "i" or (k.is_literal and not k.text.startswith("-")):
            return k
        is_negative = self.compare("<", k, literal(0))
        return self.select(is_negative, self.arithmetic("+", k, length), k)

    def load(self, one: Pointer | View, index: list[Number]) -> Number:
        """An element."""
        kind = LLVM[one.dtype.name]
        return Number(one.dtype, self.register(f"load {kind}, ptr {self.element(one, index)}"))

    def store(self, one: Pointer | View, index: list[Number], value: Number) -> None:
        """Set an element."""
        place = self.element(one, index)
        self.put(f"store {self.cast(value, one.dtype).typed}, ptr {place}")
