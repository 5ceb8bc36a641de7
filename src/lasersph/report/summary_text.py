"""The results of a run in plain sentences, from summary.json alone."""

from __future__ import annotations

from typing import Any

from lasersph.observers.energy_budget import (
    IMBALANCE_ALLOWED,
    IMBALANCE_ALLOWED_WITH_FLOW,
    NUMERICAL,
    NUMERICAL_ALLOWED,
    TERMS,
)
from lasersph.report.tables import quantity, shown


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
    if not exchanged(energy):
        return []
    error = energy["imbalance_relative"]
    if error < 1e-14:
        return ["The energy balance closes to rounding at all times."]
    text = f"The energy balance closes to {shown(error, 2)} of the energy moved, at all times"
    if error <= allowed_imbalance(summary):
        return [f"{text}."]
    return [f"{text}, which is too much: do not trust this run."]


def exchanged(energy: dict[str, Any]) -> float:
    """Largest of the energies absorbed, stored and lost [J]."""
    return max(abs(energy[f"{name}_J"]) for name in ("absorbed", "stored", "lost"))


def allowed_imbalance(summary: dict[str, Any]) -> float:
    """Largest relative error of the energy balance of a run that can be trusted."""
    return IMBALANCE_ALLOWED_WITH_FLOW if "flow" in summary else IMBALANCE_ALLOWED


def warning_texts(summary: dict[str, Any], events: list[dict[str, Any]]) -> list[str]:
    """Warnings: read them before using the numbers."""
    found = [str(e["message"]) for e in events if e["event"] == "warning" and "message" in e]
    allowed = allowed_imbalance(summary)
    if summary["energy"]["imbalance_relative"] > allowed:
        share = "a ten-thousandth" if "flow" in summary else "a millionth"
        found.append(f"The energy balance does not close within {share} of the energy moved.")
    whole = exchanged(summary["energy"])
    for name in NUMERICAL:
        share = summary["energy"].get(f"{name}_max_J", 0.0) / max(whole, 1e-300)
        if share > NUMERICAL_ALLOWED:
            percent = shown(100.0 * share, 3)
            found.append(f"The {TERMS[name]} is {percent} % of the energy moved.")
    vapor = summary.get("vaporization", {})
    if vapor.get("near_critical_start_s") is not None:
        place = vapor["near_critical_x_m"]
        where = "" if place is None else f", hottest at x = {quantity(place, 'm')}"
        found.append(
            f"The surface was above 0.9 of its critical temperature of {vapor['critical_K']:.0f} K "
            f"from {quantity(vapor['near_critical_start_s'], 's')} to "
            f"{quantity(vapor['near_critical_end_s'], 's')}{where}: the curve of vapor pressure "
            "is an extrapolation there."
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


def pool_flow(summary: dict[str, Any]) -> list[str]:
    """How the melt pool flowed; nothing for a run without flow."""
    flow = summary.get("flow")
    if flow is None:
        return []
    if not flow["speed_max_m_s"]:
        return ["Nothing flowed."]
    if "surface_speed_max_m_s" not in flow:
        fastest = f"The liquid reached at most {quantity(flow['speed_max_m_s'], 'm/s')}"
        return [f"{fastest}, at {quantity(flow['speed_max_at_s'], 's')}; its surface did not move."]
    place = quantity(abs(flow["surface_speed_max_x_m"]), "m", 3)
    first = (
        f"The liquid flowed along the surface at up to"
        f" {quantity(flow['surface_speed_max_m_s'], 'm/s', 3)}"
        f" (at {quantity(flow['surface_speed_max_at_s'], 's')}, {place} from x = 0), in a layer"
        f" {quantity(flow['layer_thickness_m'], 'm', 3)} thick, and back below it at up to"
        f" {quantity(flow['return_speed_max_m_s'], 'm/s', 3)}."
    )
    return [first, *extrema(flow.get("extrema"))]


def extrema(found: dict[str, Any] | None) -> list[str]:
    """Whether a second extremum of the surface speed appeared."""
    if found is None:
        return []
    if not found["inner_speed_max_m_s"]:
        return ["The surface speed had one extremum on each side at all times."]
    inner = (
        f"From {quantity(found['inner_start_s'], 's')} to {quantity(found['inner_end_s'], 's')} an"
        f" inner extremum stood beside or instead of the outer one, with up to"
        f" {quantity(found['inner_speed_max_m_s'], 'm/s', 3)}"
    )
    if found["inner_exceeds_lasted_s"]:
        lasted = quantity(found["inner_exceeds_lasted_s"], "s", 3)
        return [f"{inner}; it was the faster of both for {lasted}."]
    return [f"{inner}; it was never the faster of both."]


def box_flow(summary: dict[str, Any]) -> list[str]:
    """How the liquid of a closed box flowed at the end."""
    box, flow = summary["box"], summary["flow"]
    size = f"{quantity(box['width_m'], 'm')} wide and {quantity(box['height_m'], 'm')} high"
    if not flow["speed_max_m_s"]:
        return [f"The liquid in the box, {size}, stayed at rest."]
    eddies, center = box["stream_function"], box["center"]
    strongest = max(("max", "min"), key=lambda name: abs(eddies[f"{name}_m2_s"]))
    turning = "counterclockwise" if strongest == "max" else "clockwise"
    x, z = (quantity(eddies[f"{strongest}_{axis}_m"], "m", 3) for axis in "xz")
    found = [
        f"The liquid in the box, {size}, reached at most"
        f" {quantity(flow['speed_max_m_s'], 'm/s')}, at {quantity(flow['speed_max_at_s'], 's')}.",
        f"At {quantity(box['time_s'], 's')} its strongest eddy turned {turning} around x = {x},"
        f" z = {z}, with a stream function of"
        f" {quantity(eddies[f'{strongest}_m2_s'], 'm²/s')}; on the center lines u ran from"
        f" {quantity(center['u_min_m_s'], 'm/s')} to {quantity(center['u_max_m_s'], 'm/s')} and w"
        f" from {quantity(center['w_min_m_s'], 'm/s')} to {quantity(center['w_max_m_s'], 'm/s')}.",
    ]
    heat = box.get("heat", {})
    numbers = {key: value for key, value in heat.items() if key.startswith("nusselt_")}
    if numbers:
        names = {key: key.removeprefix("nusselt_") for key in numbers} | {"nusselt_mean": "carried"}
        sides = ", ".join(f"{shown(value)} ({names[key]})" for key, value in numbers.items())
        found.append(f"Nusselt numbers over the last quarter of the time: {sides}.")
    return found


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
