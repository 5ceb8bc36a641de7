"""Phases: run again, they do what their function would, with other numbers, rows and elements."""

import pytest

from lasersph import compute


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
    """Twice a multiple of chosen elements, by way of a work array; `runs`: of the function."""

    def __init__(self, backend):
        self.backend, self.runs, self.bias = backend, 0, 1.0
        self.a, self.out = backend.asarray([1.0, 2, 3, 4]), backend.zeros(4)
        self.phase = backend.phase(Doubling.run)

    def run(self, rows, own, factor):
        backend, a, self.runs = self.backend, self.a, self.runs + 1
        work, how = backend.zeros(4), {"rows": rows, "reduce": (None, "sum")}
        backend.pointwise(scaled, {"a": a}, (work, None), **how, factor=own or factor)
        backend.copy(work, self.out)
        backend.pointwise(added, {"a": self.out, "b": work}, self.out)
        fields, how = {"v": a}, {"reduce": ("max",)}
        backend.pointwise(biased, fields, (None,), **how, bias=self.bias)

    def __call__(self, rows, factor, *, own=None, lists=True):
        chosen = self.backend.asarray(rows, "index")
        listed = (chosen,) if lists else ()
        found = self.phase(self, chosen, own, reads=(self.a,), rows=listed, factor=factor)
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


def test_python_runs_twice_for_the_same_arrays():
    """The function is run once, once more while it is kept, and so again for other arrays."""
    doubling = Doubling(compute.cpu(threads=1))
    for rows, factor, expected in CALLS:
        assert doubling(rows, factor) == expected
    assert doubling.runs == 2
    doubling.a = doubling.backend.asarray([2.0, 2, 2, 2])
    for _ in range(3):
        assert doubling([1, 2], 1.0) == ((8.0, 2.0), [0, 4, 4, 0])
    assert doubling.runs == 4


def test_what_a_phase_refuses():
    """Rows that it is not given, and another value under the name of a number."""
    doubling = Doubling(compute.cpu(threads=1))
    doubling([0], 1.0)
    with pytest.raises(ValueError, match=r"scaled\(\) takes rows that its phase is not given"):
        doubling([0], 1.0, lists=False)
    doubling = Doubling(compute.cpu(threads=1))
    doubling([0], 1.0, own=7.0)
    with pytest.raises(ValueError, match=r"scaled\(\) takes other numbers than its phase"):
        doubling([0], 1.0, own=7.0)


def test_the_strict_backend_finds_what_has_changed():
    """A constant that is none of the numbers, and an array that is not said to be replaced."""
    for change in ("bias", "out"):
        doubling = Doubling(compute.strict(threads=1))
        for rows, factor, expected in CALLS:
            assert doubling(rows, factor) == expected
        setattr(doubling, change, 2.0 if change == "bias" else doubling.backend.zeros(4))
        with pytest.raises(ValueError, match="is not what its phase ran before"):
            doubling([0], 1.0)
