"""Single precision stays single, and indices stay unsigned, in the machine code."""

import re
from math import exp, sqrt
from types import SimpleNamespace

import numpy as np
import pytest

from lasersph import compute
from lasersph.compute import machine_code
from lasersph.compute.generate import Argument, Loop, LoopText

SIGMA = 5.670374419e-8
REAL = ("real", ())


def promoting(T_i, T_j, r_ij, W_ij, dt):
    """Everything that promotes a float32 to float64 in plain Numba."""
    a = T_j * 2 + 2 / T_i + max(T_j, 0) + abs(T_i - 1) ** 1.5 + T_j**2 + T_j**2.3
    b = exp(-r_ij) * sqrt(T_i) + SIGMA * T_j**4 + np.sqrt(2) / 3
    return (a if T_j > 1 else b + 1) * W_ij + dt


def limited(total, T, dt):
    return min(T + total * dt, 1e4)


def flow(g_ij, T_i, T_j):
    return g_ij * (T_j - T_i)


def mean(l_i, l_j):
    return 0.5 * (l_i + l_j)


def shape(s):
    return (1 - s) ** 4 * (1 + 4 * s) if s < 1 else 0


def compiled(loop):
    """LLVM text of a freshly compiled loop."""
    text = LoopText(loop).written()
    return str(machine_code.optimized(text, "loop_of_a_test", is_fast=True))


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_no_double(precision):
    """No `double` appears in the LLVM of a float32 loop (and the test would see one)."""
    kernel = SimpleNamespace(sigma=1.25, shape=shape, slope=shape)
    arguments = (
        Argument("T_i", "row", "T", REAL),
        Argument("T_j", "neighbor", "T", REAL),
        Argument("r_ij", "geometry", "r_ij", REAL),
        Argument("W_ij", "geometry", "W_ij", REAL),
        Argument("dt", "constant", "dt", REAL),
    )
    finish = (
        Argument("total", "total", "total", None),
        Argument("T", "row", "T", REAL),
        Argument("dt", "constant", "dt", REAL),
    )
    loop = Loop(
        "pair_sum", precision, promoting, arguments, (REAL,), ("max",), False, limited, finish,
        (kernel, mean, (True, False), 2),
    )  # fmt: skip
    text = compiled(loop)
    assert ("double" in text) == (precision == "float64")
    assert re.search(r"\bfloat\b", text) or precision == "float64"


def test_unsigned_indices():
    """No index is compared with zero to wrap negative ones around."""
    arguments = (
        Argument("g_ij", "pair", "g_ij", REAL),
        Argument("T_i", "row", "T", REAL),
        Argument("T_j", "neighbor", "T", REAL),
    )
    loop = Loop("pair_sum", "float64", flow, arguments, (REAL,))
    text = compiled(loop)
    start = text.index("define")
    body = text[start : text.index("\n}", start)]
    assert "sext" not in body
    assert not re.search(r"icmp slt i64 %[^,]+, 0", body)


def test_float32_results():
    """Single precision gives single-precision answers and refuses double-precision fields."""
    backend = compute.cpu(threads=1, precision="float32")
    assert backend.real == np.float32
    T, out = backend.asarray([1.0, 4.0]), backend.zeros(2)
    total = backend.pointwise(root, {"T": T}, out, reduce="sum", factor=0.1)
    assert out.dtype == np.float32
    np.testing.assert_allclose(out, [0.1, 0.2], rtol=1e-6)
    assert total[0] == pytest.approx(0.3, rel=1e-6)
    with pytest.raises(ValueError, match="T is float64, the backend float32"):
        backend.pointwise(root, {"T": np.ones(2)}, out, factor=0.1)


def root(T, factor):
    return factor * sqrt(T)
