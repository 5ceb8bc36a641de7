"""Binding of launches in compiled code, or in Python where arrays are laid out otherwise."""

import gc
from weakref import ref

import numpy as np

from lasersph import compute
from lasersph.compute import loops
from lasersph.compute.graph import graph
from lasersph.compute.kept_graph import KeptGraph
from lasersph.compute.rebinding import has_known_layout
from lasersph.compute.vectors import element


def doubled(a):
    """Twice a field."""
    return 2.0 * a


def scaled(a, factor):
    """A multiple of a field, and the same for its sum."""
    return factor * a, factor * a


def doubles(backend):
    """A loop run with two pairs of arrays: the second call finds the launch of the first."""
    found = []
    for values in (np.arange(3.0), np.arange(5.0)):
        out = backend.zeros(values.size)
        backend.pointwise(doubled, {"a": backend.asarray(values)}, out)
        found.append(backend.to_host(out))
    return found


def test_layout_is_known():
    """The structure of arrays is the one that the compiled code reads."""
    assert has_known_layout()


def test_same_results_without_the_layout(monkeypatch):
    """An unknown layout costs time and changes no result."""
    expected = doubles(compute.cpu(threads=1))
    monkeypatch.setattr(loops, "has_known_layout", lambda: False)
    monkeypatch.setattr(loops, "rebindable", None)
    for one, other in zip(doubles(compute.cpu(threads=1)), expected, strict=True):
        np.testing.assert_array_equal(one, other)


def both_halves(a):
    """Half of a field, and its other half."""
    return 0.5 * a, 0.25 * a


def test_calls_that_store_different_results():
    """A launch is not taken by a call that stores other ones of the results."""
    backend = compute.cpu(threads=1)
    a, first, second = backend.asarray([4.0, 8.0]), backend.zeros(2), backend.zeros(2)
    backend.pointwise(both_halves, {"a": a}, (first, None))
    backend.pointwise(both_halves, {"a": a}, (None, second))
    assert first.tolist() == [2.0, 4.0] and second.tolist() == [1.0, 2.0]


class Scaling:
    """A loop as a graph, on arrays that are replaced; `function` and kind may change too."""

    def __init__(self, backend):
        self.backend, self.function, self.sums = backend, scaled, {"reduce": (None, "sum")}

    def renew(self, values, kind="real"):
        self.a = self.backend.asarray(values, kind)
        self.out = self.backend.zeros(len(values), kind)

    @graph
    def scale(self, factor: float):
        """A multiple, and its sum."""
        out = (self.out, None) if self.function is scaled else self.out
        constants = {"factor": factor} if self.function is scaled else {}
        self.backend.pointwise(self.function, {"a": self.a}, out, **self.sums, **constants)


def test_a_graph_takes_other_arrays():
    """With other arrays, row counts and numbers its launches are the same, bound again."""
    backend, seen = compute.cpu(threads=1), []
    scaling = Scaling(backend)
    for size, factor in ((3, 2.0), (5, 3.0), (4, 5.0)):
        scaling.renew(np.arange(float(size)))
        for _ in range(3):
            assert scaling.scale(factor) == (factor * size * (size - 1) / 2.0,)
            assert scaling.out.tolist() == [factor * k for k in range(size)]
        (kept,) = [one for one in vars(scaling).values() if isinstance(one, KeptGraph)]
        seen.append(kept.recording.launches[0].launch)
    assert seen[0] is seen[1] is seen[2]


def test_a_graph_bound_anew_lets_go_of_the_arrays_before():
    """Where rows outgrow the sums of a launch another takes its place, and nothing holds that of
    before: as long as a melt pool grew, each left a ring with the pairs of its last step."""
    scaling, seen = Scaling(compute.cpu(threads=1)), []
    gc.disable()
    try:
        for size in (3, 4, 20_000):
            scaling.renew(np.ones(size))
            seen.append(ref(scaling.a))
            for _ in range(3):
                assert scaling.scale(2.0) == (2.0 * size,)
        assert [one() is None for one in seen] == [True, True, False]
    finally:
        gc.enable()


class ChosenSum(Scaling):
    """The sum over some rows of an array that is replaced, as a graph."""

    @graph
    def add(self, rows):
        """Sum of twice the elements of these rows."""
        self.backend.pointwise(doubled, {"a": self.a}, (None,), rows=rows, reduce=("sum",))


def test_a_launch_bound_again_has_room_for_all_rows():
    """Few rows of a longer array come first, then all: what their blocks reduce has room, too.
    A melt pool that grew in a larger block wrote beyond it."""
    backend = compute.cpu(threads=1)
    chosen = ChosenSum(backend)
    for size in (1_000, 100_000):
        chosen.renew(np.ones(size))
        for count in (10, 10, size):
            rows = backend.asarray(np.arange(count), "index")
            assert chosen.add(rows) == (2.0 * count,)


def test_a_graph_of_other_kinds_is_bound_anew():
    """Another function, and arrays of another type."""
    scaling = Scaling(compute.cpu(threads=1))
    scaling.renew([1.0, 2.0])
    for _ in range(3):
        assert scaling.scale(3.0) == (9.0,)
    scaling.renew([1.0, 2.0])
    scaling.function, scaling.sums = doubled, {}
    for _ in range(3):
        assert scaling.scale(3.0) == () and scaling.out.tolist() == [2.0, 4.0]
    scaling.renew([1, 2], "index")
    for _ in range(3):
        assert scaling.scale(3.0) == () and scaling.out.tolist() == [2, 4]


def test_calls_that_alternate_keep_their_launches(monkeypatch):
    """Arrays of another type get a launch of their own, which does not drive out the first."""
    backend, made, bind = compute.cpu(threads=1), [], loops.rebindable

    def count(*arguments):
        made.append(arguments)
        return bind(*arguments)

    monkeypatch.setattr(loops, "rebindable", count)
    for _ in range(3):
        for kind in ("real", "index"):
            out = backend.zeros(2, kind)
            fields, table = (
                {"place": backend.asarray([1, 0], "index")},
                backend.asarray([5, 7], kind),
            )
            backend.pointwise(element, fields, out, table=table)
            assert backend.to_host(out).tolist() == [7, 5]
    assert len(made) == 2
