"""The section of a report that says how sure the numbers are, from uncertainty.json."""

from __future__ import annotations

from typing import Any

from lasersph.input.key_units import amount_dimension, unit_in, unit_of
from lasersph.observers.observer_list import OBSERVERS
from lasersph.report.page import details, paragraph, table
from lasersph.report.tables import (
    Rows,
    in_words,
    main_results,
    quantity,
    shown,
    with_error,
)

MEANING = (
    "An error holds about 95 %. Its numerical part is the grid convergence index of this run and"
    " two coarser ones (Celik et al. 2008); the part of an input is what two standard uncertainties"
    " of it change, from one run on each side (GUM, JCGM 100:2008). Parts add in squares, for"
    " inputs that do not depend on each other and results that are linear in them."
)
NO_INPUT = (
    "No input has an uncertainty: the sources of this material state none, and none was given"
    " (--uncertain KEY=U)."
)


def how_sure(summary: dict[str, Any], found: dict[str, Any] | None) -> list[str]:
    """Main results with their errors and parts, the inputs, what failed, and all numbers."""
    if found is None:
        return []
    # Main results with their parts, spacings, inputs, then all numbers folded.
    inputs = found["inputs"]
    head = ("result", "value ± error", "numerical", *map(short_name, inputs))
    body = [paragraph(MEANING), table(main_rows(summary, found), head)]
    if found["spacings_m"]:
        used = ", ".join(quantity(d, "m") for d in found["spacings_m"])
        share = shown(100.0 * found["oscillating_share"], 2)
        body.append(paragraph(f"Spacings: {used}. {share} % of the numbers oscillate with them."))
    if inputs:
        rows = [(k, f"{shown(100.0 * i['relative'], 3)} %", i["source"]) for k, i in inputs.items()]
        body.append(table(rows, ("input", "standard uncertainty", "stated by")))
    else:
        body.append(paragraph(NO_INPUT))
    body += [paragraph(text, "warning") for text in [*found["notes"], *bent(summary, found)]]
    every = table(
        all_rows(summary, found), ("number", "value ± error", "numerical", "inputs", "behavior")
    )
    return [*body, details("Errors of all numbers", every)]


def short_name(key: str) -> str:
    """An input as a table heads it: "conductivity, solid"."""
    return key.removeprefix("material.").replace(".", ", ").replace("_", " ")


def main_rows(summary: dict[str, Any], found: dict[str, Any]) -> Rows:
    """Words, value with error, and each part of the main results."""
    rows: Rows = []
    for one, _ in main_results(summary):
        entry = found["numbers"].get(one.key)
        if entry is None:
            continue
        unit = unit_in(one.unit, amount_dimension(summary))
        twice = found["coverage"]
        # Twice the standard deviation of each input holds about 95 %.
        parts = [entry["inputs"].get(key) for key in found["inputs"]]
        sizes = [None if part is None else twice * part["standard"] for part in parts]
        texts = (two_digits(size, unit) for size in (entry["numerical"], *sizes))
        rows.append((one.words, value_text(entry, unit), *texts))
    return rows


def two_digits(size: float | None, unit: str) -> str:
    """A part of an error, rounded to the two digits that an error has."""
    return in_words(None if size is None else float(f"{size:.2g}"), unit)


def value_text(entry: dict[str, Any], unit: str) -> str:
    """A value with its error; a question mark where the numerical part is not known."""
    text = with_error(entry["value"], entry["error"], unit)
    return f"{text} ± ?" if entry["error"] is None else text


def bent(summary: dict[str, Any], found: dict[str, Any]) -> list[str]:
    """Which main results are not linear in which input, where that is so."""
    words = [
        f"{one.words} in {short_name(key)}"
        for one, _ in main_results(summary)
        for key, part in found["numbers"].get(one.key, {}).get("inputs", {}).items()
        if part["is_linear"] is False
    ]
    if not words:
        return []
    return [f"Not linear, so that the larger of both changes counts: {'; '.join(words)}."]


def all_rows(summary: dict[str, Any], found: dict[str, Any]) -> Rows:
    """Every number of the summary."""
    rows: Rows = []
    # A number that an observer declares has its unit there, any other in its key.
    declared = {one.key: one.unit for kind in OBSERVERS for one in kind.all_results()}
    for key, entry in found["numbers"].items():
        unit = unit_in(declared.get(key, unit_of(key)), amount_dimension(summary))
        parts = (two_digits(entry[name], unit) for name in ("numerical", "from_inputs"))
        behavior = entry.get("behavior", "–")
        if entry.get("order") is not None:
            behavior += f", order {shown(entry['order'], 3)}"
        rows.append((key, value_text(entry, unit), *parts, behavior))
    return rows
