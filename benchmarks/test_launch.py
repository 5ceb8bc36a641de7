"""What a loop call costs outside the compiled loop: calls on one particle, which compute nothing.

A step of a melt pool makes some 230 of them, so that on few particles they take the step's time.
Processor time is counted, since others may run. Run: pytest benchmarks/test_launch.py -s
"""

from time import process_time

import numpy as np
import pair_functions as functions
import pytest
import setting

from lasersph import compute
from lasersph.compute.graph import graph
from lasersph.linear_solvers.matrix import PairMatrix, residual
from lasersph.particles.neighbor_lists import NeighborList

CALLS, ROUNDS = 1000, 9
BOUNDS = {
    "pointwise": 40.0,
    "pair sum": 60.0,
    "pair sum of listed rows": 60.0,
    "matrix product": 50.0,
    "graph": 10.0,
}
"""Time allowed per call [us], some three times that of an idle processor."""


def pushed(v, T, dt):
    """Vector, scalar and number."""
    return v + dt * T * v


class Pushing:
    """The pointwise call as a graph."""

    def __init__(self, backend, fields, out):
        self.backend, self.fields, self.out = backend, fields, out

    @graph
    def add_rate(self, dt: float):
        """One loop."""
        self.backend.pointwise(pushed, self.fields, self.out, dt=dt)


def calls(backend):
    """The calls by name, on one particle without neighbors."""
    one, vector = backend.asarray([1.0]), backend.zeros((3, 1))
    neighbors = NeighborList(
        row_start=backend.zeros(2, "offset"), neighbor=backend.zeros(0, "index"),
        position=backend.zeros((3, 1)), support=one, kernel=setting.Wendland(),
        mean=functions.arithmetic_mean, period=(0.0, 0.0, 0.0),
    )  # fmt: skip
    flow = {"v": vector, "rho": one, "p": one, "m": one}
    rates, rest = (backend.zeros((3, 1)), backend.zeros(1)), backend.zeros(1)
    matrix = PairMatrix(neighbors, backend.zeros(0), one)
    heat = {"T": one, "v": vector}

    def pair_sum(rows=None):
        backend.pair_sum(functions.right_hand_side, neighbors, flow, rates, rows=rows, mu=1e-3)

    def pointwise():
        backend.pointwise(pushed, heat, rates[0], dt=0.1)

    rows = backend.zeros(1, "index")
    pushing = Pushing(backend, heat, rates[0])
    return {
        "pointwise": pointwise,
        "pair sum": pair_sum,
        "pair sum of listed rows": lambda: pair_sum(rows),
        "matrix product": lambda: residual(backend, matrix, one, one, rest),
        "graph": lambda: pushing.add_rate(0.2),
    }


@pytest.mark.parametrize("name", BOUNDS)
def test_launch(name):
    """Within its bound, the least of many rounds."""
    call = calls(compute.cpu(threads=1))[name]
    call()
    times = []
    for _ in range(ROUNDS):
        start = process_time()
        for _ in range(CALLS):
            call()
        times.append(process_time() - start)
    each = 1e6 * float(np.min(times)) / CALLS
    print(f"\n{name}: {each:.1f} us per call")
    assert each <= BOUNDS[name]
