"""Ejection by the enthalpy balance: what has taken up all latent heats leaves with them."""

from __future__ import annotations

from collections.abc import Mapping

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.irradiation.first_hit import FirstHitLight
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.physics.ejection import ejection_step_limit, enthalpy_departure
from lasersph.solvers.ablation.ejecta import Ejecta, Vapor

LIGHT_SHARE = 0.1
"""Share of the enthalpy of the vapor that a step of light may bring, so that layers leave one by
one. Accuracy: their times are known to a tenth of that between two; the energy balance is exact for
any."""


class EnthalpyEjection:
    """Particles leave when  h >= h_v = c_p (T_v - T_0) + L_m + L_v  and take exactly h_v along.

    The kinetic energy of the vapor is a part of h_v: as it expands from the surface it pays for its
    motion with its heat. What the last step brought beyond h_v goes down the columns of the light
    to what they uncover, and is discarded where they uncover nothing.

    Args:
        curve: caloric curve with a plateau at the vaporization temperature.
    """

    def __init__(
        self,
        backend: Backend,
        vapor: Vapor,
        curve: CaloricCurve,
        light: FirstHitLight,
        count: int,
        spacing: float,
    ) -> None:
        if curve.enthalpy_vaporized is None:
            raise ValueError("the enthalpy rule needs a caloric curve with a vaporization plateau")
        self.backend, self.vapor, self.light = backend, vapor, light
        self.spacing = spacing
        self.enthalpy_vaporized = curve.enthalpy_vaporized
        self._excess = backend.zeros(count)

    def longest_step(self, flux: float, density: float) -> float:
        """Longest step [s] at a flux absorbed by the surface [W/m^2]."""
        h_v = self.enthalpy_vaporized
        return ejection_step_limit(LIGHT_SHARE, density, self.spacing, h_v, flux)

    def eject(
        self,
        fields: Mapping[str, Array],
        pairs: NeighborList,
        rows: Rows | None,
        time: float,
        step: float,
    ) -> Ejecta:
        """Set kind, velocity, left_at and p_v of what leaves at `time`, the end of the step [s].

        Args:
            fields: by symbol; x, kind, v, h, T, m, E, exposed, normal, left_at, p_v.
        """
        # what has h >= h_v leaves with h_v along its normal, and gives what it has beyond
        kind, h = fields["kind"], fields["h"]
        rule = {"h_v": self.enthalpy_vaporized, "up": self.light.up, **self.vapor.speed}
        (excess,) = self.backend.pointwise(
            enthalpy_departure,
            {**fields, "light": fields["E"]},
            (kind, fields["v"], h, self._excess),
            rows=rows,
            reduce=(None, None, None, "sum"),
            **rule,
        )

        # mass and energy that it takes along
        ejecta = self.vapor.account(fields, rows, time)
        if excess == 0.0:
            return ejecta

        # the excess goes down the columns of the light, as far as they uncover anything
        given = self.light.pass_excess_down(self._excess, fields["x"], kind, h, fields["m"])
        return ejecta._replace(discarded=excess - given)
