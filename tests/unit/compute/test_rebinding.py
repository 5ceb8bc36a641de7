"""Binding of launches in compiled code, or in Python where arrays are laid out otherwise."""

import gc
from weakref import ref

import numpy as np

from lasersph import compute
from lasersph.compute import loops
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


def test_a_prepared_loop_takes_other_arrays():
    """Prepared again, a loop runs with the new arrays, row counts and numbers, and is the same."""
    backend, launch, seen = compute.cpu(threads=1), None, []
    for size, factor in ((3, 2.0), (5, 3.0), (4, 5.0)):
        a, out = backend.asarray(np.arange(float(size))), backend.zeros(size)
        reduce = (None, "sum")
        launch = backend.prepare(
            scaled, {"a": a}, (out, None), reduce=reduce, again=launch, factor=factor
        )
        seen.append(launch)
        del a
        assert launch() == (factor * size * (size - 1) / 2.0,)
        assert out.tolist() == [factor * k for k in range(size)]
    assert seen[2] is seen[1]


def test_a_loop_prepared_anew_lets_go_of_the_arrays_before():
    """Where rows outgrow the sums of a launch another takes its place, and nothing holds that of
    before: as long as a melt pool grew, each left a ring with the pairs of its last step."""
    backend, launch, seen = compute.cpu(threads=1), None, []
    gc.disable()
    try:
        for size in (3, 4, 20_000):
            a, out = backend.asarray(np.ones(size)), backend.zeros(size)
            how = {"reduce": (None, "sum"), "again": launch, "factor": 2.0}
            launch = backend.prepare(scaled, {"a": a}, (out, None), **how)
            seen.append(ref(a))
            del a, out, how
        assert launch() == (40_000.0,)
        assert [one() is None for one in seen] == [True, True, False]
    finally:
        gc.enable()


def test_a_prepared_loop_of_other_kinds_is_bound_anew():
    """What was another loop is left alone."""
    backend = compute.cpu(threads=1)
    a, first, second = backend.asarray([1.0, 2.0]), backend.zeros(2), backend.zeros(2)
    launch = backend.prepare(doubled, {"a": a}, first)
    other = backend.prepare(scaled, {"a": a}, (second, None), again=launch, factor=3.0)
    other()
    launch()
    assert first.tolist() == [2.0, 4.0] and second.tolist() == [3.0, 6.0]


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
