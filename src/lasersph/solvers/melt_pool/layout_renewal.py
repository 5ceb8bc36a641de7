"""Particles laid out anew below a relief, so that what melts there next starts evenly."""

from __future__ import annotations

import numpy as np

from lasersph.particles.relief_layout import lay_below
from lasersph.solvers.conduction.body import Body
from lasersph.solvers.melt_pool.domain import PoolDomain
from lasersph.solvers.melt_pool.heat_pairs import HeatPairs
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds
from lasersph.solvers.step_control import StepFailed

EVEN = (0.7, 1.4)
"""Height of particles laid out below a relief over the spacing: more than one row would count as
that at the surface, which is a spacing thick, or none."""


class UnevenRelief(StepFailed):
    """The relief is too deep for the layers below it."""


class LayoutRenewal:
    """Lays the particles of a pool out below its surface while nothing flows.

    Attributes:
        volume: that they have gained by it so far [m^2].
    """

    def __init__(
        self, body: Body, domain: PoolDomain, kinds: ParticleKinds, pairs: HeatPairs
    ) -> None:
        self.body, self.domain, self.kinds, self.pairs = body, domain, kinds, pairs
        self.volume = 0.0

    def lay_out(self) -> None:
        """Lay the particles of the finest layers out evenly below the surface as it is.

        Their volume becomes what lies below it, and their mass that of the metal in it.

        Raises:
            UnevenRelief: the relief is too deep for these layers.
        """
        body, domain, surface = self.body, self.domain, self.domain.surface
        particles, backend = body.particles, body.backend
        height = np.zeros(body.filling.surface.size)
        if surface is not None and "surface_height" in surface.arrays:
            height = backend.to_host(surface.arrays["surface_height"])
        try:
            layout = lay_below(domain.layers, height)
        except ValueError as error:
            raise UnevenRelief(f"{error}; give a larger particles.fine_depth") from None
        least, most = (size / domain.spacing for size in layout.heights)
        if least < EVEN[0] or most > EVEN[1]:
            raise UnevenRelief(
                f"particles below the relief would be {least:.3g} to {most:.3g} spacings high; "
                "give a larger particles.fine_depth, or fewer pulses"
            )
        place, volume, mass = (
            np.array(backend.to_host(particles[name])) for name in ("position", "volume", "mass")
        )
        fine = layout.volume.size
        self.volume += float(np.sum(layout.volume) - np.sum(volume[:fine]))
        place[:, :fine], volume[:fine] = layout.position, layout.volume
        mass[:fine] = body.material.density_reference * layout.volume
        for name, values in (("position", place), ("volume", volume), ("mass", mass)):
            particles.set(name, values)
        # pairs of all particles that lie elsewhere now, and of those near them
        position = particles["position"]
        if surface is not None:
            surface.rest()
            surface.find(position)
        domain.cover_fine_layers()
        block = domain.block_for(position, self.kinds)
        has_row = backend.zeros(block.count)
        backend.fill(has_row, 1.0)
        block.find_pairs(position, has_row)
        self.pairs.renew(block)
