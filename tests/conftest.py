"""Fixtures for all tests."""

import gc
import os
import shutil
import tempfile
from contextlib import ExitStack
from pathlib import Path

import process_watch
import pytest
from hypothesis import HealthCheck, settings

FOLDER, STARTED, HELD = pytest.StashKey(), pytest.StashKey(), pytest.StashKey()
SIMULATED = "tests/unit/compute/test_cuda_simulated.py::"
SHORT_FORM = "tests/validation/test_runs.py::test_short_form["
"""Tests that wait for a side process."""
ONLY_ASKED = ("validate", "release", "slow")
"""Marks of tests that run only where -m names the mark: `pytest -m validate`."""

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as on the command line
os.environ.setdefault(
    "LASERSPH_CACHE", os.path.join(tempfile.gettempdir(), f"lasersph-test-{os.getuid()}")
)

OBJECTS_BETWEEN_SEARCHES = 100_000
"""For garbage, as on the command line: thousands of tests and all libraries are lasting objects,
which Python's 700 would search all the time."""
gc.set_threshold(OBJECTS_BETWEEN_SEARCHES)

settings.register_profile(
    "any-machine", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("any-machine")


def pytest_configure(config):
    """Agree on a folder for what runs beside the tests, in whatever processes these run."""
    config.stash[STARTED], config.stash[HELD] = [], ExitStack()
    shared = getattr(config, "workerinput", {}).get("folder")  # of a process of pytest-xdist
    if shared:
        config.stash[FOLDER] = Path(shared)
        return
    # tests that tests start have their folder inside, and end with them
    outer = os.environ.get(process_watch.MARK)
    folder = config.stash[FOLDER] = Path(tempfile.mkdtemp(prefix="lasersph-tests-", dir=outer))
    if not outer:
        process_watch.watch(folder)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_setupnodes(config):
    """Let no run of a test start processes that compile ahead: tests take all processors already,
    and each such process imports everything anew and is ended with its run."""
    from lasersph.compute import ahead, cache
    from lasersph.compute.compile_lock import compiling_alone

    lock = compiling_alone(cache.location(), ahead._ONE_STARTER, waits=False)
    config.stash[HELD].enter_context(lock)


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node):
    """Tell a process of pytest-xdist the folder."""
    node.workerinput["folder"] = str(node.config.stash[FOLDER])


def pytest_collection_modifyitems(config, items):
    """Deselect tests that nobody asked for; those that wait for side processes come last."""
    marks = [mark for mark in ONLY_ASKED if mark not in config.getoption("-m")]
    unasked = [item for item in items if any(map(item.get_closest_marker, marks))]
    config.hook.pytest_deselected(items=unasked)
    kept = [item for item in items if item not in unasked]
    items[:] = sorted(kept, key=lambda item: item.nodeid.startswith((SIMULATED, SHORT_FORM)))


def pytest_collection_finish(session):
    """Start what runs beside the tests, where they run in this process."""
    gc.freeze()  # what was collected stays to the end
    config = session.config
    if not config.option.collectonly and not hasattr(config, "workerinput"):
        start_beside(config, [item.nodeid for item in session.items])


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_node_collection_finished(node, ids):
    """Start what runs beside the tests, where they run in processes of pytest-xdist."""
    if not node.config.stash[STARTED]:
        start_beside(node.config, ids)


def start_beside(config, ids):
    """Start the side processes that tests of these ids ask for."""
    import short_validations
    import simulator_process

    folder, started = config.stash[FOLDER], config.stash[STARTED]
    if any(one.startswith(SIMULATED) for one in ids) and simulator_process.is_possible():
        started.append(simulator_process.SimulatorProcess(folder))
        started[-1].start_tests()
    names = [one[len(SHORT_FORM) : -1] for one in ids if one.startswith(SHORT_FORM)]
    if names:
        started.append(short_validations.ShortValidations(folder))
        started[-1].start_validations(names)


def pytest_unconfigure(config):
    """Leave no process and no file behind."""
    for process in config.stash[STARTED]:
        process.end()
    config.stash[HELD].close()
    if not hasattr(config, "workerinput"):
        shutil.rmtree(config.stash[FOLDER], ignore_errors=True)


@pytest.fixture(scope="session")
def simulated(pytestconfig):
    """The tests in Numba's CUDA simulator, which run beside the others."""
    import simulator_process

    if not simulator_process.is_possible():
        pytest.skip("needs numba-cuda (extra gpu), and not to be the simulator already")
    return simulator_process.SimulatorProcess(pytestconfig.stash[FOLDER])


@pytest.fixture(scope="session")
def short_validations(pytestconfig):
    """The shortened validations, which run beside the others."""
    import short_validations

    return short_validations.ShortValidations(pytestconfig.stash[FOLDER])


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
