"""Fixtures for all tests."""

import os
import tempfile

import pytest

os.environ.setdefault(
    "LASERSPH_CACHE", os.path.join(tempfile.gettempdir(), f"lasersph-test-{os.getuid()}")
)


def backends():
    """Backends that are present: the graphics card's where there is one, or its simulator."""
    from lasersph.compute import cuda_device

    try:
        cuda_device.checked()
    except cuda_device.NoDevice:
        return ["cpu", "strict"]
    if cuda_device.IS_SIMULATED:
        import cuda_simulator

        cuda_simulator.hasten()
    return ["cpu", "strict", "cuda"]


def started(name):
    """Backend in double precision."""
    from lasersph import compute

    return compute.cuda() if name == "cuda" else getattr(compute, name)(threads=2)


@pytest.fixture(scope="session", params=backends())
def backend(request):
    """Each backend: the CPU's, the one whose arrays refuse NumPy, the graphics card's."""
    return started(request.param)
