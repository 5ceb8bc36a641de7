"""Compiling a loop that hands its own blocks to threads, beside Numba's own parallel loop.

Processor time, both in turn, the best of some rounds. Run: pytest benchmarks/test_compiling.py -s
"""

from time import process_time
from types import SimpleNamespace
from typing import Any

import numpy as np
import pair_functions as functions
import pytest
import setting
from numba import types

from lasersph import compute
from lasersph.compute import cache, machine_code
from lasersph.compute.generate import DISPATCH, INNER, OPTIONS

ROUNDS = 3
PARALLEL = f"""
from numba import prange


@njit({OPTIONS}, parallel=True)
def parallel_loop(begin, end, threads, count, frame):
    for b in prange(end - begin):
        block(np.uint64(b), np.uint64(b) + ONE, ONE, count, frame)
"""


def ours(text):
    """Processor time of compiling a loop that does any number of blocks [s]."""
    space = {}
    exec(text, space)
    start = process_time()
    machine_code.compile_function(space["loop"], "loop", is_fast=True)
    return process_time() - start


def twin(text):
    """That of the same loop as a function of one block and a parallel loop over blocks [s]."""
    dispatch = "    " + "\n    ".join(DISPATCH) + "\n"
    block = text.replace(dispatch, "").replace("def loop(", f"@njit({OPTIONS})\ndef block(")
    assert dispatch in text
    space = {}
    exec(block.replace(INNER, f"@njit({OPTIONS})") + PARALLEL, space)
    start = process_time()
    space["parallel_loop"].compile((types.uint64,) * 5)
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
        row_start=backend.zeros(2, "offset"), neighbor=backend.zeros(0, "index"),
        position=vector, support=one, kernel=setting.Wendland(),
        mean=functions.arithmetic_mean, period=(0.0, 0.0, 0.0),
    )  # fmt: skip
    flow = {"v": vector, "rho": one, "p": one, "m": one}
    rates = backend.zeros((3, 1)), backend.zeros(1)
    backend.pair_sum(functions.right_hand_side, neighbors, flow, rates, mu=1e-3)
    backend.pointwise(pushed, {"v": vector, "T": one}, rates[0], dt=0.1)
    texts = [path.read_text(encoding="utf-8") for path in cache.files() if path.suffix == ".py"]
    return [text for text in texts if "def loop(begin, end, threads, count, frame)" in text]


def test_compiling_a_loop(loops):
    """At most 0.8 of the time of the parallel loop."""
    assert len(loops) == 2
    for text in loops:
        rounds = [(ours(text), twin(text)) for _ in range(ROUNDS)]
        once, parallel = np.min(rounds, axis=0)
        pairs = "pair sum" if "neighbor" in text else "pointwise"
        print(f"\n{pairs}: {once:.2f} s, as a parallel loop {parallel:.2f} s")
        assert once <= 0.8 * parallel
