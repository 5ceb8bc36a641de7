"""The tables of a report, from summary.json alone: rows of words, value, and when or where.

What an observer measured has the words and the unit that it declares there; a quantity that is
added appears here by itself.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

from lasersph.input import format_duration, format_number, format_quantity, format_with_error
from lasersph.input.key_units import amount_dimension, is_section, unit_in, unit_of
from lasersph.observers import EnergyBudget, Quantity
from lasersph.observers.declared import KEY as OWN_OBSERVERS
from lasersph.observers.declared import AnyObserver, kinds_of
from lasersph.observers.quantity import MOMENT
from lasersph.output.pulse_starts import pulse_at

Rows = list[tuple[str, ...]]
ENERGY_HEAD = ("energy", "amount", "of the incident")
NUMBERS = {
    "Fo": "Fourier number Fo",
    "La": "laser number La",
    "Ph_solid_liquid": "phase change number of melting",
    "Ph_liquid_vapor": "phase change number of vaporization",
    "Pr": "Prandtl number Pr",
    "Ra": "Rayleigh number Ra",
    "Ma": "Marangoni number Ma",
    "Re": "Reynolds number Re",
}
quantity = partial(format_quantity, typographic=True)
shown = partial(format_number, typographic=True)
PARTS = {2: " in one half", 4: " in one quarter"}
"""Words behind the number of particles, by how many times what was computed makes up the whole."""
MOST_LISTED = 8
"""Longer lists are not written out."""
NOT_NUMBERS = ("warnings", OWN_OBSERVERS)
"""Parts of a summary that tell of numbers and are none."""
ESTIMATE_HEAD = ("estimate", "value", "cited")
LEFT_OUT_HEAD = ("left out", "matters from", "surface that evaporates only")
CITED_SPEEDS = (
    "380-450 m/s [AlShaer 2017]; 167, 640, 1110 m/s at the edge, on average and in the center"
    " [Hamadi, as cited there]; 750 m/s [Rajendran, as cited there]"
)
CITED_ACCELERATIONS = (
    "1.4·10¹¹ m/s² [AlShaer 2017]; 10⁸ m/s² eject without melting [Tam 1992, as cited there]"
)


def value_at(summary: dict[str, Any], key: str) -> Any:
    """Value of a dotted key of a summary; None where it is missing."""
    found: Any = summary
    for part in key.split("."):
        found = found.get(part) if isinstance(found, dict) else None
    return found


def measured(summary: dict[str, Any], kind: AnyObserver, name: str = "") -> Rows:
    """Results of an observer: words, value, and when or where.

    Args:
        summary: content of summary.json. kind: class of the observer, or its declaration.
        name: of one of several probes or traces.
    """
    rows: Rows = []
    # Each declared result that the summary has, with when and where.
    for one in kind.all_results():
        value = value_at(summary, one.key.replace("<name>", name))
        if is_shown(one, value):
            at = (place_text(summary, key.replace("<name>", name)) for key in one.at)
            rows.append((one.words, text_of(one, value, summary), ", ".join(filter(None, at))))
    return rows


def is_shown(one: Quantity, value: object) -> bool:
    """Whether a value is a number, a text or a short list, and not the name of a unit."""
    is_unit = one.key.endswith("unit")
    is_long = isinstance(value, list) and not 0 < len(value) <= MOST_LISTED
    return not (value is None or isinstance(value, dict) or is_unit or is_long)


def moment(summary: dict[str, Any], time: float | None, *, typographic: bool = True) -> str:
    """A time of a run, as "57 ns"; in a train of pulses as "pulse 5 + 57 ns"."""
    # In a train of pulses the start of the last one before counts.
    starts = (summary.get("pulses") or {}).get("starts_s")
    if time is None or not starts:
        return format_quantity(time, "s", typographic=typographic)
    pulse = pulse_at(time, starts)
    since = format_quantity(max(time - starts[pulse], 0.0), "s", typographic=typographic)
    return f"pulse {pulse + 1} + {since}"


def text_of(one: Quantity, value: Any, summary: dict[str, Any], *, typographic: bool = True) -> str:
    """A value of a summary with its unit."""
    # Times are told by pulses, all else by its unit.
    if MOMENT.fullmatch(one.key):
        times = value if isinstance(value, list) else [value]
        return ", ".join(moment(summary, time, typographic=typographic) for time in times)
    return in_words(value, unit_in(one.unit, amount_dimension(summary)), typographic)


def place_text(summary: dict[str, Any], key: str, *, typographic: bool = True) -> str:
    """A time, or a place as "x = 3 nm"; nothing where there is none."""
    value = value_at(summary, key)
    if value is None:
        return ""
    # A key of a time, or the letter of an axis before _m.
    if key.endswith("_s"):
        return moment(summary, value, typographic=typographic)
    letter = "r" if is_section(summary) and key[-3] == "x" else key[-3]
    return f"{letter} = {format_quantity(value, 'm', typographic=typographic)}"


def main_results(summary: dict[str, Any]) -> list[tuple[Quantity, Any]]:
    """The quantities that `lasersph info` shows, with their values."""
    # What `lasersph info` shows, of each probe or trace by its name.
    wanted = (one for kind in kinds_of(summary) for one in kind.all_results() if one.is_main)
    named = (each for one in wanted for each in each_named(one, summary))
    found = ((one, value_at(summary, one.key)) for one in named)
    return [(one, value) for one, value in found if is_shown(one, value)]


def each_named(one: Quantity, summary: dict[str, Any]) -> list[Quantity]:
    """The quantity itself, or where it is that of something with a name that of each in a run."""
    # Only quantities of named things have a placeholder.
    section, *names = one.key.split(".")
    if "<name>" not in names:
        return [one]
    return [
        replace(
            one,
            key=one.key.replace("<name>", name),
            at=tuple(key.replace("<name>", name) for key in one.at),
            words=f"{one.words} at {section.removesuffix('s')} {name}",
        )
        for name in summary.get(section) or {}
    ]


def main_rows(
    summary: dict[str, Any],
    uncertainty: dict[str, Any] | None = None,
    *,
    typographic: bool = True,
) -> Rows:
    """Main results: words, value with its error where that is known, and when."""
    # The error decides on the digits of its number.
    rows, errors = [], (uncertainty or {}).get("numbers", {})
    for one, value in main_results(summary):
        text = text_of(one, value, summary, typographic=typographic)
        error = errors.get(one.key, {}).get("error")
        if error is not None:
            unit = unit_in(one.unit, amount_dimension(summary))
            text = with_error(value, error, unit, typographic=typographic)
        at = place_text(summary, one.at[0], typographic=typographic) if one.at else ""
        rows.append((one.words, text, at))
    return rows


def main_numbers(
    summary: dict[str, Any], uncertainty: dict[str, Any] | None = None
) -> list[tuple[str, str]]:
    """Main results for `lasersph info`: words and value, with its error where that is known, as
    plain text."""
    return [
        (words, f"{text} at {at}" if at else text)
        for words, text, at in main_rows(summary, uncertainty, typographic=False)
    ]


def summary_rows(
    summary: dict[str, Any], uncertainty: dict[str, Any] | None = None
) -> list[tuple[str, str]]:
    """Case, size, time and the main results of a run, with units, and errors where there are any,
    as plain text."""
    return [
        ("case", str(summary.get("title") or summary["case"])),
        ("particles", f"{summary['particles']}{half_text(summary)}"),
        ("time", f"{format_quantity(summary['time_s'], 's')} in {summary['steps']} steps"),
        ("computed in", format_duration(summary["wall_time_s"])),
        *main_numbers(summary, uncertainty),
    ]


def half_text(summary: dict[str, Any]) -> str:
    """Words behind the number of particles of a run of a section or a part; else empty."""
    if is_section(summary):
        return " in a section (r, z)"
    return PARTS.get(summary.get("mirror_images", 1), "")


def computation(summary: dict[str, Any]) -> Rows:
    """How the run was computed: size, time, steps, what limited them, iterations."""
    # What was computed, and how long it took.
    steps, count = summary.get("time_step", {}), max(summary["steps"], 1)
    rows: Rows = [
        ("solver", str(summary["solver"])),
        ("dimensions", "2, (r, z)" if is_section(summary) else str(summary.get("dimensions", "–"))),
        ("particles", shown(summary["particles"], 9)),
        ("finest spacing", quantity(summary.get("spacing_m"), "m")),
        ("simulated time", quantity(summary["time_s"], "s")),
        ("steps", shown(summary["steps"], 9)),
        ("wall time", format_duration(summary["wall_time_s"])),
        ("smallest time step", entry("_s", steps.get("min_s"))),
        ("largest time step", entry("_s", steps.get("max_s"))),
    ]
    # Where it was computed: card or threads.
    if summary.get("device"):
        rows.append(("device, precision", f"{summary['device']}, {summary['precision']}"))
    elif "threads" in summary:
        rows.append(("threads, precision", f"{summary['threads']}, {summary['precision']}"))
    # Limits and iterations, the most frequent first.
    for name, times in sorted(steps.get("limits", {}).items(), key=lambda item: -item[1]):
        share = shown(100.0 * times / count, 3)
        rows.append((f"steps limited by: {name or 'unnamed'}", f"{times} ({share} %)"))
    for name, total in summary.get("iterations", {}).items():
        text = name.replace("_", " ")
        rows.append((f"iterations per step, {text}", shown(total / count, 3)))
    return rows


ALWAYS_SHOWN = tuple(f"energy.{name}_J" for name in ("absorbed", "stored", "lost", "removed"))
"""Terms of the energy budget that a reader looks for, be they 0."""


def energy(summary: dict[str, Any]) -> Rows:
    """The energy budget, absolute and relative to the incident energy."""
    incident = summary["energy"]["incident_J"]
    rows: Rows = []
    # Terms that are zero are left out, but for those that a reader expects.
    for one in EnergyBudget.all_results():
        value = value_at(summary, one.key)
        is_nothing = one.key.endswith("_J") and not value and one.key not in ALWAYS_SHOWN
        if not is_shown(one, value) or is_nothing:
            continue
        is_amount = one.unit == "J" and incident > 0.0
        share = f"{shown(100.0 * value / incident)} %" if is_amount else ""
        rows.append((one.words, text_of(one, value, summary), share))
    return rows


def removal_efficiency(summary: dict[str, Any]) -> Rows:
    """Removed volume over the incident energy, in 1-D and 2-D of the same area or length."""
    incident = summary["energy"]["incident_J"]
    if "crater" not in summary or not incident:
        return []
    # m^3/J in um^3/uJ is 1e12 larger.
    per_joule = 1e12 * summary["crater"]["removed_volume_m3"] / incident
    return [("removed volume over energy of the light", f"{format_number(per_joule)} µm³/µJ", "")]


def dimensionless(summary: dict[str, Any]) -> Rows:
    """The dimensionless numbers of the case."""
    numbers = summary.get("dimensionless", {}).get("numbers", {})
    return [(NUMBERS.get(name, str(name)), shown(value)) for name, value in numbers.items()]


def flat(value: Any, name: str = "", unit: str = "J") -> Rows:
    """Every number of a nested summary as (dotted name, text)."""
    # A table may have a unit of energy of its own.
    if isinstance(value, dict):
        unit = str(value.get("unit", unit))
        rows: Rows = []
        for key, item in value.items():
            if key in NOT_NUMBERS:
                continue
            rows += flat(item, f"{name}.{key}" if name else str(key), unit)
        return rows
    return [(name, entry(name, value, unit))]


def entry(key: str, value: Any, energy_unit: str = "J") -> str:
    """A value of summary.json in words, its unit taken from the end of its key."""
    # Long lists are counted.
    if isinstance(value, list) and len(value) > MOST_LISTED:
        return f"{len(value)} numbers"
    unit = unit_of(key)
    return in_words(value, energy_unit if unit == "J" else unit) or "–"


READABLE = {"J/m^2": (1e-4, "J/cm^2"), "K/m": (1e-6, "K/um")}
"""Factor and unit in which an engineer writes what SI writes otherwise."""


def with_error(value: float, error: float | None, unit: str, *, typographic: bool = True) -> str:
    """A number in SI with its error, in the unit in which an engineer writes it."""
    factor, name = READABLE.get(unit, (1.0, unit))
    name = name.replace("um", "µm") if typographic else name
    return format_with_error(
        factor * value, error and factor * error, name, typographic=typographic
    )


def in_words(value: Any, unit: str, typographic: bool = True) -> str:
    """A truth, a text, a number with its unit, a list of them, or nothing."""
    # By the kind of the value.
    if value is None:
        return "–"
    if isinstance(value, list):
        return ", ".join(in_words(item, unit, typographic) for item in value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    # In the unit of the field.
    factor, name = READABLE.get(unit, (1.0, unit))
    name = name.replace("um", "µm") if typographic else name
    return format_quantity(factor * float(value), name, typographic=typographic)


def estimates(summary: dict[str, Any]) -> Rows:
    """Estimates with the values that the paper gives or cites."""
    found = summary.get("estimates")
    if not found:
        return []

    # Light, heat and vapor, each beside the value that the paper gives.
    light = found["absorption"]
    heat = found["conduction"]
    vapor = found["vapor"]
    rows: Rows = []
    if light:
        share = shown(100.0 * light["left_below_first_layer"], 3)
        depth = entry("_m", light["depth_95_percent_m"])
        rows.append(("95 % of the light is absorbed within, eqs. (3), (4)", depth, "24.4 nm"))
        rows.append(("light left below the first layer", f"{share} %", "–"))
    names = {
        "penetration_m": "heat goes in one pulse, eq. (34)",
        "surface_temperature_K": "surface at its end without phase change, (A.1)",
        "surface_temperature_last_K": "the same at the end of the last pulse, on the axis, (A.3)",
        "surface_temperature_disc_K": "the same on the axis of a disc",
    }
    for key, words in names.items():
        if key in heat:
            text = entry(key, heat[key])
            if key == "surface_temperature_disc_K":
                text += f", {shown(100.0 * heat['lateral_loss_relative'], 2)} % less rise"
            rows.append((words, text, "–"))
    share = shown(100.0 * vapor["absorbed_over_two_h"], 2)
    rows.append(("light taken by the vapor over 2 h", f"{share} %", "2.4·10⁻⁶ %"))
    if "effusion_velocity_m_s" in vapor:
        both = (vapor["effusion_velocity_m_s"], vapor["mean_normal_velocity_m_s"])
        text = " and ".join(f"{shown(v)} m/s" for v in both)
        rows.append(("vapor at the boiling point: effusion, and eq. (6)", text, CITED_SPEEDS))

    # Accelerations of the traces against those that the paper cites.
    rates = (life["acceleration_m_s2"] for life in summary.get("traces", {}).values())
    largest = entry("_m_s2", max((rate for rate in rates if rate is not None), default=None))
    rows.append(("largest acceleration of a traced particle", largest, CITED_ACCELERATIONS))
    return rows


def left_out(summary: dict[str, Any]) -> Rows:
    """Effects that the model leaves out, and from which temperature of the surface it matters."""
    found = (summary.get("estimates") or {}).get("left_out")
    if found is None:
        return []
    # The temperature at which evaporation carries all flux away, beside each limit.
    hot = entry("_K", found["evaporating_K"])
    names = {
        "recoil_from_K": "melt driven out by the recoil of the vapor",
        "phase_explosion_from_K": "phase explosion (0.9 of the critical temperature)",
        "shielding_from_K": "light shielded by vapor and plasma (critical temperature)",
    }
    return [
        (text, entry("_K", found[key]) if found[key] is not None else "no data", hot)
        for key, text in names.items()
    ]
