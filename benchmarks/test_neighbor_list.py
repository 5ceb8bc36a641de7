"""Neighbor list of a million 3-D particles, and of graded ones. Run: pytest benchmarks -s"""

import numpy as np
import pair_functions as functions
import setting
from hot_loops.counting import CountingBackend
from hot_loops.loops import list_build

from lasersph import compute
from lasersph.compute import search


def test_million(benchmark):
    """1M particles with l = 2.9 spacings (90 neighbors): within 1.0 s on two threads."""
    backend = CountingBackend(2)
    build = list_build(backend, setting.jittered_cube(backend, 100))
    benchmark.pedantic(build.run, rounds=7, warmup_rounds=2)
    print(f"\n1M particles: {benchmark.stats.stats.min:.2f} s")
    assert benchmark.stats.stats.min <= 1.0


def test_graded(benchmark):
    """Rows from 4 nm to 1 um (ratio 7/9): the time per pair stays that of a uniform lattice."""
    backend = compute.cpu(threads=2)
    spacing, rows, z = 1e-6, [], 0.0
    while spacing > 4e-9:
        x = np.arange(0.0, 50e-6, 4 * spacing**0.5 * 1e-5)
        rows.append(np.array([x, np.full(x.size, z), np.full(x.size, 2.9 * spacing)]))
        z += spacing
        spacing *= 7 / 9
    x, depth, support = np.concatenate(rows, axis=1)
    position = np.array([x, depth])

    def build():
        return search.neighbor_list(
            backend, position, support, support.size, mean=functions.arithmetic_mean
        )

    _, neighbor = build()
    benchmark.pedantic(build, rounds=5, warmup_rounds=1)
    print(f"\n{support.size} graded particles, {neighbor.size} pairs")
