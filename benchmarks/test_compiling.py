"""Compiling a loop as it is done here, beside Numba's compiling of the same loop over arrays.

Processor time, both in turn, the best of some rounds. Run: pytest benchmarks/test_compiling.py -s
"""

import math
import re
from time import process_time
from types import SimpleNamespace
from typing import Any

import numpy as np
import pair_functions as functions
import pytest
import setting
from numba import njit, types

from lasersph import compute
from lasersph.compute import cache, machine_code

ROUNDS = 3
OPTIONS: Any = {"fastmath": {"reassoc", "contract", "arcp", "nsz"}, "error_model": "numpy"}
_ARRAY = re.compile(r"^    (\w+) = at_(\w+)\(words\[\d+\]\)$", re.MULTILINE)


def ours(text):
    """Processor time of compiling a loop [s]."""
    start = process_time()
    machine_code.compile_text(text, "loop", is_fast=True)
    return process_time() - start


def twin(text):
    """That of the same loop by Numba, whose arguments are the arrays [s]."""
    arrays = dict(_ARRAY.findall(text))
    text = _ARRAY.sub("", text).replace("    words = at_uint64(frame)\n", "")
    text = text.replace("loop(number, count, frame)", f"loop(number, count, {', '.join(arrays)})")
    space: dict[str, Any] = {"np": np, "math": math}
    exec(text, space)
    inner = {name: njit(**OPTIONS)(one) for name, one in space.items() if name.startswith("f__")}
    space |= inner
    kinds = [types.Array(getattr(types, kind), 1, "C") for kind in arrays.values()]
    start = process_time()
    njit(**OPTIONS)(space["loop"]).compile((types.uint64, types.uint64, *kinds))
    return process_time() - start


def pushed(v, T, dt):
    """Vector, scalar and number."""
    return v + dt * T * v


@pytest.fixture
def loops(monkeypatch, tmp_path):
    """Texts of a pointwise loop and a pair sum in 3-D, compiled once."""
    monkeypatch.setenv("LASERSPH_CACHE", str(tmp_path))
    backend = compute.cpu(threads=1)
    one, vector = backend.asarray([1.0]), backend.zeros((3, 1))
    neighbors: Any = SimpleNamespace(
        row_end=None,
        row_start=backend.zeros(2, "offset"), neighbor=backend.zeros(0, "index"),
        position=vector, support=one, kernel=setting.Wendland(),
        mean=functions.arithmetic_mean, period=(0.0, 0.0, 0.0),
    )  # fmt: skip
    flow = {"v": vector, "rho": one, "p": one, "m": one}
    rates = backend.zeros((3, 1)), backend.zeros(1)
    backend.pair_sum(functions.right_hand_side, neighbors, flow, rates, mu=1e-3)
    backend.pointwise(pushed, {"v": vector, "T": one}, rates[0], dt=0.1)
    texts = [path.read_text(encoding="utf-8") for path in cache.files() if path.suffix == ".py"]
    return [text for text in texts if "def loop(number, count, frame)" in text]


def test_compiling_a_loop(loops):
    """At most 0.3 of Numba's time."""
    assert len(loops) == 2
    for text in loops:
        rounds = [(ours(text), twin(text)) for _ in range(ROUNDS)]
        here, numba = np.min(rounds, axis=0)
        pairs = "pair sum" if "neighbor" in text else "pointwise"
        print(f"\n{pairs}: {here:.3f} s, by Numba {numba:.3f} s")
        assert here <= 0.3 * numba
