"""Loop shapes on two and three particles, against values worked out by hand."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from lasersph.compute import vectors
from lasersph.compute.graph import graph
from lasersph.compute.vectors import dot, inverse, matvec, norm, outer, trace

STEFAN_BOLTZMANN = 5.670374419e-8


@dataclass(frozen=True)
class Hat:
    """Kernel 1 - s with sigma 3: W = 3 (1 - r/l) / l^dim."""

    sigma: float
    dimension: int

    @staticmethod
    def shape(s):
        return 1 - s

    @staticmethod
    def slope(s):
        return -1.0


def mean(l_i, l_j):
    return 0.5 * (l_i + l_j)


def flow(g_ij, T_i, T_j):
    return g_ij * (T_j - T_i)


def distance_values(x_ij, r_ij, l_ij, W_ij, dW_ij):
    return x_ij, r_ij, l_ij, W_ij, dW_ij


def dyad(x_ij, v_j, m_j):
    return m_j * outer(v_j, x_ij), dot(x_ij, x_ij) * v_j


def euler(total, T, dt):
    return T + dt * total


def two_totals(total_0, total_1, m):
    return total_1 / m, trace(total_0)


def scaled(T, factor):
    return factor * T, T**2


def weights(T_j, kind_i, kind_j, fluid):
    if kind_j == fluid and kind_i != 3:
        return 2 * T_j
    return 0


def three(backend, dimension=1, period=None, rows=3):
    """Particles 0, 1, 2 at x = 0, 1, 2 (times (1, 0, ...)), each a neighbor of the next."""
    position = np.zeros((dimension, 3))
    position[0] = [0.0, 1.0, 2.0]
    starts = [0, 1, 3, 4][: rows + 1]
    return SimpleNamespace(
        row_end=None,
        row_start=backend.asarray(starts, "offset"),
        neighbor=backend.asarray([1, 0, 2, 1], "index"),
        position=backend.asarray(position),
        support=backend.asarray([2.0, 2.0, 4.0]),
        kernel=Hat(3.0, dimension),
        mean=mean,
        period=period or (0.0,) * dimension,
    )


def test_row_sum(backend):
    """Rows of a matrix: conductances 1, 2, 3, 4 W/K and temperatures 1, 2, 5 K."""
    out = backend.zeros(3)
    fields = {"g_ij": backend.asarray([1.0, 2, 3, 4]), "T": backend.asarray([1.0, 2, 5])}
    total = backend.pair_sum(flow, three(backend), fields, out, reduce=("sum",))
    assert backend.to_host(out).tolist() == [1.0, -2.0 + 9.0, -12.0]
    assert total == (-4.0,)


def test_finish_and_reduce(backend):
    """The sum is finished in the same pass: T + dt sum, its largest value, the sum of squares."""
    fields = {"g_ij": backend.asarray([1.0, 1, 1, 1]), "T": backend.asarray([1.0, 2, 5])}
    out = backend.zeros(3)
    largest = backend.pair_sum(
        flow, three(backend), fields, out, finish=euler, reduce="max", dt=0.5
    )
    assert backend.to_host(out).tolist() == [1.5, 3.0, 3.5]
    assert largest == (3.5,)


def values_beside(T_j, x_ij):
    return T_j, T_j, T_j, x_ij


def spread(total_0, total_1, T):
    return max(total_1, T) - min(total_0, T)


def test_combine(backend):
    """Least, largest and total of the neighbors' values; a row without neighbors has none."""
    neighbors = three(backend, 2)
    neighbors.row_start = backend.asarray([0, 0, 2, 3], "offset")
    neighbors.neighbor = backend.asarray([0, 2, 1], "index")
    fields = {"T": backend.asarray([4.0, 2, 5])}
    out = (*(backend.zeros(3) for _ in range(3)), backend.zeros((2, 3)))
    largest = backend.pair_sum(
        values_beside, neighbors, fields, out,
        combine=("min", "max", "sum", "min"), reduce=(None, None, "max", None),
    )  # fmt: skip
    least, most, total, step = (backend.to_host(a) for a in out)
    assert least.tolist() == [np.inf, 4.0, 2.0]
    assert most.tolist() == [-np.inf, 5.0, 2.0]
    assert total.tolist() == [0.0, 9.0, 2.0]
    assert step[0].tolist() == [np.inf, -1.0, 1.0]
    assert largest == (9.0,)
    fields["T"] = backend.asarray([np.nan, 2, 5])
    backend.pair_sum(values_beside, neighbors, fields, out, combine=("min", "max", "sum", "min"))
    assert [bool(np.isnan(backend.to_host(a)[1])) for a in out[:2]] == [True, True]


def test_combine_and_finish(backend):
    """The finish reads what the neighbors' values were combined to: a limiter's range."""
    fields = {"T": backend.asarray([1.0, 2, 5])}
    out = backend.zeros(3)
    backend.pair_sum(twice, three(backend), fields, out, finish=spread, combine=("min", "max"))
    assert backend.to_host(out).tolist() == [1.0, 4.0, 3.0]


def twice(T_j):
    return T_j, T_j


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_geometry(backend, dimension):
    """Pair (0, 1): r = 1, l = 2, W = 3 / 2^dim / 2; pair (1, 2): l = 3, W = 3 / 3^dim * 2 / 3."""
    out = tuple(backend.zeros((dimension, 3) if k == 0 else 3) for k in range(5))
    backend.pair_sum(distance_values, three(backend, dimension), {}, out)
    x, r, reach, W, dW = (backend.to_host(a) for a in out)
    assert x[0].tolist() == [-1.0, 0.0, 1.0]
    assert r.tolist() == [1.0, 2.0, 1.0]
    assert reach.tolist() == [2.0, 5.0, 3.0]
    first, second = 3 / 2**dimension, 3 / 3**dimension
    np.testing.assert_allclose(W, [first / 2, first / 2 + second * 2 / 3, second * 2 / 3])
    np.testing.assert_allclose(dW, [-first / 2, -first / 2 - second / 3, -second / 3])


def test_nearest_image(backend):
    """With a period of 2.5 m particles 0 and 2 at 0 and 2 m are 0.5 m apart."""
    neighbors = three(backend, 2, period=(2.5, 0.0))
    neighbors.neighbor = backend.asarray([2, 0, 2, 0], "index")
    out = (backend.zeros((2, 3)), backend.zeros(3))
    backend.pair_sum(separation, neighbors, {}, out)
    assert backend.to_host(out[0])[0].tolist() == [0.5, 0.0, -0.5]
    assert backend.to_host(out[1]).tolist() == [0.5, 2.0, 0.5]


def separation(x_ij, r_ij):
    return x_ij, r_ij


def test_vectors_and_tensors(backend):
    """sum_j m_j v_j (x) x_ij and sum_j |x_ij|^2 v_j in 2-D, and a finish on both sums."""
    neighbors = three(backend, 2)
    v = np.array([[1.0, 2, 3], [4, 5, 6]])
    fields = {"v": backend.asarray(v), "m": backend.asarray([1.0, 10, 100])}
    tensor, vector = backend.zeros((2, 2, 3)), backend.zeros((2, 3))
    backend.pair_sum(dyad, neighbors, fields, (tensor, vector))
    host = backend.to_host(tensor)
    assert host[:, :, 0].tolist() == [[-20.0, 0.0], [-50.0, 0.0]]
    assert host[:, 0, 1].tolist() == [1.0 - 300.0, 4.0 - 600.0]
    assert backend.to_host(vector)[:, 1].tolist() == [4.0, 10.0]
    out = (backend.zeros((2, 3)), backend.zeros(3))
    sums = backend.pair_sum(dyad, neighbors, fields, out, finish=two_totals, reduce=(None, "min"))
    assert backend.to_host(out[0])[:, 1].tolist() == [0.4, 1.0]
    assert backend.to_host(out[1]).tolist() == [-20.0, -299.0, 20.0]
    assert sums == (-299.0,)


def test_pair_values(backend):
    """One number per pair in list order; only the pairs of the active rows are written."""
    fields = {"T": backend.asarray([1.0, 2, 5]), "g_ij": backend.asarray([1.0, 2, 3, 4])}
    out = backend.zeros(4)
    rows = backend.asarray([1], "index")
    backend.pair_values(flow, three(backend), fields, out, rows=rows)
    assert backend.to_host(out).tolist() == [0.0, -2.0, 9.0, 0.0]
    backend.pair_values(flow, three(backend), fields, out)
    assert backend.to_host(out).tolist() == [1.0, -2.0, 9.0, -12.0]


def test_pointwise_rows(backend):
    """Active rows only; one of two results stored, the other reduced."""
    fields = {"T": backend.asarray([1.0, 2, 5])}
    out = backend.zeros(3)
    rows = backend.asarray([0, 2], "index")
    total = backend.pointwise(
        scaled, fields, (out, None), rows=rows, reduce=(None, "sum"), factor=10.0
    )
    assert backend.to_host(out).tolist() == [10.0, 0.0, 50.0]
    assert total == (26.0,)
    none = backend.asarray([], "index")
    assert backend.pointwise(
        scaled, fields, (out, None), rows=none, reduce=("max", "sum"), factor=1.0
    ) == (-np.inf, 0.0)


def test_dummy_particles_and_kinds(backend):
    """Two rows, three particles; integer fields are compared with integers."""
    neighbors = three(backend, rows=2)
    fields = {"T": backend.asarray([1.0, 2, 5]), "kind": backend.asarray([3, 0, 1], "flag")}
    out = backend.zeros(2)
    backend.pair_sum(weights, neighbors, fields, out, fluid=1)
    assert backend.to_host(out).tolist() == [0.0, 10.0]


def test_heads(backend):
    """Leading views of vectors and scalars serve as fields and outputs."""
    v = backend.asarray(np.arange(8.0).reshape(2, 4))
    out = backend.zeros((2, 4))
    backend.pointwise(doubled, {"v": backend.head(v, 3)}, backend.head(out, 3))
    assert backend.to_host(out).tolist() == [[0, 2, 4, 0], [8, 10, 12, 0]]


def doubled(v):
    return 2 * v


def test_not_a_number_is_seen(backend):
    """max and min return NaN as soon as one value is NaN, wherever it stands."""
    for place in range(3):
        values = np.array([1.0, 2, 5])
        values[place] = np.nan
        field = {"T": backend.asarray(values)}
        found = backend.pointwise(scaled, field, (None, None), reduce=("max", "min"), factor=1.0)
        assert np.isnan(found).all()


def test_errors(backend):
    """Missing fields, short arrays, wrong types and stray constants are named."""
    neighbors, T = three(backend), backend.asarray([1.0, 2, 5])
    g = backend.asarray([1.0, 2, 3, 4])
    out = backend.zeros(3)
    with pytest.raises(ValueError, match=r"flow\(\) needs field g_ij"):
        backend.pair_sum(flow, neighbors, {"T": T}, out)
    with pytest.raises(ValueError, match="g_ij has 3 entries, 4 are needed"):
        backend.pair_sum(flow, neighbors, {"T": T, "g_ij": T}, out)
    with pytest.raises(ValueError, match="has no argument speed"):
        backend.pair_sum(flow, neighbors, {"T": T, "g_ij": g}, out, speed=1.0)
    with pytest.raises(ValueError, match="needs a value for dt"):
        backend.pair_sum(flow, neighbors, {"T": T, "g_ij": g}, out, finish=euler)
    with pytest.raises(ValueError, match="out is also read at neighbors, as T_j"):
        backend.pair_sum(flow, neighbors, {"T": T, "g_ij": g}, T)
    with pytest.raises(ValueError, match="shape"):
        backend.pair_sum(flow, neighbors, {"T": T, "g_ij": g}, backend.zeros((2, 3)))
    with pytest.raises(ValueError, match="combine takes"):
        backend.pair_sum(flow, neighbors, {"T": T, "g_ij": g}, out, combine="mean")
    with pytest.raises(ValueError, match="combine has 2 entries for 1 values"):
        backend.pair_sum(flow, neighbors, {"T": T, "g_ij": g}, out, combine=("sum", "min"))
    with pytest.raises(ValueError, match="row 7 of 3"):
        rows = backend.asarray([7], "index")
        backend.pair_sum(flow, neighbors, {"T": T, "g_ij": g}, out, rows=rows)
    neighbors.row_start = backend.asarray([0, 1, 3, 4], "index")
    with pytest.raises(ValueError, match="row_start must be uint64"):
        backend.pair_sum(flow, neighbors, {"T": T, "g_ij": g}, out)


def waved(T, period):
    return T * period


def test_same_call_with_other_arrays(backend):
    """Whatever was checked at one call is checked at the next: lengths, rows, kinds, lists."""
    neighbors, T, out = three(backend), backend.asarray([1.0, 2, 5]), backend.zeros(3)
    g = backend.asarray([1.0, 2, 3, 4])
    rows = backend.asarray([0, 2], "index")

    def call():
        return backend.pair_sum(flow, neighbors, {"T": T, "g_ij": g}, out, rows=rows)

    call()
    backend.copy(backend.asarray([0, 3], "index"), rows)
    with pytest.raises(ValueError, match="row 3 of 3"):
        call()
    backend.fill(rows, 1)
    full, T = T, backend.head(T, 2)
    with pytest.raises(ValueError, match=r"T_[ij] has 2 entries, 3 are needed"):
        call()
    T, out = full, full
    with pytest.raises(ValueError, match="out is also read at neighbors"):
        call()
    out = backend.zeros((2, 3))
    with pytest.raises(ValueError, match="result 0 has shape"):
        call()
    out = backend.zeros(3)
    backend.copy(backend.asarray([0, 1, 3, 9], "offset"), neighbors.row_start)
    with pytest.raises(ValueError, match="9 pairs, 4 stored"):
        call()


def test_constant_named_like_the_period(backend):
    """A loop without geometry takes the caller's number of that name."""
    out = backend.zeros(3)
    backend.pointwise(waved, {"T": backend.asarray([1.0, 2, 5])}, out, period=2.0)
    assert backend.to_host(out).tolist() == [2.0, 4.0, 10.0]


def radiation(T, V, epsilon, x, nodes, values, gravity):
    """One of everything; compared with plain NumPy below."""
    hot = max(T, 300)
    flux = epsilon * STEFAN_BOLTZMANN * (hot**4 - 300.0**4)
    M = outer(x, x) + vectors.identity(len(x)) * V
    y = matvec(inverse(M), x)
    if T > 500 and V < 2:
        flux += vectors.interpolate(T, nodes, values)
    elif not T > 400:
        flux = -flux
    total = 0.0
    for k in range(3):
        total += k * V
    count = 0
    while count < 3 and values[count] < 2.5:
        count += 1
    a, b = flux, total
    a, b = b, a
    return (
        a + b * T**1.5 + norm(y) + count,
        y / V + gravity,
        abs(x[-1]) ** -2 if V > 1 else trace(M),
    )


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_same_as_plain_python(backend, dimension):
    """The generated code of a function with every construct equals the function itself."""
    rng = np.random.default_rng(1)
    T, V = rng.uniform(200, 900, 20), rng.uniform(0.5, 2.5, 20)
    x = rng.normal(size=(dimension, 20))
    nodes, values = np.array([100.0, 400, 800]), np.array([1.0, 2, 3])
    gravity = tuple(float(k) for k in range(dimension))
    out = (backend.zeros(20), backend.zeros((dimension, 20)), backend.zeros(20))
    fields = {name: backend.asarray(a) for name, a in (("T", T), ("V", V), ("x", x))}
    tables = {"nodes": backend.asarray(nodes), "values": backend.asarray(values)}
    backend.pointwise(radiation, fields, out, epsilon=0.5, gravity=gravity, **tables)
    for i in range(20):
        expected = radiation(T[i], V[i], 0.5, x[:, i], nodes, values, np.array(gravity))
        for got, value in zip(out, expected, strict=True):
            np.testing.assert_allclose(backend.to_host(got)[..., i], value, rtol=1e-12)


class Stepping:
    """A step of three particles as a graph."""

    def __init__(self, backend):
        self.backend, self.neighbors, self.out = backend, three(backend), backend.zeros(3)
        self.T = backend.asarray([1.0, 2.0, 4.0])
        self.weights = backend.single(backend.asarray(np.ones(4)))

    @graph
    def step(self, dt: float):
        """Temperatures after dt."""
        fields = {"g_ij": self.weights, "T": self.T}
        self.backend.pair_sum(flow, self.neighbors, fields, self.out, finish=euler, dt=dt)


def test_recorded_pair_sum(backend):
    """The sums of test particles with T, after T has changed in place, with other numbers."""
    stepping = Stepping(backend)
    for _ in range(2):
        stepping.step(0.5)
    backend.copy(backend.asarray([0.0, 2.0, 4.0]), stepping.T)
    stepping.step(0.5)
    assert backend.to_host(stepping.out).tolist() == [1.0, 2.0, 3.0]
    stepping.step(dt=1.0)
    assert backend.to_host(stepping.out).tolist() == [2.0, 2.0, 2.0]


def test_no_particles(backend):
    """Loops over nothing do nothing: arrays without entries are as good as others."""
    empty = backend.zeros(0)
    (total,) = backend.pointwise(
        scaled, {"T": empty}, (empty, None), reduce=(None, "sum"), factor=2.0
    )
    assert total == 0.0
