"""A flow in plain sentences, from summary.json alone."""

from __future__ import annotations

from typing import Any

from lasersph.report.numbers import quantity, shown


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
    heat = box["heat"]
    numbers = {key: value for key, value in heat.items() if key.startswith("nusselt_")}
    if numbers:
        sides = " and ".join(
            f"{shown(value)} ({key.removeprefix('nusselt_')})" for key, value in numbers.items()
        )
        found.append(f"Nusselt numbers: {sides}.")
    return found
