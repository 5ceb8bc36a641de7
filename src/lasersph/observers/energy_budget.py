"""Where the energy of the light went, and how well the balance closes.

    incident - reflected - transmitted = absorbed = stored + lost + removed + discarded

`transmitted` is the light that met nothing because a hole had been burnt through. `lost` leaves
through boundaries (negative where heat comes in), `removed` with evaporated material, `discarded`
is what the plateau rule `clip` cuts off. The imbalance is the difference between the two ends of
this line divided by the absorbed energy; in a run without light, by the heat that came in through
boundaries or was stored.
"""

from __future__ import annotations

from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity, unit_in
from lasersph.observers.view import View

TERMS = {
    "incident": "energy of the light",
    "absorbed": "absorbed energy",
    "reflected": "reflected energy",
    "transmitted": "energy through holes in the metal",
    "stored": "energy in the metal",
    "lost": "energy lost through boundaries",
    "removed": "energy removed with vapor",
    "discarded": "energy discarded by the plateau rule",
    "rescaled": "absorbed energy added so that the shares of moved particles sum up",
}
IMBALANCE_ALLOWED = 1e-6
"""Relative imbalance up to which a run can be trusted."""
IMBALANCE_ALLOWED_WITH_FLOW = 1e-4
"""The same for a run whose particles move and are shifted."""


class EnergyBudget(Observer):
    """Observes the energy budget of a run of a given dimension."""

    title = "energy"
    note = "In 1-D per unit area, in 2-D per unit length, of the part that is computed."
    columns = (
        *(
            Quantity(f"energy_{k}_J", "J", words, end=f"energy.{k}_J", is_main=k == "absorbed")
            for k, words in TERMS.items()
        ),
        Quantity(
            "energy_imbalance_relative",
            "",
            "energy imbalance, relative to the absorbed",
            end="energy.imbalance_relative",
            is_main=True,
        ),
    )
    results = (Quantity("energy.unit", "", "unit of the energies"),)

    def __init__(self, dimension: int) -> None:
        super().__init__()
        self.unit = unit_in("J", dimension)

    def observe(self, view: View) -> Row:
        """The terms since the start, and the relative imbalance."""
        terms = {name: float(view.energy.get(name, 0.0)) for name in TERMS}
        return self.record(view.time, (*terms.values(), relative_imbalance(terms)))

    def values(self) -> dict[str, object]:
        """The unit of the terms."""
        return {"energy.unit": self.unit}


def relative_imbalance(terms: dict[str, float]) -> float:
    """|incident - reflected - transmitted - stored - lost - removed - discarded| / absorbed."""
    absorbed = terms["incident"] - terms["reflected"] - terms["transmitted"]
    gone = terms["stored"] + terms["lost"] + terms["removed"] + terms["discarded"]
    scale = absorbed if absorbed > 0.0 else max(abs(terms["stored"]), abs(terms["lost"]))
    return abs(absorbed - gone) / scale if scale > 0.0 else 0.0
