"""Without parts of Numba that it does not document: the same bits, and one line that says so."""

import os
import subprocess
import sys
import warnings
from pathlib import Path

import numba_without
import numpy as np
import pytest

from lasersph.compute import cache, numba_internals, trial
from lasersph.compute.numba_internals import Part

PARTS = [part.name for part in Part]
SOLVERS = ("conduction", "melt-pool", "ablation")
"""The first stands for the others, which have the same kinds of loops and 150 more of them to
compile."""


def run(parts, cases):
    """Check sums by case, and notices, of a process without some parts.

    Machine code of other tests would serve where Numba's LLVM is not understood: those processes
    have a folder of their own.
    """
    folder = cache.location()
    folder = folder / "without-machine-code" if "MACHINE_CODE" in parts else folder
    result = subprocess.run(
        [sys.executable, numba_without.__file__, ",".join(parts), ",".join(cases)],
        env={**os.environ, "LASERSPH_CACHE": str(folder)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    lines = result.stdout.splitlines()
    return dict(line.split() for line in lines[: len(cases)]), lines[len(cases) :]


@pytest.mark.parametrize("part", PARTS)
def test_without_a_part(part):
    """A loop of each kind gives the same bits; one line names the part and its cost."""
    found, notices = run([part], ["loops"])
    assert found == {"loops": numba_without.sum_of("loops")}
    name, cost = Part[part].value
    assert len(notices) == 1
    assert f" has no {name} (" in notices[0] and notices[0].endswith(f"but {cost}")


@pytest.mark.parametrize(
    "solvers", [SOLVERS[:1], pytest.param(SOLVERS[1:], marks=pytest.mark.release)], ids=len
)
def test_without_all_parts(solvers):
    """A solver gives the same bits, and one line names all parts that were looked for."""
    found, notices = run(PARTS, solvers)
    assert found == {name: numba_without.sum_of(name) for name in solvers}
    assert len(notices) == 1
    looked_for = [part for part in Part if part is not Part.MACHINE_CODE]  # not without threads
    assert all(part.value[0] in notices[0] for part in looked_for)


@pytest.fixture
def unchecked(monkeypatch):
    """As at the start of a process."""
    monkeypatch.setattr(numba_internals, "_missing", {})
    monkeypatch.setattr(numba_internals, "_checked", [])


def test_known_numba_is_not_tried(unchecked):
    """What is installed has all parts, without a trial and without a word."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        numba_internals.check(lambda part: pytest.fail("tried"))
    assert all(map(numba_internals.has, Part)) and numba_internals.keeps_object_files()


def test_newer_numba_is_tried(unchecked, monkeypatch):
    """Parts that run machine code are tried, once; those that fail are done without."""
    monkeypatch.setattr(numba_internals, "UNTESTED", (0, 1))
    tried = []

    def passes(part):
        tried.append(part)
        return part == "THREADS"

    with pytest.warns(
        RuntimeWarning, match="no LLVM functions as known .its trial failed."
    ) as told:
        numba_internals.check(passes)
        numba_internals.check(passes)
    assert tried == ["THREADS", "MACHINE_CODE"] and len(told) == 1
    assert numba_internals.has(Part.THREADS) and not numba_internals.keeps_object_files()


def test_said_once(unchecked):
    """A part that is lost later is named once, by the first line of the error."""
    with pytest.warns(
        RuntimeWarning, match="an error.: results stay the same, but a start"
    ) as told:
        for _ in range(2):
            numba_internals.lose(Part.MACHINE_CODE, ValueError("an error\nof many lines"))
    assert len(told) == 1


@pytest.mark.parametrize("part", ["THREADS", "MACHINE_CODE"])
def test_trial(part, tmp_path, monkeypatch):
    """The installed Numba passes, and is not tried again; a process that ends fails."""
    assert trial.passes(tmp_path, part)
    (kept,) = tmp_path.iterdir()
    monkeypatch.setattr(sys, "executable", "/bin/false")
    assert trial.passes(tmp_path, part)
    kept.unlink()
    assert not trial.passes(tmp_path, part)
    assert not trial.passes(tmp_path, part) and kept.read_text() == "fails"


def test_other_calls_are_refused(monkeypatch):
    """A function that takes other arguments than is known is not called."""
    from numba import cfunc, types

    def loop(first, count):
        pass

    other = cfunc(types.void(types.uint32, types.uint64))(loop)
    monkeypatch.setattr(numba_internals, "compiled_callback", lambda *_, **__: other)
    with pytest.raises(LookupError, match="a function of 2 integers takes ptr, ptr, i32, i64"):
        numba_internals.module_of(loop, "loop_of_other_arguments", is_fast=True)


TEXT = """
import numpy as np

from lasersph.compute.parallel import dispatch_blocks

ONE = np.uint64(1)


def loop(begin, end, threads, count, frame):
    if end - begin > ONE:
        dispatch_blocks()
        return
    count
"""


def test_public_text():
    """A loop that is called by its address does one block; who calls it shares the blocks."""
    text = cache.shared_text(TEXT)
    assert "dispatch_blocks" not in text and "import invoke\n" in text
    assert "def loop(begin, end, threads, count, frame):\n    count" in text
    assert cache.shared_text("answer = 42\n") == "answer = 42\n"


STORED = """
from numba import njit


@njit(cache=True)
def doubled(values):
    values *= 2.0
"""


def test_full_disk(tmp_path, monkeypatch):
    """Where Numba could not store machine code, it is not asked to."""
    monkeypatch.setenv("LASERSPH_CACHE", str(tmp_path))

    def full(folder):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(cache, "_refuse_full", full)
    values = np.ones(8)
    with pytest.warns(RuntimeWarning, match="not stored: .*No space left"):
        module = cache.load(STORED)
    module.doubled(values)
    assert values.tolist() == [2.0] * 8
    assert not list(Path(tmp_path, "__pycache__").iterdir())
