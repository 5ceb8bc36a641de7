"""Heat and melting under interfering beams, 14 fluences [Demuth2020, Section 5, Figs. 2-4, 8, 9].

Steel at 0.4 ... 1.0 and aluminum at 0.6 ... 1.2 J/cm2 at the published spacing, without flow (which
changes widths and depths by about 1 nm and T by 3-6 K). Steel at 0.6 and aluminum at 1.0 J/cm2 are
judged against finite volumes; what only the paper has is shown. Sizes are whole cells: the
shortened run, of twice the spacing, is allowed one cell more.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lasersph.output import Run
from lasersph.plots import melt_pools, style, surface_temperatures
from lasersph.plots.arrangement import arrangement
from lasersph.validation.dlip_numbers import table_rows
from lasersph.validation.dlip_reference import METALS, PAPER, TIMES, VOLUMES, Metal
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, at_most, claimed, judged, shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TITLE = "Interference patterning of steel and aluminum, heat and melting: 14 fluences"
SPACING, QUICK_SPACING = 3.97, 8.0
"""[nm]"""
TEMPERATURE_TOLERANCE = 0.005
TIME_TOLERANCE = 0.2
PLATEAU_MARGIN = 1.0
"""[ns]: closer to an end of the plateau temperatures change too fast to be judged."""
IMBALANCE = 1e-6
EVENTS = (
    ("melting begins (f_m > 0)", "melt", "start_any_s"),
    ("first fluid (f_m = 1)", "melt", "start_s"),
    ("T_v reached", "vaporization", "start_s"),
    ("T_v left", "vaporization", "end_s"),
    ("last fluid", "melt", "end_s"),
    ("last mush", "melt", "end_any_s"),
)
LEVELS = (("f_m > 0", "_any"), ("f_m = 0.5", "_half"), ("f_m = 1", ""))


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """All fluences; `quick` computes steel at 0.6 J/cm2 with 8 nm only."""
    rows: list[Row] = []
    figures: list[Path] = []
    for label, metal in METALS.items():
        rows += table_rows(label, metal, quick=quick)
        fluences = metal.fluences
        if quick:
            fluences = (metal.reference_fluence,) if label == "steel" else ()
        spacing = QUICK_SPACING if quick else SPACING
        runs = {f: one_fluence(out_dir, metal, f, spacing) for f in fluences}
        for fluence, one in runs.items():
            rows += common_rows(f"{label} {fluence}", metal, one)
            if fluence == metal.reference_fluence:
                rows += reference_rows(f"{label} {fluence}", metal, one, spacing)
        if len(runs) > 1:
            rows += claims(label, metal, runs)
        if runs:
            figures += draw(out_dir, label, runs)
    if not quick:
        rows += step_rows(out_dir)
    remarks = (
        "fluence is the mean over the pattern, 2 Phi_0; the reading per beam melts 28 nm of steel",
        "T at the surface, by a parabola without slope there through the two uppermost particles",
    )
    return Report("dlip-thermal", TITLE, tuple(rows), tuple(figures), remarks, quick)


def one_fluence(
    out_dir: Path, metal: Metal, fluence: float, spacing: float, step: float = 50.0
) -> Run:
    """Run of a fluence [J/cm2] at a spacing [nm] with steps of at most `step` [ps]."""
    second = f'probes=[{{name="second", depth="{1.5 * spacing} nm", method="nearest"}}]'
    settings = [f"laser.fluence={fluence} J/cm^2", f"particles.spacing={spacing} nm",
                f"time.step={step} ps", second]  # fmt: skip
    label = f"{metal.case}-{fluence}-{spacing:g}nm-{step:g}ps"
    return computed(metal.case, settings, out_dir, label)


def at_times(one: Run) -> np.ndarray:
    """T of the surface at the maximum [K] at TIMES.

    T_1 + (T_1 - T_2) / 8: the parabola through the two uppermost particles with no slope at the
    surface, through which no heat flows; T_1 itself at T_v.
    """
    first, second = one.history["temperature_at_maximum_K"], one.history["probe_second_K"]
    boiling = one.summary["material"]["vaporization_K"]
    surface = np.where(first >= boiling * (1.0 - 1e-6), first, first + (first - second) / 8.0)
    return np.interp(1e-9 * np.array(TIMES), one.history["time_s"], np.minimum(surface, boiling))


def value(one: Run, section: str, key: str, factor: float) -> float | None:
    """Number of the summary times a factor; None where it is missing."""
    found = one.summary.get(section, {}).get(key)
    return None if found is None else factor * found


def reference_rows(label: str, metal: Metal, one: Run, spacing: float) -> list[Row]:
    """Temperatures, events and sizes against finite volumes."""
    rows = []
    ends = metal.events[2:4]
    for at, T, expected in zip(TIMES, at_times(one), metal.temperature, strict=True):
        name = f"{label}: T at the maximum, {at} ns"
        if min(abs(at - end) for end in ends) < PLATEAU_MARGIN:
            rows.append(shown(name, "K", float(T), reference=expected, source=VOLUMES))
        else:
            tolerance = TEMPERATURE_TOLERANCE * expected
            rows.append(judged(name, "K", float(T), expected, tolerance, source=VOLUMES))
    for (name, section, key), expected in zip(EVENTS, metal.events, strict=True):
        found = value(one, section, key, 1e9)
        rows.append(judged(f"{label}: {name}", "ns", found, expected, TIME_TOLERANCE,
                           source=VOLUMES))  # fmt: skip
    coarser = max(spacing - SPACING, 0.0)
    for k, (level, suffix) in enumerate(LEVELS):
        width = value(one, "melt", f"width{suffix}_max_m", 1e9)
        depth = value(one, "melt", f"depth{suffix}_max_m", 1e9)
        # half a period is computed: the width counts each cell twice
        rows.append(
            judged(f"{label}: largest width, {level}", "nm", width, metal.widths[k],
                   metal.width_tolerance + 2.0 * coarser, published=metal.published_width,
                   source=f"{VOLUMES}; {PAPER}, Section 6")
        )  # fmt: skip
        name, printed = f"{label}: largest depth, {level}", metal.published_depth
        source = f"{VOLUMES}; {PAPER}, Section 6"
        if suffix == "_half":
            tolerance = metal.depth_tolerance + coarser
            rows.append(judged(name, "nm", depth, metal.depths[k], tolerance, published=printed,
                               source=source))  # fmt: skip
        else:
            rows.append(shown(name, "nm", depth, published=printed, reference=metal.depths[k],
                              source=source))  # fmt: skip
    return rows


def common_rows(label: str, metal: Metal, one: Run) -> list[Row]:
    """What is shown of every fluence, and the energy balance."""
    imbalance = abs(one.summary["energy"]["imbalance_relative"])
    width, depth = (value(one, "melt", f"{q}_half_max_m", 1e9) for q in ("width", "depth"))
    duration = None
    begin, end = (value(one, "melt", key, 1e9) for key in ("start_any_s", "end_any_s"))
    if begin is not None and end is not None:
        duration = end - begin
    rows = [
        at_most(f"{label}: energy imbalance over absorbed", "1", imbalance, IMBALANCE),
        shown(f"{label}: highest T of the surface", "K", one.summary["temperature_max_K"],
              source=f"{PAPER}, Figs. 3, 8"),
        shown(f"{label}: melt lasts", "ns", duration, source=f"{PAPER}, Figs. 4, 9"),
        shown(f"{label}: largest width, f_m = 0.5", "nm", width, source=f"{PAPER}, Figs. 4, 9"),
        shown(f"{label}: largest depth, f_m = 0.5", "nm", depth, source=f"{PAPER}, Figs. 4, 9"),
    ]  # fmt: skip
    if width and depth:
        rows.append(shown(f"{label}: depth / width", "1", depth / width, published=metal.aspect,
                          source=f"{PAPER}, Section 5.2"))  # fmt: skip
    return rows


def claims(label: str, metal: Metal, runs: dict[float, Run]) -> list[Row]:
    """Statements of Section 5.2 over all fluences."""
    vapor = {f: value(one, "vaporization", "fraction_max", 1.0) for f, one in runs.items()}
    filled = {f for f, most in vapor.items() if (most or 0.0) >= 1.0 - 1e-9}
    reached = {f for f, one in runs.items() if value(one, "vaporization", "start_s", 1.0)}
    depths = [value(one, "melt", "depth_half_max_m", 1e9) or 0.0 for one in runs.values()]
    rows = [
        claimed(f"{label}: L_v is fully inserted from {metal.filled_from} J/cm2 on",
                filled == {f for f in runs if f >= metal.filled_from},
                source=f"{PAPER}, Section 5.2"),
        claimed(f"{label}: the pool grows with the fluence", bool(np.all(np.diff(depths) > 0.0)),
                source=f"{PAPER}, Figs. 4, 9"),
    ]  # fmt: skip
    if metal.vaporizes_from is not None:
        rows.append(
            claimed(f"{label}: T_v is reached at all fluences but the lowest",
                    reached == {f for f in runs if f >= metal.vaporizes_from},
                    source=f"{PAPER}, Section 5.2.1")
        )  # fmt: skip
    return rows


def step_rows(out_dir: Path) -> list[Row]:
    """Steps of 50 ps against 10 ps, steel 0.6 J/cm2, 8 nm."""
    metal = METALS["steel"]
    runs = [one_fluence(out_dir, metal, 0.6, QUICK_SPACING, step) for step in (50.0, 10.0)]
    long, short = (at_times(one) for one in runs)
    rows = [
        shown(f"steel 0.6: T at {at} ns, 50 ps steps (reference: 10 ps)", "K", float(a),
              reference=float(b), source="step study, spacing 8 nm")
        for at, a, b in zip(TIMES, long, short, strict=True)
    ]  # fmt: skip
    depths = [value(one, "melt", "depth_half_max_m", 1e9) for one in runs]
    rows.append(shown("steel 0.6: depth, 50 ps steps (reference: 10 ps)", "nm", depths[0],
                      reference=depths[1], source="step study, spacing 8 nm"))  # fmt: skip
    return rows


def draw(out_dir: Path, label: str, runs: dict[float, Run]) -> list[Path]:
    """Fig. 2 (particles), Figs. 3 and 8 (temperature), Figs. 4 and 9 (melt pool)."""
    numbers = {"steel": ("fig3", "fig4"), "aluminium": ("fig8", "fig9")}[label]
    ordered = list(runs.values())
    drawings: dict[str, Figure | None] = {
        f"{numbers[0]}-{label}-temperature": surface_temperatures(ordered),
        f"{numbers[1]}-{label}-melt-pool": melt_pools(ordered),
    }
    if label == "steel":
        drawings["fig2-particles"] = arrangement(ordered[0].snapshots[0])
    return [
        style.save(figure, out_dir / f"{name}.png") for name, figure in drawings.items() if figure
    ]
