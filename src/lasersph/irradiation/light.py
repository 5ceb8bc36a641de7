"""`Light`: what a step wants to know of the laser light on its particles.

    shine     fixes what falls in the step
    absorb    gives each particle its share, at the temperatures that it has then

`layered` light knows at what depth of a flat surface a particle lies and follows Beer and Lambert;
`first_hit` light finds the particles that lie open, whatever the surface looks like.
"""

from __future__ import annotations

from typing import Protocol

from lasersph.compute.array_types import Array

COLDEST, HOTTEST = 1.0, 2.0e4
"""Range of surface temperatures of the table of the reflectivity [K]. Format: it ends far above any
metal."""


class Light(Protocol):
    """Laser light on particles.

    Attributes:
        deposit: (n,) absorbed by each particle in the step [J]. incident: what falls in the step.
            reflected: what of it the surface throws back, at the temperatures of the last
            `absorb`. transmitted: what meets no particle, or passes through all of them [J].
    """

    deposit: Array
    incident: float
    reflected: float
    transmitted: float

    def shine(self, start: float, end: float) -> None:
        """Fix the light from `start` to `end` [s]; sets `incident`."""
        ...

    def absorb(self, temperature: Array) -> float:
        """Set `deposit`, `reflected` and `transmitted` from temperatures (n,) [K]; returns the sum
        of the deposits [J]."""
        ...


def energies(light: Light, absorbed: float) -> dict[str, float]:
    """Where the light of a step goes [J], when `absorbed` is absorbed.

    Each is a sum of its own; `unassigned` is what they leave of the incident light.
    """
    known = {"absorbed": absorbed, "reflected": light.reflected, "transmitted": light.transmitted}
    unassigned = light.incident - sum(known.values())
    return {"incident": light.incident, "unassigned": unassigned, **known}
