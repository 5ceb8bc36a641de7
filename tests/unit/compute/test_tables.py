"""Tables of scalars, vectors and tensors: what loops read at places of their own choice."""

import numpy as np
import pytest

from lasersph import compute
from lasersph.compute import loops
from lasersph.compute.values import LoopSourceError
from lasersph.compute.vectors import (
    dot,
    element,
    identity,
    interpolate,
    matmul,
    matvec,
    outer,
    trace,
    vector,
)

COUNT = 4
SOURCE = [2, 0, 3, 3, 1, 0]


def entries(table):
    """The entries of a host table (..., n), as plain Python indexes them."""
    return list(np.moveaxis(table, -1, 0))


def mixed(source, kind, v, M, m, sign):
    """Every operation on vectors and tensors, of entries at two places."""
    a, s = v[source], sign[kind]
    b = s * a + m[source] * a / 2.0
    T = outer(a, b) + matmul(M[source], identity(len(a)) - 2.0 * outer(s, s))
    return dot(a, b), matvec(M[source], v[kind]) - b, T, v[source][0] + M[source][-1, 0] + trace(T)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_entries_of_vectors_and_tensors(backend, dimension):
    """Loops give what the plain function gives of the entries."""
    rng, d, count = np.random.default_rng(3), dimension, len(SOURCE)
    host = {
        "v": rng.normal(size=(d, COUNT)),
        "M": rng.normal(size=(d, d, COUNT)),
        "m": rng.normal(size=COUNT),
        "sign": rng.normal(size=(d, 2)),
    }
    kind = [0, 1, 1, 0, 1, 0]
    fields = {name: backend.asarray(a, "index") for name, a in (("source", SOURCE), ("kind", kind))}
    shapes = ((count,), (d, count), (d, d, count), (count,))
    out = tuple(backend.zeros(shape) for shape in shapes)
    backend.pointwise(mixed, fields, out, **{n: backend.asarray(a) for n, a in host.items()})
    plain = {name: entries(table) for name, table in host.items()}
    for i, (source, k) in enumerate(zip(SOURCE, kind, strict=True)):
        expected = mixed(source, k, **plain)
        for got, value in zip(out, expected, strict=True):
            # round-off of a few sums of numbers of order one
            np.testing.assert_allclose(backend.to_host(got)[..., i], value, rtol=1e-13, atol=1e-14)


def test_by_hand(backend):
    """Two entries of a vector and of a tensor, the second first."""
    v, M = [[1.0, 2.0], [10.0, 20.0]], [[[1.0, 2.0], [3.0, 4.0]], [[5.0, 6.0], [7.0, 8.0]]]
    place = {"place": backend.asarray([1, 0], "index")}
    for table, expected in ((v, [[2.0, 1.0], [20.0, 10.0]]), (M, np.array(M)[..., ::-1].tolist())):
        out = backend.zeros(np.shape(table))
        backend.pointwise(element, place, out, table=backend.asarray(table))
        assert backend.to_host(out).tolist() == expected


def difference(m_i, i, v, other):
    """A vector between places that fields and constants name, times a number of the neighbor."""
    return m_i * (v[i] - v[other])


def test_same_bits_as_components(backend):
    """A vector table is read as its components are."""
    rng = np.random.default_rng(5)
    v, m = backend.asarray(rng.normal(size=(2, 50))), backend.asarray(rng.normal(size=50))
    place = backend.asarray(rng.integers(0, 50, 50), "index")
    fields = {"m_i": m, "i": place}
    whole = backend.zeros((2, 50))
    backend.pointwise(difference, fields, whole, v=v, other=7)
    for k in (0, 1):
        one = backend.zeros(50)
        backend.pointwise(difference, fields, one, v=backend.component(v, k), other=7)
        np.testing.assert_array_equal(backend.to_host(whole)[k], backend.to_host(one))


def whole_numbers(place, cell):
    """Entries of a table of whole numbers may be places again."""
    return cell[cell[place][1]]


def test_table_of_whole_numbers(backend):
    """(0, 1) is entry 0, (1, 2) entry 1, (2, 0) entry 2."""
    cell = backend.asarray([[0, 1, 2], [1, 2, 0]], "index")
    out = backend.zeros((2, 3), "index")
    fields = {"place": backend.asarray([0, 1, 2], "index")}
    backend.pointwise(whole_numbers, fields, out, cell=cell)
    assert backend.to_host(out).tolist() == [[1, 2, 0], [2, 0, 1]]


def curve(T, nodes, values):
    """A vector that is linear between nodes, and the number of these."""
    return interpolate(T, nodes, values), len(values)


def test_interpolated_vector(backend):
    """A quarter of the way from (1, 10) to (3, 50)."""
    nodes, values = backend.asarray([0.0, 4.0]), backend.asarray([[1.0, 3.0], [10.0, 50.0]])
    out = backend.zeros((2, 1)), backend.zeros(1)
    backend.pointwise(curve, {"T": backend.asarray([1.0])}, out, nodes=nodes, values=values)
    assert [backend.to_host(one).tolist() for one in out] == [[[1.5], [20.0]], [2.0]]


@pytest.mark.parametrize("knows_layout", [True, False])
def test_later_calls_take_other_tables(monkeypatch, knows_layout):
    """Other tables, longer ones and views of the first entries, in one launch where it can."""
    if not knows_layout:
        monkeypatch.setattr(loops, "has_known_layout", lambda: False)
    backend = compute.cpu(threads=1)
    for count in (3, 5, 4):
        table = backend.head(backend.asarray(np.arange(2.0 * 7).reshape(2, 7)), count)
        nodes = backend.asarray(np.arange(float(count)))
        out = backend.zeros((2, 1)), backend.zeros(1)
        fields = {"T": backend.asarray([count - 0.5])}
        backend.pointwise(curve, fields, out, nodes=nodes, values=table)
        assert out[0].tolist() == [[count - 0.5], [count + 6.5]] and out[1].tolist() == [count]


def test_entries_of_another_shape_are_another_loop():
    """The same call with scalars, vectors and tensors, none of which takes another's launch."""
    backend = compute.cpu(threads=1)
    for shape in ((3,), (2, 3), (3, 3), (2, 2, 3), (3, 3, 3), (2, 3)):
        table = np.arange(float(np.prod(shape))).reshape(shape)
        out = backend.zeros((*shape[:-1], 1))
        place = {"place": backend.asarray([2], "index")}
        backend.pointwise(element, place, out, table=backend.asarray(table))
        np.testing.assert_array_equal(out[..., 0], table[..., 2])


def summed(place, v, w):
    return v[place] + w[place]


def unread(place, v):
    return v + 1.0


def by_two(place, v):
    return v[place, 0]


def far(place, v):
    return v[place][2]


@pytest.mark.parametrize(
    ("function", "tables", "shape", "message"),
    [
        (summed, {"v": (2, 3), "w": (3, 3)}, (2, 1), r"shapes \(2,\) and \(3,\) do not fit"),
        (unread, {"v": (2, 3)}, (2, 1), "table v must be indexed"),
        (by_two, {"v": (2, 3)}, (1,), "table v is indexed by one integer"),
        (far, {"v": (2, 3)}, (1,), r"index 2 is outside shape \(2,\)"),
        (element, {"table": (2, 3)}, (3, 1), r"shape \(2,\) per row, out has \(3,\)"),
        (element, {"table": (2, 2, 2, 3)}, (2, 1), r"table table has shape \(2, 2, 2, 3\)"),
    ],
)
def test_wrong_shapes_are_refused(backend, function, tables, shape, message):
    """The message names the table or the shapes."""
    out, fields = backend.zeros(shape), {"place": backend.asarray([0], "index")}
    given = {name: backend.asarray(np.ones(size)) for name, size in tables.items()}
    with pytest.raises((LoopSourceError, TypeError, ValueError), match=message):
        backend.pointwise(function, fields, out, **given)


def test_every_other_entry_is_refused():
    """Loops read tables without gaps; the message names the table."""
    backend, place = compute.cpu(threads=1), {"place": np.zeros(1, np.uint32)}
    for table in (np.ones(6)[::2], np.ones((2, 6))[:, ::2]):
        with pytest.raises(ValueError, match="table is not contiguous"):
            backend.pointwise(element, place, np.zeros((*table.shape[:-1], 1)), table=table)


def axis_mark(x, low):
    return 1.0 if x < low else 0.0


def marks(x, low):
    """A mark per axis, the last one twice."""
    found = vector(*(axis_mark(x[k], low[k]) for k in range(len(x) - 1)), x[-1])
    return found, max(0.5, *(found[k] for k in range(len(x))))


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_arguments_for_each_axis(backend, dimension):
    """`*(... for k in range(...))` is written out, and is plain Python."""
    x = np.array([[-1.0, 2.0], [0.2, -3.0], [5.0, 0.7]])[:dimension]
    out = backend.zeros((dimension, 2)), backend.zeros(2)
    low = (0.0,) * dimension
    backend.pointwise(marks, {"x": backend.asarray(x)}, out, low=low)
    for i in (0, 1):
        for got, value in zip(out, marks(x[:, i], low), strict=True):
            assert np.array_equal(backend.to_host(got)[..., i], value)


def unknown_number(x, count):
    return max(*(x[0] for k in range(count)))


def taken_name(x):
    k = 1.0
    return max(k, *(x[k] for k in range(len(x))))


@pytest.mark.parametrize("function", [unknown_number, taken_name])
def test_arguments_that_cannot_be_written_out(backend, function):
    """Bounds are literal, and names new."""
    constants = {"count": 2} if function is unknown_number else {}
    with pytest.raises(LoopSourceError, match="new name and literal bounds"):
        backend.pointwise(
            function, {"x": backend.asarray([[1.0], [2.0]])}, backend.zeros(1), **constants
        )
