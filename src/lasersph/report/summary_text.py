"""The results of a run in plain sentences, from summary.json alone."""

from __future__ import annotations

from typing import Any

from lasersph.input.key_units import is_section
from lasersph.observers.run_warnings import (
    allowed_imbalance,
    event_warnings,
    found_warnings,
)
from lasersph.report.tables import moment, quantity, shown


def verdict(summary: dict[str, Any]) -> str:
    """The course of a run in two to eight sentences."""
    # A box has a flow and a balance, nothing melts in it.
    if "box" in summary:
        return " ".join([*box_flow(summary), *balance(summary)])
    parts = [hottest(summary)]
    # Melting: off, none, begun, or with a pool.
    melt = summary.get("melt")
    if melt is None:
        melts = summary.get("material", {}).get("solidus_K") is not None
        off = "Melting was not computed: switched off, or the material has no melting point."
        parts.append("Nothing melted." if melts else off)
    elif melt["start_s"] is None:
        parts.append(
            "The metal began to melt at "
            f"{moment(summary, melt['start_any_s'])}, but no cell became completely fluid."
        )
    else:
        parts += melting(summary)
    # Boiling is said by the crater where there is one.
    vapor = summary.get("vaporization")
    if vapor is not None and vapor["start_s"] is not None and "crater" not in summary:
        parts.append(boiling(summary))
    sentences = [*parts, *crater(summary), *pool_flow(summary), *balance(summary)]
    return " ".join(sentences)


def hottest(summary: dict[str, Any]) -> str:
    """The largest temperature and when."""
    at = moment(summary, summary.get("temperature_max_at_s"))
    return f"The metal reached at most {quantity(summary['temperature_max_K'], 'K')}, at {at}."


def melting(summary: dict[str, Any]) -> list[str]:
    """Life and size of the pool."""
    melt = summary["melt"]
    # Life of the pool, in pulses or in time.
    if "pulses" in summary:
        text = f"Completely fluid metal was there {lives(summary['pulses'], 'melt')}."
    elif melt["molten_at_end"]:
        start = moment(summary, melt["start_s"])
        text = f"Completely fluid metal was there from {start} until the end of the run."
    else:
        start, end = (moment(summary, melt[f"{name}_s"]) for name in ("start", "end"))
        text = f"Completely fluid metal was there from {start} to {end}."
    # Its size, in a section without width only the depth.
    deep = f"{quantity(melt['depth_max_m'], 'm')} deep"
    deep += f" (at {moment(summary, melt['depth_max_at_s'])})"
    if not melt["width_max_m"]:
        return [text, f"The pool was at most {deep}."]
    wide = f"{quantity(melt['width_max_m'], 'm')} wide"
    wide += f" (at {moment(summary, melt['width_max_at_s'])})"
    return [text, f"The pool was at most {wide} and {deep}."]


def lives(pulses: dict[str, Any], name: str) -> str:
    """After how many pulses of a train something lived, and for how long."""
    # Pulses after which it lived, and the shortest and longest time.
    both = zip(pulses[f"{name}_starts_s"], pulses[f"{name}_ends_s"], strict=True)
    lengths = [end - start for start, end in both if start is not None]
    begun = len(pulses["starts_s"])
    whom = "each" if len(lengths) == begun else f"{len(lengths)}"
    shortest, longest = (quantity(length, "s", 3) for length in (min(lengths), max(lengths)))
    span = longest if shortest == longest else f"{shortest} to {longest}"
    return f"after {whom} of {begun} pulses, for {span}"


def boiling(summary: dict[str, Any]) -> str:
    """How long the surface was at the vaporization temperature and what came of it."""
    vapor = summary["vaporization"]
    # When the surface boiled.
    start, end = (moment(summary, vapor[f"{name}_s"]) for name in ("start", "end"))
    when = f"from {start} to {end}"
    if "pulses" in summary:
        when = lives(summary["pulses"], "boiling")
    text = f"The surface was at the vaporization temperature or above {when}"
    # What came of it: metal gone, metal that took up all the heat, or only a share of it.
    thickness = vapor["evaporated_thickness_max_m"]
    if thickness:
        return f"{text}; up to {quantity(thickness, 'm', 2)} evaporated."
    if vapor["depth_max_m"]:
        return (
            f"{text}; down to {quantity(vapor['depth_max_m'], 'm')} the metal took up its whole "
            "heat of vaporization: more light means ablation, which this run leaves out."
        )
    share = shown(100.0 * vapor["fraction_max"], 3)
    return f"{text}; no cell took up more than {share} % of its heat of vaporization."


def balance(summary: dict[str, Any]) -> list[str]:
    """How well the energy budget closes; nothing where no energy went anywhere."""
    # Nothing to balance without energy.
    energy = summary["energy"]
    if not any(energy[f"{name}_J"] for name in ("absorbed", "stored", "lost")):
        return []
    error = energy["imbalance_relative"]
    if error < 1e-14:
        return ["The energy balance closes to rounding at all times."]
    text = f"The energy balance closes to {shown(error, 2)} of the energy moved, at all times"
    if error <= allowed_imbalance(summary):
        return [f"{text}."]
    return [f"{text}, which is too much: do not trust this run."]


def warning_texts(summary: dict[str, Any] | None, events: list[dict[str, Any]]) -> list[str]:
    """Warnings: read them before using the numbers.

    Args:
        summary: None of a run that is not complete; one without `warnings` is of a run by an
            earlier version, what it found follows from its numbers.
    """
    # A run that is not complete has the warnings of its events.
    if summary is None:
        return event_warnings(events)
    if "warnings" in summary:
        return list(summary["warnings"])
    return [*event_warnings(events), *found_warnings(summary)]


def note_texts(summary: dict[str, Any]) -> list[str]:
    """Notes beside the numbers."""
    found = model_limits(summary)
    # Whole cells move the spacing.
    requested, used = summary.get("spacing_requested_m"), summary.get("spacing_m")
    if requested and used and abs(used - requested) > 1e-6 * requested:
        found.append(
            f"The spacing of {quantity(requested, 'm')} was rounded to {quantity(used, 'm', 6)} so"
            " that whole cells fill the block."
        )
    # A part of a symmetric body was computed, or a section of a body of revolution.
    if is_section(summary):
        found.append(
            "A section through the axis r = 0 was computed: widths are diameters, volumes and"
            " energies are those of the whole revolution."
        )
    elif (images := summary.get("mirror_images", 1)) > 1:
        part = {2: "half", 4: "a quarter"}[images]
        found.append(
            f"Only {part} of what is symmetric was computed: volumes, masses, energies and widths"
            " are those of the whole, numbers of particles those of the part."
        )
    return found


def pool_flow(summary: dict[str, Any]) -> list[str]:
    """How the melt pool flowed; nothing for a run without flow."""
    flow = summary.get("flow")
    if flow is None:
        return []
    # No flow, or a flow below a surface at rest.
    if not flow["speed_max_m_s"]:
        return ["Nothing flowed."]
    if "surface_speed_max_m_s" not in flow:
        fastest = f"The liquid reached at most {quantity(flow['speed_max_m_s'], 'm/s')}"
        return [
            f"{fastest}, at {moment(summary, flow['speed_max_at_s'])}; its surface did not move."
        ]
    # Speed along the surface, when and where, and the flow back below it.
    place = quantity(abs(flow["surface_speed_max_x_m"]), "m", 3)
    place += " from the axis" if is_section(summary) else " from x = 0"
    first = (
        f"The liquid flowed along the surface at up to"
        f" {quantity(flow['surface_speed_max_m_s'], 'm/s', 3)}"
        f" (at {moment(summary, flow['surface_speed_max_at_s'])}, {place}), in a layer"
        f" {quantity(flow['layer_thickness_m'], 'm', 3)} thick, and back below it at up to"
        f" {quantity(flow['return_speed_max_m_s'], 'm/s', 3)}."
    )
    return [first, *extrema(summary)]


def extrema(summary: dict[str, Any]) -> list[str]:
    """Whether a second extremum of the surface speed appeared."""
    # One extremum on each side, or two, and which of them was faster.
    found = summary["flow"].get("extrema")
    if found is None:
        return []
    if not found["inner_speed_max_m_s"]:
        return ["The surface speed had one extremum on each side at all times."]
    start, end = (moment(summary, found[f"inner_{name}_s"]) for name in ("start", "end"))
    inner = (
        f"From {start} to {end} an"
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
    center = box["center"]
    found = [
        f"The liquid in the box, {size}, reached at most"
        f" {quantity(flow['speed_max_m_s'], 'm/s')}, at {quantity(flow['speed_max_at_s'], 's')}.",
        f"At {quantity(box['time_s'], 's')} {_strongest_eddy(box)}on the center lines u ran from"
        f" {quantity(center['u_min_m_s'], 'm/s')} to {quantity(center['u_max_m_s'], 'm/s')} and w"
        f" from {quantity(center['w_min_m_s'], 'm/s')} to {quantity(center['w_max_m_s'], 'm/s')}.",
    ]
    # Heat through the walls, where they have temperatures.
    heat = box.get("heat", {})
    numbers = {key: value for key, value in heat.items() if key.startswith("nusselt_")}
    if numbers:
        names = {key: key.removeprefix("nusselt_") for key in numbers} | {"nusselt_mean": "carried"}
        sides = ", ".join(f"{shown(value)} ({names[key]})" for key, value in numbers.items())
        found.append(f"Nusselt numbers over the last quarter of the time: {sides}.")
    return found


def _strongest_eddy(box: dict[str, Any]) -> str:
    """Words for the larger of both extremes of the stream function; none of a block."""
    eddies = box.get("stream_function")
    if eddies is None:
        return ""
    strongest = max(("max", "min"), key=lambda name: abs(eddies[f"{name}_m2_s"]))
    turning = "counterclockwise" if strongest == "max" else "clockwise"
    x, z = (quantity(eddies[f"{strongest}_{axis}_m"], "m", 3) for axis in "xz")
    psi = quantity(eddies[f"{strongest}_m2_s"], "m²/s")
    return (
        f"its strongest eddy turned {turning} around x = {x}, z = {z}, with a stream function of "
        f"{psi}; "
    )


def crater(summary: dict[str, Any]) -> list[str]:
    """Crater and ejecta; nothing for a run without ablation."""
    found, ejecta = summary.get("crater"), summary.get("ejecta")
    if found is None or ejecta is None:
        return []
    if not ejecta["count"]:
        return ["Nothing was ablated."]
    # Size of the crater, then the ejecta and the energy that they took along.
    size = f"{quantity(found['depth_m'], 'm')} deep at the axis"
    if found["diameter_m"]:
        size += f" and {quantity(found['diameter_m'], 'm')} wide"
    share = 100.0 * ejecta["energy_J"] / max(summary["energy"]["absorbed_J"], 1e-300)
    return [
        f"The light left a crater {size}.",
        f"The ejecta left between {moment(summary, ejecta['start_s'])} and"
        f" {moment(summary, ejecta['end_s'])}, at {quantity(ejecta['speed_mean_m_s'], 'm/s', 3)} on"
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

    # Evaporation alone against the critical temperature.
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

    # Explosion of the metal, where its critical temperature is known.
    if explodes is None:
        parts.append("The material has no critical temperature to compare with.")
    elif hot is not None:
        word = "above" if hot > explodes else "below"
        parts.append(
            f"That is {word} the {quantity(explodes, 'K')} from which metal is expected to explode"
            " into vapor and drops"
            + (": take the computed depth as an estimate." if hot > explodes else ".")
        )

    # Recoil moves the melt already below.
    recoil = found["recoil_from_K"]
    if recoil is not None:
        parts.append(f"Recoil moves the melt from about {quantity(recoil, 'K')} on.")
    return [" ".join(parts)]
