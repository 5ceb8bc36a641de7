"""Warnings of a run, to be read before its numbers are used: sentences as they follow "warning: ",
with a small first letter and no full stop.

Those that come before the first step (`lasersph check` says the same) stand among the events of the
run folder. Those that the run itself has found follow from its summary. Both are kept under
`warnings` in summary.json, where the terminal, the report and the page in a browser find them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from lasersph.input import format_number, format_quantity
from lasersph.observers.energy_budget import (
    IMBALANCE_ALLOWED,
    IMBALANCE_ALLOWED_WITH_FLOW,
    NUMERICAL,
    NUMERICAL_ALLOWED,
    TERMS,
)
from lasersph.observers.vaporization import NEAR_CRITICAL
from lasersph.output.history import WARNING


def event_warnings(events: Iterable[Mapping[str, Any]]) -> list[str]:
    """Warnings among the events of a run, each once, in their order."""
    found = (str(one["message"]) for one in events if one["event"] == WARNING and "message" in one)
    return list(dict.fromkeys(found))


def found_warnings(summary: Mapping[str, Any], last: Mapping[str, Any] | None = None) -> list[str]:
    """Warnings that follow from the results of a run.

    Args:
        summary: content of summary.json.
        last: row of history.csv of the last step, where it is at hand: tells how deep melt was.
    """
    return [
        *_energy(summary),
        *_near_critical(summary.get("vaporization", {})),
        *_held_at_boiling(summary),
        *_thin_melt(summary),
        *_resting_melt(summary),
        *_still_molten(summary, last or {}),
    ]


def energy_moved(energy: Mapping[str, Any]) -> float:
    """Largest energy absorbed, lost and held during a run [J].

    Older summaries do not hold it: what was stored at the end stands for it there.
    """
    if "moved_J" in energy:
        return energy["moved_J"]
    return max(abs(energy[f"{name}_J"]) for name in ("absorbed", "stored", "lost"))


def allowed_imbalance(summary: Mapping[str, Any]) -> float:
    """Largest relative error of the energy balance of a run that can be trusted."""
    return IMBALANCE_ALLOWED_WITH_FLOW if "flow" in summary else IMBALANCE_ALLOWED


def _energy(summary: Mapping[str, Any]) -> Iterator[str]:
    """An energy balance that does not close, heat that numerics have added."""
    energy = summary["energy"]
    if energy["imbalance_relative"] > allowed_imbalance(summary):
        share = "a ten-thousandth" if "flow" in summary else "a millionth"
        yield f"the energy balance does not close within {share} of the energy moved"
    for name in NUMERICAL:
        # one numerical term over the energy moved
        share = energy.get(f"{name}_max_J", 0.0) / max(energy_moved(energy), 1e-300)
        if share > NUMERICAL_ALLOWED:
            yield f"the {TERMS[name]} is {format_number(100.0 * share, 3)} % of the energy moved"


def _near_critical(vapor: Mapping[str, Any]) -> Iterator[str]:
    """A surface so hot that the curve of vapor pressure does not hold."""
    # near the critical point the curve of vapor pressure is an extrapolation
    if vapor.get("near_critical_start_s") is None:
        return
    place = vapor["near_critical_x_m"]
    where = "" if place is None else f", hottest at x = {format_quantity(place, 'm')}"
    yield (
        f"the surface was above {NEAR_CRITICAL:g} of its critical temperature of "
        f"{vapor['critical_K']:.0f} K from {format_quantity(vapor['near_critical_start_s'], 's')} "
        f"to {format_quantity(vapor['near_critical_end_s'], 's')}{where}: the curve of vapor "
        "pressure is an extrapolation there"
    )


def _held_at_boiling(summary: Mapping[str, Any]) -> Iterator[str]:
    """Metal that took up its whole heat of vaporization and stayed; ejecta tell of ablation."""
    depth = summary.get("vaporization", {}).get("depth_max_m")
    # ejecta tell of this already
    if not depth or "crater" in summary:
        return
    wrong = "the depth of the melt and the relief are" if _moves(summary) else "its depth is"
    yield (
        f"metal down to {format_quantity(depth, 'm')} took up its whole heat of vaporization and "
        f"was held at the boiling point, where it would have left as vapor: {wrong} not right; "
        'vaporization = "flux" in [solver] computes the vapor'
    )


def _thin_melt(summary: Mapping[str, Any]) -> Iterator[str]:
    """Melt that no cell holds to a half: its size is not resolved."""
    melt = summary.get("melt", {})
    if melt.get("depth_half_max_m") != 0.0:
        return
    yield (
        "metal began to melt, but no cell was half molten: its width and depth are not resolved, "
        "and 0 stands for them; take a finer spacing"
    )


def _resting_melt(summary: Mapping[str, Any]) -> Iterator[str]:
    """Completely fluid metal of which no particle flowed: the pool holds too few of them."""
    depth, spacing = summary.get("melt", {}).get("depth_max_m"), summary.get("spacing_m")
    flow = summary.get("flow", {})
    # a box of liquid has no pool; one that rests has its reason elsewhere
    if depth and spacing and flow.get("particles_max") == 0:
        yield (
            f"metal was fluid down to {format_quantity(depth, 'm', 3)}, but no particle flowed: "
            f"{format_quantity(spacing, 'm', 3)} are too coarse for such a pool, and its speed and "
            "relief of 0 say nothing; take a finer spacing"
        )


def _still_molten(summary: Mapping[str, Any], last: Mapping[str, Any]) -> Iterator[str]:
    """Melt at the end: of any fraction where the surface moves with it, else completely fluid."""
    melt, moves = summary.get("melt"), _moves(summary)
    if melt is None:
        return
    # a surface that moves needs all of the melt gone, else what was fluid
    is_left = melt["end_any_s"] == summary["time_s"] if moves else melt["molten_at_end"]
    if not is_left:
        return
    depth = last.get("melt_depth_any_m" if moves else "melt_depth_m")
    metal = f"metal down to {format_quantity(depth, 'm')}" if depth else "metal"
    late = "the relief is not final" if moves else "melting ends later than given"
    # a run that jumps over pauses is not resumed to a later end
    # a run that jumps over pauses is not resumed to a later end
    how = "compute it again" if _jumps(summary) else "go on"
    yield (
        f"{metal} was still {'molten' if moves else 'fluid'} at the end, "
        f"{format_quantity(summary['time_s'], 's')}: {late}; {how} with a later time.end"
    )


def _jumps(summary: Mapping[str, Any]) -> bool:
    """Whether pauses between pulses were jumped over."""
    return bool(summary.get("topography", {}).get("after_pulses_m"))


def _moves(summary: Mapping[str, Any]) -> bool:
    """Whether the surface moved."""
    return "topography" in summary
