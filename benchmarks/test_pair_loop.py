"""3-D right-hand side of weakly compressible SPH against the same loop written in C++.

Needs g++ with OpenMP. Run: pytest benchmarks/test_pair_loop.py -s
"""

import ctypes
import subprocess
from pathlib import Path

import numpy as np
import pair_functions as functions
import pytest
import setting

from lasersph import compute

OPTIONS = ["-O3", "-march=native", "-fopenmp", "-shared", "-fPIC"]


def compiled(folder):
    """The C++ loop, compiled for this processor."""
    library = folder / "pair_loop.so"
    source = Path(__file__).with_name("pair_loop.cpp")
    subprocess.run(["g++", *OPTIONS, str(source), "-o", str(library)], check=True)
    return ctypes.CDLL(str(library)).right_hand_side


@pytest.mark.parametrize("edge", [40, 80])
def test_right_hand_side(benchmark, tmp_path, edge):
    """At least 0.9 of the C++ loop's speed, with the same result."""
    backend = compute.cpu(threads=2)
    neighbors = setting.jittered_cube(backend, edge)
    count = edge**3
    rng = np.random.default_rng(2)
    fields = {
        "v": rng.random((3, count)),
        "rho": 1000 + rng.random(count),
        "p": rng.random(count),
        "m": 1 + rng.random(count),
    }
    ours = (np.zeros((3, count)), np.zeros(count))
    theirs = (np.zeros((3, count)), np.zeros(count))
    function = compiled(tmp_path)
    arrays = [neighbors.position, neighbors.support, *fields.values()]
    ends = (neighbors.row_start, neighbors.neighbor)
    pointers, lists, results = (
        [np.asarray(a).ctypes.data_as(ctypes.c_void_p) for a in given]
        for given in (arrays, ends, theirs)
    )
    size = ctypes.c_int64(count)
    sigma = ctypes.c_double(neighbors.kernel.sigma)

    def generated():
        backend.pair_sum(functions.right_hand_side, neighbors, fields, ours, mu=1e-3)

    def handwritten():
        function(
            size, *lists, size, *pointers, ctypes.c_double(1e-3), *results, sigma, backend.threads
        )

    generated()
    handwritten()
    for a, b in zip(ours, theirs, strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-9, atol=1e-12 * np.abs(b).max())
    benchmark(generated)
    generated_time, handwritten_time = setting.fastest(generated, handwritten)
    ratio = handwritten_time / generated_time
    benchmark.extra_info["speed relative to C++"] = ratio
    pairs = neighbors.neighbor.shape[0]
    print(
        f"\n{count} particles: {1e9 * generated_time / pairs:.2f} ns per pair,"
        f" {ratio:.2f} of C++ {' '.join(OPTIONS[:2])}"
    )
    assert ratio >= 0.9
