"""Without the part of Numba that it does not document: the same bits, and one line that says so."""

import os
import subprocess
import sys
import warnings

import numba_without
import pytest

from lasersph.compute import cache, numba_internals, trial


@pytest.mark.parametrize(
    "cases",
    [["loops", "conduction"], pytest.param(["melt-pool", "ablation"], marks=pytest.mark.release)],
    ids=lambda cases: cases[0],
)
def test_without_the_entry(cases):
    """A loop of each kind and a solver give the same bits; one line names the part and its cost."""
    result = subprocess.run(
        [sys.executable, numba_without.__file__, ",".join(cases)],
        env={**os.environ, "LASERSPH_CACHE": str(cache.location())},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    *sums, notice = result.stdout.splitlines()
    assert dict(line.split() for line in sums) == {
        name: numba_without.sum_of(name) for name in cases
    }
    assert "has no entry of its threads (numba_parallel_for is unknown): results stay" in notice


@pytest.fixture
def unchecked(monkeypatch):
    """As at the start of a process."""
    monkeypatch.setattr(numba_internals, "_found", [])


def test_known_numba_is_not_tried(unchecked):
    """What is installed has the entry, without a trial and without a word."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        numba_internals.check_entry(lambda: pytest.fail("tried"))
    assert numba_internals.has_entry()


@pytest.mark.parametrize("passes", [True, False])
def test_newer_numba_is_tried(unchecked, monkeypatch, passes):
    """Once; where the trial fails, one line says so."""
    monkeypatch.setattr(numba_internals, "UNTESTED", (0, 1))
    tried = []
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        for _ in range(2):
            numba_internals.check_entry(lambda: tried.append(1) or passes)
    assert tried == [1] and numba_internals.has_entry() is passes
    messages = [str(one.message) for one in told]
    assert [message.count("(its trial failed)") for message in messages] == [1] * (not passes)


def test_trial(tmp_path, monkeypatch):
    """The installed Numba passes, and is not tried again; a process that ends fails."""
    assert trial.passes(tmp_path)
    (kept,) = tmp_path.iterdir()
    monkeypatch.setattr(sys, "executable", "/bin/false")
    assert trial.passes(tmp_path)
    kept.unlink()
    assert not trial.passes(tmp_path)
    assert not trial.passes(tmp_path) and kept.read_text() == "fails"
