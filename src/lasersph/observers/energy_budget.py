"""Where the energy of the light went, and how well the balance closes.

    incident - reflected - transmitted = absorbed = stored + lost + removed + discarded

`transmitted` is the light that met nothing because a hole had been burnt through. `lost` leaves
through boundaries (negative where heat comes in), `removed` with evaporated material, `discarded`
is what the plateau rule `clip` cuts off. The imbalance is the difference between the two ends of
this line divided by the absorbed energy; in a run without light, by the heat that came in through
boundaries or was stored.
"""

from __future__ import annotations

from typing import Any

from lasersph.observers.view import ENERGY_UNITS, View

TERMS: tuple[str, ...] = (
    "incident",
    "absorbed",
    "reflected",
    "transmitted",
    "stored",
    "lost",
    "removed",
    "discarded",
)
IMBALANCE_ALLOWED = 1e-6
"""Relative imbalance up to which a run is sound."""
IMBALANCE_ALLOWED_WITH_FLOW = 1e-4
"""The same for a run whose particles move and are shifted."""


class EnergyBudget:
    """Observes the energy budget of a run of a given dimension."""

    columns = (*(f"energy_{name}_J" for name in TERMS), "energy_imbalance_relative")

    def __init__(self, dimension: int) -> None:
        self.unit = ENERGY_UNITS[dimension]
        self.terms: dict[str, float] = dict.fromkeys(TERMS, 0.0)

    def observe(self, view: View) -> dict[str, float]:
        """The terms since the start, and the relative imbalance."""
        terms: dict[str, float] = {name: float(view.energy.get(name, 0.0)) for name in TERMS}
        self.terms = terms
        row = {f"energy_{name}_J": value for name, value in terms.items()}
        return {**row, "energy_imbalance_relative": relative_imbalance(terms)}

    def summary(self) -> dict[str, Any]:
        """`energy`: the unit, the terms at the end, the relative imbalance."""
        energy: dict[str, Any] = {"unit": self.unit}
        energy.update({f"{name}_J": value for name, value in self.terms.items()})
        energy["imbalance_relative"] = relative_imbalance(self.terms)
        return {"energy": energy}

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        return dict(self.terms)

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        self.terms = dict(state)


def relative_imbalance(terms: dict[str, float]) -> float:
    """|incident - reflected - transmitted - stored - lost - removed - discarded| / absorbed."""
    absorbed = terms["incident"] - terms["reflected"] - terms["transmitted"]
    gone = terms["stored"] + terms["lost"] + terms["removed"] + terms["discarded"]
    scale = absorbed if absorbed > 0.0 else max(abs(terms["stored"]), abs(terms["lost"]))
    return abs(absorbed - gone) / scale if scale > 0.0 else 0.0
