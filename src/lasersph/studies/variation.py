"""Variations of a case: the same model with one key changed, validated anew."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Protocol, TypeVar

from pydantic import BaseModel

M = TypeVar("M", bound=BaseModel)


class Finished(Protocol):
    """A finished run, as far as studies look at it."""

    @property
    def summary(self) -> dict[str, Any]:
        """The numbers of summary.json."""
        ...


Run = Callable[[Any, Path], Finished]
"""Makes the run folder of a case exist."""


Prepare = Callable[[Mapping[Path, Any]], None]
"""Makes run folders of cases that do not wait for each other exist, several at a time. What it
leaves, because it fails or was not asked to, `Run` makes when its turn comes."""


def simulate(case: Any, folder: Path) -> Finished:
    """Make the run folder of a case exist: find it complete, continue it, or compute it."""
    from lasersph.simulation import run

    return run(case, folder, resume=True, same_case=True)


def changed(model: M, key: str, value: Any) -> M:
    """A copy of a model with one key ("particles.spacing") set and everything checked again.

    Raises:
        KeyError: there is no such key. pydantic.ValidationError: the value does not fit.
    """
    head, _, inner = key.partition(".")
    if head not in type(model).model_fields:
        raise KeyError(f"{type(model).__name__} has no key {head!r}")
    # only keys that were set: defaults may depend on the others
    data = {name: getattr(model, name) for name in model.model_fields_set}
    old = getattr(model, head)
    data[head] = changed(old, inner, value) if inner else value
    return type(model).model_validate(data)
