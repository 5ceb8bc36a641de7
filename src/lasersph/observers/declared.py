"""Declarations of observers that a run was given from Python, kept with its results.

Whoever reads a run folder has no class of them: titles, notes, keys, units and words under
`own_observers` in summary.json tell what they measured.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

from lasersph.observers.observer import Observer
from lasersph.observers.observer_list import OBSERVERS
from lasersph.observers.quantity import Quantity

KEY = "own_observers"


@dataclass(frozen=True)
class DeclaredObserver:
    """Observer as a summary tells it: title and note of its table, what it measured."""

    title: str
    note: str
    quantities: tuple[Quantity, ...]

    def all_results(self) -> tuple[Quantity, ...]:
        """Every key of summary.json that it filled, with unit and words."""
        return self.quantities


AnyObserver = type[Observer] | DeclaredObserver


def declarations(members: Iterable[Observer]) -> list[dict[str, Any]]:
    """Declarations of the observers that do not come with lasersph, as plain data."""
    return [
        {
            "title": one.title or type(one).__name__,
            # keys and units as the observer declares them
            "note": one.note,
            "quantities": [asdict(quantity) for quantity in one.all_results()],
        }
        for one in members
        if type(one) not in OBSERVERS and one.all_results()
    ]


def kinds_of(summary: Mapping[str, Any]) -> tuple[AnyObserver, ...]:
    """Observers that a report tells of: those of lasersph, then those that the run was given."""
    return (*OBSERVERS, *(_declared(one) for one in summary.get(KEY, ())))


def _declared(found: Mapping[str, Any]) -> DeclaredObserver:
    """An observer from its declaration; all that it measured is shown where space is short."""
    # a later version may know more about a quantity than this one
    known = {one.name for one in fields(Quantity)}
    quantities = []
    for given in found["quantities"]:
        values = {name: value for name, value in given.items() if name in known}
        quantities.append(replace(Quantity(**values), at=tuple(given["at"]), is_main=True))
    return DeclaredObserver(found["title"], found["note"], tuple(quantities))
