"""Machine code of generated texts: written once by LLVM, kept as object files.

An object file holds one function of unsigned 64-bit integers, whose name follows from its text.
It is found again by that name and by what decides about machine code: LLVM's version and the
processor. A file that is damaged is written anew.
"""

from __future__ import annotations

import hashlib
import importlib
from functools import cache
from importlib.metadata import version
from typing import Any

from lasersph.compute import numba_internals
from lasersph.compute.native_calls import SHARE
from lasersph.compute.native_text import NativeText

_SUM_BYTES = 16
_EFFORT = 3
"""LLVM's level of optimization, its highest."""
SLOW_GATHERS = "znver"
"""How LLVM's names of processors begin on which an instruction that reads eight places of an array
takes longer than eight that read one. Speed: without it sums over pairs take 0.7 of the time on a
fourth-generation EPYC (AMD), `benchmarks/roofline.py`."""
_owners: list[Any] = []
"""Owners of machine code of Numba's, which goes with them."""


@cache
def target() -> str:
    """Short name of what machine code depends on beside the text."""
    parts = (version("llvmlite"), *_processor())
    return hashlib.sha256("|".join(parts).encode()).hexdigest()[:8]


@cache
def _processor() -> tuple[str, str]:
    """LLVM's name of this processor, and of its instructions those that loops are to use."""
    import llvmlite.binding as llvm

    name, features = llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten()
    return name, features + (",+prefer-no-gather" if name.startswith(SLOW_GATHERS) else "")


@cache
def _engine() -> Any:
    """Owner of the machine code of this process; never closed."""
    import llvmlite.binding as llvm

    # the threads that loops are shared among: by their entry, or by a loop of Numba's
    parallel = importlib.import_module("lasersph.compute.parallel")  # whose import starts them
    has_entry = numba_internals.has_entry()
    engine = llvm.create_mcjit_compiler(
        llvm.parse_assembly(parallel.BY_ENTRY if has_entry else ""), _machine()
    )
    if not has_entry:
        _owners.append(parallel.shared_by_numba())
        llvm.add_symbol(SHARE, _owners[0].address)
    return engine


def _machine() -> Any:
    """Description of this processor, which writes machine code for it."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    name, features = _processor()
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=name,
        features=features,
        opt=_EFFORT,
        jit=True,
        codemodel="jitdefault",
        reloc="default",
    )


def compile_text(text: str, symbol: str, *, is_fast: bool) -> bytes:
    """Object file, with its check sum, of the function `loop` of a text.

    Args:
        symbol: what it is called there. is_fast: whether sums may be rearranged.

    Raises:
        LoopSourceError: the text has something that is not understood.
    """
    code = _machine().emit_object(optimized(text, symbol, is_fast=is_fast))
    return hashlib.sha256(code).digest()[:_SUM_BYTES] + code


def optimized(text: str, symbol: str, *, is_fast: bool) -> Any:
    """LLVM module of a text's function, as it is translated to machine code."""
    import llvmlite.binding as llvm

    machine = _machine()
    module = llvm.parse_assembly(NativeText(text, symbol, is_fast=is_fast).written())
    module.triple, module.data_layout = machine.triple, str(machine.target_data)
    # several elements at a time where a loop allows it
    options = llvm.create_pipeline_tuning_options(_EFFORT)
    options.loop_vectorization = True
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    return module


def address_of(content: bytes, symbol: str) -> int | None:
    """Address of the function in an object file; None where the file is damaged."""
    import llvmlite.binding as llvm

    check, code = content[:_SUM_BYTES], content[_SUM_BYTES:]
    if hashlib.sha256(code).digest()[:_SUM_BYTES] != check:
        return None
    engine = _engine()
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    return engine.get_function_address(symbol)
