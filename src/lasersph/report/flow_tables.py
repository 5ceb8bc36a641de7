"""The tables of a report that tell of a flow, from summary.json: rows of name and text."""

from __future__ import annotations

from typing import Any

from lasersph.report.numbers import entry, quantity, shown
from lasersph.report.tables import Rows

SPEED_HEAD = ("flow", "largest", "at")
EXTREMA_HEAD = ("extrema of the surface speed", "from", "to", "lasted", "fastest", "at")
LID_HEAD = ("flat surface", "pressure", "at", "x", "recoil pressure there")


def speeds(summary: dict[str, Any]) -> Rows:
    """Largest speeds and kinetic energy, and when."""
    flow = summary.get("flow")
    if flow is None:
        return []
    below, row = (quantity(flow.get(f"{name}_depth_m"), "m", 3) for name in ("below", "row"))
    names = {
        "surface_speed_max": "speed at the surface",
        "row_speed_max": f"horizontal speed of the first particles, {row} below",
        "below_speed_max": f"horizontal speed {below} below the fastest place of the surface",
        "return_speed_max": "horizontal speed against it",
        "speed_max": "speed of any particle",
    }
    rows: Rows = [
        (text, entry("_m_s", flow[f"{name}_m_s"]), entry("_s", flow[f"{name}_at_s"]))
        for name, text in names.items()
        if f"{name}_m_s" in flow
    ]
    energy = quantity(flow["kinetic_energy_max_J"], flow["kinetic_energy_unit"])
    rows.append(("kinetic energy", energy, entry("_s", flow["kinetic_energy_max_at_s"])))
    return rows


def layer(summary: dict[str, Any]) -> Rows:
    """The layer at the surface when it was fastest, and the estimates from it."""
    flow = summary.get("flow", {})
    if "estimate" not in flow:
        return []
    estimate = flow["estimate"]
    return [
        ("fastest place of the surface, x", entry("_m", flow["surface_speed_max_x_m"])),
        ("thickness of the layer that flows outward", entry("_m", flow["layer_thickness_m"])),
        ("mean gradient along the liquid surface", per_micrometer(estimate["gradient_mean_K_m"])),
        ("estimated speed, eq. (79)", entry("_m_s", estimate["speed_m_s"])),
        ("surface speed over this", entry("", estimate["surface_speed_over_estimate"])),
        ("estimated time to cross half the width, eq. (80)", entry("_s", estimate["time_s"])),
    ]


def extrema(summary: dict[str, Any]) -> Rows:
    """Inner and outer extremum of the surface speed."""
    found = summary.get("flow", {}).get("extrema")
    if found is None:
        return []

    def span(name: str) -> tuple[str, ...]:
        keys = ("start_s", "end_s", "lasted_s")
        return tuple(entry("_s", found[f"{name}_{key}"]) for key in keys)

    def fastest(name: str) -> tuple[str, ...]:
        speed = found[f"{name}_speed_max_m_s"] or None
        return entry("_m_s", speed), entry("_s", found[f"{name}_speed_max_at_s"])

    return [
        ("outer", "–", "–", "–", *fastest("outer")),
        ("inner", *span("inner"), *fastest("inner")),
        ("both at a time", *span("coexist"), "", ""),
        ("inner faster than outer", *span("inner_exceeds"), "", ""),
    ]


def lid(summary: dict[str, Any]) -> Rows:
    """Pressure of the flat surface beside the recoil pressure of a free one."""
    found = summary.get("lid")
    if found is None:
        return []
    return [
        (
            text,
            entry("_Pa", found[f"{name}_Pa"]),
            entry("_s", found[f"{name}_at_s"]),
            entry("_m", found[f"{name}_x_m"]),
            entry("_Pa", found[f"recoil_at_{name}_Pa"]),
        )
        for name, text in (("pressure_max", "largest"), ("pressure_min", "smallest"))
    ]


def soundness(summary: dict[str, Any]) -> Rows:
    """What says how good the computed flow is."""
    flow = summary.get("flow")
    if flow is None:
        return []
    return [
        ("flowing particles at most", f"{flow['particles_max']:,}".replace(",", " ")),
        ("smallest distance of two particles", entry("_m", flow["spacing_min_m"])),
        ("largest divergence of the velocity", entry("_1_s", flow["divergence_max_1_s"])),
        ("its largest root mean square", entry("_1_s", flow["divergence_rms_max_1_s"])),
    ]


def box(summary: dict[str, Any]) -> Rows:
    """Extrema on the center lines and of the stream function of a box, at the end."""
    found = summary.get("box")
    if found is None:
        return []
    rows: Rows = []
    for name, text in (("u", "u at half the width"), ("w", "w at half the height")):
        axis = "z" if name == "u" else "x"
        for which, word in (("max", "largest"), ("min", "smallest")):
            value = entry("_m_s", found["center"][f"{name}_{which}_m_s"])
            place = entry("_m", found["center"][f"{name}_{which}_at_{axis}_m"])
            rows.append((f"{word} {text}", value, f"{axis} = {place}"))
    for which, word in (("max", "largest"), ("min", "smallest")):
        psi = found["stream_function"]
        x, z = (entry("_m", psi[f"{which}_{axis}_m"]) for axis in "xz")
        value = entry("_m2_s", psi[f"{which}_m2_s"])
        rows.append((f"{word} stream function", value, f"x = {x}, z = {z}"))
    return rows


BOX_HEAD = ("box, at the end", "value", "where")


def walls(summary: dict[str, Any]) -> Rows:
    """Heat through the sides of a box."""
    heat = summary.get("box", {}).get("heat") or {}
    sides = [key.removeprefix("temperature_").removesuffix("_K") for key in heat]
    return [
        (
            side,
            entry("_K", heat[f"temperature_{side}_K"]),
            entry("_W_m2", heat[f"flux_{side}_W_m2"]),
            shown(heat[f"nusselt_{side}"]) if f"nusselt_{side}" in heat else "–",
        )
        for side in sides
        if f"temperature_{side}_K" in heat
    ]


WALLS_HEAD = ("side", "mean temperature", "mean heat flux into the box", "Nusselt number")


def dimensionless(summary: dict[str, Any]) -> Rows:
    """The dimensionless numbers of the case."""
    numbers = summary.get("dimensionless", {}).get("numbers", {})
    return [(str(NAMES.get(name, name)), shown(value)) for name, value in numbers.items()]


NAMES: dict[str, str] = {
    "Fo": "Fourier number Fo",
    "La": "laser number La",
    "Ph_solid_liquid": "phase change number of melting",
    "Ph_liquid_vapor": "phase change number of vaporization",
    "Pr": "Prandtl number Pr",
    "Ra": "Rayleigh number Ra",
    "Ma": "Marangoni number Ma",
    "Re": "Reynolds number Re",
}


def per_micrometer(value: float) -> str:
    """A gradient in K/µm."""
    return f"{shown(value * 1e-6)} K/µm"
