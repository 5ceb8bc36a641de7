"""The top of a report: what was computed in one sentence, and five numbers with their errors."""

from __future__ import annotations

import re
from html import escape
from typing import Any

from lasersph.input.key_units import amount_dimension, is_section, unit_in
from lasersph.observers.quantity import Quantity
from lasersph.output import Run
from lasersph.report.page import paragraph
from lasersph.report.tables import main_results, place_text, quantity, shown, text_of, with_error

EFFECTS = {
    "conduction": "heating and melting",
    "melt-pool": "heating, melting and flow",
    "ablation": "heating, melting and ablation",
}
LARGE = {
    "crater.depth_m": "crater depth",
    "crater.diameter_m": "crater diameter",
    "topography.peak_to_valley_m": "relief, peak to valley",
    "temperature_max_K": "highest temperature",
    "melt.depth_max_m": "melt depth",
    "melt.width_max_m": "melt width",
    "flow.surface_speed_max_m_s": "speed along the surface",
    "ejecta.speed_mean_m_s": "speed of the ejecta",
    "flow.speed_max_m_s": "highest speed of a particle",
    "melt.end_s": "melt until",
    "ejecta.mass_kg": "mass of the ejecta",
}
"""Main results that a reader asks for first, the most telling before the others, in short words."""
COMMON_NAME = re.compile(r"([A-Z][a-z]+(-[a-z]+)?|An?)(?!\S)(?! [0-9])")
"""Begins a metal that is small inside a sentence, as "Pure copper" and "An alloy"; not "Ti-6Al-4V",
not the trade name "Inconel 718"."""
MOST_NUMBERS = 5
WIDTHS = {
    "radius": "radius",
    "radius_1e2": "1/e² radius",
    "diameter_1e2": "1/e² diameter",
    "diameter_fwhm": "FWHM",
}
"""Keys of a beam that give its width, in words."""
UNIT_BEHIND = re.compile(r"(?<=[0-9]) (?=\S)")
"""Blank behind a number, where no line may end."""
TELLING_FIGURES = (
    "crater-3d",
    "relief-section",
    "surface-height",
    "flow",
    "crater",
    "particles",
    "box-flow",
    "temperature",
)
"""Figures that show the relief, the crater or the pool, the most telling first."""


def what_was_computed(run: Run) -> str:
    """One sentence: metal, light, dimensions, particles, time."""
    summary, case = run.summary, run.case
    # "Pure copper, 99.9 %" becomes "pure copper": the sentence has no room for the rest of the
    # title.
    material = case.get("material") or {}
    metal = str(material.get("title") or material.get("name") or "a liquid")
    metal = re.split(r", | \(", metal)[0]
    if COMMON_NAME.match(metal):
        metal = metal[0].lower() + metal[1:]
    # How much was computed.
    size = f"{shown(summary['particles'], 9)} particles"
    if summary.get("spacing_m"):
        size += f", {quantity(summary['spacing_m'], 'm', 3)} apart at the finest"
    end = quantity(summary["time_s"], "s", 3)
    space = "a section (r, z)" if is_section(summary) else f"{summary.get('dimensions', '–')}-D"
    # Numbers and their units stay on one line.
    text = (
        f"This run computes the {effects_of(run)} of {metal}"
        f"{light_text(case.get('laser') or {}, summary.get('laser'))} over {end},"
        f" in {space} with {size}."
    )
    return UNIT_BEHIND.sub("\u00a0", text)


def effects_of(run: Run) -> str:
    """Physics that a run computes, in words."""
    summary, kind = run.summary, run.case.get("solver", {}).get("kind")
    # A box, or matter that only moves, is about flow.
    if "box" in summary or (kind == "ablation" and "crater" not in summary):
        return "flow"
    if summary.get("material", {}).get("solidus_K") is None:
        return "heating"
    return EFFECTS.get(kind, "heating")


def light_text(laser: dict[str, Any], computed: dict[str, Any] | None = None) -> str:
    """The light of a case after the name of its metal; empty where there is none.

    Args:
        computed: the table `laser` of a summary, with the fluence that follows from an energy.
    """
    # Without an amount of light there is none.
    if all(laser.get(key) is None for key in ("fluence", "pulse_energy", "intensity", "power")):
        return ""
    pulse = laser.get("pulse") or {}
    count = int(pulse.get("count") or 1)
    text = " under one pulse" if count == 1 else f" under {count} pulses"
    if lasts := pulse.get("fwhm") or pulse.get("duration"):
        text += f" of {quantity(lasts, 's', 3)}"
    return f"{text} with {_amount_text(laser, count, computed)}{_beam_text(laser)}"


def _amount_text(laser: dict[str, Any], count: int, computed: dict[str, Any] | None) -> str:
    """How much light there is in so many pulses, in the words of the case."""
    fluence, energy, intensity = (laser.get(k) for k in ("fluence", "pulse_energy", "intensity"))
    each = "" if count == 1 else " each"
    if fluence is not None:
        return f"{quantity(1e-4 * fluence, 'J/cm^2', 3)}{each}{fluence_kind(laser)}"
    if energy is None and intensity is not None:
        return f"{quantity(1e-4 * intensity, 'W/cm^2', 3)}{fluence_kind(laser)}"
    if energy is None:
        return quantity(laser["power"], "W", 3)

    # The fluence of a spot differs from place to place: that which was computed.
    text = f"{quantity(energy, 'J', 3)}{each}"
    if count > 1:
        has_spot = bool((laser.get("spot") or {}).get("diameter"))
        text += f", {quantity(count * energy, 'J', 3)} in all" + "," * (has_spot and not computed)
    if computed:
        mean = quantity(1e-4 * computed["mean_fluence_J_m2"], "J/cm^2", 3)
        is_pattern = (laser.get("beam") or {}).get("kind") == "interference"
        text += f", {mean}{' in the mean over a period' * is_pattern} where it is computed,"
    return text


def _beam_text(laser: dict[str, Any]) -> str:
    """Shape of the beam: spot, pattern, widths."""
    beam, spot = laser.get("beam") or {}, laser.get("spot") or {}
    text = ""
    if spot.get("diameter"):
        definition = spot["definition"].replace("e^2", "e²")
        text = f" in a spot of {quantity(spot['diameter'], 'm', 3)} ({definition})"
    if beam.get("kind") in (None, "uniform"):
        return text
    if beam["kind"] == "interference":
        period = beam.get("period")
        text += " of interfering beams"
        return f"{text} (period {quantity(period, 'm', 3)})" if period else text
    sizes = (
        f"{words} {quantity(beam[key], 'm', 3)}" for key, words in WIDTHS.items() if beam.get(key)
    )
    name = beam["kind"].replace("gaussian", "Gaussian")
    return f"{text} in a {name} beam" + "".join(f" ({size})" for size in sizes)


def fluence_kind(laser: dict[str, Any]) -> str:
    """Kind of the fluence of a case, behind its number; empty where it is one everywhere."""
    kind, is_peak = laser.get("beam", {}).get("kind"), laser.get("fluence_kind") == "peak"
    if kind == "interference":
        found = "peak of the pattern" if is_peak else "mean over a period"
    elif kind == "gaussian":
        found = "peak" if is_peak else "mean over the circle of 1/e²"
    else:
        return ""
    return f" ({found}, at the center)" if laser.get("spot") else f" ({found})"


def telling_results(summary: dict[str, Any]) -> dict[str, tuple[Quantity, Any]]:
    """Main results that are not 0, with their declarations, by their keys; the end of the melt only
    where that is not the end of the run."""
    found = {one.key: (one, value) for one, value in main_results(summary) if value}
    # The melt cannot be said to end where the run ends before it.
    if summary.get("melt", {}).get("molten_at_end"):
        found.pop("melt.end_s", None)
    return found


def large_numbers(run: Run) -> str:
    """Five main results, large, with unit, error and when, and what the errors hold."""
    summary, found = run.summary, run.uncertainty
    results = telling_results(summary)
    # The most telling results first, others after them.
    order = [key for key in LARGE if key in results]
    order += [key for key in results if key not in order]
    cards, are_known = [], False
    for key in order[:MOST_NUMBERS]:
        one, value = results[key]
        text = text_of(one, value, summary)
        error = error_of(summary, found, key)
        if error:
            unit = unit_in(one.unit, amount_dimension(summary))
            text = with_error(value, error, unit)
            are_known = True
        when = place_text(summary, one.at[0]) if one.at else ""
        words = LARGE.get(key, one.words.split(" (")[0]) + (f", at {when}" if when else "")
        cards.append(f"<div><dd>{escape(text)}</dd><dt>{escape(words)}</dt></div>")
    # Where errors come from, or how to get them.
    if found is not None:
        note = "Errors hold about 95 %: of the spacing and of the inputs, see How sure."
    elif are_known:
        note = "Errors are twice what counting in cells makes uncertain; --uncertainty gives all."
    else:
        note = "The errors of these numbers were not assessed: run with --uncertainty."
    return f'<dl class="numbers">{"".join(cards)}</dl>' + paragraph(note, "about")


def error_of(summary: dict[str, Any], found: dict[str, Any] | None, key: str) -> float | None:
    """Error of a main result that holds about 95 % [SI]; None where none is known."""
    # With companions every number has an error; without, twice what counting in cells leaves open.
    if found is not None:
        return found["numbers"].get(key, {}).get("error")
    deviation = (summary.get("numerical_sd") or {}).get(key)
    return None if deviation is None else 2.0 * deviation
