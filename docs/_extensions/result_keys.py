"""Markdown tables of what runs measure, made from the declarations of the observers.

Names, units and words are declared once, beside the formula that fills them.
"""

import re
from collections.abc import Iterable

from lasersph.observers.observer_list import OBSERVERS
from lasersph.observers.quantity import Quantity


def summary_keys() -> str:
    """A section for each observer: the keys of summary.json that it fills."""
    parts = []
    for kind in OBSERVERS:
        parts.append(f"### {kind.title[0].upper()}{kind.title[1:]}\n")
        if kind.note:
            parts.append(kind.note.replace("<", r"\<") + "\n")
        parts.append(_table(kind.all_results()))
    return "\n".join(parts)


def history_columns() -> str:
    """The columns of history.csv, observer by observer."""
    return _table(column for kind in OBSERVERS for column in kind.columns)


def _table(quantities: Iterable[Quantity]) -> str:
    lines = ["| key | unit | meaning |", "| --- | --- | --- |"]
    for one in quantities:
        keys = ", ".join(f"`{key}`" for key in (one.key, *one.at))
        where = "; when" * any(key.endswith("_at_s") for key in one.at)
        where += "; where" * any(not key.endswith("_s") for key in one.at)
        words = re.sub(r"([|*<>$_\[\]\\])", r"\\\1", one.words + where)
        lines.append(f"| {keys} | {one.unit} | {words} |")
    return "\n".join(lines) + "\n"
