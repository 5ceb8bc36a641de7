"""Loops, searches, solvers and runs in Numba's CUDA simulator, in a process of its own.

Machine code for a card is then generated of every kernel that has run there, without a card.
"""

import importlib.util

import pytest

from lasersph.compute import cuda_device

FEWEST_KERNELS = 150
DOUBLE = {"float", "float64"}


def test_simulator(simulated):
    """Every test that runs on all backends passes there, and the solvers give the CPU's fields."""
    assert simulated.returncode == 0, simulated.text[-6000:]


def test_machine_code(simulated):
    """Every kernel of the three solvers becomes assembly for cards of capability 9.0.

    What computes in float32 alone holds no operation in double precision.
    """
    assert simulated.returncode == 0, simulated.text[-6000:]
    kernels = simulated.kernels
    assert len(kernels) > FEWEST_KERNELS
    for file, name, arguments, is_for_newest_card, has_double in kernels:
        assert is_for_newest_card, (file, name)
        words = {argument.split()[0] for argument in arguments}
        if name in ("loop", "scan") and "float32" in words and not words & DOUBLE:
            assert not has_double, (file, name)


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
