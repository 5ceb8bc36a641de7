"""Loops that hand their blocks to threads: every block once, errors raised, compiled once."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.compute import cache
from lasersph.compute.generate import POINTS
from lasersph.compute.launch import SHARED

HEAD = """
import numpy as np
from numba import njit

from lasersph.compute.parallel import dispatch_blocks

ONE = np.uint64(1)


@njit(cache=True)
def loop(begin, end, threads, visits, limit):
    if end - begin > ONE:
        dispatch_blocks()
        return
    if begin >= limit:
        raise ValueError("beyond the limit")
    visits[begin] += begin + ONE
"""


def run(monkeypatch, folder, begin, end, threads, limit):
    """Visits of the blocks of a loop that stops at a limit."""
    monkeypatch.setenv("LASERSPH_CACHE", str(folder))
    visits = np.zeros(40, np.uint64)
    numbers = (np.uint64(k) for k in (begin, end, threads))
    cache.load(HEAD).loop(*numbers, visits, np.uint64(limit))
    return visits


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize(("begin", "end"), [(0, 1), (3, 4), (0, 40), (5, 38), (7, 9)])
def test_every_block_once(monkeypatch, tmp_path_factory, threads, begin, end):
    """Blocks from begin to end are done once each with their own numbers, no others."""
    visits = run(monkeypatch, tmp_path_factory.getbasetemp(), begin, end, threads, 100)
    blocks = np.arange(40)
    wanted = np.where((blocks >= begin) & (blocks < end), blocks + 1, 0)
    assert visits.tolist() == wanted.tolist()


@pytest.mark.parametrize("threads", [1, 2])
def test_error_in_a_block(monkeypatch, tmp_path_factory, threads):
    """An error of one block is raised after the others are done."""
    with pytest.raises(ValueError, match="beyond the limit"):
        run(monkeypatch, tmp_path_factory.getbasetemp(), 0, 40, threads, 39)


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
