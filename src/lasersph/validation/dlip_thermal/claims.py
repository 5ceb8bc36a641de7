"""Claims of Sections 5.2 and 6 of [Demuth2020] on temperatures and pools, held against our runs.

Claims in words; "distinctly", "moderate" and the like are read as stated in each row.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from lasersph.output import Run
from lasersph.validation.comparison import number_at
from lasersph.validation.study import Study

FILLED = 1.0 - 1e-9
"""Vapor fraction from which L_v counts as fully inserted."""
Runs = dict[float, Run]
"""By fluence [J/cm2]."""


def melt(one: Run, key: str) -> float:
    """Number of the melt pool [SI]; 0 where there is none."""
    return number_at(one.summary, f"melt.{key}") or 0.0


def grows(numbers: Sequence[float]) -> bool:
    """Whether every number exceeds the one before."""
    return all(later > earlier for earlier, later in pairwise(numbers))


def add_claims_of_metal(study: Study, label: str, metal: dict[str, Any], runs: Runs) -> None:
    """Statements of Section 5.2 over all fluences of a metal."""
    # Sizes, lifetimes and times of the largest sizes, in order of the fluence.
    ordered = list(runs.values())
    width, depth = ([melt(one, f"{q}_half_max_m") for one in ordered] for q in ("width", "depth"))
    lasts = [melt(one, "end_any_s") - melt(one, "start_any_s") for one in ordered]
    widest, deepest = ([melt(one, f"{q}_max_at_s") for one in ordered] for q in ("width", "depth"))
    # From which fluence L_v is filled in, and that everything grows.
    fraction = {f: number_at(one.summary, "vaporization.fraction_max") for f, one in runs.items()}
    filled = {f for f, found in fraction.items() if (found or 0.0) >= FILLED}
    lowest = metal["filled_from"]
    study.add("filled", filled == {f for f in runs if f >= lowest}, label=label, fluence=lowest)
    study.add("longer", grows(lasts), label=label)
    study.add("wider", grows(width), label=label)
    study.add("deeper", grows(depth), label=label)
    # Ratio of depth and width; width is largest before depth.
    low, high = metal["aspect_range"]
    holds = all(low <= d / w <= high for d, w in zip(depth, width, strict=True))
    study.add("aspect_range", holds, label=label, aspect=metal["aspect"], low=low, high=high)
    holds = all(first < last for first, last in zip(widest, deepest, strict=True))
    study.add("from_edges", holds, label=label)
    # From which fluence the metal boils, and up to which depth grows faster than width.
    lowest = metal.get("vaporizes_from")
    if lowest is not None:
        reached = {f for f, one in runs.items() if number_at(one.summary, "vaporization.start_s")}
        study.add("vaporizes", reached == {f for f in runs if f >= lowest}, label=label)
    highest = metal.get("distinct_up_to")
    if highest is not None:
        last = max(k for k, f in enumerate(runs) if f <= highest)
        holds = depth[last] / depth[0] > width[last] / width[0]
        study.add("distinct", holds, label=label, fluence=highest)


def add_claims_of_both(study: Study, runs: dict[str, Runs]) -> None:
    """Statements of Section 6 that compare the metals."""
    # How far temperatures spread over the fluences.
    ranges = {}
    for label, found in runs.items():
        ranges[label] = float(np.ptp([one.summary["temperature_max_K"] for one in found.values()]))
        study.add("range", ranges[label], label=label)
    study.add("range_claim", ranges["aluminium"] > ranges["steel"])
    # Sizes at fluences that both metals share.
    steel, aluminium = runs["steel"], runs["aluminium"]
    shared = [f for f in steel if f in aluminium and melt(aluminium[f], "width_half_max_m") > 0.0]
    for name, key in (("deeper_claim", "depth_half_max_m"), ("wider_claim", "width_half_max_m")):
        study.add(name, all(melt(aluminium[f], key) > melt(steel[f], key) for f in shared))
