"""Loop graphs: run again, they do what their methods would, with other numbers, rows, elements."""

import gc
from functools import partial
from weakref import ref

import pytest

from lasersph import compute
from lasersph.compute.compiled_iteration import reduction, run_step
from lasersph.compute.graph import checked_graphs, graph


def scaled(a, factor):
    """A multiple of a field, and its square."""
    return factor * a, (factor * a) ** 2


def added(a, b):
    """The sum of two fields."""
    return a + b


def biased(v, bias):
    """Another multiple."""
    return bias * v


class Doubling:
    """Twice a multiple of chosen elements, by way of a work array; `runs`: of the method."""

    def __init__(self, backend):
        self.backend, self.runs, self.bias = backend, 0, 1.0
        self.a, self.out = backend.asarray([1.0, 2, 3, 4]), backend.zeros(4)

    @graph
    def double(self, rows, factor: float):
        """Twice a multiple, and the largest element."""
        backend, a, self.runs = self.backend, self.a, self.runs + 1
        work, how = backend.zeros(4), {"rows": rows, "reduce": (None, "sum")}
        backend.pointwise(scaled, {"a": a}, (work, None), **how, factor=factor)
        backend.copy(work, self.out)
        backend.pointwise(added, {"a": self.out, "b": work}, self.out)
        fields, how = {"v": a}, {"reduce": ("max",)}
        backend.pointwise(biased, fields, (None,), **how, bias=self.bias)

    def __call__(self, rows, factor):
        found = self.double(self.backend.asarray(rows, "index"), factor)
        return found, self.backend.to_host(self.out).tolist()


CALLS = [
    ([0, 1], 1.0, ((5.0, 4.0), [2, 4, 0, 0])),
    ([3], 2.0, ((64.0, 4.0), [0, 0, 0, 16])),
    ([0, 2, 3], 3.0, ((234.0, 4.0), [6, 0, 18, 24])),
    ([], 1.0, ((0.0, 4.0), [0, 0, 0, 0])),
    ([1], -1.0, ((4.0, 4.0), [0, -4, 0, 0])),
]
"""Rows and factor, and what is reduced and written."""


def test_runs_again(backend):
    """Work arrays begin with zeros each time; rows, numbers and elements are the present ones."""
    doubling = Doubling(backend)
    for rows, factor, expected in CALLS:
        assert doubling(rows, factor) == expected
    backend.fill(doubling.a, 10.0)
    assert doubling([0], 1.0) == ((100.0, 10.0), [20, 0, 0, 0])


def test_python_runs_where_arrays_are_new():
    """The method is run once, once more while it is recorded, and again for other arrays."""
    doubling = Doubling(compute.cpu(threads=1))
    for rows, factor, expected in CALLS:
        assert doubling(rows, factor) == expected
    assert doubling.runs == 2
    for values in ([2.0, 2, 2, 2], [2.0, 2, 2, 0]):
        doubling.a = doubling.backend.asarray(values)
        for _ in range(3):
            assert doubling([1, 2], 1.0) == ((8.0, 2.0), [0, 4, 4, 0])
    assert doubling.runs == 4


def test_keywords_and_order_do_not_matter():
    """A graph takes its arguments as the method does."""
    doubling = Doubling(compute.cpu(threads=1))
    rows = doubling.backend.asarray([0, 1], "index")
    for _ in range(3):
        assert doubling.double(factor=2.0, rows=rows) == (20.0, 4.0)
    assert doubling.runs == 2
    with pytest.raises(TypeError):
        doubling.double(rows)


class Hiding(Doubling):
    """Reads what nothing leads to."""

    @graph
    def read(self):
        """Write a multiple of an array that is made elsewhere."""
        a = self.backend.asarray([1.0, 2, 3, 4])
        self.backend.pointwise(biased, {"v": a}, self.out, bias=2.0)

    @graph
    def choose(self):
        """Write to rows that are made anew."""
        rows = self.backend.asarray([1], "index")
        self.backend.pointwise(biased, {"v": self.a}, self.out, rows=rows, bias=2.0)

    @graph
    def sort(self):
        """Find rows."""
        self.rows = self.backend.rows_where(self.a, 2.0)

    @graph
    def halve(self, factor: float):
        """Write a multiple by a number that is computed."""
        self.backend.pointwise(biased, {"v": self.a}, self.out, bias=0.5 * factor)


def test_what_is_refused():
    """An array and rows that no attribute holds, a sort, and a number computed on the way."""
    for name, numbers, words in (
        ("read", (), r"v of biased\(\) is reached by no attribute or argument"),
        ("choose", (), r"rows of biased\(\) are rows that no attribute"),
        ("sort", (), r"rows_where\(\) is no loop: a graph would not run it again"),
        ("halve", (2.0,), "a graph computes with a number that it is given"),
    ):
        hiding = Hiding(compute.cpu(threads=1))
        getattr(hiding, name)(*numbers)
        with pytest.raises(ValueError, match=words):
            getattr(hiding, name)(*numbers)


def test_a_constant_that_changes_is_found():
    """The strict backend, and any within `checked_graphs`, run the method beside the recording."""
    doubling = Doubling(compute.strict(threads=1))
    for rows, factor, expected in CALLS:
        assert doubling(rows, factor) == expected
    doubling.bias = 2.0
    with pytest.raises(ValueError, match=r"biased\(\) is not what its graph recorded"):
        doubling([0], 1.0)
    doubling = Doubling(compute.cpu(threads=1))
    with checked_graphs():
        for rows, factor, expected in CALLS:
            assert doubling(rows, factor) == expected
        assert doubling.runs == len(CALLS)
        doubling.bias = 2.0
        with pytest.raises(ValueError, match=r"biased\(\) is not what its graph recorded"):
            doubling([0], 1.0)


class Holder:
    """Objects in one another, with an array that two ways lead to."""

    def __init__(self, backend):
        self.backend, self.out = backend, backend.zeros(3)
        first = backend.asarray([1.0, 2, 3])
        self.short, self.table = first, {"deep": [(first, None)]}
        self.optional = None

    @graph
    def read(self):
        """Copy by the longer way, and add what there may be."""
        a = self.table["deep"][0][0]
        self.backend.pointwise(biased, {"v": a}, self.out, bias=1.0)
        if self.optional is not None:
            fields = {"a": self.out, "b": self.optional}
            self.backend.pointwise(added, fields, self.out)

    def values(self):
        self.read()
        return self.backend.to_host(self.out).tolist()


def test_all_ways_to_an_array_are_watched(backend):
    """The longer way leads elsewhere while the shorter stays; and an array comes where was None."""
    holder = Holder(backend)
    for _ in range(3):
        assert holder.values() == [1, 2, 3]
    holder.table["deep"][0] = (backend.asarray([4.0, 5, 6]), None)
    for _ in range(3):
        assert holder.values() == [4, 5, 6]
    holder.optional = holder.short
    for _ in range(3):
        assert holder.values() == [5, 7, 9]
    del holder.table["deep"][0]
    holder.table["deep"].append((holder.short, None))
    assert holder.values() == [2, 4, 6]


class Adding:
    """Two attributes that may hold the same array."""

    def __init__(self, backend):
        self.backend, self.out = backend, backend.zeros(2)
        self.a = self.b = backend.asarray([1.0, 2.0])

    @graph
    def add(self):
        """Add both."""
        self.backend.pointwise(added, {"a": self.a, "b": self.b}, self.out)

    def values(self):
        self.add()
        return self.backend.to_host(self.out).tolist()


def test_two_ways_to_the_same_array(backend):
    """What was one array becomes two, by either way."""
    for name in ("a", "b"):
        adding = Adding(backend)
        for _ in range(3):
            assert adding.values() == [2, 4]
        setattr(adding, name, backend.asarray([10.0, 20.0]))
        for _ in range(3):
            assert adding.values() == [11, 22]


class Nesting(Holder):
    """A graph inside a graph."""

    @graph
    def read_twice(self):
        """Run another graph, whose loops are part of this one, and add to what it gives."""
        self.read()
        how = {"reduce": (None, "sum")}
        self.backend.pointwise(scaled, {"a": self.out}, (self.out, None), **how, factor=2.0)


def test_nested(backend):
    """What the inner graph reads is watched by the outer one."""
    nesting = Nesting(backend)
    for _ in range(4):
        assert nesting.read_twice() == (56.0,)
    nesting.table["deep"][0] = (backend.asarray([0.0, 0, 1]), None)
    for _ in range(3):
        assert nesting.read_twice() == (4.0,)
    assert nesting.read() == ()


def halve_until(scale, nothing, total, wanted, most):
    """Halve values until their sum is small; runs, and the last sum."""
    runs = 0.0
    while total > wanted and runs < most:
        run_step(scale, 0.5)
        run_step(nothing, 0.0)
        total = reduction(scale, 0)
        runs += 1.0
    return runs, total


def multiplied(v, factor, own):
    """Values times two factors, and their sum."""
    return own * factor * v, own * factor * v


class Halving:
    """Values that are halved until their sum is small; `runs`: of the method."""

    def __init__(self, backend, count=10_000):
        self.backend, self.runs = backend, 0
        self.renew(count)

    def renew(self, count):
        values = [1.0 + k / (count - 1) for k in range(count)]
        self.v = self.backend.asarray(values)
        self.rows = self.backend.asarray(range(count), "index")

    @graph
    def scale(self, v, own: float, factor: float):
        """Multiply the values; reduces their sum."""
        self.runs += 1
        how = {"rows": self.rows, "reduce": (None, "sum")}
        self.backend.pointwise(multiplied, {"v": v}, (v, None), **how, factor=factor, own=own)

    def iterate(self, most=50, own=1.0):
        steps = partial(self.scale, self.v, own=own), None
        return self.backend.iterate(halve_until, steps, 15_000.0, 100.0, most)[:2]


def test_until_convergence(backend):
    """Eight halvings of a sum of 15 000 leave less than 100; each iteration begins anew."""
    halving = Halving(backend)
    for count in (10_000, 10_000, 10_001):
        halving.renew(count)
        runs, total = halving.iterate()
        assert runs == 8.0
        assert total == pytest.approx(1.5 * count / 256.0, rel=1e-12)
    halving.renew(10_000)
    halving.rows = backend.asarray([0], "index")
    assert halving.iterate(most=1, own=4.0) == (1.0, 2.0)
    assert halving.scale(halving.v, 1.0, 0.5) == (1.0,)
    assert halving.scale(halving.v, 1.0, 8.0) == (8.0,)
    assert halving.iterate(most=1) == (1.0, 4.0)
    assert halving.scale(halving.v, 1.0, 0.0) == (0.0,)


def test_steps_are_bound_where_arrays_are_new():
    """The method runs once for each set of arrays, not for each iteration."""
    halving = Halving(compute.cpu(threads=1))
    for _ in range(3):
        halving.iterate()
    assert halving.runs == 1
    halving.renew(5_000)
    halving.iterate()
    assert halving.runs == 2


def bits_of(backend, own_step=None):
    """Numbers of an iteration and the values that it leaves."""
    halving = Halving(backend)
    found = halving.iterate()
    if own_step:
        halving = Halving(backend)

        def scale(factor):
            return halving.scale(halving.v, 1.0, factor)

        found = backend.iterate(halve_until, (scale, None), 15_000.0, 100.0, 50)[:2]
    return found, backend.to_host(halving.v).tobytes()


@pytest.mark.parametrize("threads", [1, 2])
def test_compiled_and_interpreted_agree(threads):
    """Steps in compiled code, and as functions that Python calls, have the same bits."""
    compiled = bits_of(compute.cpu(threads=threads))
    assert compiled == bits_of(compute.cpu(threads=1), own_step=True)


def test_single_precision():
    """The number enters in the precision of the loop."""
    runs, total = Halving(compute.cpu(threads=1, precision="float32")).iterate()
    assert runs == 8.0 and total == pytest.approx(15_000.0 / 256.0, rel=1e-6)


def test_an_iteration_makes_no_arrays():
    """Nothing would fill them with zeros at each step."""
    doubling = Doubling(compute.cpu(threads=1))
    step = partial(doubling.double, doubling.backend.asarray([0], "index"))
    with pytest.raises(ValueError, match="a step of an iteration makes no arrays"):
        doubling.backend.iterate(halve_until, (step, None), 1.0, 0.0, 1)


def test_an_owner_goes_without_a_ring():
    """Nothing that is kept of a graph holds its owner, nor arrays that were replaced."""
    gc.disable()
    try:
        halving = Halving(compute.cpu(threads=1))
        seen = []
        for count in (100, 200, 20_000):
            halving.renew(count)
            for _ in range(3):
                halving.scale(halving.v, 1.0, 0.5)
                halving.iterate(most=1)
            seen.append(ref(halving.v))
        assert [one() is None for one in seen] == [True, True, False]
        seen.append(ref(halving))
        del halving
        assert [one() is None for one in seen] == [True] * 4
    finally:
        gc.enable()
