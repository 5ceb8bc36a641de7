"""Melt pools that flow under interfering beams [Demuth2020, Section 5.2, Figs. 3-12].

For one metal: every fluence in both readings of the vaporization plateau (`hold`, `clip`), the
fluence that the paper follows in detail also without Marangoni stress, and the experiment of
Fig. 12 at its own period. Judged against finite volumes: velocities, place and layer at 57 ns of
that fluence, the size of the pool against the run without flow, and energy. What only the paper has
is shown. Runs take minutes to an hour each; they are kept and continued (`runs.computed`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.observers.interpolation import interpolate
from lasersph.output import Run
from lasersph.validation.dlip_flow_reference import FLOWS, INSTANT, PAPER, VOLUMES, Flow
from lasersph.validation.dlip_reference import METALS, Metal
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, at_most, claimed, judged, shown

SPEED_TOLERANCE = 0.05
PLACE_TOLERANCE = 0.05
"""[um]"""
LAYER_TOLERANCE = 0.1
PROFILE_TOLERANCE = 0.05
"""Of the largest speed."""
IMBALANCE = 1e-4
PLATEAUS = ("hold", "clip")
PROFILE_TIMES = (50.0, 52.0, 54.0, 55.0, 56.0, 57.0, 58.0, 59.0, 60.0, 62.0, 65.0)
"""[ns] of snapshots from which profiles are drawn."""


@dataclass(frozen=True)
class Plan:
    """Which runs are made.

    Attributes:
        fluences: [J/cm2]. detail_spacing: [nm] at the detailed fluence with `hold`, with and
            without Marangoni stress. spacing: [nm] of all others. plateaus: readings computed.
        end: [ns]. experiment: whether Fig. 12 is computed. share: tolerances over those in full.
    """

    fluences: tuple[float, ...]
    detail_spacing: float
    spacing: float
    plateaus: tuple[str, ...] = PLATEAUS
    end: float = 200.0
    experiment: bool = True
    share: float = 1.0


Runs = dict[tuple[float, str], Run]


def run_all(label: str, plan: Plan, out_dir: Path) -> tuple[list[Row], Runs, Run]:
    """Rows, the runs by fluence [J/cm2] and plateau, and the detailed one without stress."""
    metal, flow = METALS[label], FLOWS[label]
    runs: Runs = {}
    rows: list[Row] = []
    for plateau in plan.plateaus:
        for fluence in plan.fluences:
            one = run_one(out_dir, metal, plan, fluence, plateau)
            runs[fluence, plateau] = one
            rows += common_rows(f"{fluence} {plateau}", one)
    detail = runs[flow.fluence, "hold"]
    still = run_one(out_dir, metal, plan, flow.fluence, "hold", marangoni=False)
    rows += detail_rows(f"{flow.fluence} hold", flow, detail, plan)
    rows += size_rows(f"{flow.fluence} hold", flow, detail, still, plan)
    rows += paper_rows(f"{flow.fluence} hold", flow, detail)
    if len(plan.fluences) > 1:
        rows += claims(label, runs, plan.fluences)
    if plan.experiment:
        rows += experiment_rows(out_dir, metal, flow, plan)
    return rows, runs, still


def run_one(
    out_dir: Path,
    metal: Metal,
    plan: Plan,
    fluence: float,
    plateau: str,
    *,
    marangoni: bool = True,
    more: tuple[str, ...] = (),
) -> Run:
    """Run at a fluence [J/cm2] in a folder named after it."""
    detailed = plateau == "hold" and fluence == FLOWS_BY_CASE[metal.case].fluence and not more
    spacing = plan.detail_spacing if detailed else plan.spacing
    times = ", ".join(f'"{t:g} ns"' for t in PROFILE_TIMES if t <= plan.end)
    settings = [
        "solver.kind=melt-pool",
        f"laser.fluence={fluence} J/cm^2",
        f"particles.spacing={spacing} nm",
        f"solver.plateau={plateau}",
        f"time.end={plan.end:g} ns",
        f"output.snapshots.times=[{times}]",
        *more,
    ]
    label = f"{metal.case}-{fluence}-{plateau}-{spacing:g}nm"
    if not marangoni:
        settings.append("solver.marangoni=false")
        label += "-still"
    if more:
        label += "-fig12"
    return computed(metal.case, settings, out_dir, label)


FLOWS_BY_CASE = {METALS[label].case: flow for label, flow in FLOWS.items()}


def number(one: Run, path: str, factor: float = 1.0) -> float | None:
    """Number of the summary by its path "flow.speed_max_m_s", times a factor; None without."""
    found: Any = one.summary
    for key in path.split("."):
        found = found.get(key) if isinstance(found, Mapping) else None
    return None if found is None else factor * float(found)


def at_instant(one: Run, column: str) -> float:
    """Value of a history column at INSTANT; None where the run ends before."""
    return float(np.interp(INSTANT * 1e-9, one.history["time_s"], one.history[column]))


def profile_below(one: Run, x: float, depths: np.ndarray) -> np.ndarray:
    """Horizontal velocity [m/s] at depths (m,) [m] below a place x [m] at INSTANT, (m,)."""
    step = one.snapshots.nearest(INSTANT * 1e-9)
    near = np.abs(step["position"][0] - x) < 12.0 * np.min(step["width"])
    places = np.stack([np.full(depths.size, x), -depths])
    return interpolate(step["position"][:, near], step["velocity"][0, near], places)


def common_rows(label: str, one: Run) -> list[Row]:
    """What is shown of every run, and its energy balance."""
    least = number(one, "flow.spacing_min_m", 1.0 / one.summary["spacing_m"])
    source = f"{PAPER}, Figs. 5, 7, 10"
    imbalance = abs(one.summary["energy"]["imbalance_relative"])
    shows = (
        ("largest speed of the surface", "m/s", "flow.surface_speed_max_m_s", 1.0),
        ("when", "ns", "flow.surface_speed_max_at_s", 1e9),
        ("largest |u| of the uppermost particles", "m/s", "flow.row_speed_max_m_s", 1.0),
        ("outer extremum, largest", "m/s", "flow.extrema.outer_speed_max_m_s", 1.0),
        ("inner extremum, largest", "m/s", "flow.extrema.inner_speed_max_m_s", 1.0),
        ("inner extremum exists for", "ns", "flow.extrema.inner_lasted_s", 1e9),
        ("inner extremum is faster for", "ns", "flow.extrema.inner_exceeds_lasted_s", 1e9),
        ("largest width, f_m = 1", "nm", "melt.width_max_m", 1e9),
        ("largest depth, f_m = 1", "nm", "melt.depth_max_m", 1e9),
        ("largest pressure of the lid", "MPa", "lid.pressure_max_Pa", 1e-6),
        ("recoil pressure there", "MPa", "lid.recoil_at_pressure_max_Pa", 1e-6),
    )
    rows = [
        at_most(f"{label}: energy imbalance over absorbed", "1", imbalance, IMBALANCE),
        shown(f"{label}: least distance of two particles over the spacing", "1", least),
    ]
    rows += [shown(f"{label}: {name}", unit, number(one, path, factor), source=source)
             for name, unit, path, factor in shows]  # fmt: skip
    return rows


def detail_rows(label: str, flow: Flow, one: Run, plan: Plan) -> list[Row]:
    """Velocities, place and layer against finite volumes."""
    rows = []
    tolerance = plan.share * SPEED_TOLERANCE
    speed, when = flow.largest
    name = f"{label}, {INSTANT:g} ns"
    rows += [
        judged(f"{label}: largest speed of the surface", "m/s",
               number(one, "flow.surface_speed_max_m_s"), speed, tolerance * speed, source=VOLUMES),
        shown(f"{label}: when", "ns", number(one, "flow.surface_speed_max_at_s", 1e9),
              reference=when, source=VOLUMES),
        judged(f"{name}: speed of the surface", "m/s",
               at_instant(one, "flow_surface_speed_max_m_s"), flow.surface,
               tolerance * flow.surface, source=VOLUMES),
        judged(f"{name}: return flow", "m/s", at_instant(one, "flow_return_speed_m_s"), flow.back,
               2.0 * tolerance * flow.back, source=VOLUMES),
    ]  # fmt: skip
    x = at_instant(one, "flow_surface_speed_max_x_m")
    row_below = float(profile_below(one, x, np.array([3.97e-9]))[0])
    rows.append(judged(f"{name}: speed 3.97 nm below the surface", "m/s", row_below, flow.below,
                       tolerance * flow.below, source=VOLUMES))  # fmt: skip
    layer = at_instant(one, "flow_layer_thickness_m") * 1e9
    if flow.place is None or flow.layer is None:
        rows += [
            shown(f"{name}: place of the largest speed", "um", 1e6 * x),
            shown(f"{name}: thickness of the outward layer", "nm", layer,
                  published=flow.paper_layer, source=f"{PAPER}, Section 6"),
        ]  # fmt: skip
        return rows
    rows += [
        judged(f"{name}: place of the largest speed", "um", 1e6 * x, flow.place,
               plan.share * PLACE_TOLERANCE, source=VOLUMES),
        judged(f"{name}: thickness of the outward layer", "nm", layer, flow.layer,
               plan.share * LAYER_TOLERANCE * flow.layer, published=flow.paper_layer,
               source=f"{VOLUMES}; {PAPER}, Section 6"),
    ]  # fmt: skip
    depths = np.array([depth for depth, _ in flow.profile])
    values = profile_below(one, x, 1e-9 * depths)
    allowed = plan.share * PROFILE_TOLERANCE * flow.surface
    rows += [
        judged(f"{name}: u {depth:g} nm below that place", "m/s", float(value), expected, allowed,
               source=VOLUMES)
        for (depth, expected), value in zip(flow.profile, values, strict=True)
    ]  # fmt: skip
    return rows


def size_rows(label: str, flow: Flow, one: Run, still: Run, plan: Plan) -> list[Row]:
    """Largest width and depth against those of the same run without Marangoni stress."""
    rows = []
    for level, suffix in (("f_m = 1", ""), ("f_m = 0.5", "_half")):
        for quantity in ("width", "depth"):
            path = f"melt.{quantity}{suffix}_max_m"
            reference = number(still, path, 1e9) or np.nan
            rows.append(
                judged(f"{label}: largest {quantity}, {level}, against no flow", "nm",
                       number(one, path, 1e9), reference, plan.share * flow.size_tolerance,
                       source="same run without Marangoni stress")
            )  # fmt: skip
    return rows


def paper_rows(label: str, flow: Flow, one: Run) -> list[Row]:
    """Numbers that only the text of the paper has."""
    gradient = 1e-6 * at_instant(one, "flow_gradient_mean_K_m")
    estimate = at_instant(one, "flow_estimate_m_s")
    speed = at_instant(one, "flow_surface_speed_max_m_s")
    period = one.case["domain"]["width"]
    name, source = f"{label}, {INSTANT:g} ns", f"{PAPER}, Section 6"
    rows = [
        shown(f"{name}: mean |dT/dx| of the surface", "K/um", gradient, published=flow.gradient,
              source=source),
        shown(f"{name}: estimate (79)", "m/s", estimate, published=flow.estimate, source=source),
        shown(f"{name}: estimate (80)", "ns", 0.5e9 * period / estimate if estimate else None,
              published=flow.estimate_time, source=source),
        shown(f"{name}: speed of the surface over (79)", "1",
              speed / estimate if estimate else None, published=flow.surface_over_estimate,
              source=source),
        shown(f"{name}: speed of the surface", "m/s", speed,
              published=round(flow.estimate * flow.surface_over_estimate, 2), source=source),
    ]  # fmt: skip
    rows += [
        shown(f"{label}: {what}", unit, number(one, f"flow.extrema.{key}", factor),
              published=published, source=f"{PAPER}, Section 5.2")
        for what, unit, published, key, factor in flow.sayings
    ]  # fmt: skip
    return rows


def claims(label: str, runs: Runs, fluences: tuple[float, ...]) -> list[Row]:
    """Statements of the text over all fluences, by `hold`."""
    speeds = [number(runs[f, "hold"], "flow.surface_speed_max_m_s") or 1e-3 for f in fluences]
    power = float(np.polyfit(np.log(fluences), np.log(speeds), 1)[0])
    source = f"{PAPER}, Section 5.2"
    rows = [claimed(f"speeds grow superlinearly with the fluence (here as its power {power:.2f})",
                    power > 1.0, source=source)]  # fmt: skip
    if label == "aluminium":
        moderate = max(speeds[: len(speeds) // 2 + 1])
        rows.append(claimed("speeds beyond 10 m/s even at moderate fluences (here below or at "
                            f"{fluences[len(fluences) // 2]} J/cm2)", moderate > 10.0,
                            source=source))  # fmt: skip
    else:
        inner, outer = (
            number(runs[fluences[-1], "hold"], f"flow.extrema.{name}_speed_max_m_s") or 0.0
            for name in ("inner", "outer")
        )
        first = number(runs[fluences[0], "hold"], "flow.extrema.inner_lasted_s") or 0.0
        rows += [
            claimed("inner extrema dominate at elevated fluences", inner > outer, source=source),
            claimed("there is none at the lowest fluence", first == 0.0, source=source),
        ]
    return rows


def experiment_rows(out_dir: Path, metal: Metal, flow: Flow, plan: Plan) -> list[Row]:
    """The measurements of Fig. 12 beside runs at their period and fluence."""
    period, fluence, measured = flow.experiment
    more = (f'laser.beam={{kind="interference", period="{period} um"}}',
            f"domain.width={period} um", "probes=[]")  # fmt: skip
    name = f"period {period} um, {fluence} J/cm2"
    rows = []
    for plateau in plan.plateaus:
        one = run_one(out_dir, metal, plan, fluence, plateau, more=more)
        rows += [
            shown(f"{name}, {plateau}: {what}", unit, number(one, f"melt.{key}", factor),
                  published=published, source=f"{PAPER}, Fig. 12")
            for what, unit, published, key, factor in measured
        ]  # fmt: skip
    return rows
