"""The tables of a report, from summary.json and resolved.json: rows of name and text."""

from __future__ import annotations

from typing import Any

from lasersph.input import format_duration
from lasersph.report.numbers import entry, quantity, shown

Rows = list[tuple[str, ...]]

MELT_LEVELS = (("completely fluid (f_m = 1)", ""), ("half molten", "_half"), ("any melt", "_any"))
ENERGY_NAMES = {
    "incident": "incident light",
    "reflected": "reflected",
    "transmitted": "through holes in the metal",
    "absorbed": "absorbed",
    "stored": "in the metal at the end",
    "lost": "lost through boundaries",
    "removed": "removed with vapor",
    "discarded": "discarded by the plateau rule",
}


def computation(summary: dict[str, Any]) -> Rows:
    """How the run was computed."""
    rows: Rows = [
        ("solver", str(summary["solver"])),
        ("dimensions", str(summary.get("dimensions", "–"))),
        ("particles", f"{summary['particles']:,}".replace(",", " ")),
        ("finest spacing", quantity(summary.get("spacing_m"), "m")),
        ("simulated time", quantity(summary["time_s"], "s")),
        ("steps", f"{summary['steps']:,}".replace(",", " ")),
        ("wall time", format_duration(summary["wall_time_s"])),
    ]
    if summary.get("device"):
        rows.append(("device, precision", f"{summary['device']}, {summary['precision']}"))
    elif "threads" in summary:
        rows.append(("threads, precision", f"{summary['threads']}, {summary['precision']}"))
    return rows


def temperatures(summary: dict[str, Any]) -> Rows:
    """Temperatures, rates, and the melting and boiling points that they compare with."""
    surface, material = summary.get("surface", {}), summary.get("material", {})
    rows: Rows = [
        ("largest temperature", entry("_K", summary["temperature_max_K"])),
        ("reached at", entry("_s", summary.get("temperature_max_at_s"))),
    ]
    names = {
        "temperature_at_maximum_max_K": "largest of the surface at x = 0",
        "temperature_at_maximum_end_K": "there at the end",
        "depth_of_particle_m": "depth of that particle",
        "heating_rate_max_K_s": "fastest heating",
        "cooling_rate_max_K_s": "fastest cooling",
    }
    rows += [(text, entry(key, surface[key])) for key, text in names.items() if key in surface]
    points = {"solidus_K": "solidus", "liquidus_K": "liquidus", "vaporization_K": "vaporization"}
    rows += [
        (f"{text} of the metal", entry(key, material[key]))
        for key, text in points.items()
        if material.get(key) is not None
    ]
    return rows


def melt_pool(summary: dict[str, Any]) -> Rows:
    """Times and sizes at the three levels of melt."""
    melt = summary.get("melt")
    if melt is None:
        return []
    rows: Rows = []
    for text, level in MELT_LEVELS:
        cells = [entry("_s", melt[f"start{level}_s"]), entry("_s", melt[f"end{level}_s"])]
        for size in ("width", "depth"):
            cells.append(entry("_m", melt[f"{size}{level}_max_m"]))
            cells.append(entry("_s", melt[f"{size}{level}_max_at_s"]))
        rows.append((text, *cells))
    return rows


MELT_HEAD = ("melt pool", "from", "to", "largest width", "at", "largest depth", "at")


def vaporization(summary: dict[str, Any]) -> Rows:
    """Times at the vaporization temperature, depths, evaporated thickness."""
    vapor = summary.get("vaporization")
    if vapor is None:
        return []
    names = {
        "start_s": "first at the vaporization temperature",
        "end_s": "last at the vaporization temperature",
        "fraction_max": "largest share of the heat of vaporization taken up",
        "depth_any_max_m": "depth of cells that took up some of it",
        "depth_max_m": "depth of cells that took up all of it",
        "evaporated_thickness_max_m": "evaporated thickness",
    }
    return [(text, entry(key, vapor[key])) for key, text in names.items()]


def probes(summary: dict[str, Any]) -> Rows:
    """What the probes saw, and where they really are."""
    return [
        (
            name,
            entry("_m", probe["depth_m"]),
            entry("_m", probe["depth_used_m"]),
            probe["method"],
            entry("_K", probe["temperature_max_K"]),
            entry("_s", probe["temperature_max_at_s"]),
            entry("_K", probe["temperature_end_K"]),
        )
        for name, probe in summary.get("probes", {}).items()
    ]


PROBE_HEAD = ("probe", "depth asked", "depth used", "method", "largest", "at", "at the end")


def energy(summary: dict[str, Any]) -> Rows:
    """The energy budget, absolute and relative to the incident energy."""
    terms = summary["energy"]
    incident = terms["incident_J"]
    rows: Rows = []
    for name, text in ENERGY_NAMES.items():
        value = terms[f"{name}_J"]
        if name == "transmitted" and not value:
            continue
        share = f"{shown(100.0 * value / incident)} %" if incident > 0.0 else "–"
        rows.append((text, quantity(value, terms["unit"]), share))
    imbalance = shown(terms["imbalance_relative"], 3)
    rows.append(("imbalance, relative to the absorbed energy", imbalance, ""))
    return rows


ENERGY_HEAD = ("energy", "amount", "of the incident")


def time_steps(summary: dict[str, Any]) -> Rows:
    """Range of the time step, how often each limit bound it, iterations per step."""
    steps = summary.get("time_step", {})
    count = max(summary["steps"], 1)
    rows: Rows = [
        ("smallest time step", entry("_s", steps.get("min_s"))),
        ("largest time step", entry("_s", steps.get("max_s"))),
    ]
    for name, times in sorted(steps.get("limits", {}).items(), key=lambda item: -item[1]):
        share = shown(100.0 * times / count, 3)
        rows.append((f"steps limited by: {name or 'unnamed'}", f"{times} ({share} %)"))
    for name, total in summary.get("iterations", {}).items():
        text = name.replace("_", " ")
        rows.append((f"iterations per step, {text}", shown(total / count, 3)))
    return rows


def flat(value: Any, name: str = "", unit: str = "J") -> Rows:
    """Every number of a nested summary as (dotted name, text)."""
    if isinstance(value, dict):
        unit = str(value.get("unit", unit))
        rows: Rows = []
        for key, item in value.items():
            rows += flat(item, f"{name}.{key}" if name else str(key), unit)
        return rows
    return [(name, entry(name, value, unit))]
