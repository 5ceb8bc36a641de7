"""Electrons of a run with two temperatures: how hot they are, and how much heat is theirs."""

from __future__ import annotations

import numpy as np

from lasersph.input.key_units import unit_in
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View


class HotElectrons(Observer):
    """Observes the electrons of a run of a given dimension.

    The heat of electrons and of the lattice are sums over the particles; together they are what
    the energy budget calls stored.
    """

    title = "electrons"
    columns = (
        Quantity(
            "electrons.temperature_max_K",
            "K",
            "temperature of the electrons",
            largest="electrons.temperature_max_K",
            is_main=True,
        ),
        Quantity(
            "electrons.difference_max_K",
            "K",
            "difference of the temperatures of electrons and lattice",
            largest="electrons.difference_max_K",
        ),
        Quantity(
            "electrons.energy_J",
            "J",
            "heat of the electrons",
            largest="electrons.energy_max_J",
            end="electrons.energy_J",
        ),
        Quantity(
            "electrons.lattice_energy_J",
            "J",
            "heat of the lattice, latent heat included",
            end="electrons.lattice_energy_J",
        ),
    )
    results = (Quantity("electrons.unit", "", "unit of these energies"),)

    def __init__(self, dimension: int) -> None:
        super().__init__()
        self.unit = unit_in("J", dimension)

    def observe(self, view: View) -> Row:
        """Temperatures and energies at this step."""
        seen = view.electrons
        assert seen is not None
        difference = np.max(np.abs(seen.temperature - view.temperature))
        heat = float(np.sum(view.mass * seen.energy))
        lattice = float(np.sum(view.mass * (view.enthalpy - seen.energy)))
        hottest = float(np.max(seen.temperature))
        return self.record(view.time, (hottest, float(difference), heat, lattice))

    def values(self) -> dict[str, object]:
        """The unit of the energies."""
        return {"electrons.unit": self.unit}
