"""Machine code for graphics cards is generated without one: loops, search and other kernels."""

import importlib.util
from types import SimpleNamespace

import numpy as np
import pytest
from machine_code import assembly, newest_card

from lasersph.compute import cache, cuda_device
from lasersph.particles.support import arithmetic
from lasersph.sph import kernels

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("numba_cuda") is None or cuda_device.IS_SIMULATED,
    reason="needs numba-cuda (extra gpu), not simulated",
)


@pytest.fixture(autouse=True)
def device():
    """The newest cards, present or not."""
    with newest_card():
        yield


def ptx(kernel, *values):
    """Assembly of a kernel for arrays and numbers like these."""
    from numba import typeof, types

    return assembly(kernel, [
        types.Array(typeof(v).dtype, v.ndim, "C") if isinstance(v, np.ndarray) else typeof(v)
        for v in values
    ])  # fmt: skip


def flow(T_i, T_j, r_ij, dW_ij):
    return 4 * (T_j - T_i) * dW_ij / (r_ij + 0.01), max(T_j, 0.0) ** 1.5


def finish(total_0, total_1, T, rate):
    return T + rate * total_0, total_1


def pair_sum(precision):
    """Assembly of a pair sum with a periodic axis, a kernel function and a reduction."""
    from lasersph.compute.cuda_launch import CudaLauncher
    from lasersph.compute.loops import Loops
    from lasersph.compute.signature import Call

    real = np.dtype(precision)
    offset, index, field = np.zeros(4, np.uint64), np.zeros(6, np.uint32), np.zeros(3, real)
    neighbors = SimpleNamespace(
        row_end=None,
        row_start=offset, neighbor=index, position=np.zeros((2, 3), real), support=field,
        kernel=kernels.kernel("wendland-c2", 2), mean=arithmetic, period=(1.0, 0.0),
    )  # fmt: skip
    call = Call(
        "pair_sum", flow, neighbors, {"T": field}, (np.zeros(3, real), None), None, finish,
        (None, "max"), {"rate": 2.0},
    )  # fmt: skip
    loops = Loops(precision, CudaLauncher(), lambda array: array)
    text, lines = loops.text(loops.given(call))
    kernel = cache.load(lines).loop
    given = {
        "row_start": offset,
        "neighbor": index,
        "period__0": real.type(0),
        "c_rate": real.type(0),
    }
    values = [given.get(name, field) for name in text.parameters()]
    return ptx(kernel, np.uint64(3), *values)


@pytest.mark.parametrize("precision", ["float64", "float32"])
def test_pair_sum(precision):
    """A loop compiles, whose threads of a row give each other their sums; in float32 it holds no
    operation in double precision."""
    text = pair_sum(precision)
    assert ".target sm_90" in text and "bar.sync" in text and "shfl.sync.bfly" in text
    assert (".f64" in text) == (precision == "float64")


@pytest.mark.parametrize("precision, dimension", [("float32", 1), ("float64", 2), ("float32", 3)])
def test_scan(precision, dimension):
    """The neighbor search compiles, with a periodic axis and others."""
    from lasersph.compute.cuda_search import cuda_scan_text

    real = np.dtype(precision)
    field, table, number = np.zeros(2, real), np.zeros((2, dimension), real), np.zeros(2, np.uint32)
    offset = np.zeros(2, np.uint64)
    text = cuda_scan_text(precision, dimension, arithmetic, (True, False, False)[:dimension])
    assembly = ptx(
        cache.load(text).scan, np.uint64(2), *[field] * dimension, field, *[field] * dimension,
        field, number, offset, offset, table, table, field, np.zeros((2, dimension), np.int64),
        field, real.type(0), field, offset, number, number, True,
    )  # fmt: skip
    assert (".f64" in assembly) == (precision == "float64")


def test_sort():
    """Kernels that several threads work on together compile."""
    from lasersph.compute import cuda_kernels

    count, index, offset = np.uint64(2), np.zeros(2, np.uint32), np.zeros(2, np.uint64)
    assert "bar.sync" in ptx(cuda_kernels.piece_sums, count, index, offset, offset)
    assert "bar.sync" in ptx(
        cuda_kernels.sort_digits, count, index, index, count, count, offset, index, index
    )
    assert "atom" in ptx(cuda_kernels.count_digits, count, index, count, count, index)
