"""Parts of Numba that it does not document, each with the public way beside it.

Loops are compiled and started faster by parts that Numba may change: `Part` lists them. What is
missing is found out once in each process; of a Numba newer than those that the parts were tested
with, those that run machine code are tried in a process of their own (`trial`). Where parts are
missing, one line says so with what that costs, and the public way gives the same bits.

| part | here | public way |
|---|---|---|
| THREADS | `hand_over` | `prange` (`cache.shared_text`, `parallel.invoke`) |
| MACHINE_CODE | `llvm_of`, for object files (`machine_code`) | `cfunc(..., cache=True).address` |
| WRAPPERS | options of `njit` | `with_public_options` |
| BLAS | `skip_blas` | Numba looks for BLAS at its first function |

Importing this starts nothing.
"""

from __future__ import annotations

import importlib
import re
import warnings
from collections.abc import Callable
from enum import Enum
from importlib.metadata import version
from typing import Any

UNTESTED = (0, 69)
"""First Numba that the parts were not tested with."""
FAST = {"reassoc", "contract", "arcp", "nsz"}
"""Liberties of the compiler with sums and products of a loop; NaN and infinity stay."""
_LONGEST_REASON = 120
_PARALLEL_FOR = "numba_parallel_for"
_CGUTILS = ("alloca_once_value", "for_range", "get_or_insert_function", "gep_inbounds")
_CGUTILS += ("if_unlikely", "is_not_null", "voidptr_t")
_WRAPPERS = ("no_cpython_wrapper", "no_cfunc_wrapper")


class Part(Enum):
    """A part by the words for what is missing, and what the public way costs."""

    THREADS = ("entry of its threads", "compiling takes a third longer")
    MACHINE_CODE = (
        "LLVM functions as known",
        "a start takes some tenths of a second longer",
    )
    WRAPPERS = ("options without wrappers", "compiling takes a tenth longer")
    BLAS = ("check for BLAS as known", "a start may load SciPy's linear algebra, 0.15 s")


_missing: dict[Part, str] = {}
_checked: list[bool] = []


def check(passes: Callable[[str], bool]) -> None:
    """Find out once which parts are missing, and say so.

    Args:
        passes: whether a part, by its name, does what it should when it is tried.
    """
    if _checked:
        return
    _checked.append(True)
    # what a look at Numba shows
    for part, refuse in _REFUSALS.items():
        try:
            refuse()
        except Exception as error:
            _missing[part] = _reason(error)
    # what only a run of machine code shows, which may end the process
    if _release() >= UNTESTED:
        for part in (Part.THREADS, Part.MACHINE_CODE):
            if part not in _missing and not passes(part.name):
                _missing[part] = "its trial failed"
    if _missing:
        _say(_missing)


def lose(part: Part, error: Exception) -> None:
    """Do without a part from now on, and say so once."""
    if part not in _missing:
        _missing[part] = _reason(error)
        _say({part: _missing[part]})


def has(part: Part) -> bool:
    """Whether a part is there, as far as is known; see `check`."""
    return part not in _missing


def keeps_object_files() -> bool:
    """Whether loops are kept as object files: what `prange` adds to a loop needs Numba to load."""
    return has(Part.MACHINE_CODE) and has(Part.THREADS)


def _say(missing: dict[Part, str]) -> None:
    """One line for all parts that are missing, with what that costs."""
    parts = ", ".join(f"no {part.value[0]} ({reason})" for part, reason in missing.items())
    costs = "; ".join(part.value[1] for part in missing)
    text = f"Numba {version('numba')} has {parts}: results stay the same, but {costs}"
    warnings.warn(text, RuntimeWarning, stacklevel=3)


def _reason(error: Exception) -> str:
    """First line of an error, or its kind."""
    return (str(error).splitlines() or [type(error).__name__])[0][:_LONGEST_REASON]


def _release() -> tuple[int, ...]:
    """Numba's version, its first two numbers."""
    return tuple(int(number) for number in re.findall(r"\d+", version("numba"))[:2])


# ----------------------------------------------------------------------------------------------
# THREADS: the entry of Numba's threads, called from the code of a loop


def _refuse_threads() -> None:
    """Raise where the entry of the threads, or what writes its call, is not there."""
    import llvmlite.binding as llvm
    from numba import get_num_threads
    from numba.core import cgutils

    get_num_threads()  # starts the threads, which makes their entry known
    if llvm.address_of_symbol(_PARALLEL_FOR) is None:
        raise AttributeError(f"{_PARALLEL_FOR} is unknown")
    for name in _CGUTILS:
        getattr(cgutils, name)


_BEGIN = 2
"""Place of a loop's first argument, after two of Numba's: where its result and an error go."""


def hand_over(context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
    """Code of `parallel.dispatch_blocks`: all arguments in one place, and the call of the threads.

    Numba's entry calls task(numbers, counts, steps, frame) from each of its threads with a part of
    the blocks; `frame` is room for the code of an error, and the loop's arguments.
    """
    from llvmlite import ir
    from numba.core import cgutils

    loop = builder.function
    loop.attributes.add("noinline")
    word, byte = loop.args[_BEGIN].type, cgutils.voidptr_t
    frame_type = ir.LiteralStructType([ir.IntType(32), *(one.type for one in loop.args)])
    with builder.goto_entry_block():
        frame = builder.alloca(frame_type)  # alloca_once would fill it with zeros at each call
    # the frame: no error yet, and the arguments as they are
    builder.store(ir.Constant(ir.IntType(32), 0), cgutils.gep_inbounds(builder, frame, 0, 0))
    for k, argument in enumerate(loop.args):
        builder.store(argument, cgutils.gep_inbounds(builder, frame, 0, k + 1))
    # the first operand is no address but the number of a block, which grows by a step of one
    begin, end, threads = loop.args[_BEGIN : _BEGIN + 3]
    number = cgutils.alloca_once_value(builder, builder.inttoptr(begin, byte))
    count = cgutils.alloca_once_value(builder, builder.sub(end, begin))
    step = cgutils.alloca_once_value(builder, ir.Constant(word, 1))
    # numba_parallel_for(task, operands, counts, steps, data, 0, number of operands, threads)
    shape = ir.FunctionType(ir.VoidType(), [byte] * 5 + [word] * 3)
    run = cgutils.get_or_insert_function(builder.module, shape, _PARALLEL_FOR)
    pointers = (_task(builder.module, loop, frame_type), number, count, step, frame)
    sizes = [ir.Constant(word, 0), ir.Constant(word, 1), threads]
    builder.call(run, [*(builder.bitcast(pointer, byte) for pointer in pointers), *sizes])
    # an error of any block is the loop's
    code = builder.load(cgutils.gep_inbounds(builder, frame, 0, 0))
    with builder.if_then(cgutils.is_not_null(builder, code), likely=False):
        builder.ret(code)
    return context.get_dummy_value()


def _task(module: Any, loop: Any, frame_type: Any) -> Any:
    """Function that threads call, as Numba calls functions of arrays: the loop for each block."""
    from llvmlite import ir
    from numba.core import cgutils

    word, byte = loop.args[_BEGIN].type, cgutils.voidptr_t
    pointers = [byte.as_pointer(), word.as_pointer(), word.as_pointer(), byte]
    task = ir.Function(module, ir.FunctionType(ir.VoidType(), pointers), f"{loop.name}.task")
    task.linkage = "internal"
    builder = ir.IRBuilder(task.append_basic_block())
    numbers, counts, _, data = task.args
    frame = builder.bitcast(data, frame_type.as_pointer())
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


# ----------------------------------------------------------------------------------------------
# MACHINE_CODE: LLVM modules as text, and functions in them

_RELEASE = re.compile(r"^declare void @NRT_MemInfo_call_dtor\(.*$", re.MULTILINE)
"""Symbol that frees arrays in Numba, and exists only where Numba has compiled something; tables
that are handed on name it, but a frame owns no array."""
_RELEASES_NOTHING = "define internal void @NRT_MemInfo_call_dtor(ptr %0) { ret void }"
_ENTRY = """
define void @{name}({parameters}) {{
  %result = alloca ptr
  %error = alloca ptr
  %status = call i32 @"{native}"(ptr %result, ptr %error, {parameters})
  ret void
}}
"""
"""Function that calls another as Numba does; Numba's own for that purpose need Python to run."""


def compiled_callback(
    function: Callable[..., None], name: str, *, is_fast: bool, stores: bool = False
) -> Any:
    """A function of unsigned integers without a result, compiled by `cfunc`: the public way.

    Args:
        name: what it is called. is_fast: whether sums may be rearranged. stores: whether Numba
            keeps its machine code beside the function's file.
    """
    from numba import cfunc, types

    function.__qualname__ = name  # enters all names of the module, which then clash with no other
    return cfunc(
        types.void(*[types.uint64] * function.__code__.co_argcount),
        fastmath=FAST if is_fast else False,
        error_model="numpy",
        cache=stores,
    )(function)


def module_of(function: Callable[..., None], name: str, *, is_fast: bool) -> Any:
    """LLVM module of such a function, with one of that name that needs no Python to run.

    Raises:
        LookupError: Numba's functions are not called as is known here.
    """
    import llvmlite.binding as llvm

    compiled = compiled_callback(function, name, is_fast=is_fast)
    count = function.__code__.co_argcount
    native = compiled.native_name.removeprefix("cfunc.")
    parameters = ", ".join(f"i64 %{k}" for k in range(count))
    entry = _ENTRY.format(name=name, native=native, parameters=parameters)
    text = compiled.inspect_llvm()
    if f'"{native}"(' not in text and f"@{native}(" not in text:
        raise LookupError("the function behind a callback has another name")
    module = llvm.parse_assembly(text + entry)
    # nothing else tells a call with other arguments from the right one
    kinds = [str(argument.type) for argument in module.get_function(native).arguments]
    if kinds != ["ptr", "ptr", *["i64"] * count]:
        raise LookupError(f"a function of {count} integers takes {', '.join(kinds)}")
    return module


def without_release(text: str) -> str:
    """LLVM's text without the need for Numba's function that frees arrays."""
    return _RELEASE.sub(_RELEASES_NOTHING, text)


# ----------------------------------------------------------------------------------------------
# WRAPPERS: options of njit that leave out what nothing calls


def _refuse_wrappers() -> None:
    """Raise where njit takes no such options."""
    options = importlib.import_module("numba.core.options").DefaultOptions
    for name in _WRAPPERS:
        getattr(options, name)


def with_public_options(text: str) -> str:
    """The text of loops with documented options alone."""
    for name in _WRAPPERS:
        text = text.replace(f", {name}=True", "")
    return text


# ----------------------------------------------------------------------------------------------
# BLAS: a look for it


def _refuse_blas() -> None:
    """Raise where Numba does not look for BLAS as is known."""
    _ = importlib.import_module("numba.np.linalg").ensure_blas


def skip_blas() -> None:
    """Keep Numba from loading SciPy's linear algebra with its first function, 0.15 s.

    No loop here calls BLAS; a function of somebody else's that does loads it then.
    """
    try:
        _refuse_blas()
    except (AttributeError, ImportError):
        return
    linalg: Any = importlib.import_module("numba.np.linalg")
    linalg.ensure_blas = lambda: None


_REFUSALS: dict[Part, Callable[[], None]] = {
    Part.THREADS: _refuse_threads,
    Part.WRAPPERS: _refuse_wrappers,
    Part.BLAS: _refuse_blas,
}
