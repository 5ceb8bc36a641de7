"""Threshold of a case: the fluence at which melting, boiling or ablation begins, by bisection.

The case's own energy (fluence, intensity, pulse_energy or power, whichever it gives) is varied:
first doubled or halved until a run with the event and one without bracket the threshold, then the
bracket is halved until it is narrow enough. Every trial is a full run of the case.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from lasersph.lasers.laser import AMOUNTS
from lasersph.studies.variation import Run, changed, simulate

Event = Literal["melt", "vaporize", "ablate"]
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
    """An energy in SI with the unit in which a user thinks of it."""
    unit, factor = UNITS[key.rpartition(".")[2]]
    return f"{value * factor:.{digits}g} {unit}"


def threshold(
    case: Any,
    of: Event,
    out: Path,
    *,
    tolerance: float = 0.01,
    bracket: tuple[float, float] | None = None,
    largest_factor: float = 1024.0,
    run: Run = simulate,
    report: Callable[[str], None] | None = None,
) -> Threshold:
    """Energy at which the hottest spot just melts completely, just boils, or just ablates.

    Args:
        case: the case; its energy is the first guess.
        of: "melt" (f_m = 1 somewhere), "vaporize" (T_v reached) or "ablate" (a particle left, so
            that the threshold falls with the spacing).
        out: folder that receives the run folders of all trials.
        tolerance: half-width of the final bracket over its middle.
        bracket: a value without and one with the event, if known; both are run first.
        largest_factor: give up when the first guess times or over this factor does not bracket.
        run: how a case is run. report: called with one line after each run.

    Raises:
        ValueError: the material has no such event, no bracket is found, or `bracket` is none.
    """
    if not 0.0 < tolerance < 1.0:
        raise ValueError(f"the tolerance must lie between 0 and 1, not {tolerance}")
    name = next(name for name in AMOUNTS if getattr(case.laser, name) is not None)
    search = _Search(case, of, f"laser.{name}", out, run, report)
    if bracket is not None:
        below, above = sorted(bracket)
        if search.reached(below) or not search.reached(above):
            raise ValueError(
                f"{below:g} and {above:g} do not bracket the threshold; give one value below it "
                "and one above"
            )
    else:
        below, above = search.expand(getattr(case.laser, name), largest_factor)
    while above - below > tolerance * (above + below):
        middle = 0.5 * (below + above)
        below, above = (below, middle) if search.reached(middle) else (middle, above)
    return Threshold(of, search.key, below, above, tuple(search.trials))


class _Search:
    """Runs trials and keeps them."""

    def __init__(self, case, of: Event, key: str, out: Path, run: Run, report):
        self.case, self.of, self.key = case, of, key
        self.out, self.run, self.report = out, run, report
        self.trials: list[Trial] = []
        self.temperature = _event_temperature(case.material, of)

    def reached(self, value: float) -> bool:
        """Whether the event happens at this energy: one run."""
        number = len(self.trials) + 1
        folder = self.out / f"{number:02d}-{self.key.partition('.')[2]}-{value:.6g}"
        summary = self.run(changed(self.case, self.key, value), folder).summary
        hottest = float(summary["temperature_max_K"])
        if self.of == "melt":  # the liquidus alone is not enough where melting is isothermal
            reached = (summary.get("melt") or {}).get("start_s") is not None
        elif self.of == "ablate":
            reached = bool(summary["ejecta"]["count"])
        else:
            reached = hottest >= self.temperature * (1.0 - 1e-9)
        self.trials.append(Trial(value, reached, hottest))
        if self.report:
            word = "reached" if reached else "not reached"
            energy = f"{self.key} = {show_energy(self.key, value)}"
            self.report(f"run {number}: {energy}: {hottest:.1f} K, {word}")
        return reached

    def expand(self, guess: float, largest_factor: float) -> tuple[float, float]:
        """Double or halve the guess until it brackets the threshold."""
        factor = 0.5 if self.reached(guess) else 2.0
        here = guess
        while max(here / guess, guess / here) < largest_factor:
            following = here * factor
            if self.reached(following) == (factor > 1.0):
                low, high = sorted((here, following))
                return low, high
            here = following
        side = "above" if factor > 1.0 else "below"
        raise ValueError(
            f"the threshold to {self.of} lies {side} {show_energy(self.key, here)}, "
            f"{largest_factor:g} times away from the {self.key} of the case; give a bracket"
        )


def _event_temperature(material: Any, of: Event) -> float:
    """Temperature of the event [K]; ValueError where the material has none."""
    if of == "melt" and material.melting is not None:
        return material.melting.liquidus
    if of in ("vaporize", "ablate") and material.vaporization is not None:
        return material.vaporization.temperature
    data = {"melt": "melting", "vaporize": "vaporization", "ablate": "vaporization"}.get(of)
    if data is None:
        raise ValueError(f'no threshold of "{of}"; choose "melt", "vaporize" or "ablate"')
    raise ValueError(f"material {material.name!r} has no {data} data, so no threshold to {of}")
