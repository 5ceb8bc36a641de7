"""Threshold of a case: the fluence at which melting, boiling or ablation begins, by bisection.

The case's own energy (fluence, intensity, pulse_energy or power, whichever it gives) is varied:
first doubled or halved until a run with the event and one without bracket the threshold, then the
bracket is halved until it is narrow enough. Every trial is a full run of the case. Several runs at
a time try what both outcomes of a run would ask for: three make two halvings in the time of one.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import ceil, log2
from os import PathLike
from pathlib import Path
from typing import Any, Literal

from lasersph.lasers.laser_keys import AMOUNTS
from lasersph.physics.ablation_estimates import PHASE_EXPLOSION
from lasersph.studies.variation import Prepare, Run, changed, simulate

Event = Literal["melt", "vaporize", "ablate", "explode"]
UNITS = {
    "fluence": ("J/cm^2", 1e-4),
    "intensity": ("W/cm^2", 1e-4),
    "pulse_energy": ("J", 1.0),
    "power": ("W", 1.0),
}
"""By the last part of the key: unit to show and its number of SI units."""


@dataclass(frozen=True)
class Trial:
    """One run: its energy in SI, whether the event happened, the highest temperature [K]."""

    value: float
    reached: bool
    temperature: float


@dataclass(frozen=True)
class Threshold:
    """Where the event begins: the key varied ("laser.fluence"), the highest value without and the
    lowest value with the event, in SI, and all trials in their order."""

    of: Event
    key: str
    below: float
    above: float
    trials: tuple[Trial, ...]

    @property
    def value(self) -> float:
        """Middle of the bracket."""
        return 0.5 * (self.below + self.above)

    @property
    def tolerance(self) -> float:
        """Half the width of the bracket over its middle."""
        return 0.5 * (self.above - self.below) / self.value


def show_energy(key: str, value: float, digits: int = 5) -> str:
    """An energy in SI with the unit in which a user thinks of it, always to as many digits."""
    unit, factor = UNITS[key.rpartition(".")[2]]
    return f"{f'{value * factor:#.{digits}g}'.rstrip('.')} {unit}"


def threshold(
    case: Any,
    of: Event,
    out: str | PathLike[str],
    *,
    tolerance: float = 0.01,
    bracket: tuple[float, float] | None = None,
    largest_factor: float = 1024.0,
    run: Run | None = None,
    prepare: Prepare | None = None,
    at_once: int = 1,
    report: Callable[[str], None] | None = None,
) -> Threshold:
    """Energy at which the hottest spot just melts completely, just boils, or just ablates.

        found = lasersph.threshold(lasersph.load_case("dlip-steel"), "melt", "runs/threshold")
        found.value, found.below, found.above  # J/m^2, where `found.key` is a fluence

    Args:
        case: the case; its energy is the first guess.
        of: "melt" (f_m = 1 somewhere), "vaporize" (T_v reached), "ablate" (a particle left, so
            that the threshold falls with the spacing) or "explode" (0.9 of the critical
            temperature reached, an estimate of ablation by short pulses).
        out: folder that receives the run folders of all trials.
        tolerance: half-width of the final bracket over its middle.
        bracket: a value without and one with the event, if known; both are run first.
        largest_factor: give up when the first guess times or over this factor does not bracket.
        run: how a case is run; None computes it. report: called with one line after each run.
        prepare: makes `at_once` runs at a time, the next one and those that may be wanted after
            it; the answer does not depend on how many.

    Raises:
        ValueError: the material has no such event, no bracket is found, or `bracket` is none.
    """
    if not 0.0 < tolerance < 1.0:
        raise ValueError(f"the tolerance must lie between 0 and 1, not {tolerance}")
    # one value after the other, with those ahead made at the same time
    search = _Search(case, of, Path(out), tolerance, bracket, largest_factor)
    while (value := search.following(search.known)) is not None:
        if prepare is not None and not (search.folder(value) / "summary.json").exists():
            prepare({search.folder(one): search.case_at(one) for one in search.ahead(at_once)})
        made = (run or simulate)(search.case_at(value), search.folder(value))
        trial = search.judge(value, made.summary)
        if report:
            word = "reached" if trial.reached else "not reached"
            energy = f"{search.key} = {show_energy(search.key, value)}"
            report(f"run {len(search.known)}: {energy}: {trial.temperature:.1f} K, {word}")

    # the bracket as found, or why there is none
    if search.bracket and (search.known[search.bracket[0]] or not search.known[search.bracket[1]]):
        raise ValueError(
            f"{search.bracket[0]:g} and {search.bracket[1]:g} do not bracket the threshold; give "
            "one value below it and one above"
        )
    below, above = search.ends(search.known)
    if below is None or above is None:
        here = search.trials[-1].value
        raise ValueError(
            f"the threshold to {of} lies {'below' if below is None else 'above'} "
            f"{show_energy(search.key, here)}, {largest_factor:g} times away from the {search.key} "
            "of the case; give a bracket"
        )
    return Threshold(of, search.key, below, above, tuple(search.trials))


def usual_runs(tolerance: float) -> int:
    """Runs of a search whose first guess lies within a factor of 2 of the threshold: two that
    bracket it, a third of their middle to either side, and halvings."""
    return 2 + max(0, ceil(log2(1.0 / (3.0 * tolerance))))


class _Search:
    """Outcomes known of a threshold, and the value to try next."""

    def __init__(
        self,
        case: Any,
        of: Event,
        out: Path,
        tolerance: float,
        bracket: tuple[float, float] | None,
        largest_factor: float,
    ) -> None:
        name = next(name for name in AMOUNTS if getattr(case.laser, name) is not None)
        self.case, self.of, self.key, self.out = case, of, f"laser.{name}", out
        self.tolerance, self.largest_factor = tolerance, largest_factor
        self.guess = getattr(case.laser, name)
        self.bracket = None if bracket is None else (min(bracket), max(bracket))
        self.trials: list[Trial] = []
        self.known: dict[float, bool] = {}
        self.temperature = _event_temperature(case.material, of)
        if of == "explode" and getattr(case.solver, "plateau", "") != "evaporate":
            raise ValueError(
                f"solver.plateau holds the boiling point, below the {self.temperature:.0f} K of "
                'an explosion; write plateau = "evaporate" in [solver]'
            )

    def case_at(self, value: float) -> Any:
        """The case with this energy."""
        return changed(self.case, self.key, value)

    def folder(self, value: float) -> Path:
        """Of the run with this energy, in the unit that `show_energy` has."""
        name = self.key.partition(".")[2]
        older = self.out / f"{name}-{value:.8g}"  # in SI, until November 2026
        return older if older.exists() else self.out / f"{name}-{value * UNITS[name][1]:.8g}"

    def ends(self, known: Mapping[float, bool]) -> tuple[float | None, float | None]:
        """The highest value without and the lowest with the event; None where none is known."""
        below = max((value for value, reached in known.items() if not reached), default=None)
        return below, min((value for value, reached in known.items() if reached), default=None)

    def following(self, known: Mapping[float, bool]) -> float | None:
        """The value to try next, were this known; None at the end, and where the bracket is none
        or nothing near the guess is one."""
        # first the given bracket, or the case's own energy
        for value in self.bracket or (self.guess,):
            if value not in known:
                return value
        if self.bracket and (known[self.bracket[0]] or not known[self.bracket[1]]):
            return None
        # bracketed: halve; else double or halve until it is
        below, above = self.ends(known)
        if below is not None and above is not None:
            is_narrow = above - below <= self.tolerance * (above + below)
            return None if is_narrow else 0.5 * (below + above)
        here, factor = (above, 0.5) if below is None else (below, 2.0)
        assert here is not None  # the guess is known
        is_near = max(here / self.guess, self.guess / here) < self.largest_factor
        return factor * here if is_near else None

    def ahead(self, count: int) -> list[float]:
        """The next value and those that would follow from what it and others may give, the soonest
        needed first: where all are run at a time, the search takes the same way in fewer rounds."""
        found, outcomes = dict[float, None](), deque([self.known])
        # breadth first: what is needed soonest comes first
        while outcomes and len(found) < count:
            known = outcomes.popleft()
            value = self.following(known)
            if value is not None:
                found[value] = None
                outcomes += [{**known, value: reached} for reached in (True, False)]
        return list(found)

    def judge(self, value: float, summary: dict[str, Any]) -> Trial:
        """Keep whether the event happened at this energy."""
        hottest = float(summary["temperature_max_K"])
        if self.of == "melt":  # the liquidus alone is not enough where melting is isothermal
            reached = (summary.get("melt") or {}).get("start_s") is not None
        elif self.of == "ablate":
            reached = bool(summary["ejecta"]["count"])
        else:
            reached = hottest >= self.temperature * (1.0 - 1e-9)
        self.known[value] = reached
        self.trials.append(Trial(value, reached, hottest))
        return self.trials[-1]


def _event_temperature(material: Any, of: Event) -> float:
    """Temperature of the event [K]; ValueError where the material has none."""
    vapor = material.vaporization
    if of == "explode" and vapor is not None and vapor.critical_temperature is not None:
        return PHASE_EXPLOSION * vapor.critical_temperature
    if of == "melt" and material.melting is not None:
        return material.melting.liquidus
    if of in ("vaporize", "ablate") and material.vaporization is not None:
        return material.vaporization.temperature
    data = {"melt": "melting", "vaporize": "vaporization", "ablate": "vaporization"}.get(of)
    data = "critical temperature in its vaporization" if of == "explode" else data
    if data is None:
        raise ValueError(
            f'no threshold of "{of}"; choose "melt", "vaporize", "ablate" or "explode"'
        )
    raise ValueError(f"material {material.name!r} has no {data} data, so no threshold to {of}")
