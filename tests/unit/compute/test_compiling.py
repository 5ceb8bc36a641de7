"""Who waits for loops to be compiled is told so, once."""

import pytest

from lasersph import compute
from lasersph.compute.compiling import Compiling


def shifted(T):
    return T + 0.25


def scaled(T):
    return shifted(T) * 3.5


def test_told_once_and_counted(monkeypatch, tmp_path):
    """Two loops: told before the first; functions that they call are not counted."""
    backend = compute.cpu(1)
    monkeypatch.setenv("LASERSPH_CACHE", str(tmp_path))
    T, out, told = backend.asarray([1.0]), backend.zeros(1), []

    def run():
        for function in (shifted, scaled):
            backend.pointwise(function, {"T": T}, out)

    with Compiling(lambda: told.append(list(tmp_path.glob("*.o")))) as compiling:
        assert not told
        run()
    assert told == [[]] and compiling.loops == 2 and compiling.seconds > 0.0
    with Compiling(lambda: pytest.fail("nothing is left to compile")) as compiling:
        run()
    assert (compiling.loops, compiling.seconds) == (0, 0.0)
