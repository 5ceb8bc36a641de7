"""The page of a comparison with a measurement: sentence, picture, numbers."""

from __future__ import annotations

from html import escape
from pathlib import Path
from typing import Any

from lasersph.input import format_quantity
from lasersph.output.atomic import replace_text
from lasersph.report.page import figure, heading, page, paragraph, table

WORDS = {
    "shift_x_m": ("shift along x, from the middle of the measurement", "m"),
    "shift_y_m": ("shift along y, from the middle of the measurement", "m"),
    "rotation_rad": ("angle of the measurement to the lines", "rad"),
    "lateral_scale": ("lateral scale of the measurement", ""),
    "fluence_factor": ("factor on the local fluence", ""),
}


def unknown_rows(content: dict[str, Any]) -> list[list[str]]:
    """Rows of what was aligned: value, standard error, 95 % interval, in words."""
    rows = []
    # Unknowns that were fitted, with their intervals.
    for name, one in content["unknowns"].items():
        words, unit = WORDS[name]
        low, high = (format_quantity(end, unit, 5) for end in one["interval_95"])
        value, error = (
            format_quantity(one[k], unit, n) for k, n in (("value", 5), ("standard_error", 2))
        )
        interval = f"{low} to {high}"
        if one["is_at_bound"]:  # the error of an unknown at a bound says nothing of the other side
            error = "at its bound"
            interval = f"{low} or more" if value == high else f"{high} or less"
        rows.append([words, value, error, interval])
    # Where our origin lies in the measurement, so that its places can be found again.
    for name, place in content["origin_in_measurement"].items():
        axis = name.removesuffix("_m")
        words = f"our {axis} = 0 lies at this {axis} of the measurement"
        rows.append([words, format_quantity(place, "m", 5), "", ""])
    return rows


def difference_rows(content: dict[str, Any]) -> list[list[str]]:
    """How measured and computed heights differ, in words."""
    found, factor = content["difference"], content["height_factor"]
    # The difference, beside what noise and interpolation explain of it.
    shown = {
        "difference, rms": found["rms_m"],
        "largest difference": found["largest_m"],
        "noise from point to point": found["noise_m"],
        "interpolation between cells": found["interpolation_m"],
    }
    heights = content["peak_to_valley"]
    shown |= {
        "peak to valley of the measured heights": heights["measured_m"],
        "peak to valley of the computed heights there": heights["computed_m"],
    }
    rows = [[words, format_quantity(value, "m", 3)] for words, value in shown.items()]
    text = f"{factor['value']:.4g} +- {factor['standard_error']:.2g}"
    return [*rows, ["measured over computed heights", text]]


def write_comparison(
    path: Path, content: dict[str, Any], picture: Path, title: str, maps: Path | None = None
) -> Path:
    """Write the page, with the maps of a height map. Raises OutputError."""
    words = "Heights of all points after leveling and alignment, and their difference."
    body = [
        f"<h1>{escape(title)}</h1>",
        paragraph(content["sentence"], "result"),
        figure(
            picture,
            "Above: measured and computed heights after leveling and alignment. Below: "
            "their difference; the band is twice what noise and interpolation explain.",
            1,
        ),
        *([figure(maps, words, 2)] if maps else []),
        heading("Alignment"),
        table(unknown_rows(content), ("", "value", "standard error", "95 %")),
        heading("Difference"),
        table(difference_rows(content), ("", "value")),
    ]
    replace_text(path, page(title, body))
    return path
