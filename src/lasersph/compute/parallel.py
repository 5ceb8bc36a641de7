"""Blocks of rows side by side: what a compiled loop calls to be run by several threads.

A loop that Numba parallelizes itself is compiled some four times over: as a function, as the body
of its parallel region, in the wrapper of that region and in the caller. Here it is compiled once,
for one block of rows. Called for several, it hands itself to Numba's threads, block by block, with
the arguments that it has been given (`dispatch_blocks`). The public way is Numba's own parallel
loop, where the entry of its threads is not known (`shared_text`, `invoke`).

Importing this starts Numba's threads, which also makes their entry known to the compiler.
"""

from __future__ import annotations

import ast
from typing import Any

import numpy as np
from numba import get_num_threads, njit, prange, types
from numba.extending import intrinsic

from lasersph.compute import native, numba_internals

get_num_threads()


@intrinsic
def dispatch_blocks(_context: Any) -> tuple:
    """Run the loop that calls this once for each of its blocks.

    For functions loop(begin, end, threads, ...) of three unsigned integers and anything else, with
    no result: for each b from `begin` to `end` loop(b, b + 1, threads, ...) runs on one of so many
    threads. An error that a block raises is raised when all are done.
    """
    return types.none(), numba_internals.hand_over


_ONE = np.uint64(1)
_invoke_block: Any = native.invoke


@njit(parallel=True)
def _invoke_blocks(address, begin, end, threads, count, frame):
    """Call the loop at an address for each of its blocks, a share of them on each thread."""
    for k in prange(np.int64(threads)):
        share = np.uint64(k)
        first = begin + (end - begin) * share // threads
        last = begin + (end - begin) * (share + _ONE) // threads
        for block in range(first, last):
            _invoke_block(address, block, block + _ONE, _ONE, count, frame)


@njit
def invoke(address, begin, end, threads, count, frame):
    """`native.invoke` for loops of one block, by `prange` where there are several."""
    if end - begin > _ONE:
        _invoke_blocks(address, begin, end, threads, count, frame)
    else:
        _invoke_block(address, begin, end, threads, count, frame)


_IMPORT = "from lasersph.compute.parallel import dispatch_blocks\n"
_PUBLIC_IMPORT = "from numba import prange\nfrom lasersph.compute.parallel import invoke\n"
_SHARED = """
def {name}(begin, end, threads, {names}):
    one = np.uint64(1)
    for k in prange(np.int64(threads)):
        share = np.uint64(k)
        first = begin + (end - begin) * share // threads
        last = begin + (end - begin) * (share + one) // threads
        for block in range(first, last):
            {name}_block(block, block + one, one, {names})
"""


def shared_text(text: str) -> str:
    """The text of loops with `prange` in place of `dispatch_blocks`.

    A loop that is called by its address does one block, and `invoke` shares its blocks. One that
    Python calls, with a decorator, becomes a function of one block and a parallel loop over blocks.
    """
    if _IMPORT not in text:
        return text
    tree = ast.parse(text.replace(_IMPORT, _PUBLIC_IMPORT))
    parts: list[ast.stmt] = []
    for part in tree.body:
        parts.append(part)
        if not isinstance(part, ast.FunctionDef):
            continue
        body = [line for line in part.body if not _dispatches(line)]
        if len(body) == len(part.body):
            continue
        part.body = body
        if part.decorator_list:
            names = ", ".join(one.arg for one in part.args.args[3:])
            (shared,) = ast.parse(_SHARED.format(name=part.name, names=names)).body
            assert isinstance(shared, ast.FunctionDef)
            shared.decorator_list = [_parallel(part.decorator_list[0])]
            part.name, part.decorator_list = f"{part.name}_block", [_serial(part.decorator_list[0])]
            parts.append(shared)
    tree.body = parts
    return ast.unparse(ast.fix_missing_locations(tree)) + "\n"


def _dispatches(line: ast.stmt) -> bool:
    """Whether a statement hands blocks over."""
    return isinstance(line, ast.If) and "dispatch_blocks()" in ast.unparse(line)


def _parallel(decorator: ast.expr) -> ast.expr:
    """The decorator of a function with a parallel loop."""
    return ast.parse(
        ast.unparse(decorator).removesuffix(")") + ", parallel=True)", mode="eval"
    ).body


def _serial(decorator: ast.expr) -> ast.expr:
    """The decorator of a function that only compiled ones call."""
    return ast.parse(ast.unparse(decorator).replace(", cache=True", ""), mode="eval").body
