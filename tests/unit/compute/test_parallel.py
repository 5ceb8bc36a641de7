"""Blocks that are shared among threads: every block once, compiled once."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.compute import cache
from lasersph.compute.arguments import address
from lasersph.compute.generate import POINTS
from lasersph.compute.launch import SHARED

BLOCK = """
def loop(block, count, frame):
    visits = at_uint64(frame)
    visits[block] += block + count
"""
RUN = """
def loop(block_address, blocks, threads, frame):
    share(block_address, blocks, threads, np.uint64(1), frame)
"""


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("blocks", [0, 1, 2, 39, 40])
def test_every_block_once(threads, blocks):
    """Blocks from 0 to `blocks` are done once each with their own numbers, no others."""
    visits = np.zeros(40, np.uint64)
    cache.function(RUN, 4)(cache.entry(BLOCK), blocks, threads, address(visits))
    assert visits.tolist() == [*range(1, blocks + 1), *[0] * (40 - blocks)]


def doubled(T):
    return 2.0 * T


def test_compiled_once(monkeypatch, tmp_path):
    """One function serves any number of rows and threads."""
    monkeypatch.setenv("LASERSPH_CACHE", str(tmp_path))
    for threads in (1, 2):
        backend = compute.cpu(threads)
        for count in (10, POINTS + SHARED):
            T, out = backend.asarray(np.arange(float(count))), backend.zeros(count)
            backend.pointwise(doubled, {"T": T}, out)
            assert (backend.to_host(out) == 2.0 * np.arange(count)).all()
    loops = [path.read_text() for path in tmp_path.glob("*.py")]
    assert len([text for text in loops if "f__doubled" in text]) == 1
