"""An ablation in plain sentences, from summary.json alone: crater, ejecta, and effects left out."""

from __future__ import annotations

from typing import Any

from lasersph.report.numbers import quantity, shown


def crater(summary: dict[str, Any]) -> list[str]:
    """Crater and ejecta; nothing for a run without ablation."""
    found, ejecta = summary.get("crater"), summary.get("ejecta")
    if found is None or ejecta is None:
        return []
    if not ejecta["count"]:
        return ["Nothing was ablated."]
    size = f"{quantity(found['depth_m'], 'm')} deep at the axis"
    if found["diameter_m"]:
        size += f" and {quantity(found['diameter_m'], 'm')} wide"
    share = 100.0 * ejecta["energy_J"] / max(summary["energy"]["absorbed_J"], 1e-300)
    return [
        f"The light left a crater {size}.",
        f"The ejecta left between {quantity(ejecta['start_s'], 's')} and"
        f" {quantity(ejecta['end_s'], 's')}, at {quantity(ejecta['speed_mean_m_s'], 'm/s', 3)} on"
        f" average, and carried {shown(share, 3)} % of the absorbed energy away.",
        *hole(summary["energy"]),
    ]


def hole(energy: dict[str, Any]) -> list[str]:
    """Light that went through where the metal was gone; nothing where there was none."""
    if not energy["transmitted_J"]:
        return []
    share = 100.0 * energy["transmitted_J"] / energy["incident_J"]
    return [f"Of the light {shown(share, 3)} % went through a hole burnt into the metal."]


def model_limits(summary: dict[str, Any]) -> list[str]:
    """Effects that the model leaves out, with the temperatures from which it matters."""
    found = (summary.get("estimates") or {}).get("left_out")
    if found is None:
        return []
    parts = [
        "The model leaves out melt that the recoil of the vapor drives out, phase explosion, and"
        " light that vapor and plasma shield."
    ]
    hot, explodes = found["evaporating_K"], found["phase_explosion_from_K"]
    critical = found["shielding_from_K"]
    if hot is not None and hot == critical:
        parts.append(
            "Evaporation alone cannot carry the absorbed flux away below the critical temperature"
            f" of {quantity(hot, 'K')}."
        )
    elif hot is not None:
        parts.append(
            "To carry the absorbed flux away by evaporation alone the surface would have to be at"
            f" {quantity(hot, 'K')}."
        )
    if explodes is None:
        parts.append("The material has no critical temperature to compare with.")
    elif hot is not None:
        word = "above" if hot > explodes else "below"
        parts.append(
            f"That is {word} the {quantity(explodes, 'K')} from which metal is expected to explode"
            " into vapor and drops"
            + (": take the computed depth as an estimate." if hot > explodes else ".")
        )
    recoil = found["recoil_from_K"]
    if recoil is not None:
        parts.append(f"Recoil moves the melt from about {quantity(recoil, 'K')} on.")
    return [" ".join(parts)]
