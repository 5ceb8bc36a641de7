"""What loops must move and compute at least, against counts by hand."""

import numpy as np
import pytest
from hot_loops.counted import Counted, Tally
from hot_loops.counting import CountingBackend
from hot_loops.functions import flow, right_hand_side, triad
from hot_loops.least import Least
from hot_loops.particles import jittered
from hot_loops.sweeping import least_of_sweep

from lasersph import compute
from lasersph.compute.compiled_iteration import run_step
from lasersph.compute.graph import graph
from lasersph.compute.sweeps import Sweep, ordered_pairs
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient, PairOperator
from lasersph.sph.kernels import kernel

N = 100


@pytest.fixture(scope="module")
def backend():
    """One thread."""
    return CountingBackend(1)


@pytest.fixture(scope="module")
def neighbors(backend):
    """A hundred particles in 2-D."""
    return jittered(backend, 10, kernel("wendland-c2", 2))


@pytest.mark.parametrize(
    ("formula", "simple", "divisions"),
    [
        (lambda x: 2.0 * x + 1.0, 2, 0),
        (lambda x: (1.0 - x) ** 3, 3, 0),
        (lambda x: x**4 * x**2, 4, 0),
        (lambda x: 1.0 / x + x / 3.0, 1, 2),
        (lambda x: np.sqrt(x) + x**1.5, 1, 2),
        (lambda x: max(x, 0.0), 1, 0),
        (lambda x: -abs(x), 0, 0),
        (lambda x: x if x < 3.0 else 2.0 * x, 1, 0),
        (lambda x: np.dot(x * np.ones(3), np.ones(3)), 3 + 3 + 2, 0),
        (lambda x: int(x) // 2 + 5, 1, 0),
    ],
)
def test_operations_of_a_formula(formula, simple, divisions):
    """As a reader counts them; the value is that of a float."""
    tally = Tally()
    result = formula(Counted(2.0, tally))
    assert (tally.simple, tally.divisions) == (simple, divisions)
    assert float(getattr(result, "value", result)) == formula(2.0)


def test_a_root_of_the_standard_library_is_no_float():
    """Nothing slips out uncounted."""
    with pytest.raises(TypeError):
        float(Counted(2.0, Tally()))  # type: ignore[arg-type]


def test_pointwise(backend):
    """b + s c: two arrays read, one fetched and written; written in place it is fetched once."""
    b, c, out = (backend.zeros(N) for _ in range(3))
    fields = {"b": b, "c": c}
    assert backend.least(lambda: backend.pointwise(triad, fields, out, s=0.5)) == Least(
        32.0 * N, 2.0 * N
    )
    assert backend.least(lambda: backend.pointwise(triad, fields, b, s=0.5)).traffic == 24.0 * N


def test_product_with_a_matrix(backend, neighbors):
    """Weight and column of each pair, three operations; T is read once for all i and j."""
    pairs = neighbors.neighbor.shape[0]
    fields = {"g_ij": np.ones(pairs), "T": np.ones(N)}
    least = backend.least(lambda: backend.pair_sum(flow, neighbors, fields, np.zeros(N)))
    assert least == Least(12.0 * pairs + 8.0 * (N + 1) + 24.0 * N, 3.0 * pairs)


def test_right_hand_side(backend, neighbors):
    """x, v, support, rho, p, m read, a and rate written; what depends on i alone is no work.

    Operations of a pair: 2 of x_ij, 3 of r_ij^2, 2 of l_ij, 1 + 2 of s and sigma / l^2, 1 + 1 of
    the slope's scale, 5 of the slope, 1 of m W', 2 of the pressure's bracket, 1 of its factor, 2 of
    the viscous one, 2 of v_ij, 2 + 2 + 2 of the force, 3 + 1 of the rate, 3 sums.
    """
    pairs = neighbors.neighbor.shape[0]
    fields = {"v": np.ones((2, N)), "rho": np.ones(N), "p": np.ones(N), "m": np.ones(N)}
    out = (np.zeros((2, N)), np.zeros(N))
    least = backend.least(
        lambda: backend.pair_sum(right_hand_side, neighbors, fields, out, mu=1e-3)
    )
    assert least.traffic == 4.0 * pairs + 8.0 * (N + 1) + 8 * 8.0 * N + 3 * 16.0 * N
    assert least.divisions == 5.0 * pairs
    assert least.operations == pytest.approx(39.0 * pairs)


def test_iteration_of_conjugate_gradients(backend, neighbors):
    """One more: weights in float32, 9 vectors read, 4 of them changed, one written anew."""
    pairs = neighbors.neighbor.shape[0]
    weights, zeros, ones = np.ones(pairs), np.zeros(N), np.ones(N)
    degree = np.diff(neighbors.row_start).astype(float)
    operator = PairOperator(neighbors, weights, zeros, degree)
    solver = ConjugateGradient(backend, operator, N, rounds=True)
    b = np.random.default_rng(0).standard_normal(N)

    def least(iterations):
        return backend.least(
            lambda: solver.solve(b, ones, ones, 0.1, residual=0.0, max_iterations=iterations)
        )

    one, two = least(1), least(2)
    expected = 8.0 * pairs + 8.0 * (N + 1) + (9 + 4 + 2) * 8.0 * N
    assert two.traffic - one.traffic == expected
    assert 15.0 * N <= two.operations - one.operations - 2.0 * pairs <= 20.0 * N


def scaled(total, b, s):
    """Three operations and a division, the last for a value that is summed."""
    x = (b + s * total) / s
    return x, x * b


def test_sweep(backend, neighbors):
    """Weights and columns, one field read, one vector written; 3 operations and a sum a row."""
    weights = np.ones(neighbors.neighbor.shape[0])
    pairs = ordered_pairs(backend, neighbors, weights)
    assert pairs is not None
    sweep = Sweep(pairs, scaled, {"b": np.ones(N)}, [np.zeros(N)], reduces=1, s=2.0)
    least, tiles = least_of_sweep(sweep), pairs.sides[0]
    stored = tiles.value.size + 6 * (N // 4)
    assert least.traffic == 8.0 * stored + tiles.column.nbytes + tiles.start.nbytes + 24.0 * N
    assert least.operations == 2.0 * stored + (3 + 1) * N and least.divisions == N


class Adding:
    """The triad as a graph."""

    def __init__(self, backend):
        self.backend = backend
        self.b, self.c, self.out = (backend.asarray(np.arange(float(N))) for _ in range(3))

    @graph
    def add(self):
        """a = b + s c."""
        self.backend.pointwise(triad, {"b": self.b, "c": self.c}, self.out, s=0.5)

    @graph
    def step(self, s: float):
        """The same with a number, for an iteration."""
        self.backend.pointwise(triad, {"b": self.b, "c": self.c}, self.out, s=s)


def once(step, number):
    """Run a step once with a number."""
    run_step(step, number)
    return (number,)


def test_calls_graphs_and_steps_count_the_same(backend):
    """Each run of a loop once, called or of a graph; and only while it is asked for."""
    adding = Adding(backend)
    fields = {"b": adding.b, "c": adding.c}
    called = backend.least(lambda: backend.pointwise(triad, fields, adding.out, s=0.5))
    for _ in range(3):
        assert backend.least(adding.add) == called
        assert backend.least(lambda: backend.iterate(once, (adding.step,), 0.5)) == called
    assert backend.least(lambda: None) == Least()
    plain = np.zeros(N)
    compute.cpu(threads=1).pointwise(triad, fields, plain, s=0.5)
    np.testing.assert_array_equal(adding.out, plain)
