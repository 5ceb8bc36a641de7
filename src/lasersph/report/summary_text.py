"""The results of a run in plain sentences, from summary.json alone."""

from __future__ import annotations

from typing import Any

from lasersph.observers.energy_budget import IMBALANCE_ALLOWED, IMBALANCE_ALLOWED_WITH_FLOW
from lasersph.report.ablation_text import crater, model_limits
from lasersph.report.flow_text import box_flow, pool_flow
from lasersph.report.numbers import quantity, shown


def verdict(summary: dict[str, Any]) -> str:
    """The course of a run in two to eight sentences."""
    if "box" in summary:
        return " ".join([*box_flow(summary), *balance(summary)])
    parts = [hottest(summary)]
    melt = summary.get("melt")
    if melt is None:
        melts = summary.get("material", {}).get("solidus_K") is not None
        parts.append("Nothing melted." if melts else "The material of this case does not melt.")
    elif melt["start_s"] is None:
        parts.append(
            "The metal began to melt at "
            f"{quantity(melt['start_any_s'], 's')}, but no cell became completely fluid."
        )
    else:
        parts += melting(melt)
    vapor = summary.get("vaporization")
    if vapor is not None and vapor["start_s"] is not None and "crater" not in summary:
        parts.append(boiling(vapor))
    told = [*parts, *crater(summary), *pool_flow(summary), *balance(summary)]
    return " ".join(told)


def hottest(summary: dict[str, Any]) -> str:
    """The largest temperature and when."""
    at = quantity(summary.get("temperature_max_at_s"), "s")
    return f"The metal reached at most {quantity(summary['temperature_max_K'], 'K')}, at {at}."


def melting(melt: dict[str, Any]) -> list[str]:
    """Life and size of the pool."""
    end = (
        "until the end of the run"
        if melt["molten_at_end"]
        else f"to {quantity(melt['end_s'], 's')}"
    )
    depth = f"at most {quantity(melt['depth_max_m'], 'm')} deep"
    deep_at = f" (at {quantity(melt['depth_max_at_s'], 's')})"
    wide = ""
    if melt["width_max_m"]:
        wide = f"{quantity(melt['width_max_m'], 'm')} wide"
        wide += f" (at {quantity(melt['width_max_at_s'], 's')}) and "
        depth = depth.replace("at most ", "")
    first = f"Completely fluid metal was there from {quantity(melt['start_s'], 's')} {end}."
    return [first, f"The pool was {'at most ' if wide else ''}{wide}{depth}{deep_at}."]


def boiling(vapor: dict[str, Any]) -> str:
    """How long the surface was at the vaporization temperature and what came of it."""
    text = (
        "The surface was at the vaporization temperature or above from "
        f"{quantity(vapor['start_s'], 's')} to {quantity(vapor['end_s'], 's')}"
    )
    thickness = vapor["evaporated_thickness_max_m"]
    if thickness:
        return f"{text}; up to {quantity(thickness, 'm')} evaporated."
    if vapor["depth_max_m"]:
        return (
            f"{text}; down to {quantity(vapor['depth_max_m'], 'm')} the metal took up its whole "
            "heat of vaporization: more light means ablation, which this run leaves out."
        )
    share = shown(100.0 * vapor["fraction_max"], 3)
    return f"{text}; no cell took up more than {share} % of its heat of vaporization."


def balance(summary: dict[str, Any]) -> list[str]:
    """How well the energy budget closes; nothing where no energy went anywhere."""
    energy = summary["energy"]
    if not any(energy[f"{name}_J"] for name in ("absorbed", "stored", "lost")):
        return []
    error = energy["imbalance_relative"]
    if error < 1e-14:
        return ["The energy balance closes to rounding."]
    text = f"The energy balance closes to {shown(error, 2)} of the absorbed energy"
    if error <= allowed_imbalance(summary):
        return [f"{text}."]
    return [f"{text}, which is too much: do not trust this run."]


def allowed_imbalance(summary: dict[str, Any]) -> float:
    """Largest relative error of the energy balance of a run that can be trusted."""
    return IMBALANCE_ALLOWED_WITH_FLOW if "flow" in summary else IMBALANCE_ALLOWED


def warning_texts(summary: dict[str, Any], events: list[dict[str, Any]]) -> list[str]:
    """Warnings: read them before using the numbers."""
    found = [str(e["message"]) for e in events if e["event"] == "warning" and "message" in e]
    allowed = allowed_imbalance(summary)
    if summary["energy"]["imbalance_relative"] > allowed:
        share = "a ten-thousandth" if "flow" in summary else "a millionth"
        found.append(f"The energy balance does not close within {share} of the absorbed energy.")
    if summary["energy"].get("discarded_J"):
        share = summary["energy"]["discarded_J"] / max(summary["energy"]["absorbed_J"], 1e-300)
        found.append(
            f"The plateau rule `clip` discarded {shown(100.0 * share, 3)} % of the absorbed energy."
        )
    return list(dict.fromkeys(found))


def note_texts(summary: dict[str, Any]) -> list[str]:
    """Notes beside the numbers."""
    found = model_limits(summary)
    if summary.get("melt", {}).get("molten_at_end"):
        found.append(
            "The run ended while metal was still fluid: the end of melting is later than given."
        )
    requested, used = summary.get("spacing_requested_m"), summary.get("spacing_m")
    if requested and used and abs(used - requested) > 1e-6 * requested:
        found.append(
            f"The spacing of {quantity(requested, 'm')} was rounded to {quantity(used, 'm', 6)} so"
            " that whole cells fill the block."
        )
    if summary.get("surface", {}).get("symmetry_factor") == 2:
        found.append(
            "Half a period was computed: widths are those of the whole pool, energies those of the"
            " half."
        )
    return found
