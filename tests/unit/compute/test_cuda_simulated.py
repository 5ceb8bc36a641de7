"""Loops, searches, solvers and runs in Numba's CUDA simulator, in a process of its own.

Machine code for a card is then generated of every kernel that has run there, without a card.
"""

import importlib.util
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from cuda_simulator import KERNELS
from machine_code import assembly, newest_card, recorded_kernel, recorded_kind

from lasersph.compute import cuda_device

TESTS = Path(__file__).parents[2]
FEWEST_KERNELS = 150
DOUBLE = {"float", "float64"}
FILES = ("unit/compute/test_strict_arrays.py", "unit/compute/test_pair_loops.py",
         "unit/compute/test_search.py", "unit/compute/test_splice.py",
         "unit/compute/test_looking.py", "unit/compute/test_connected.py",
         "unit/particles/test_images.py", "unit/solvers/test_near_melt.py",
         "unit/linear_solvers/test_components.py", "unit/benchmark/test_cuda_card.py",
         "laws/test_cuda_backend.py")  # fmt: skip


@pytest.fixture(scope="module")
def simulated(tmp_path_factory):
    """The finished process, and the kernels that ran in it."""
    if importlib.util.find_spec("numba_cuda") is None or cuda_device.IS_SIMULATED:
        pytest.skip("needs numba-cuda (extra gpu), and not to be the simulator already")
    kernels = tmp_path_factory.mktemp("simulated") / "kernels.json"
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-k", "cuda"]
    done = subprocess.run(
        [*command, *(str(TESTS / name) for name in FILES)], cwd=TESTS.parent, text=True,
        env=os.environ | {"NUMBA_ENABLE_CUDASIM": "1", KERNELS: str(kernels)}, capture_output=True,
    )  # fmt: skip
    return done, json.loads(kernels.read_text())


def test_simulator(simulated):
    """Every test that runs on all backends passes there, and the solvers give the CPU's fields."""
    done, _ = simulated
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-2000:]


def test_machine_code(simulated):
    """Every kernel of the three solvers becomes assembly for cards of capability 9.0.

    What computes in float32 alone holds no operation in double precision.
    """
    _, kernels = simulated
    assert len(kernels) > FEWEST_KERNELS
    with newest_card():
        for file, name, arguments in kernels:
            kinds = [recorded_kind(argument) for argument in arguments]
            text = assembly(recorded_kernel(file, name), kinds, optimized=False)
            assert ".target sm_90" in text, (file, name)
            words = {argument.split()[0] for argument in arguments}
            if name in ("loop", "scan") and "float32" in words and not words & DOUBLE:
                assert ".f64" not in text, (file, name)


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
