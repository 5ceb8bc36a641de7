"""Blocks of rows side by side: what a compiled loop calls to be run by several threads.

A loop that Numba parallelizes itself is compiled some four times over: as a function, as the body
of its parallel region, in the wrapper of that region and in the caller. Here it is compiled once,
for one block of rows. Called for several, it hands itself to Numba's threads, block by block, with
the arguments that it has been given.

Importing this starts Numba's threads, which also makes their entry known to the compiler.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import get_num_threads, types
from numba.core import cgutils
from numba.extending import intrinsic

_BEGIN = 2
"""Place of a loop's first argument, after two of Numba's: where its result and an error go."""

get_num_threads()


@intrinsic
def dispatch_blocks(_context: Any) -> tuple:
    """Run the loop that calls this once for each of its blocks.

    For functions loop(begin, end, threads, ...) of three unsigned integers and anything else, with
    no result: for each b from `begin` to `end` loop(b, b + 1, threads, ...) runs on one of so many
    threads. An error that a block raises is raised when all are done.
    """
    return types.none(), _handed_over


def _handed_over(context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
    """Code of `dispatch_blocks`: all arguments in one place, and the call of Numba's threads."""
    loop = builder.function
    loop.attributes.add("noinline")
    word, byte = loop.args[_BEGIN].type, cgutils.voidptr_t
    with builder.goto_entry_block():
        frame = builder.alloca(_frame(loop))  # alloca_once would fill it with zeros at each call
    builder.store(ir.Constant(ir.IntType(32), 0), cgutils.gep_inbounds(builder, frame, 0, 0))
    for k, argument in enumerate(loop.args):
        builder.store(argument, cgutils.gep_inbounds(builder, frame, 0, k + 1))
    begin, end, threads = loop.args[_BEGIN : _BEGIN + 3]
    number = cgutils.alloca_once_value(builder, builder.inttoptr(begin, byte))
    count = cgutils.alloca_once_value(builder, builder.sub(end, begin))
    step = cgutils.alloca_once_value(builder, ir.Constant(word, 1))
    shape = ir.FunctionType(ir.VoidType(), [byte] * 5 + [word] * 3)
    run = cgutils.get_or_insert_function(builder.module, shape, "numba_parallel_for")
    pointers = (_task(builder.module, loop), number, count, step, frame)
    sizes = [ir.Constant(word, 0), ir.Constant(word, 1), threads]
    builder.call(run, [*(builder.bitcast(pointer, byte) for pointer in pointers), *sizes])
    code = builder.load(cgutils.gep_inbounds(builder, frame, 0, 0))
    with builder.if_then(cgutils.is_not_null(builder, code), likely=False):
        builder.ret(code)
    return context.get_dummy_value()


def _frame(loop: ir.Function) -> ir.Type:
    """What tasks are given: room for the code of an error, and the loop's arguments."""
    return ir.LiteralStructType([ir.IntType(32), *(argument.type for argument in loop.args)])


def _task(module: ir.Module, loop: ir.Function) -> ir.Function:
    """What threads call, as Numba calls functions of arrays.

    The pointer to its first operand is no address but the number of a block: it starts at `begin`
    and grows by a step of one.
    """
    word, byte = loop.args[_BEGIN].type, cgutils.voidptr_t
    pointers = [byte.as_pointer(), word.as_pointer(), word.as_pointer(), byte]
    task = ir.Function(module, ir.FunctionType(ir.VoidType(), pointers), f"{loop.name}.task")
    task.linkage = "internal"
    builder = ir.IRBuilder(task.append_basic_block())
    numbers, counts, _, data = task.args
    frame = builder.bitcast(data, _frame(loop).as_pointer())
    places = (cgutils.gep_inbounds(builder, frame, 0, k + 1) for k in range(len(loop.args)))
    given: list[Any] = [builder.load(place) for place in places]
    first = builder.ptrtoint(builder.load(numbers), word)
    with cgutils.for_range(builder, builder.load(counts)) as blocks:
        block = builder.add(first, blocks.index)
        given[_BEGIN : _BEGIN + 2] = block, builder.add(block, ir.Constant(word, 1))
        code = builder.call(loop, given)
        with cgutils.if_unlikely(builder, cgutils.is_not_null(builder, code)):
            builder.store(code, cgutils.gep_inbounds(builder, frame, 0, 0))
    builder.ret_void()
    return task
