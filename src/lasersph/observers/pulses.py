"""The life of melt and boiling after each pulse of a train.

Between two pulses metal freezes: the first and the last time at which a whole run saw fluid metal
say nothing of how long it was there. The clock of a pulse begins with its period, as that of the
first does with the run, so that its times compare with those of the first.
"""

from __future__ import annotations

import numpy as np

from lasersph.observers.melt_pool import FULL, remaining_fraction
from lasersph.observers.observer import Observer, Row
from lasersph.observers.peak import Span
from lasersph.observers.quantity import Quantity
from lasersph.observers.vaporization import TOLERANCE
from lasersph.observers.view import View
from lasersph.output.pulse_starts import pulse_at

LIVES = {
    "melt": "completely fluid metal (f_m = 1) after each pulse",
    "boiling": "at the vaporization temperature or above after each pulse",
}


class Pulses(Observer):
    """Observes the pulses of a train.

    Args:
        count: pulses of the case. period: between their starts [s].
        starts: of the clock of each that begins within the run [s].
    """

    title = "pulses"
    note = "Times count from the start of the run; null where there was none after a pulse."
    results = (
        Quantity("pulses.count", "", "number of pulses"),
        Quantity("pulses.period_s", "s", "time between the starts of two pulses"),
        Quantity("pulses.starts_s", "s", "start of the clock of each pulse"),
        *(
            Quantity(f"pulses.{life}_{end}s_s", "s", f"{text} {words}")
            for life, words in LIVES.items()
            for end, text in (("start", "first"), ("end", "last"))
        ),
    )
    kept = ("span",)

    def __init__(self, count: int, period: float, starts: tuple[float, ...]) -> None:
        super().__init__()
        self.count, self.period, self.starts = count, period, starts
        self.span = {life: [Span() for _ in starts] for life in LIVES}

    def observe(self, view: View) -> Row:
        """Nothing goes to the history."""
        # the pulse that this time belongs to
        pulse = pulse_at(view.time, self.starts)
        fluid = bool(np.max(remaining_fraction(view)) >= FULL)
        self.span["melt"][pulse].update(fluid, view.time)
        # metal that boils, or lies at its boiling point but for rounding
        if view.vaporization is not None:
            hottest = float(np.max(view.temperature[view.surface]))
            boils = hottest >= view.vaporization * (1.0 - TOLERANCE)
            self.span["boiling"][pulse].update(boils, view.time)
        return self.record(view.time, ())

    def values(self) -> dict[str, object]:
        """Number, period and starts of the pulses, and when each life began and ended."""
        found: dict[str, object] = {
            "pulses.count": self.count,
            "pulses.period_s": self.period,
            "pulses.starts_s": list(self.starts),
        }
        for life, spans in self.span.items():
            found[f"pulses.{life}_starts_s"] = [span.first for span in spans]
            found[f"pulses.{life}_ends_s"] = [span.last for span in spans]
        return found
