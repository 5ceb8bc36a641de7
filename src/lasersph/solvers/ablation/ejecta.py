"""Particles that leave in a step, and the mass and energy that they take along."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.materials import Material
from lasersph.physics.ejection import ejected_quantities
from lasersph.physics.evaporation import NO_CRITICAL_POINT, vapor_constants


class Ejecta(NamedTuple):
    """Particles that left: how many, and what they took along.

    Per area in 1-D, per length in 2-D.

    Attributes:
        mass: [kg]. energy: enthalpy, from the initial temperature on, and kinetic energy [J].
            kinetic: that part of it [J]. discarded: heat beyond the full enthalpy of the vapor that
            found nothing to go to [J]. work: kinetic energy that no heat has paid for [J].
    """

    number: int = 0
    mass: float = 0.0
    energy: float = 0.0
    kinetic: float = 0.0
    discarded: float = 0.0
    work: float = 0.0


class Vapor:
    """Constants of the vapor and the account of what leaves.

    Args:
        is_effusion: which velocity of the vapor. is_published: whether its pressure is the one
            that [Alshaer2017, eq. (5)] prints, with a latent heat that does not fall.
    """

    def __init__(
        self, backend: Backend, material: Material, *, is_effusion: bool, is_published: bool
    ) -> None:
        vaporization = material.vaporization
        if vaporization is None:
            raise ValueError(f"material {material.name!r} has no vaporization data")
        self.backend = backend
        self.temperature = vaporization.temperature
        self.gas_constant = vaporization.specific_gas_constant
        self.speed = {"R_s": self.gas_constant, "is_effusion": float(is_effusion)}
        self._constants = vapor_constants(vaporization)
        if is_published:
            self._constants["T_c"] = NO_CRITICAL_POINT

    def account(self, fields: Mapping[str, Array], rows: Rows | None, time: float) -> Ejecta:
        """Write `left_at` [s] and `p_v` [Pa] of what has just left; returns what it takes along.

        Args:
            fields: by symbol; kind, m, h, v, T, left_at, p_v. time: end of the step [s].
        """
        # one pass over the particles, with sums over those that leave in this step
        out = (fields["left_at"], fields["p_v"], None, None, None, None)
        given = {"reduce": (None, None, *4 * ("sum",)), "time": time, **self._constants}
        number, mass, energy, kinetic = self.backend.pointwise(
            ejected_quantities, fields, out, rows=rows, **given
        )
        return Ejecta(int(number), mass, energy + kinetic, kinetic)
