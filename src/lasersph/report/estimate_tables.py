"""The tables of a report about the estimates of an ablation, with the values that papers cite."""

from __future__ import annotations

from typing import Any

from lasersph.report.numbers import entry, shown
from lasersph.report.tables import Rows

ESTIMATE_HEAD = ("estimate", "value", "cited")
LEFT_OUT_HEAD = ("left out", "matters from", "surface that evaporates only")
CITED_SPEEDS = (
    "380-450 m/s [AlShaer 2017]; 167, 640, 1110 m/s at the edge, on average and in the center"
    " [Hamadi, as cited there]; 750 m/s [Rajendran, as cited there]"
)
CITED_ACCELERATIONS = (
    "1.4·10¹¹ m/s² [AlShaer 2017]; 10⁸ m/s² eject without melting [Tam 1992, as cited there]"
)


def estimates(summary: dict[str, Any]) -> Rows:
    """Estimates with the values that the paper gives or cites."""
    found = summary.get("estimates")
    if not found:
        return []
    light, heat, vapor = found["absorption"], found["conduction"], found["vapor"]
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
    rates = (life["acceleration_m_s2"] for life in summary.get("traces", {}).values())
    largest = entry("_m_s2", max((rate for rate in rates if rate is not None), default=None))
    rows.append(("largest acceleration of a traced particle", largest, CITED_ACCELERATIONS))
    return rows


def left_out(summary: dict[str, Any]) -> Rows:
    """Effects that the model leaves out, and from which temperature of the surface it matters."""
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
