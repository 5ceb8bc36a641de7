"""The tables of a report that tell of an ablation, from summary.json: rows of name and text."""

from __future__ import annotations

from typing import Any

from lasersph.report.numbers import entry, quantity, shown
from lasersph.report.tables import Rows

TRACE_HEAD = (
    "particle", "melted", "boiled", "left", "temperature then", "speed then", "acceleration",
    "vapor pressure",
)  # fmt: skip
ESTIMATE_HEAD = ("estimate", "value", "cited")
LEFT_OUT_HEAD = ("left out", "matters from", "surface that evaporates only")
CITED_SPEEDS = (
    "380-450 m/s [AlShaer 2017]; 167, 640, 1110 m/s at the edge, on average and in the center"
    " [Hamadi, as cited there]; 750 m/s [Rajendran, as cited there]"
)
CITED_ACCELERATIONS = (
    "1.4·10¹¹ m/s² [AlShaer 2017]; 10⁸ m/s² eject without melting [Tam 1992, as cited there]"
)


def crater(summary: dict[str, Any]) -> Rows:
    """Size of the crater at the end."""
    found = summary.get("crater")
    if found is None:
        return []
    names = {
        "depth_m": "depth at the axis",
        "depth_mean_m": "mean depth",
        "depth_max_m": "largest depth",
        "width_m": "width along x at the original surface",
        "diameter_m": "diameter of the circle of the same area",
    }
    rows: Rows = [
        (text, entry("_m", found[key])) for key, text in names.items() if found[key] is not None
    ]
    if found["taper_deg"] is not None:
        rows.append(("taper of the walls from the vertical", f"{shown(found['taper_deg'], 3)}°"))
    unit = found["volume_unit"]
    rows += [
        ("removed volume", quantity_of(found["removed_volume_m3"], unit)),
        ("with the shares of what was about to leave", quantity_of(
            found["vaporized_volume_max_m3"], unit)),
    ]  # fmt: skip
    pulses = found["depth_of_pulse_m"]
    if len(pulses) > 1:
        rows.append(("depth of each pulse", entry("_m", pulses)))
        rows.append(("on average", entry("_m", sum(pulses) / len(pulses))))
    if (efficiency := removal_efficiency(summary)) is not None:
        rows.append(("removed volume over energy of the light", efficiency))
    return rows


def removal_efficiency(summary: dict[str, Any]) -> str | None:
    """Removed volume over the incident energy, in 1-D and 2-D of the same area or length."""
    incident = summary["energy"]["incident_J"]
    if not incident:
        return None
    per_joule = summary["crater"]["removed_volume_m3"] / incident
    return f"{shown(1e12 * per_joule)} µm³/µJ"


def quantity_of(value: float, unit: str) -> str:
    """A volume in cubic micrometers, per area in nm, per length in um^2."""
    if unit == "m":
        return f"{quantity(value, 'm')} (per area)"
    factor, name = (1e12, "µm² (per length)") if unit == "m^2" else (1e18, "µm³")
    return f"{shown(factor * value)} {name}"


def ejecta(summary: dict[str, Any]) -> Rows:
    """What left the surface, with what it had when it left."""
    found = summary.get("ejecta")
    if found is None:
        return []
    rows: Rows = [
        ("ejected particles", f"{found['count']:,}".replace(",", " ")),
        ("of these beyond the box", f"{found['gone_count']:,}".replace(",", " ")),
        ("mass", quantity(found["mass_kg"], found["mass_unit"])),
        ("energy carried away", quantity(found["energy_J"], found["energy_unit"])),
        ("kinetic energy", quantity(found["kinetic_energy_J"], found["energy_unit"])),
    ]
    if found["count"]:
        rows += [
            ("first and last", f"{entry('_s', found['start_s'])}, {entry('_s', found['end_s'])}"),
            ("speed, mean (smallest to largest)", spread(found, "speed", "m_s", "m/s")),
            ("temperature", spread(found, "temperature", "K", "K")),
            ("angle from the vertical", spread(found, "angle", "deg", "°")),
            ("largest vapor pressure, eq. (5)", entry("_Pa", found["vapor_pressure_max_Pa"])),
        ]
    return rows


def spread(found: dict[str, Any], name: str, suffix: str, unit: str) -> str:
    """Mean and range of a quantity of the ejecta."""
    mean, low, high = (found[f"{name}_{word}_{suffix}"] for word in ("mean", "min", "max"))
    return f"{shown(mean)} ({shown(low)} to {shown(high)}) {unit}"


def traces(summary: dict[str, Any]) -> Rows:
    """When each traced particle melted, boiled and left."""
    return [
        (
            name,
            *(entry("_s", life[f"{word}_at_s"]) for word in ("melted", "boiled", "left")),
            entry("_K", life["temperature_left_K"]),
            entry("_m_s", life["speed_left_m_s"]),
            acceleration(life["acceleration_m_s2"]),
            entry("_Pa", life["vapor_pressure_Pa"]),
        )
        for name, life in summary.get("traces", {}).items()
    ]


def acceleration(value: float | None) -> str:
    """An acceleration in m/s2."""
    return "–" if value is None else f"{shown(value, 3)} m/s²"


def estimates(summary: dict[str, Any]) -> Rows:
    """Estimates with the values that the paper gives or cites."""
    found = summary.get("estimates")
    if not found:
        return []
    light, heat, vapor = found["absorption"], found["conduction"], found["vapor"]
    rows: Rows = []
    if light:
        rows += [
            ("95 % of the light is absorbed within, eqs. (3), (4)",
             entry("_m", light["depth_95_percent_m"]), "24.4 nm"),
            ("light left below the first layer",
             f"{shown(100.0 * light['left_below_first_layer'], 3)} %", "–"),
        ]  # fmt: skip
    rows += [
        ("heat goes in one pulse, eq. (34)", entry("_m", heat["penetration_m"]), "–"),
        ("surface at its end without phase change, (A.1)",
         entry("_K", heat["surface_temperature_K"]), "–"),
    ]  # fmt: skip
    if "surface_temperature_last_K" in heat:
        rows.append(
            ("the same at the end of the last pulse, on the axis, (A.3)",
             entry("_K", heat["surface_temperature_last_K"]), "–")
        )  # fmt: skip
    if "surface_temperature_disc_K" in heat:
        lost = f"{shown(100.0 * heat['lateral_loss_relative'], 2)} % less rise"
        rows.append(
            ("the same on the axis of a disc",
             f"{entry('_K', heat['surface_temperature_disc_K'])}, {lost}", "–")
        )  # fmt: skip
    rows.append(
        ("light taken by the vapor over 2 h",
         f"{shown(100.0 * vapor['absorbed_over_two_h'], 2)} %", "2.4·10⁻⁶ %")
    )  # fmt: skip
    if "effusion_velocity_m_s" in vapor:
        both = (vapor["effusion_velocity_m_s"], vapor["mean_normal_velocity_m_s"])
        text = " and ".join(f"{shown(v)} m/s" for v in both)
        rows.append(("vapor at the boiling point: effusion, and eq. (6)", text, CITED_SPEEDS))
    found = [life["acceleration_m_s2"] for life in summary.get("traces", {}).values()]
    largest = max((value for value in found if value is not None), default=None)
    rows.append(("largest acceleration of a traced particle", acceleration(largest),
                 CITED_ACCELERATIONS))  # fmt: skip
    return rows


def left_out(summary: dict[str, Any]) -> Rows:
    """What the model leaves out, and from which temperature of the surface it matters."""
    found = (summary.get("estimates") or {}).get("left_out")
    if found is None:
        return []
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
