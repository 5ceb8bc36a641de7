"""Fixtures for all tests."""

import os
import tempfile

import pytest
from hypothesis import HealthCheck, settings

SIMULATOR, SHORT = pytest.StashKey(), pytest.StashKey()
ONLY_ASKED = ("validate",)
"""Marks of tests that run only where -m names the mark: `pytest -m validate`."""

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as on the command line
os.environ.setdefault(
    "LASERSPH_CACHE", os.path.join(tempfile.gettempdir(), f"lasersph-test-{os.getuid()}")
)

settings.register_profile(
    "any-machine", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("any-machine")


def pytest_collection_modifyitems(config, items):
    """Deselect tests that nobody asked for."""
    marks = [mark for mark in ONLY_ASKED if mark not in config.getoption("-m")]
    unasked = [item for item in items if any(map(item.get_closest_marker, marks))]
    config.hook.pytest_deselected(items=unasked)
    items[:] = [item for item in items if item not in unasked]


def pytest_collection_finish(session):
    """Start what runs beside the tests, where they ask for it."""
    import short_validations
    import simulator_process

    if session.config.option.collectonly:
        return
    stash = session.config.stash
    asked = {name for item in session.items for name in getattr(item, "fixturenames", ())}
    if "simulated" in asked and simulator_process.is_possible():
        stash[SIMULATOR] = simulator_process.SimulatorProcess()
    if "short_validations" in asked:
        items = [item for item in session.items if "short_validations" in item.fixturenames]
        names = [item.callspec.params["name"] for item in items]
        stash[SHORT] = short_validations.ShortValidations(names)


def pytest_unconfigure(config):
    """Leave no process behind."""
    for key in (SIMULATOR, SHORT):
        if key in config.stash:
            config.stash[key].end()


@pytest.fixture(scope="session")
def simulated(pytestconfig):
    """The tests in Numba's CUDA simulator, which run beside the others."""
    if SIMULATOR not in pytestconfig.stash:
        pytest.skip("needs numba-cuda (extra gpu), and not to be the simulator already")
    return pytestconfig.stash[SIMULATOR]


@pytest.fixture(scope="session")
def short_validations(pytestconfig):
    """The shortened validations, which run beside the others."""
    return pytestconfig.stash[SHORT]


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
