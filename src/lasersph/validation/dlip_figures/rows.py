"""Statements of [Demuth2020] on its Figs. 3 to 11, held against flowing pools of both metals."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from lasersph.output import Run
from lasersph.plots import (
    melt_pools,
    speed_extrema,
    surface_flow_profiles,
    surface_speeds,
    surface_temperatures,
)
from lasersph.validation.comparison import Words, number_at
from lasersph.validation.study import Study

HOLD, CLIP = "hold", "clip"
Runs = dict[float, Run]
"""By fluence [J/cm2]."""
Readings = dict[tuple[str, str], Runs]
"""By metal and reading of the plateau."""
INNER, OUTER = "flow.extrema.inner_speed_max_m_s", "flow.extrema.outer_speed_max_m_s"


class Printed(NamedTuple):
    """A number of the text at `detail`.

    Attributes:
        what, unit: its words. value: printed. band: with more heat, in the unit.
    """

    what: str
    unit: str
    value: float
    band: float


PRINTED = {
    "inner": Printed("largest inner extremum", "m/s", 4.0, 0.5),
    "outer": Printed("largest outer extremum", "m/s", 3.5, 0.35),
    "coexist": Printed("both extrema exist for", "ns", 4.0, 1.0),
    "exceeds": Printed("the inner one is faster for", "ns", 1.7, 0.85),
    "gradient": Printed("mean |dT/dx| at 57 ns", "K/um", 1240.0, 124.0),
    "surface": Printed("speed at 57 ns", "m/s", 3.49, 0.35),
    "steepest": Printed("steepest |dT/dx| beside the plateau", "K/um", 3000.0, 1500.0),
}
"""The inner extremum "reaches 4 m/s", the outer is "not much higher than 3.5", both "coexist for
more than 4 ns", gradients are "several 1000 K/um": read as 1500 to 4500."""


def compare(study: Study) -> None:
    """Every fluence of both metals, in both readings of the plateau where they differ."""
    plan = study.plan
    runs: Readings = {}
    # Both readings of the plateau differ only where heat of vaporization is filled in.
    for label, metal in plan.metals.items():
        runs[label, HOLD] = {f: run_pool(study, metal, f, HOLD) for f in metal["fluences"]}
        runs[label, CLIP] = {
            f: run_pool(study, metal, f, CLIP) if f in metal["filled"] else one
            for f, one in runs[label, HOLD].items()
        }
        add_pools(study, label, metal, runs)
    add_speeds(study, runs)
    add_elevated(study, runs)
    # Details of Figs. 6, 7 and 11 need the finest runs.
    if plan.is_whole:
        heated = add_detail(study, runs["steel", HOLD])
        add_aluminium(study, runs["aluminium", HOLD])
        pair = [runs["steel", HOLD][plan.detail], heated]
        study.save("fig7a-extrema", speed_extrema(pair[1:]))
        study.save("fig6-more-heat", surface_flow_profiles(heated, times_of(study, heated)))
        study.save("fig7b-extrema", speed_extrema([runs["steel", CLIP][plan.elevated]]))
    draw(study, runs)


def run_pool(study: Study, metal: dict[str, Any], fluence: float, plateau: str) -> Run:
    """Run of a metal at a fluence [J/cm2] with a reading of the plateau."""
    times = ", ".join(f'"{t:g} ns"' for t in study.plan.profile_times if t <= study.plan.end)
    return study.run(
        f"{metal['case']}-{fluence:g}-{plateau}-{metal['spacing']:g}nm",
        f"laser.fluence={fluence} J/cm^2",
        f"particles.spacing={metal['spacing']} nm",
        f"solver.plateau={plateau}",
        f"time.end={study.plan.end:g} ns",
        f"output.snapshots.times=[{times}]",
        case=metal["case"],
    )


def number(one: Run, path: str, factor: float = 1.0) -> float:
    """Number of a summary; 0 where there is none."""
    return number_at(one.summary, path, factor) or 0.0


def at_instant(study: Study, one: Run, column: str) -> float:
    """Value of a history column at the instant of Section 6."""
    return float(np.interp(1e-9 * study.plan.instant, one.history["time_s"], one.history[column]))


def add_pools(study: Study, label: str, metal: dict[str, Any], runs: Readings) -> None:
    """Sizes and their ratio, and where T_v is reached."""
    # Sizes at one fluence, then depth over width at all.
    if study.plan.is_whole:
        fluence = metal["sized"]
        for plateau in (HOLD, CLIP):
            words: Words = {"label": label, "fluence": fluence, "plateau": plateau}
            for size in ("width", "depth"):
                if size in metal:
                    found = number(runs[label, plateau][fluence], f"melt.{size}_max_m", 1e9)
                    given: Words = {"published": metal[size], "share": metal[f"{size}_band"]}
                    study.add(size, found, metal[size], **given, **words)
        ratios = [
            number(one, "melt.depth_max_m") / number(one, "melt.width_max_m")
            for one in runs[label, HOLD].values()
        ]
        low, high = min(ratios), max(ratios)
        lowest, highest = metal["aspect_range"]
        words = {"low": low, "high": high, "lowest": lowest, "highest": highest}
        holds = lowest <= low and high <= highest
        study.add("aspect", holds, label=label, aspect=metal["aspect"], **words)
    # T_v is reached from the second fluence on.
    if label == "steel":
        start = "vaporization.start_s"
        reached = {f for f, one in runs[label, HOLD].items() if number(one, start) > 0.0}
        study.add("vaporizes", reached == set(metal["fluences"][1:]), label=label)


def add_speeds(study: Study, runs: Readings) -> None:
    """Speeds over the fluences, and those of aluminium over those of steel."""
    # Speeds rise more than in proportion to the fluence: their power in a log-log fit.
    distinct = [key for key in runs if key[1] == HOLD or study.plan.metals[key[0]]["filled"]]
    for label, plateau in distinct:
        found = runs[label, plateau]
        power = np.polyfit(np.log(list(found)), np.log(speeds(found)), 1)[0]
        study.add("superlinear", power > 1.0, label=label, plateau=plateau, power=float(power))

    # Aluminum: more than 10 m/s at the middle fluence.
    aluminium = runs["aluminium", HOLD]
    middle = list(aluminium)[len(aluminium) // 2]
    speed = speeds(aluminium)[list(aluminium).index(middle)]
    study.add("beyond", speed > 10.0, speed=speed, fluence=middle)

    # Aluminum over steel at equal fluences, and how far speeds spread.
    for plateau in (HOLD, CLIP):
        steel, metal = runs["steel", plateau], runs["aluminium", plateau]
        ratios = [a / s for a, s in zip(speeds(metal), speeds(steel), strict=True)]
        row = "twice_clip" if plateau == CLIP else "twice"
        study.add(row, min(ratios) >= 2.0, plateau=plateau, least=min(ratios))
        for fluence in (f for f in steel if f in metal):
            ratio = speed_of(metal[fluence]) / speed_of(steel[fluence])
            study.add("times", ratio, fluence=fluence, plateau=plateau)
        row = "sensitive_clip" if plateau == CLIP else "sensitive"
        spreads = [float(np.ptp(speeds(found))) for found in (metal, steel)]
        words = {"plateau": plateau, "metal": spreads[0], "steel": spreads[1]}
        study.add(row, spreads[0] > spreads[1], **words)
        # The inner extremum appears late, from the second fluence on.
        inner = [f for f, one in steel.items() if risen(one)]
        holds = inner == list(steel)[1:]
        study.add("late", holds, plateau=plateau, lowest=min(inner, default=float("nan")))

    # Temperatures of aluminum spread more than those of steel.
    warmest = [
        [number(one, "temperature_max_K") for one in runs[label, HOLD].values()]
        for label in ("aluminium", "steel")
    ]
    metal, steel = (float(np.ptp(found)) for found in warmest)
    study.add("hotter", metal > steel, metal=metal, steel=steel)


def speed_of(one: Run) -> float:
    """Largest speed of the surface [m/s]."""
    return number(one, "flow.surface_speed_max_m_s")


def speeds(runs: Runs) -> list[float]:
    """Largest speeds of the surface [m/s], in order of the fluence."""
    return [speed_of(one) for one in runs.values()]


def risen(one: Run) -> bool:
    """Whether an inner extremum exceeds the outer one, and begins after 55 ns."""
    start = number_at(one.summary, "flow.extrema.inner_start_s", 1e9)
    return start is not None and start > 55.0 and number(one, INNER) > number(one, OUTER)


def add_detail(study: Study, steel: Runs) -> Run:
    """Steel at the fluence of Figs. 6 and 7a: shown; with more heat: judged.

    Returns:
        The run with more heat.
    """
    plan = study.plan
    # The same pool with a little more heat, for which the bands are given.
    fluence = plan.detail * plan.more_heat
    heated = run_pool(study, plan.metals["steel"], fluence, HOLD)
    for one, found in ((steel[plan.detail], plan.detail), (heated, fluence)):
        judge = one is heated
        for key, value in details(study, one).items():
            printed = PRINTED[key]
            words: Words = {"fluence": found, "what": printed.what, "unit": printed.unit}
            share = printed.band if judge else 1.0
            row = "heated" if judge else "printed"
            given: Words = {"published": printed.value, "share": share}
            study.add(row, value, printed.value, **given, **words)
    study.add("late_heated", risen(heated), fluence=fluence)
    return heated


def details(study: Study, one: Run) -> dict[str, float]:
    """Numbers of `PRINTED` of a run."""
    extrema = "flow.extrema."
    return {
        "inner": number(one, INNER),
        "outer": number(one, OUTER),
        "coexist": number(one, f"{extrema}coexist_lasted_s", 1e9),
        "exceeds": number(one, f"{extrema}inner_exceeds_lasted_s", 1e9),
        "gradient": 1e-6 * at_instant(study, one, "flow_gradient_mean_K_m"),
        "surface": at_instant(study, one, "flow_surface_speed_max_m_s"),
        "steepest": 1e-6
        * max(
            float(np.max(np.abs(step["surface_gradient"][step["surface"] > 0])))
            for step in one.snapshots
        ),
    }


def add_elevated(study: Study, runs: Readings) -> None:
    """Fig. 7b: the inner extremum takes over, the outer one vanishes."""
    fluence = study.plan.elevated
    for plateau in (HOLD, CLIP):
        one = runs["steel", plateau][fluence]
        words: Words = {"fluence": fluence, "plateau": plateau}
        time = one.history["time_s"]
        # When the inner extremum appears, exceeds the outer one, and outlives it.
        inner, outer = (one.history[f"flow_{name}_speed_m_s"] for name in ("inner", "outer"))
        # where an outer one does not count beside it, the inner one exceeds it, too
        exists, exceeds = time[inner > 0.0], time[inner > outer]
        after = 1e9 * float(exceeds[0] - exists[0]) if exceeds.size else None
        study.add("emerges", after, **words)
        last = time[outer > 0.0]
        vanishes = bool(exists.size and last.size and last[-1] < exists[-1])
        study.add("vanishes", vanishes, **words)


def add_aluminium(study: Study, runs: Runs) -> None:
    """Fig. 11 and the numbers of Section 6."""
    fluence = study.plan.metals["aluminium"]["sized"]
    # Extrema, gradient and speed at the instant of Section 6.
    one, instant = runs[fluence], study.plan.instant
    ratio = number(one, INNER) / number(one, OUTER)
    study.add("separate", ratio, fluence=fluence, plateau=HOLD)
    gradient = 1e-6 * at_instant(study, one, "flow_gradient_mean_K_m")
    study.add("gradient", gradient, fluence=fluence, time=instant)
    speed = at_instant(study, one, "flow_surface_speed_max_m_s")
    study.add("surface", speed, fluence=fluence, time=instant)


def times_of(study: Study, one: Run) -> list[float]:
    """Times [s] of profiles that a run reached."""
    end = one.summary["time_s"]
    return [1e-9 * t for t in study.plan.profile_times if 1e-9 * t <= end]


def draw(study: Study, runs: Readings) -> None:
    """Figs. 3-6 of steel and 8-11 of aluminium, by `clip` where the readings differ."""
    for label, metal in study.plan.metals.items():
        temperature, pool, speed, profiles = metal["figures"]
        # Curves of the reading that differs, profiles of the other.
        found = list(runs[label, CLIP].values())
        study.save(f"{temperature}-temperature", surface_temperatures(found))
        study.save(f"{pool}-melt-pool", melt_pools(found))
        study.save(f"{speed}-speed", surface_speeds(found, column="flow_below_speed_m_s"))
        one = runs[label, HOLD][metal.get("sized", metal["fluences"][0])]
        if label == "steel" and study.plan.detail in runs[label, HOLD]:
            one = runs[label, HOLD][study.plan.detail]
        study.save(f"{profiles}-profiles", surface_flow_profiles(one, times_of(study, one)))
