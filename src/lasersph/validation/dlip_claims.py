"""What Sections 5.2 and 6 of [Demuth2020] say of temperatures and pools, held against our runs.

Claims in words; "distinctly", "moderate" and the like are read as stated in each row.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from lasersph.output import Run
from lasersph.validation.dlip_reference import PAPER, Metal
from lasersph.validation.verdict import Row, claimed, shown

POOLS = f"{PAPER}, Section 5.2, Figs. 4, 9"
FILLED = 1.0 - 1e-9


def value(one: Run, section: str, key: str, factor: float) -> float | None:
    """Number of the summary times a factor; None where it is missing."""
    found = one.summary.get(section, {}).get(key)
    return None if found is None else factor * found


def melt(one: Run, key: str) -> float:
    """Number of the melt pool [SI]; 0 where there is none."""
    return value(one, "melt", key, 1.0) or 0.0


def grows(numbers: list[float]) -> bool:
    """Whether every number exceeds the one before."""
    return all(later > earlier for earlier, later in pairwise(numbers))


def one_metal(label: str, metal: Metal, runs: dict[float, Run]) -> list[Row]:
    """Statements of Section 5.2 over all fluences of a metal."""
    filled = {f for f, one in runs.items()
              if (value(one, "vaporization", "fraction_max", 1.0) or 0.0) >= FILLED}  # fmt: skip
    ordered = list(runs.values())
    width, depth = ([melt(one, f"{q}_half_max_m") for one in ordered] for q in ("width", "depth"))
    lasts = [melt(one, "end_any_s") - melt(one, "start_any_s") for one in ordered]
    first, last = ([melt(one, f"{q}_max_at_s") for one in ordered] for q in ("width", "depth"))
    ratios = [d / w for d, w in zip(depth, width, strict=True)]
    low, high = metal.aspect_range
    rows = [
        claimed(f"{label}: L_v is fully inserted from {metal.filled_from} J/cm2 on",
                filled == {f for f in runs if f >= metal.filled_from}, source=POOLS),
        claimed(f"{label}: the pool lasts longer the higher the fluence", grows(lasts),
                source=POOLS),
        claimed(f"{label}: the pool is wider the higher the fluence", grows(width), source=POOLS),
        claimed(f"{label}: the pool is deeper the higher the fluence", grows(depth), source=POOLS),
        claimed(f"{label}: depth / width {metal.aspect} (read as {low} to {high})",
                all(low <= ratio <= high for ratio in ratios), source=POOLS),
        claimed(f"{label}: it solidifies from the edges (widest before deepest)",
                all(a < b for a, b in zip(first, last, strict=True)), source=POOLS),
    ]  # fmt: skip
    if metal.vaporizes_from is not None:
        reached = {f for f, one in runs.items() if value(one, "vaporization", "start_s", 1.0)}
        rows.append(
            claimed(f"{label}: T_v is reached at all fluences but the lowest",
                    reached == {f for f in runs if f >= metal.vaporizes_from},
                    source=f"{PAPER}, Section 5.2.1")
        )  # fmt: skip
    if metal.distinct_up_to is not None:
        upper = [f for f in runs if f <= metal.distinct_up_to]
        by_width, by_depth = (_relative_growth(dict(zip(runs, sizes, strict=True)), upper)
                              for sizes in (width, depth))  # fmt: skip
        rows.append(
            claimed(f"{label}: up to {metal.distinct_up_to} J/cm2 the depth grows in a larger "
                    "ratio than the width", by_depth > by_width,
                    source=f"{PAPER}, Section 5.2.1")
        )  # fmt: skip
    return rows


def _relative_growth(sizes: dict[float, float], fluences: list[float]) -> float:
    return sizes[fluences[-1]] / sizes[fluences[0]]


def both_metals(runs: dict[str, dict[float, Run]]) -> list[Row]:
    """Statements of Section 6 that compare the metals."""
    steel, aluminium = runs["steel"], runs["aluminium"]
    spread = {label: np.ptp([one.summary["temperature_max_K"] for one in found.values()])
              for label, found in runs.items()}  # fmt: skip
    shared = [f for f in steel if f in aluminium and melt(aluminium[f], "width_half_max_m") > 0.0]
    source = f"{PAPER}, Section 6"
    rows = [
        shown(f"{label}: spread of the highest T over the fluences", "K", float(spread[label]),
              source=source)
        for label in runs
    ]  # fmt: skip
    return [
        *rows,
        claimed("the highest T depends more on the fluence in aluminium than in steel",
                bool(spread["aluminium"] > spread["steel"]), source=source),
        claimed("at the same fluence the pool of aluminium is deeper",
                all(melt(aluminium[f], "depth_half_max_m") > melt(steel[f], "depth_half_max_m")
                    for f in shared), source=source),
        claimed("at the same fluence the pool of aluminium is wider",
                all(melt(aluminium[f], "width_half_max_m") > melt(steel[f], "width_half_max_m")
                    for f in shared), source=source),
    ]  # fmt: skip
