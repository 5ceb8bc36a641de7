"""Where the energy of the light went, audited: what is stored is summed anew from the particles.

Solvers book what crosses the border of the metal and what their numerics add or take away; the
observer sums the fields. None of the two knows the other, so each of these can fail:

    light     unassigned = incident - reflected - transmitted - absorbed
    metal     absorbed + shifting + ejection work - lost - removed - discarded - pauses
                  = sum m h + kinetic energy,                            since the start
    ejecta    removed = sum m (h + v^2 / 2) of all that has left, where the run follows it

`energy.imbalance_relative` is the largest value over the run of the differences of the last two
lines together, over the largest so far of the light absorbed, the heat lost and the heat that the
particles hold, sum m |h|: what has warmed and what has cooled both count.
What the numerics do has numbers of its own, so that each fails by itself: light that no particle
took, heat that shifting added, heat that was cut off, work of an ejection that no heat pays for,
and the residual of the implicit steps, which is added to the enthalpies, so that it loses nothing.
Of each the largest magnitude over the run is given beside the value at the end, where what was
added and taken away again does not show.

Kinetic energy counts in runs with light. Models of flow without viscous heating and without work
by surface stress take it from no heat, so that it is a part of the imbalance: some 1e-6 in a melt
pool. What moves without light is driven by walls, gravity or its start, and only its heat counts.
"""

from __future__ import annotations

import numpy as np

from lasersph.input.key_units import unit_in
from lasersph.observers.ablation_view import CONDENSED, LEAVING
from lasersph.observers.flow_speed import kinetic_energy
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View

BOOKED = {
    "incident": "energy of the light",
    "absorbed": "absorbed energy",
    "reflected": "reflected energy",
    "transmitted": "energy through the metal or holes in it",
    "unassigned": "energy of the light that no particle took, or several did (negative)",
    "lost": "energy lost through boundaries",
    "removed": "energy removed with vapor",
    "discarded": "energy cut off at the full heat of vaporization",
    "shifting": "heat that particle shifting added",
    "ejection_work": "kinetic energy that no heat of the ejecta pays for",
    "pauses": "heat taken away in pauses between pulses that are jumped over",
    "newton_residual": "sum of the |residuals| of implicit steps, which joined the enthalpies",
}
"""Terms that solvers book since the start; a `View` holds them."""
NUMERICAL = ("unassigned", "discarded", "shifting", "ejection_work", "newton_residual")
"""Those of them that numerics or a rule bring in, and no physics."""
NUMERICAL_ALLOWED = 1e-4
"""Share of the energy moved from which a report warns of one: a hundredth of one percent, to which
the absorptivity of a metal is known at best."""
SUMMED = {
    "stored": "heat in the metal, summed from the particles",
    "latent": "latent heat in it",
    "kinetic": "kinetic energy of the metal, summed from the particles",
}
"""Terms that the observer sums from the fields."""
TERMS = BOOKED | SUMMED
IMBALANCE_ALLOWED = 1e-6
"""Relative imbalance up to which a run can be trusted: rounding of some 1e5 steps stays below."""
IMBALANCE_ALLOWED_WITH_FLOW = 1e-4
"""The same for a run whose particles flow, with the kinetic energy that no heat pays for."""


class EnergyBudget(Observer):
    """Observes the energy budget of a run of a given dimension."""

    title = "energy"
    note = (
        "In 1-D per unit area, in 2-D per unit length; of the whole where a half or a quarter is "
        "computed. The imbalance is relative to the largest so far of the energy absorbed, lost "
        "and held, sum m |h|."
    )
    columns = (
        *(
            Quantity(
                f"energy_{name}_J",
                "J",
                words,
                largest=f"energy.{name}_max_J" if name in NUMERICAL else "",
                end=f"energy.{name}_J",
                is_main=name == "absorbed",
            )
            for name, words in TERMS.items()
        ),
        Quantity(
            "energy_imbalance_relative",
            "",
            "energy imbalance, over the energy moved",
            largest="energy.imbalance_relative",
            is_main=True,
        ),
    )
    results = (
        Quantity("energy.moved_J", "J", "largest of the energy absorbed, lost and held, sum m |h|"),
        Quantity("energy.unit", "", "unit of the energies"),
    )
    kept = ("start", "scale")

    def __init__(self, dimension: int) -> None:
        super().__init__()
        self.unit = unit_in("J", dimension)
        self.start: float | None = None
        self.scale = 0.0

    def observe(self, view: View) -> Row:
        """The terms since the start, and the relative imbalance."""
        heat, latent, kinetic, ejecta = sum_energies(view)
        # a run that is resumed counts from its own start, which a checkpoint keeps
        if self.start is None:
            self.start = heat if view.step == 0 else 0.0
        terms = {name: float(view.energy.get(name, 0.0)) for name in BOOKED}
        terms |= {"stored": heat - self.start, "latent": latent, "kinetic": kinetic}
        # largest energy moved or held so far, over which the imbalance is given
        held = float(np.sum(np.abs(view.mass * view.enthalpy)))
        self.scale = max(self.scale, terms["absorbed"], abs(terms["lost"]), held)
        difference = abs(imbalance(terms)) + abs(terms["removed"] - ejecta)
        relative = difference / self.scale if self.scale > 0.0 else 0.0
        row = self.record(view.time, (*terms.values(), relative))
        # numerical terms may change sign: their largest size counts
        for name in NUMERICAL:
            self.peak[f"energy_{name}_J"].update(abs(terms[name]), view.time)
        return row

    def values(self) -> dict[str, object]:
        """The energy moved, and the unit of the terms."""
        return {"energy.moved_J": self.scale, "energy.unit": self.unit}


def imbalance(terms: dict[str, float]) -> float:
    """Energy that the metal has beyond what the bookings explain [J], by TERMS."""

    # what came, less what went, is what must be found in the fields
    came = terms["absorbed"] + terms["shifting"] + terms["ejection_work"]
    went = terms["lost"] + terms["removed"] + terms["discarded"] + terms["pauses"]
    # without light the motion was there from the start, and no heat pays for it
    kinetic = terms["kinetic"] if terms["incident"] > 0.0 else 0.0
    return terms["stored"] + kinetic - (came - went)


def sum_energies(view: View) -> tuple[float, float, float, float]:
    """Heat, latent heat and kinetic energy of the metal, energy of what has left it [J].

    Heat counts from the initial temperature on. Where no particle leaves, what evaporates is known
    from the booking alone, which then stands for the last one.
    """

    # latent heat by both changes of phase
    heat = view.mass * view.enthalpy
    latent = 0.0 * heat
    for latent_heat, fraction in zip(
        view.latent_heats, (view.melt_fraction, view.vapor_fraction), strict=True
    ):
        if latent_heat:
            latent = latent + latent_heat * (view.mass * fraction)

    # matter that stays as it is: all of it is metal
    if view.ablation is None:
        kinetic = 0.0 if view.flow is None else kinetic_energy(view)
        removed = float(view.energy.get("removed", 0.0))
        return float(np.sum(heat)), float(np.sum(latent)), kinetic, removed

    # matter that ablates: condensed, on its way, and gone
    stage, velocity = view.ablation.stage, view.ablation.velocity
    motion = 0.5 * view.mass * np.sum(velocity * velocity, axis=0)
    stays, is_condensed = stage <= LEAVING, stage <= CONDENSED
    return (
        float(np.sum(np.where(stays, heat, 0.0))),
        float(np.sum(np.where(stays, latent, 0.0))),
        float(np.sum(np.where(is_condensed, motion, 0.0))),
        float(np.sum(np.where(stays, 0.0, heat + motion))),
    )
