"""Assembly of kernels for graphics cards: written by Numba, kept in the folder of generated loops.

A card need not be there. A file's name is the hash of all that its text depends on: the source of
the kernel, the kinds of its arguments, the card's capability and Numba's versions.
"""

from __future__ import annotations

import re
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numba import from_dtype, types
from numba.cuda import compile_ptx  # pyright: ignore[reportPrivateImportUsage]

from lasersph.compute import cache

Kind = tuple[np.dtype, int]
"""Type of an argument's elements, and its number of axes, 0 for a number."""
_ENTRY = re.compile(r"\.visible \.entry (\w+)\(")
_ENVIRONMENT = re.compile(r"^\.common .*NumbaEnv.*\n", re.MULTILINE)
"""Places that Numba keeps for Python's objects, of which kernels have none."""


def assembly(kernel: Any, kinds: tuple[Kind, ...], capability: tuple[int, int]) -> tuple[str, str]:
    """Name of a kernel, and its assembly for arguments of these kinds.

    Args:
        kernel: Numba's, of a file. capability: (major, minor) number of the card's kind.
    """
    function = kernel.py_func
    name = f"{function.__name__} {kinds} {capability} {version('numba')} {version('numba-cuda')}"
    text = cache.kept(
        f"{name}\n{_source(function)}", lambda: _compiled(function, kinds, capability)
    )
    found = _ENTRY.search(text)
    assert found is not None
    return found[1], text


def _source(function: Any) -> str:
    """Text of the file that a function stands in; of one without a file its code."""
    try:
        return Path(function.__code__.co_filename).read_text(encoding="utf-8")
    except OSError:
        return function.__code__.co_code.hex()


def _compiled(function: Any, kinds: tuple[Kind, ...], capability: tuple[int, int]) -> str:
    """Assembly of a function as a kernel."""
    signature = tuple([_type_of(kind) for kind in kinds])
    text, _ = compile_ptx(function, signature, cc=capability)
    return _ENVIRONMENT.sub("", text)


def _type_of(kind: Kind) -> Any:
    """Numba's type of an argument."""
    element = from_dtype(kind[0])
    return types.Array(element, kind[1], "C") if kind[1] else element
