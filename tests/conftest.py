"""Fixtures for all tests."""

import os
import tempfile

import pytest
from hypothesis import HealthCheck, settings

SIMULATOR = pytest.StashKey()

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as on the command line
os.environ.setdefault(
    "LASERSPH_CACHE", os.path.join(tempfile.gettempdir(), f"lasersph-test-{os.getuid()}")
)

settings.register_profile(
    "any-machine", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("any-machine")


def pytest_collection_finish(session):
    """Start the simulator's tests where they are asked for."""
    import simulator_process

    asked = any("simulated" in getattr(item, "fixturenames", ()) for item in session.items)
    if asked and not session.config.option.collectonly and simulator_process.is_possible():
        session.config.stash[SIMULATOR] = simulator_process.SimulatorProcess()


def pytest_unconfigure(config):
    """Leave no process behind."""
    if SIMULATOR in config.stash:
        config.stash[SIMULATOR].end()


@pytest.fixture(scope="session")
def simulated(pytestconfig):
    """The tests in Numba's CUDA simulator, which run beside the others."""
    if SIMULATOR not in pytestconfig.stash:
        pytest.skip("needs numba-cuda (extra gpu), and not to be the simulator already")
    return pytestconfig.stash[SIMULATOR]


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
