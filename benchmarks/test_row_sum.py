"""Sparse matrix times vector, as a row sum over assembled conductances, against read bandwidth.

Counted are 12 bytes per entry (value and neighbor); row pointers and vectors come on top. The
bandwidth is that of summing an array far larger than the caches. Run: pytest benchmarks -s
"""

import numpy as np
import pair_functions as functions
import pytest
import setting

from lasersph import compute


@pytest.mark.parametrize("threads", [1, 2])
def test_row_sum(benchmark, threads):
    """At least 85 % of the measured read bandwidth."""
    backend = compute.cpu(threads=threads)
    neighbors = setting.jittered_cube(backend, 70)
    count, entries = 70**3, neighbors.neighbor.shape[0]
    fields = {"g_ij": np.random.default_rng(0).random(entries), "T": np.ones(count)}
    out = np.zeros(count)
    large = np.ones(12 * entries // 8)

    def product():
        backend.pair_sum(functions.flow, neighbors, fields, out)

    def read():
        backend.pointwise(functions.same, {"a": large}, None, reduce="sum")

    benchmark(product)
    product_time, read_time = setting.fastest(product, read)
    share = read_time / product_time
    benchmark.extra_info["share of read bandwidth"] = share
    print(
        f"\n{threads} threads: {12e-9 * entries / product_time:.1f} GB/s,"
        f" {share:.2f} of the {12e-9 * entries / read_time:.1f} GB/s read"
    )
    assert share >= 0.85
