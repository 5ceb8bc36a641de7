"""Compiling a loop that hands its own blocks to threads, beside Numba's own parallel loop.

Processor time, both in turn, the best of some rounds. Run: pytest benchmarks/test_compiling.py -s
"""

from time import process_time
from types import SimpleNamespace

import numpy as np
import pair_functions as functions
import pytest
import setting

from lasersph import compute
from lasersph.compute import cache
from lasersph.compute.generate import INNER, OPTIONS, OUTER, SPREAD

ROUNDS = 3
PARALLEL = """
from numba import prange


@njit({options}, parallel=True)
def loop(begin, end, threads, count, {names}):
    for b in prange(end - begin):
        block(np.uint64(b), np.uint64(b) + ONE, ONE, count, {names})
"""


def twin(text):
    """The same loop as a function of one block and a parallel loop over blocks."""
    names = text.split("def loop(begin, end, threads, count, ")[1].split("):")[0]
    block = text.replace("    " + "\n    ".join(SPREAD) + "\n", "").replace(
        "def loop(", "def block("
    )
    for decorator in (INNER, OUTER):
        block = block.replace(decorator, f"@njit({OPTIONS})")
    return block + PARALLEL.format(options=OPTIONS, names=names)


def seconds(text, signature):
    """Processor time of compiling what is called for any number of blocks [s]."""
    space = {}
    exec(text.replace(", cache=True", ""), space)
    start = process_time()
    space["loop"].compile(signature)
    if "block" in space:
        space["block"].compile(signature)
    return process_time() - start


def pushed(v, T, dt):
    """Vector, scalar and number."""
    return v + dt * T * v


@pytest.fixture
def loops(monkeypatch, tmp_path):
    """Texts and types of a pointwise loop and a pair sum in 3-D, compiled once."""
    monkeypatch.setenv("LASERSPH_CACHE", str(tmp_path))
    backend = compute.cpu(threads=1)
    one, vector = backend.asarray([1.0]), backend.zeros((3, 1))
    neighbors = SimpleNamespace(
        row_start=backend.zeros(2, "offset"), neighbor=backend.zeros(0, "index"),
        position=vector, support=one, kernel=setting.Wendland(),
        mean=functions.arithmetic_mean, period=(0.0, 0.0, 0.0),
    )  # fmt: skip
    flow = {"v": vector, "rho": one, "p": one, "m": one}
    rates = backend.zeros((3, 1)), backend.zeros(1)
    backend.pair_sum(functions.right_hand_side, neighbors, flow, rates, mu=1e-3)
    backend.pointwise(pushed, {"v": vector, "T": one}, rates[0], dt=0.1)
    texts = [path.read_text(encoding="utf-8") for path in cache.files()]
    return [(text, cache.load(text).loop.signatures[0]) for text in texts]


def test_compiling_a_loop(loops):
    """At most 0.8 of the time of the parallel loop."""
    for text, signature in loops:
        rounds = [(seconds(text, signature), seconds(twin(text), signature)) for _ in range(ROUNDS)]
        once, parallel = np.min(rounds, axis=0)
        pairs = "pair sum" if "neighbor" in text else "pointwise"
        print(f"\n{pairs}: {once:.2f} s, as a parallel loop {parallel:.2f} s")
        assert once <= 0.8 * parallel
