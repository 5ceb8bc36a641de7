"""Step of two temperatures: linearly implicit, extrapolated to the second order [Deuflhard1985].

A step of length s, with all coefficients as they are at its start:

    exchange   T_e after G alone, Q and the capacity C with which T_e answers to energy: exact for
               constant C_e, C_l and G (`physics.two_temperature`)
    electrons  (C + s K_e) x = E + s div(k_e grad T_e): T_e + x, and the energy S of each particle
    give       e and Q + r (1 - f) S, what the lattice gains
    lattice    (m dh/dP + s K_l) dP = gained + s (div(grad P) - q), plateaus held; h follows from
               the flows, so that what enters a plateau is latent heat

Both matrices are those of the pairs of one temperature, with other weights, and positive, so that
any step is stable. Energies follow from flows between particles: their sum is kept to rounding,
however well the equations are solved. Twice the result of two halves less that of one whole is of
second order; their difference is the error by which the step is chosen, or taken again.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from lasersph.physics import two_temperature as terms
from lasersph.solvers.conduction.electron_body import ElectronBody
from lasersph.solvers.conduction.electron_part import ElectronPart
from lasersph.solvers.conduction.state import HeatState
from lasersph.solvers.conduction.surface_exchange import SurfaceExchange
from lasersph.solvers.step_control import NotConverged, StepFailed

REJECTED = 4.0
"""Error over the wanted one from which a step is taken again, half as long. Cost: errors of the
next step are expected within 20 % of the wanted one."""
SAFETY = 0.9
"""Length of the next step over the one that would just have the wanted error. Cost: fewer steps
are taken twice."""
COLDEST_RISE = 1.0
"""Rise of the temperature to which errors are related at least [K]. Accuracy: a hundredth of a
degree is no error."""


class HotElectrons(StepFailed):
    """The electrons are hotter than the metal's tables know."""


class ElectronStep:
    """Whole steps of electrons and lattice.

    Attributes:
        newton, linear: iterations of the last step. error: of the last step, over the wanted one.
    """

    def __init__(self, body: ElectronBody, exchange: SurfaceExchange, wanted: float) -> None:
        """`wanted`: error of a step over the rise of the temperature."""
        backend, count = body.backend, body.count
        self.body, self.backend, self.wanted = body, backend, wanted
        self.part = ElectronPart(body, exchange)
        self.e_once, self.h_once = backend.zeros(count), backend.zeros(count)
        self.newton, self.error = 0, 0.0
        # tables and constants of the extrapolation
        self.tables = {key: body.lattice_tables[key] for key in ("h_nodes", "T_nodes")}
        self.tables |= body.electron_tables
        material = body.material
        self.c = float(material.heat_capacity_at(material.reference_temperature))
        self.cold = body.curve.initial_temperature

    @property
    def linear(self) -> int:
        """Linear iterations of the last step."""
        return self.part.linear

    def advance(self, state: HeatState, step: float, exchanged: float) -> dict[str, float]:
        """Energies after `step` [s] into the particles; returns those of the step [J].

        Raises:
            NotConverged: its error is too large. HotElectrons: they leave the tables.
        """
        now, half, end = state.time, state.time + 0.5 * step, state.time + step
        e, h = self.body.particles["electron_energy"], self.body.particles["enthalpy"]
        part, copy = self.part, self.backend.copy
        part.linear = 0
        # one whole step
        copy(e, part.e)
        copy(h, part.h)
        once = part.advance(now, end)
        copy(part.e, self.e_once)
        copy(part.h, self.h_once)
        # two halves of it, and both ways together
        copy(e, part.e)
        copy(h, part.h)
        first, second = part.advance(now, half), part.advance(half, end)
        self._extrapolate()
        booked = {
            name: first[name] + second[name] + (first[name] + second[name] - value)
            for name, value in once.items()
        }
        # the energies of light that the solver books
        found = self.body.light
        found.incident = booked.pop("incident")
        found.reflected, found.transmitted = booked.pop("reflected"), booked.pop("transmitted")
        copy(part.h, h)
        copy(part.e, e)
        return booked

    def next_step(self, step: float) -> float:
        """Length of a step that would have the wanted error, from that of the last [s]."""
        return step * SAFETY / sqrt(max(self.error, 1e-6))

    def _extrapolate(self) -> None:
        """Energies of second order into the part, from those after two halves and one whole step.

        Raises:
            NotConverged: the two ways differ too much. HotElectrons: T_e leaves the tables.
        """
        part = self.part
        fields = {"e": part.e, "h": part.h, "e_once": self.e_once, "h_once": self.h_once}
        found = self.backend.pointwise(
            terms.extrapolate,
            fields,
            (part.e, part.h, None, None, None, None, None),
            reduce=(None, None, "max", "max", "max", "min", "max"),
            c=self.c,
            **self.tables,
        )
        electrons, lattice, hottest, least, heat = found
        rise = max(hottest - self.cold, COLDEST_RISE)
        errors = electrons / rise, lattice / max(heat, COLDEST_RISE)
        self.error = max(errors) / self.wanted
        nodes = self.body.nodes
        assert nodes is not None
        if not np.isfinite(self.error) or self.error > REJECTED or least <= nodes.energy[0]:
            raise NotConverged(
                f"temperatures of electrons and lattice change by {self.error * self.wanted:.2g} "
                f"of their rise where the step is halved, allowed are {self.wanted:.2g}"
            )
        if hottest > nodes.hottest:
            raise HotElectrons(
                f"electrons are at {hottest:.0f} K, beyond the table of the metal, which ends at "
                f"{nodes.hottest:.0f} K; give less light (laser.fluence), or a table "
                "in material.electrons.heat_capacity that goes on"
            )
