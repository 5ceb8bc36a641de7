"""Names of the attributes that a method may read, itself or by what it calls.

They are those in its code, and in the code of all functions, methods and properties that these
names stand for: in its module, in modules that it names, and in the classes of the objects that it
is given and comes to. Names that a program computes are not found, nor those that `vars` gives.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from types import CodeType, FunctionType, ModuleType
from typing import Any

from lasersph.compute.array_types import PairList

_HOME = __name__.partition(".")[0]
_SPECIAL = {"__call__", "__contains__", "__getattr__", "__getitem__", "__iter__", "__len__"}
"""Methods that code calls without their names."""


class NamesRead:
    """Names that a function may read, as far as classes are known.

    Attributes:
        names: those found so far; what loops read of a list of pairs is always among them.
    """

    def __init__(self, function: Callable) -> None:
        self.names = {name for name in vars(PairList) if not name.startswith("_")} | _SPECIAL
        self._codes, self._classes = set[CodeType](), set[type]()
        self._owners: list[Any] = []
        self._add(function)

    def add_classes(self, classes: Iterable[type]) -> bool:
        """Look names up in the classes of objects; returns whether there are new names."""
        # a name that is found may stand for a member whose code has further names
        before = len(self.names)
        self._classes.update(one for kind in classes for one in kind.__mro__)
        while True:
            count = len(self._codes)
            for owner in (*self._classes, *self._owners):
                members = vars(owner)
                for name in self.names & members.keys():
                    self._add(members[name])
            if len(self._codes) == count:
                return len(self.names) > before

    def _add(self, member: Any) -> None:
        """Take the names in the code of a function, method, property or graph."""
        function = _function_of(member)
        if function is None or function.__code__ in self._codes:
            return
        for code in _nested(function.__code__):
            self._codes.add(code)
            self.names.update(code.co_names)
            for name in code.co_names:
                found = function.__globals__.get(name)
                if isinstance(found, ModuleType) and found.__name__.startswith(_HOME):
                    self._owners.append(found)
                elif isinstance(found, FunctionType):
                    self._add(found)


def _function_of(member: Any) -> FunctionType | None:
    """The plain function behind what a class or a module has under a name."""
    if isinstance(member, property):
        member = member.fget
    elif isinstance(member, cached_property):
        member = member.func
    elif isinstance(member, staticmethod | classmethod):
        member = member.__func__
    else:
        member = getattr(member, "__wrapped__", member)
    return member if isinstance(member, FunctionType) else None


def _nested(code: CodeType) -> Iterator[CodeType]:
    """A code and those of the functions in it."""
    yield code
    for one in code.co_consts:
        if isinstance(one, CodeType):
            yield from _nested(one)
