"""Blocks of a loop side by side: the function `lasersph_share_blocks` that loops are run by.

    lasersph_share_blocks(loop, blocks, threads, count, frame)

calls what is compiled at the address `loop` with each number of a block, `count` and `frame`, on so
many of Numba's threads. By the entry of these threads, which Numba does not document, that is a
function written here; where the entry is not as known, it is one of Numba's own parallel loops.

Importing this starts Numba's threads, which also makes their entry known.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import cfunc, get_num_threads, njit, prange, types
from numba.extending import intrinsic

from lasersph.compute.native_calls import SHARE
from lasersph.compute.numba_internals import PARALLEL_FOR

get_num_threads()

BY_ENTRY = f"""
declare void @{PARALLEL_FOR}(ptr, ptr, ptr, ptr, ptr, i64, i64, i64)

; blocks of one thread, as Numba calls functions of arrays: the operand is no address but the number
; of the first block, which grows by a step of one; `data` holds loop, count and frame
define internal void @{SHARE}.task(ptr %operands, ptr %counts, ptr %steps, ptr %data) {{
start:
  %first = load i64, ptr %operands
  %blocks = load i64, ptr %counts
  %end = add i64 %first, %blocks
  %address = load i64, ptr %data
  %count_place = getelementptr i64, ptr %data, i64 1
  %count = load i64, ptr %count_place
  %frame_place = getelementptr i64, ptr %data, i64 2
  %frame = load i64, ptr %frame_place
  %loop = inttoptr i64 %address to ptr
  br label %test
test:
  %block = phi i64 [ %first, %start ], [ %next, %body ]
  %is_more = icmp ult i64 %block, %end
  br i1 %is_more, label %body, label %done
body:
  call void %loop(i64 %block, i64 %count, i64 %frame)
  %next = add nuw i64 %block, 1
  br label %test
done:
  ret void
}}

define void @{SHARE}(i64 %loop, i64 %blocks, i64 %threads, i64 %count, i64 %frame) {{
start:
  %data = alloca [3 x i64]
  %operand = alloca i64
  %length = alloca i64
  %step = alloca i64
  store i64 %loop, ptr %data
  %count_place = getelementptr i64, ptr %data, i64 1
  store i64 %count, ptr %count_place
  %frame_place = getelementptr i64, ptr %data, i64 2
  store i64 %frame, ptr %frame_place
  store i64 0, ptr %operand
  store i64 %blocks, ptr %length
  store i64 1, ptr %step
  ; one operand, which has no axes of its own
  call void @{PARALLEL_FOR}(ptr @{SHARE}.task, ptr %operand, ptr %length, ptr %step, ptr %data,
                            i64 0, i64 1, i64 %threads)
  ret void
}}
"""


@intrinsic
def _invoke(_context: Any, _address: Any, _block: Any, _count: Any, _frame: Any) -> tuple:
    """Call the loop at an address with its three unsigned integers; gives 0."""
    from llvmlite import ir

    def code(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        word = ir.IntType(64)
        loop = ir.FunctionType(ir.VoidType(), [word] * 3)
        builder.call(builder.inttoptr(arguments[0], loop.as_pointer()), arguments[1:])
        return ir.Constant(word, 0)

    return types.uint64(*[types.uint64] * 4), code


_ONE = np.uint64(1)
_invoke_block: Any = _invoke


@njit(parallel=True)
def _share_blocks(address, blocks, threads, count, frame):
    """Call the loop at an address for each of its blocks, a share of them on each thread."""
    for k in prange(np.int64(threads)):
        share = np.uint64(k)
        for block in range(blocks * share // threads, blocks * (share + _ONE) // threads):
            _invoke_block(address, block, count, frame)


def shared_by_numba() -> Any:
    """The function by Numba's own parallel loop, with its `address`; its owner must stay."""

    @cfunc(types.void(*[types.uint64] * 5))
    def share(address, blocks, threads, count, frame):
        _share_blocks(address, blocks, threads, count, frame)

    return share
