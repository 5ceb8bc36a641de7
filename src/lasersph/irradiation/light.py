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
"""Range of surface temperatures of the table of the reflectivity [K]."""


class Light(Protocol):
    """Laser light on particles.

    Attributes:
        deposit: (n,) absorbed by each particle in the step [J]. incident: what falls in the step.
            transmitted: what of it meets no particle [J]. rescaled: what was added to the deposits
            of the step so that they sum up [J].
    """

    deposit: Array
    incident: float
    transmitted: float
    rescaled: float

    def shine(self, start: float, end: float) -> None:
        """Fix the light from `start` to `end` [s]; sets `incident` and `transmitted`."""
        ...

    def absorb(self, temperature: Array) -> float:
        """Set `deposit` from temperatures (n,) [K]; returns its sum [J]."""
        ...


def energies(light: Light, absorbed: float) -> dict[str, float]:
    """Where the light of a step goes [J], when `absorbed` is absorbed: nothing is left over.

    `rescaled` is a part of what is absorbed.
    """
    return {
        "incident": light.incident,
        "absorbed": absorbed,
        "transmitted": light.transmitted,
        "reflected": light.incident - absorbed - light.transmitted,
        "rescaled": light.rescaled,
    }
