"""Access paths: how a method that launches loops reaches the arrays that these take.

A recorded graph stays valid as long as its method would come to the same arrays. `explore` walks
from the arguments of the method, its owner first, along entries and along attributes by names that
it may read (`names_read`), breadth first, and finds every way that leads to an array that was
taken. The ways are written as one Python function
of the arguments, which compares what lies at their ends now with what lay there then:

    array       the same one, by all ways that lead to it
    row list    any one, the same by all ways; it is taken in the place of the one before
    holder      where two ways led to the same object that holds arrays, they still do
    None        still None, beside arrays that are read

so that no array is missed that the method may have read by another way than the shortest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from functools import lru_cache
from inspect import Parameter, signature
from types import FunctionType, MethodType, ModuleType
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute.names_read import NamesRead
from lasersph.compute.opaque_array import OpaqueArray

_LEAVES = __name__.rpartition(".")[0]
"""Backends, launches and lists of this room are not entered."""
LOST = (AttributeError, KeyError, IndexError, TypeError)
"""Errors of a way that ends early now."""
NamedArray = tuple[str, np.ndarray]
"""An array with what it is in the words of a message."""


class Parameters(NamedTuple):
    """Parameters of a graph's method.

    Attributes:
        function: the method. text: as they stand in its definition. objects, numbers: names of
            those that are annotated `float`, and of the others, the owner first.
    """

    function: Callable
    text: str
    objects: tuple[str, ...]
    numbers: tuple[str, ...]


class AccessPaths(NamedTuple):
    """Compiled ways; both functions take the arguments of the method.

    Attributes:
        compare: (kept, ...) -> row lists there now and numbers; None where anything else differs.
        ends: (...) -> what `kept` would be now, and row lists.
    """

    compare: Callable[..., tuple[tuple, tuple] | None]
    ends: Callable[..., tuple[tuple, tuple]]


class Place(NamedTuple):
    """Value of an expression, which continues the expression of another place.

    Attributes:
        value: there. text: the last part of its expression. before: number of the place before.
    """

    value: Any
    text: str
    before: int


class Places(NamedTuple):
    """All arrays, and all that may hold any, breadth first.

    Attributes:
        found: place 0 stands before the arguments. crossings: further ways to these, as (from,
            text, to). nothing: where None lies, as (from, text).
    """

    found: list[Place]
    crossings: list[tuple[int, str, int]]
    nothing: list[tuple[int, str]]


def parameters_of(function: Callable) -> Parameters:
    """Parameters of a method.

    Raises:
        TypeError: it has defaults, *arguments or **options.
    """
    plain: list[str] = []
    named: list[str] = []
    given = signature(function).parameters
    for one in given.values():
        if one.kind not in (Parameter.POSITIONAL_OR_KEYWORD, Parameter.KEYWORD_ONLY):
            raise TypeError(f"{function.__qualname__}(): a graph has no *arguments or **options")
        if one.default is not Parameter.empty:
            raise TypeError(f"{function.__qualname__}(): a graph has no defaults")
        (named if one.kind is Parameter.KEYWORD_ONLY else plain).append(one.name)
    numbers = tuple([name for name in given if given[name].annotation in ("float", float)])
    objects = tuple([name for name in given if name not in numbers])
    text = ", ".join([*plain, *(["*", *named] if named else [])])
    return Parameters(function, text, objects, numbers)


@lru_cache(maxsize=1024)
def arrangement(parameters: Parameters) -> Callable[..., tuple[tuple, tuple]]:
    """Function of the arguments of a method, which gives its objects and its numbers."""
    objects, numbers = map(_tuple_text, (parameters.objects, parameters.numbers))
    return eval(f"lambda {parameters.text}: ({objects}, {numbers})", {})


def owner_of(host: np.ndarray) -> np.ndarray:
    """The array whose memory an array shows, itself where that is its own."""
    return host.base if isinstance(host.base, np.ndarray | OpaqueArray) else host


def access_paths(
    parameters: Parameters,
    objects: Sequence[Any],
    taken: Sequence[NamedArray],
    rows: Sequence[NamedArray],
    unwrap: Callable[[Any], np.ndarray],
) -> AccessPaths:
    """Find the ways from the arguments of a method to arrays.

    Args:
        objects: arguments that are no numbers. taken: arrays that loops take, but for their row
            lists, which are `rows`.

    Raises:
        ValueError: no way leads to an array.
    """
    # number the places by the arrays there, and by the arrays whose memory these show
    places = _all_places(parameters, objects)
    exact: dict[int, int] = {}
    by_owner: dict[int, list[int]] = {}
    for k, place in enumerate(places.found):
        host = _host(place.value, unwrap)
        if host is not None:
            exact[id(host)] = k
            by_owner.setdefault(id(owner_of(host)), []).append(k)

    # a view that is made on the way is found by all arrays that show its memory
    fixed: dict[int, None] = {}
    for name, host in taken:
        found = [exact[id(host)]] if id(host) in exact else by_owner.get(id(owner_of(host)), [])
        if not found:
            raise ValueError(f"{name} is reached by no attribute or argument of its graph")
        fixed |= dict.fromkeys(found)
    listed: dict[int, None] = {}
    for name, host in rows:
        if id(host) not in exact:
            raise ValueError(f"{name} are rows that no attribute or argument of its graph holds")
        if exact[id(host)] not in fixed:
            listed[exact[id(host)]] = None
    return _written(parameters, places, list(fixed), list(listed))


def _all_places(parameters: Parameters, objects: Sequence[Any]) -> Places:
    """Places that a method may come to from its arguments."""
    # methods of the classes that are found may read further names: repeat until no class is new
    read = NamesRead(parameters.function)
    while True:
        places = explore(parameters.objects, objects, read.names)
        if not read.add_classes({type(place.value) for place in places.found}):
            return places


def explore(names: Sequence[str], objects: Sequence[Any], read: set[str]) -> Places:
    """Find all arrays, and all that may hold any, from objects by their names.

    Args:
        read: names of attributes that are followed.
    """
    places, numbers = Places([Place(None, "", -1)], [], []), dict[int, int]()
    found, crossings, nothing = places
    # breadth first: `found` grows while it is walked, so the first way is the shortest
    for k, place in enumerate(found):
        parts = _parts(place.value, read) if k else zip(names, objects, strict=True)
        for text, value in parts:
            if value is None:
                nothing.append((k, text))
            # a second way to an object is a crossing, which has to lead to the same object later
            elif (there := numbers.get(id(value))) is not None:
                crossings.append((k, text, there))
            elif _is_array(value) or _is_entered(value):
                numbers[id(value)] = len(found)
                found.append(Place(value, text, k))
    return places


def _is_array(value: Any) -> bool:
    return isinstance(value, np.ndarray | OpaqueArray)


def _is_entered(value: Any) -> bool:
    """Whether the parts of an object are looked at: of containers, and of objects of any class but
    those that loops are made of."""
    if isinstance(value, dict | list | tuple):
        return True
    if isinstance(value, type | FunctionType | MethodType | ModuleType):
        return False
    # by the module first: to ask for attributes slows those of an object down
    return not type(value).__module__.startswith(_LEAVES) and hasattr(value, "__dict__")


def _parts(value: Any, read: set[str]) -> Iterator[tuple[str, Any]]:
    """Parts of an object with the ends of their expressions."""
    if _is_array(value):
        return
    # entries by keys that can be written as text
    if isinstance(value, dict):
        for key, one in value.items():
            if isinstance(key, str | int):
                yield f"[{key!r}]", one
    elif isinstance(value, list | tuple):
        for k, one in enumerate(value):
            yield f"[{k}]", one
    else:
        # attributes, but only those that the method may read by name
        for name, one in _attributes(value).items():
            if name in read:
                yield f".{name}", one


def _attributes(value: Any) -> dict[str, Any]:
    """Attributes of an object by their names, which stay as fast to read as before.

    Asking for them makes Python 3.11 and 3.12 keep them apart from their names, which the objects
    of a class share; each then takes three times as long to read, wherever that is done. A
    dictionary of its own holds both.
    """
    own = dict(vars(value))
    # by `object`, since frozen classes refuse; some compiled ones have a dictionary that must stay
    with suppress(AttributeError, TypeError):
        object.__setattr__(value, "__dict__", own)
    return own


def _host(value: Any, unwrap: Callable[[Any], np.ndarray]) -> np.ndarray | None:
    """NumPy array behind an array of the backend; None of anything else."""
    try:
        return unwrap(value) if _is_array(value) else None
    except TypeError:
        return None


def _leading_to(places: Places, ends: Sequence[int]) -> set[int]:
    """Numbers of the places from which some ends are reached, with the ends."""
    into: dict[int, list[int]] = {}
    for k, _, to in places.crossings:
        into.setdefault(to, []).append(k)
    # walk backward from the ends, along first ways and crossings
    leading, waiting = set[int](), list(ends)
    while waiting:
        k = waiting.pop()
        if k not in leading:
            leading.add(k)
            waiting += into.get(k, ())
            if k:
                waiting.append(places.found[k].before)
    return leading


def _written(
    parameters: Parameters, places: Places, fixed: list[int], listed: list[int]
) -> AccessPaths:
    """Functions that go the ways to arrays that stay, `fixed`, and to row lists."""
    found, leading = places.found, _leading_to(places, [*fixed, *listed])
    crossings = [one for one in places.crossings if one[2] in leading]

    # names of arrays and lists, and of all that holds them
    kept = {k: f"_k{n}" for n, k in enumerate(fixed)}
    rows = {k: f"_r{n}" for n, k in enumerate(listed)}
    holders = {found[k].before for k in leading if k} | {k for k, _, _ in crossings} - {0}
    names = {0: ""} | {k: f"_n{k}" for k in sorted(holders) if k} | rows

    def expression(k: int) -> str:
        return names[found[k].before] + found[k].text

    # an assignment for each holder and row list, a comparison for each array that stays
    lines = [f"{names[k]} = {expression(k)}" for k in sorted(names) if k]
    ends = [expression(k) for k in fixed]
    same = [f"{end} is {kept[k]}" for end, k in zip(ends, fixed, strict=True)]
    same += [f"{names[k]}{text} is {kept.get(to) or names[to]}" for k, text, to in crossings]
    reading = {found[k].before for k in (*fixed, *listed)} | {0}
    same += [f"{names[k]}{text} is None" for k, text in places.nothing if k in reading]

    # arguments that lead to no array: flags, names and functions
    seen = {found[k].text for k in leading if found[k].before == 0}
    seen |= {text for k, text, _ in crossings if k == 0}
    seen |= {text for k, text in places.nothing if k == 0}
    others = [name for name in parameters.objects if name not in seen]
    same += [f"{name} is _k{len(ends) + n}" for n, name in enumerate(others)]
    return _compiled(
        parameters.text,
        parameters.numbers,
        tuple(lines),
        tuple(same),
        (*ends, *others),
        tuple(rows.values()),
    )


def _tuple_text(parts: Sequence[str]) -> str:
    return "(" + "".join(f"{part}, " for part in parts) + ")"


@lru_cache(maxsize=1024)
def _compiled(
    arguments: str,
    numbers: tuple[str, ...],
    lines: tuple[str, ...],
    same: tuple[str, ...],
    ends: tuple[str, ...],
    rows: tuple[str, ...],
) -> AccessPaths:
    """The two functions, compiled; graphs of equal owners share them."""
    # write one function that compares, and one that only fetches
    body = "".join(f"    {line}\n" for line in lines)
    kept = _tuple_text([f"_k{n}" for n in range(len(ends))])
    found = f"({_tuple_text(rows)}, {_tuple_text(numbers)})"
    text = f"def compare(_kept, {arguments}):\n"
    text += (f"    {kept} = _kept\n" if ends else "") + body
    text += f"    if {' and '.join(same) or 'True'}:\n        return {found}\n    return None\n\n\n"
    text += f"def ends({arguments}):\n{body}"
    text += f"    return {_tuple_text(ends)}, {_tuple_text(rows)}\n"
    space: dict[str, Any] = {}
    exec(compile(text, "<access paths>", "exec"), space)
    return AccessPaths(space["compare"], space["ends"])
