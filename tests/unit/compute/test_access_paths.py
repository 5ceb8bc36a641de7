"""Ways of a graph's method to its arrays, and the names that it may read."""

import numpy as np
import pytest

from lasersph.compute.access_paths import LOST, access_paths, parameters_of
from lasersph.compute.names_read import NamesRead


def helper(holder):
    """Reads by a function of the module."""
    return holder.by_helper


class Inner:
    """What lies inside, with an entry by key."""

    def __init__(self, array):
        self.table = {"x": array}

    def __getitem__(self, name):
        return self.table[name]


class Outer:
    """Arrays by a property, a method, a function and an entry; `unread` is no business of it."""

    def __init__(self):
        self._a, self.b = np.zeros(3), np.ones(3)
        self.by_helper, self.unread = np.ones(2), [np.zeros(1)]
        self.inner, self.flag = Inner(np.zeros(4)), None

    @property
    def a(self):
        return self._a

    def other(self):
        return self.b

    def method(self, rows, *, flag, factor: float):
        """Only its code is looked at."""
        parts = [one for one in (self.a, self.inner["x"])]
        return self.other(), helper(self), parts, rows, flag, factor


PARAMETERS = parameters_of(Outer.method)


def paths_of(outer, rows, flag=True):
    """Ways to all that the method reads."""
    arrays = [outer._a, outer.b, outer.by_helper, outer.inner.table["x"]]
    taken = [(f"array {k}", array) for k, array in enumerate(arrays)]
    paths = access_paths(
        PARAMETERS, (outer, rows, flag), taken, [("rows", rows)], lambda array: array
    )
    kept, lists = paths.ends(outer, rows, flag=flag, factor=1.0)
    assert {id(one) for one in kept} >= {id(array) for array in arrays}
    assert lists == (rows,)
    return paths, kept


def test_names():
    """Those of the method and of all that it calls, by class, module and special methods."""
    read = NamesRead(Outer.method)
    assert "by_helper" in read.names and "_a" not in read.names
    assert read.add_classes({Outer, Inner})
    assert read.names >= {"_a", "b", "table"}
    assert "unread" not in read.names
    assert not read.add_classes({Outer, Inner})


def test_parameters():
    """Numbers are those that are annotated so; defaults and lists of arguments are refused."""
    assert PARAMETERS.objects == ("self", "rows", "flag")
    assert PARAMETERS.numbers == ("factor",)
    assert PARAMETERS.text == "self, rows, *, flag, factor"
    with pytest.raises(TypeError, match="a graph has no defaults"):
        parameters_of(lambda self, a=1: None)
    with pytest.raises(TypeError, match=r"a graph has no \*arguments"):
        parameters_of(lambda self, *a: None)


def change_property(outer):
    """Another array behind the property."""
    outer._a = np.zeros(3)


def change_entry(outer):
    """Another array in a table of what lies inside."""
    outer.inner.table["x"] = np.zeros(4)


def change_helped(outer):
    """Another array that a function reads."""
    outer.by_helper = np.ones(2)


def change_inner(outer):
    """Another object with another array."""
    outer.inner = Inner(np.zeros(4))


@pytest.mark.parametrize("change", [change_property, change_entry, change_helped, change_inner])
def test_changes_are_seen(change):
    """Whatever of these is replaced is noticed; what the method does not read is not."""
    outer, rows = Outer(), np.arange(2)
    paths, kept = paths_of(outer, rows)
    more = {"flag": True, "factor": 2.0}
    outer.unread = None
    assert paths.compare(kept, outer, rows, **more) == ((rows,), (2.0,))
    other = np.arange(1)
    assert paths.compare(kept, outer, other, **more)[0][0] is other
    assert paths.compare(kept, outer, rows, flag=False, factor=2.0) is None
    change(outer)
    assert paths.compare(kept, outer, rows, **more) is None


def test_a_way_that_ends():
    """What is gone is told by one of the known errors."""
    outer, rows = Outer(), np.arange(2)
    paths, kept = paths_of(outer, rows)
    del outer.inner.table["x"]
    with pytest.raises(LOST):
        paths.compare(kept, outer, rows, flag=True, factor=2.0)


def test_views():
    """A view that is made on the way is told by all arrays of its memory."""
    outer, rows = Outer(), np.arange(2)
    paths = access_paths(
        PARAMETERS, (outer, rows, None), [("head", outer.b[:2])], [], lambda array: array
    )
    kept, _ = paths.ends(outer, rows, flag=None, factor=1.0)
    assert any(one is outer.b for one in kept)
    with pytest.raises(ValueError, match="lost is reached by no attribute or argument"):
        access_paths(PARAMETERS, (outer, rows, None), [("lost", np.zeros(2))], [], lambda a: a)
