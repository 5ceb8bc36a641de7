"""Machine code for graphics cards, generated without one."""

import importlib.util
from contextlib import contextmanager
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np

CAPABILITY = (9, 0)


@contextmanager
def newest_card():
    """Functions called by kernels are compiled for the newest cards, present or not."""
    from numba.cuda import dispatcher

    card = SimpleNamespace(compute_capability=CAPABILITY)
    with patch.object(dispatcher, "get_current_device", lambda: card):
        yield


def assembly(kernel, kinds, *, optimized=True):
    """Assembly of a kernel for arguments of these types of Numba."""
    from numba.cuda import compile_ptx  # pyright: ignore[reportPrivateImportUsage]

    return compile_ptx(kernel.py_func, tuple(kinds), cc=CAPABILITY, opt=optimized)[0]


def recorded_kernel(file, name):
    """A kernel that `cuda_simulator` has written down, from its source file."""
    spec = importlib.util.spec_from_file_location(f"recorded_{abs(hash(file))}", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return getattr(module, name)


def recorded_kind(text):
    """Type of Numba of an argument that `cuda_simulator` has written down."""
    from numba import from_dtype, types

    word, axes = text.split()
    plain = {"bool": types.boolean, "int": types.int64, "float": types.float64}
    kind = plain[word] if word in plain else from_dtype(np.dtype(word))
    return types.Array(kind, int(axes), "C") if int(axes) else kind
