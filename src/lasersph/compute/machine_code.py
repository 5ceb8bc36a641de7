"""Machine code of generated functions: compiled once by Numba, kept as object files.

An object file holds one function of unsigned 64-bit integers, whose name follows from its text.
It is found again by that name and by what decides about machine code: versions and processor. A
file that is damaged is written anew.
"""

from __future__ import annotations

import hashlib
import importlib
from collections.abc import Callable
from functools import cache
from importlib.metadata import version
from typing import Any

from lasersph.compute import numba_internals

_SUM_BYTES = 16


@cache
def target() -> str:
    """Short name of what machine code depends on beside the text."""
    import llvmlite.binding as llvm

    features = llvm.get_host_cpu_features().flatten()
    parts = (version("numba"), version("llvmlite"), llvm.get_host_cpu_name(), features)
    return hashlib.sha256("|".join(parts).encode()).hexdigest()[:8]


@cache
def _engine() -> Any:
    """Owner of the machine code of this process; never closed."""
    import llvmlite.binding as llvm

    importlib.import_module("lasersph.compute.parallel")  # whose import starts the threads
    return llvm.create_mcjit_compiler(llvm.parse_assembly(""), _machine())


def _machine() -> Any:
    """Description of this processor, which writes machine code for it."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=llvm.get_host_cpu_name(),
        features=llvm.get_host_cpu_features().flatten(),
        opt=3,
        jit=True,
        codemodel="jitdefault",
        reloc="default",
    )


def compile_function(function: Callable[..., None], name: str, *, is_fast: bool) -> bytes:
    """Object file, with its check sum, of a function of unsigned integers without a result.

    Args:
        name: what it is called there. is_fast: whether sums may be rearranged.
    """
    import llvmlite.binding as llvm

    module = llvm.parse_assembly(llvm_of(function, name, is_fast=is_fast))
    code = _machine().emit_object(module)
    return hashlib.sha256(code).digest()[:_SUM_BYTES] + code


def llvm_of(function: Callable[..., None], name: str, *, is_fast: bool) -> str:
    """LLVM's text of a function, with nothing that it does not call; see `compile_function`."""
    module = numba_internals.module_of(function, name, is_fast=is_fast)
    _drop_unused(module, name, _machine())
    return numba_internals.without_release(str(module))


def _drop_unused(module: Any, name: str, machine: Any) -> None:
    """Remove the functions that Numba adds to every module, which nothing calls."""
    import llvmlite.binding as llvm

    for function in module.functions:
        if not function.is_declaration and function.name != name:
            function.linkage = llvm.Linkage.internal
    builder = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(0))
    manager = llvm.create_new_module_pass_manager()
    manager.add_global_dead_code_eliminate_pass()
    manager.run(module, builder)


def address_of(content: bytes, name: str) -> int | None:
    """Address of the function in an object file; None where the file is damaged."""
    import llvmlite.binding as llvm

    check, code = content[:_SUM_BYTES], content[_SUM_BYTES:]
    if hashlib.sha256(code).digest()[:_SUM_BYTES] != check:
        return None
    engine = _engine()
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    return engine.get_function_address(name)
