"""Loops, searches, solvers and runs in Numba's CUDA simulator, in a process of its own."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

from lasersph.compute import cuda_device

TESTS = Path(__file__).parents[2]
FILES = ("unit/compute/test_strict_arrays.py", "unit/compute/test_pair_loops.py",
         "unit/compute/test_search.py", "unit/compute/test_splice.py",
         "unit/compute/test_looking.py",
         "laws/test_cuda_backend.py")  # fmt: skip


@pytest.mark.skipif(
    importlib.util.find_spec("numba_cuda") is None or cuda_device.IS_SIMULATED,
    reason="needs numba-cuda (extra gpu), and not to be the simulator already",
)
def test_simulator():
    """Every test that runs on all backends passes there, and the solvers give the CPU's fields."""
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-k", "cuda"]
    done = subprocess.run(
        [*command, *(str(TESTS / name) for name in FILES)], cwd=TESTS.parent, text=True,
        env=os.environ | {"NUMBA_ENABLE_CUDASIM": "1"}, capture_output=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-2000:]


def test_missing_package(monkeypatch):
    """Without numba-cuda the message says how to install it."""
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(cuda_device.NoDevice, match=r"pip install 'lasersph\[gpu\]'"):
        cuda_device.checked()


def test_missing_device(monkeypatch):
    """Without a card the message says so."""
    cuda = pytest.importorskip("numba.cuda")
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: object())
    monkeypatch.setattr(cuda_device, "IS_SIMULATED", False)
    monkeypatch.setattr(cuda, "is_available", lambda: False)
    with pytest.raises(cuda_device.NoDevice, match="no CUDA device found"):
        cuda_device.checked()
