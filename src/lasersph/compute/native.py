"""Text that generated code needs beside Numba's language: arrays and functions by their addresses.

Loops take all their arrays as addresses in one array of 64-bit words, a frame, so that every loop
is called alike: from Python by one foreign call, from other compiled code through its address.
What is used of Numba and llvmlite here is documented with `numba.extending.intrinsic`.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

__all__ = [
    "CAPACITY",
    "at_float32",
    "at_float64",
    "at_int64",
    "at_uint8",
    "at_uint32",
    "at_uint64",
    "invoke",
    "maximum",
    "minimum",
    "scratch_float32",
    "scratch_float64",
    "scratch_int64",
    "scratch_uint8",
    "scratch_uint32",
    "scratch_uint64",
]


def _view(element: Any) -> Any:
    """Intrinsic that makes a pointer to elements of a type from an address."""

    @intrinsic
    def at(_context: Any, _address: Any) -> tuple:
        pointer = types.CPointer(element)

        def code(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
            return builder.inttoptr(arguments[0], context.get_value_type(pointer))

        return pointer(types.uint64), code

    return at


at_float64, at_float32 = _view(types.float64), _view(types.float32)
at_uint64, at_uint32, at_uint8 = _view(types.uint64), _view(types.uint32), _view(types.uint8)
at_int64 = _view(types.int64)

CAPACITY = 64
"""Elements of the scratch memory of a function: more than most particles have neighbors."""


def _scratch(element: Any) -> Any:
    """Intrinsic that gives a function memory for some elements, which no other memory overlaps."""

    @intrinsic
    def scratch(_context: Any) -> tuple:
        def code(context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
            kind = context.get_value_type(element)
            with builder.goto_entry_block():
                place = builder.alloca(kind, CAPACITY)
            return place

        return types.CPointer(element)(), code

    return scratch


scratch_float64, scratch_float32 = _scratch(types.float64), _scratch(types.float32)
scratch_uint64, scratch_uint32, scratch_uint8 = (
    _scratch(types.uint64),
    _scratch(types.uint32),
    _scratch(types.uint8),
)
scratch_int64 = _scratch(types.int64)


def _extreme(name: str) -> Any:
    """Intrinsic of two numbers of one type; NaN where one is NaN, so that loops keep their order of
    operations free and can be done several elements at a time."""

    @intrinsic
    def extreme(_context: Any, a: Any, b: Any) -> tuple:
        def code(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
            kind = arguments[0].type
            shape = ir.FunctionType(kind, [kind, kind])
            function = builder.module.declare_intrinsic(f"llvm.{name}", [kind], shape)
            return builder.call(function, arguments, fastmath=("nsz",))

        return a(a, a), code

    return extreme


minimum, maximum = _extreme("minimum"), _extreme("maximum")


@intrinsic
def invoke(
    _context: Any, _address: Any, _begin: Any, _end: Any, _threads: Any, _count: Any, _frame: Any
) -> tuple:
    """Call the loop at an address with its five unsigned integers; gives 0."""

    def code(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        word = ir.IntType(64)
        loop = ir.FunctionType(ir.VoidType(), [word] * 5)
        builder.call(builder.inttoptr(arguments[0], loop.as_pointer()), arguments[1:])
        return ir.Constant(word, 0)

    return types.uint64(*[types.uint64] * 6), code
