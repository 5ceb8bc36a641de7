"""Results of earlier versions, read as this one would have written them.

Up to version 1 of the formats of summary.json, uncertainty.json and resolved.json, volumes, masses
and energies of a run that computed half a period, or half or a quarter of a spot, were those of
the computed part. From version 2 on they are those of the whole, as widths always were. What an
older version wrote is multiplied where it is read, so that runs of both can be compared.

Left out: a resting spot on an edge of the block in a run without ablation that computed x < 0 as
well; its older amounts stay those of the part.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from lasersph.output.errors import read_json

RESULTS_SCHEMA = 2
"""Of summary.json, uncertainty.json and resolved.json, raised whenever the meaning of a key or of a
column of history.csv changes."""
AMOUNT = re.compile(r"(?!box_heat_(left|right)_J).*(_J|_kg|volume(_max)?_m[23]?)")
"""Names of amounts: energies, masses, and volumes, in 2-D per length. Heat through an upright side
of a box stays that of the side, which a half computes as a whole."""
NO_AMOUNTS = ("dimensionless", "estimates", "laser", "numerical_sd", "box", "uncertainty")
"""Tables of summary.json that hold none, whatever their keys end in."""
OF_A_NUMBER = ("value", "error", "numerical", "from_inputs", "extrapolated", "values", "inputs")
"""Entries of a number of uncertainty.json that are amounts where it is one."""
PER_INPUT = ("standard", "up", "down")
"""Entries of an input of such a number that are."""


def is_older(content: Mapping[str, Any]) -> bool:
    """Whether a summary, an uncertainty or a resolved case is of an earlier format."""
    return int(content.get("schema_version", 1)) < RESULTS_SCHEMA


def read_summary(folder: Path) -> dict[str, Any]:
    """Content of summary.json with the amounts of the whole. Raises OutputError."""
    summary = read_json(folder / "summary.json")
    if not is_older(summary):
        return summary
    images = images_of_older(folder, summary)
    found = {
        name: times(part, images) if isinstance(part, dict) and name not in NO_AMOUNTS else part
        for name, part in summary.items()
    }
    return {**found, "schema_version": RESULTS_SCHEMA, "mirror_images": images}


def read_uncertainty(folder: Path) -> dict[str, Any]:
    """Content of uncertainty.json with the amounts of the whole. Raises OutputError."""
    content = read_json(folder / "uncertainty.json")
    if not is_older(content):
        return content
    images = images_of_older(folder)
    numbers = {
        name: number_times(entry, images) if is_amount(name) else entry
        for name, entry in content["numbers"].items()
    }
    return {**content, "schema_version": RESULTS_SCHEMA, "numbers": numbers}


def images_of_older(folder: Path, summary: Mapping[str, Any] | None = None) -> int:
    """By how much the amounts of a run of an earlier format are multiplied; 1 of other runs.

    Args:
        summary: as it was written, which tells of a quarter of a crater.
    """
    resolved = read_if_there(folder / "resolved.json")
    if not resolved or not is_older(resolved):
        return 1
    # a crater says itself how often it was computed; else the case says half
    summary = read_if_there(folder / "summary.json") if summary is None else summary
    images = (summary.get("crater") or {}).get("mirror_images")
    is_half = resolved["case"].get("domain", {}).get("extent") == "half"
    return int(images or (2 if is_half else 1))


def note_on_older(folder: Path) -> str | None:
    """One line on amounts that are multiplied as they are read; None where none is."""
    images = images_of_older(folder)
    if images == 1:
        return None
    part = {2: "half", 4: "quarter"}[images]
    return (
        f"{folder} was computed by an earlier version, which gave volumes, masses and energies of"
        f" the {part} that it computed; they are shown times {images}, those of the whole"
    )


def read_if_there(path: Path) -> dict[str, Any]:
    """Content of a JSON file; nothing where there is none. Raises OutputError."""
    return read_json(path) if path.exists() else {}


def is_amount(name: str) -> bool:
    """Whether a dotted key of a summary is that of an amount."""
    section, *_, last = name.split(".")
    return section not in NO_AMOUNTS and AMOUNT.fullmatch(last) is not None


def times(table: Mapping[str, Any], images: int) -> dict[str, Any]:
    """A table of a summary, or the columns of a history, with its amounts multiplied."""
    return {
        name: images * value if AMOUNT.fullmatch(name) and value is not None else value
        for name, value in table.items()
    }


def number_times(entry: Mapping[str, Any], images: int) -> dict[str, Any]:
    """A number of uncertainty.json with value and errors multiplied."""
    found = dict(entry)
    for name in OF_A_NUMBER:
        value = entry.get(name)
        if name == "inputs" and value:
            found[name] = {key: scaled(part, images) for key, part in value.items()}
        elif isinstance(value, list):
            found[name] = [images * one for one in value]
        elif value is not None:
            found[name] = images * value
    return found


def scaled(part: Mapping[str, Any], images: int) -> dict[str, Any]:
    """The contribution of an input to a number, multiplied."""
    return {
        name: images * value if name in PER_INPUT and value is not None else value
        for name, value in part.items()
    }
