"""Steps of a flow: on arrays that refuse NumPy, with any number of threads, in single precision."""

import numpy as np
import pytest
from flow_boxes import LID, box, go, host_fields, pool

from lasersph import compute

STEPS = 3
HEAT = {"left": "fixed-temperature", "left_temperature": 310.0, "right": "fixed-temperature"}
MATERIAL = {"expansion": "0.01 1/K"}


def small_box(backend):
    """A warm wall, a cold wall and a moving lid, started from disorder by three steps."""
    solver = box(backend, heat=HEAT, flow=LID, material=MATERIAL, gravity=10.0, end=10.0, step=0.1)
    go(solver, STEPS)
    return solver


def small_pool(backend, *settings):
    """A pool of 8 x 5 particles with a hot middle, driven by its surface."""
    solver = pool(lambda x, z: (x < 1e-6) & (z > -6e-7), *settings, backend=backend, slope=-5e8)
    go(solver, STEPS)
    return solver


MAKERS = {
    "box": small_box,
    "pool": small_pool,
    "published pool": lambda backend: small_pool(
        backend, "solver.pressure=published", "solver.viscosity=explicit",
        "solver.step_limits=published",
    ),
}  # fmt: skip


def assert_same_bits(make, *backends):
    """All backends give the same fields and numbers, and something flows."""
    first, *others = (make(backend) for backend in backends)
    assert first.flow.largest_speed > 0.0
    for other in others:
        assert other.checkpoint_scalars() == first.checkpoint_scalars()
        fields = host_fields(other)
        for name, values in host_fields(first).items():
            assert np.array_equal(values, fields[name]), name


@pytest.mark.parametrize("name", MAKERS)
def test_strict_arrays(name):
    """Every step runs where NumPy cannot touch the particles' arrays, to the same bits."""
    assert_same_bits(MAKERS[name], compute.cpu(threads=1), compute.strict(threads=1))


@pytest.mark.parametrize("name", ["box", "pool"])
def test_threads(name):
    """One thread and two give the same bits."""
    assert_same_bits(MAKERS[name], compute.cpu(threads=1), compute.cpu(threads=2))


def test_threads_with_many_particles():
    """The same with more rows than one block of a reduction."""

    def make(backend):
        solver = box(backend, cells=70, end=10.0, step=0.1)
        assert solver.body.count > 4096
        go(solver, 2)
        return solver

    assert_same_bits(make, compute.cpu(threads=1), compute.cpu(threads=2))


@pytest.mark.parametrize("name", ["box", "pool"])
def test_single_precision(name):
    """float32 runs, and is close to float64."""
    single, double = (
        MAKERS[name](compute.cpu(threads=1, precision=p)) for p in ("float32", "float64")
    )
    assert single.flow.largest_speed == pytest.approx(double.flow.largest_speed, rel=0.02)
    assert single.state.time == pytest.approx(double.state.time, rel=0.02)
    for key, values in host_fields(single).items():
        assert np.isfinite(values).all(), key
